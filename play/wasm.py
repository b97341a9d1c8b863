"""Controller and robot compiled to WebAssembly."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

import ziglang

from build_fmu import compile as compiler
from build_fmu.platforms import BuildError
from play.numbers import size_of

HERE: Final = Path(__file__).parent

_OPTIONS: Final = (
    *("-target", "wasm32-freestanding", "-Wl,--no-entry", "-s"),
    # square root and the like are instructions, and so is copying of memory
    *("-fhosted", "-mbulk-memory"),
)


def module(n_legs: int) -> bytes:
    """A WebAssembly module that asks for no imports, for a number of legs.

    Raises:
        BuildError: the compiler failed; the message holds its output.
    """
    # headers of a C library without that library
    include = Path(ziglang.__file__).parent / "lib" / "libc" / "include"
    source = HERE.parent / "fmu_src"
    c_files = [*sorted((source / "core").glob("*.c")), *sorted((source / "plant").glob("*.c"))]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "play.wasm"
        command = [
            *(sys.executable, "-m", "ziglang", "cc", *_OPTIONS, *compiler.FLAGS),
            *("-DPLANT_PLAIN", "-DPLANT_ONE_ROBOT", f"-DAPNC_LEGS={n_legs}"),
            f"-DPLAY_NUMBERS_SIZE={size_of(n_legs)}",
            *(
                "-isystem",
                str(include / "wasm-wasi-musl"),
                "-isystem",
                str(include / "generic-musl"),
            ),
            *(f"-I{part}" for part in (source / "core", source / "plant", HERE)),
            *(str(HERE / "play.c"), *map(str, c_files), "-o", str(file)),
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BuildError(f"compiler failed for the page:\n{done.stderr.strip()}")
        return file.read_bytes()
