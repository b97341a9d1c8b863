"""The binding of the plant in C: its header read as it is, one library, loaded once when needed."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from compilers import run, tool

from apnc_plant import library as binding
from apnc_plant.compiled import CompiledPlant
from apnc_plant.library import aligned_memory, declarations, library
from apnc_plant.robot import load_robot
from build_fmu import compile as compiler
from build_fmu import library as built
from build_fmu.library import headers, library_name, library_path, sources
from build_fmu.platforms import PLATFORMS, BuildError, host_platform

HOST = PLATFORMS[host_platform()]


def structs() -> list[str]:
    ffi, _ = library()
    names, _, _ = ffi.list_types()
    return [name for name in names if ffi.typeof(name).kind == "struct"]


def test_structs_lie_as_the_compiler_lays_them(tmp_path: Path) -> None:
    ffi, _ = library()
    expected, lines = [], []
    for name in structs():
        kind = ffi.typeof(name)
        expected.append(f"{name} {ffi.sizeof(kind)}")
        lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
        for field, place in kind.fields:
            expected.append(f"{name}.{field} {place.offset}")
            lines.append(f'printf("{name}.{field} %zu\\n", offsetof({name}, {field}));')
    assert len(expected) > 100
    for name, content in sources().items():
        (tmp_path / name).write_bytes(content)
    includes = '#include <stdio.h>\n#include "plant.h"\n#include "loop.h"\n'
    (tmp_path / "show.c").write_text(f"{includes}int main(void) {{ {' '.join(lines)} }}")
    run(tool("cc", "gcc"), "-std=c11", "show.c", "-o", "show", cwd=tmp_path)
    assert run(tmp_path / "show").splitlines() == expected


def test_every_function_of_the_headers_is_in_the_library() -> None:
    _, lib = library()
    text = declarations("\n".join(headers()))
    names = [name for name in dir(lib) if f"{name}(" in text]
    assert len(names) > 30
    for name in names:
        assert getattr(lib, name)


def test_declarations_are_what_is_neither_preprocessor_nor_c_plus_plus() -> None:
    header = (
        "#ifndef A_H\n#define A_H\n#include <stdint.h>\n#ifdef __cplusplus\nextern "
        '"C" {\n#endif\nint a(void);\n#ifdef __cplusplus\n}\n#endif\n#endif\n'
    )
    assert declarations(header).split() == ["int", "a(void);"]


def test_nothing_is_loaded_before_it_is_needed() -> None:
    code = (
        "import apnc_plant.compiled, apnc_plant.legged, exudyn_models.plant\n"
        "from apnc_plant import library\n"
        "print(library._loaded)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_threads_that_come_at_once_get_one_library(monkeypatch: pytest.MonkeyPatch) -> None:
    loads: list[object] = []

    def slowly() -> tuple[object, object]:
        time.sleep(0.05)
        loads.append(object())
        return loads[-1], None

    monkeypatch.setattr(binding, "_loaded", [])
    monkeypatch.setattr(binding, "_load", slowly)
    found: list[object] = []
    threads = [threading.Thread(target=lambda: found.append(library()[0])) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [loads[0]] * 8
    assert len(loads) == 1


def test_while_c_runs_other_threads_run_too() -> None:
    plant, done, counted = CompiledPlant(load_robot("lilibot")), threading.Event(), [0]
    zero = np.zeros(4)

    def count() -> None:
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.0)

    thread = threading.Thread(target=count)
    thread.start()
    begin, before = time.perf_counter(), counted[0]
    plant.advance(zero, zero, 300.0)
    took, after = time.perf_counter() - begin, counted[0]
    done.set()
    thread.join()
    assert took > 0.02
    # at a switch interval of 5 ms a thread that holds the lock lets others in only afterwards
    assert after - before > 1000 * took


@pytest.fixture
def nothing_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """No ready library and an empty cache."""
    monkeypatch.setattr(built, "READY", tmp_path / "ready")
    monkeypatch.setenv("APNC_CACHE", str(tmp_path / "cache"))
    (tmp_path / "ready").mkdir()
    return tmp_path


def test_without_library_and_compiler_one_line_says_what_to_install(
    nothing_there: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compiler, "compiler_version", str)
    with pytest.raises(BuildError, match="the C compiler is not installed: pip install ziglang"):
        library_path()
    (nothing_there / "ready" / library_name(HOST)).write_bytes(b"ready")
    assert library_path().read_bytes() == b"ready"
    assert not (nothing_there / "cache").exists()


def test_it_is_compiled_once(nothing_there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled: list[str] = []

    def compile_library(folder: Path, files: list[str], platform: object, *_: object) -> bytes:
        assert all((folder / name).is_file() for name in files)
        compiled.extend(files)
        return b"compiled"

    monkeypatch.setattr(compiler, "compile_library", compile_library)
    told: list[str] = []
    for _ in range(2):
        path = library_path(progress=told.append)
        assert path.is_relative_to(nothing_there / "cache")
        assert path.read_bytes() == b"compiled"
    assert compiled.count("plant.c") == 1
    assert told == [HOST.folder]


def test_its_name_changes_with_sources_and_platform(monkeypatch: pytest.MonkeyPatch) -> None:
    names = {library_name(platform) for platform in PLATFORMS.values()}
    assert len(names) == len(PLATFORMS)
    files = sources()
    changed = files | {"servo.h": files["servo.h"] + b"\n"}
    monkeypatch.setattr(built, "sources", lambda: changed)
    assert library_name(HOST) not in names


def test_memory_for_a_plant_begins_at_a_cache_line_and_is_empty() -> None:
    ffi, _ = library()
    for size in (1, 63, 64, 1000):
        at, owner = aligned_memory(size)
        assert int(ffi.cast("uintptr_t", at)) % 64 == 0
        assert at - ffi.cast("unsigned char *", owner) + size <= ffi.sizeof(owner)
        assert bytes(ffi.buffer(at, size)) == bytes(size)
    with pytest.raises(ValueError, match="robots of 2 to 64 legs"):
        aligned_memory(0)
