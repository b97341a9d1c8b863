"""What lies in the FMU for people: documentation, licences, icon, reference experiment."""

from __future__ import annotations

import shutil
import struct
import subprocess
import zipfile
import zlib
from pathlib import Path, PurePosixPath

import fmpy
import numpy as np
import pytest
from lxml import etree, html

from apnc_core.variables import TABLE, scalars
from build_fmu.build import cached_fmu
from build_fmu.icon import SIZE
from build_fmu.options import BuildOptions, host_platform
from build_fmu.reference import FOLDER, TOLERANCE

ROOT = Path(__file__).resolve().parents[2]
VARIANTS = [(4, "structured"), (6, "structured"), (4, "flat")]


def built(legs: int, naming: str) -> Path:
    return cached_fmu(BuildOptions(legs, naming, (host_platform(),)))


def files(fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="session")
def contents(fmu4: Path) -> dict[str, bytes]:
    return files(fmu4)


@pytest.mark.parametrize(("legs", "naming"), VARIANTS)
def test_documentation_names_every_variable(legs: int, naming: str) -> None:
    page = html.fromstring(files(built(legs, naming))["documentation/index.html"])
    shown = {code.text for code in page.iter("code")}
    for v in TABLE:
        entries = [s.name for s in scalars(legs, naming) if s.variable is v]
        label = entries[0] if len(entries) == 1 else f"{entries[0]} ... {entries[-1]}"
        assert label in shown
    names = {s.name for s in scalars(legs, naming)}
    assert {name for name in names if name.endswith((".grf", "_grf"))} & set(
        " ".join(filter(None, shown)).split()
    )


def test_documentation_needs_nothing_from_the_network(contents: dict[str, bytes]) -> None:
    text = contents["documentation/index.html"].decode()
    page = html.fromstring(text)
    for element in page.iter():
        for attribute in ("src", "href"):
            target = element.get(attribute)
            if target is None or target.startswith("#"):
                if target:
                    assert page.get_element_by_id(target[1:]) is not None
                continue
            assert f"documentation/{target}" in contents, target
    assert "@import" not in text and "url(http" not in text and "<script" not in text


def test_documentation_shows_equations_and_a_diagram(contents: dict[str, bytes]) -> None:
    page = html.fromstring(contents["documentation/index.html"])
    numbers = " ".join(e.text_content() for e in page.find_class("eq"))
    for number in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 16, 17, 18):
        assert str(number) in numbers
    assert len(page.findall(".//math")) >= 13
    assert len(page.findall(".//svg//rect")) >= 8


def test_documentation_opens_in_a_browser(contents: dict[str, bytes], tmp_path: Path) -> None:
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        pytest.skip("chromium is missing (Debian package chromium)")
    page = tmp_path / "index.html"
    page.write_bytes(contents["documentation/index.html"])
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=2000"]
    options += ["--enable-logging=stderr", "--v=0", f"--user-data-dir={tmp_path / 'profile'}"]
    done = subprocess.run(
        [browser, *options, "--dump-dom", page.as_uri()],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert "CONSOLE" not in done.stderr
    dom = html.fromstring(done.stdout)
    assert len(dom.findall(".//math")) >= 13 and dom.find(".//h1").text == "Apnc"


def test_licences_are_those_of_the_project_and_of_the_headers(contents: dict[str, bytes]) -> None:
    assert contents["documentation/licenses/license.txt"] == (ROOT / "LICENSE").read_bytes()
    headers = contents["documentation/licenses/fmi_headers.txt"].decode()
    assert "Modelica Association" in headers and "2-Clause BSD" in headers
    # the clauses themselves, to their end
    assert "Redistributions in binary form" in headers
    assert headers.rstrip().endswith(("DAMAGE.", "DAMAGE.\n" + "-" * 76))


def test_icon_is_a_picture(contents: dict[str, bytes]) -> None:
    content = contents["model.png"]
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(content):
        length, kind = struct.unpack_from(">I4s", content, at)
        body = content[at + 8 : at + 8 + length]
        (checksum,) = struct.unpack_from(">I", content, at + 8 + length)
        assert checksum == zlib.crc32(kind + body)
        chunks[kind] = body
        at += 12 + length
    assert list(chunks) == [b"IHDR", b"IDAT", b"IEND"]
    assert struct.unpack(">IIBBBBB", chunks[b"IHDR"]) == (SIZE, SIZE, 8, 6, 0, 0, 0)
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(SIZE, 1 + 4 * SIZE)
    pixels = rows[:, 1:].reshape(SIZE, SIZE, 4)
    assert np.all(rows[:, 0] == 0)
    # transparent corners, an opaque middle, and more than one colour
    assert pixels[0, 0, 3] == 0 and pixels[SIZE // 2, SIZE // 2, 3] == 255
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 20


def test_manifest_of_the_reference_lists_what_is_there(contents: dict[str, bytes]) -> None:
    root = etree.fromstring(contents[f"{FOLDER}/fmi-ls-manifest.xml"])
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.tag == "fmiReferences"
    assert root.get(f"{space}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    assert root.get(f"{space}fmi-ls-version") and root.get(f"{space}fmi-ls-description")
    listed = set()
    for related in root.findall("Related"):
        path = PurePosixPath(FOLDER) / str(related.get("source"))
        parts: list[str] = []
        for part in path.parts:
            if part == "..":
                parts.pop()
            else:
                parts.append(part)
        listed.add("/".join(parts))
    assert listed <= set(contents)
    extra = {name for name in contents if name.startswith("extra/")}
    assert extra - {f"{FOLDER}/fmi-ls-manifest.xml"} <= listed


def reproduced(fmu: Path, tmp_path: Path, **start: float) -> dict[str, float]:
    """Largest difference of every result of the reference experiment, run as its file says."""
    content = files(fmu)
    root = etree.fromstring(content[f"{FOLDER}/experiments.exp"])
    experiment = root.find("Experiment")
    time = experiment.find("TransientSimulation")
    tables = {}
    for kind in ("Stimuli", "References"):
        source = experiment.find(kind).get("source")
        path = tmp_path / source
        path.write_bytes(content[f"{FOLDER}/{source}"])
        tables[kind] = fmpy.read_csv(str(path))
    expected = tables["References"]
    result = fmpy.simulate_fmu(
        str(fmu),
        start_time=float(time.get("startTime")),
        stop_time=float(time.get("stopTime")),
        step_size=float(time.get("stepSize")),
        output_interval=float(time.get("stepSize")),
        input=tables["Stimuli"],
        output=list(expected.dtype.names[1:]),
        start_values=start,
    )
    assert float(experiment.get("tolerance")) == TOLERANCE
    assert len(result) == len(expected) > 500
    return {name: float(np.abs(result[name] - expected[name]).max()) for name in result.dtype.names}


@pytest.mark.parametrize(("legs", "naming"), VARIANTS)
def test_reference_results_are_reproduced(legs: int, naming: str, tmp_path: Path) -> None:
    differences = reproduced(built(legs, naming), tmp_path)
    assert max(differences.values()) <= TOLERANCE, differences


def test_reference_results_see_the_couplings_switch_on_and_work_under_load(tmp_path: Path) -> None:
    for legs, naming in VARIANTS:
        content = files(built(legs, naming))
        (tmp_path / "results.csv").write_bytes(content[f"{FOLDER}/results.csv"])
        (tmp_path / "stimuli.csv").write_bytes(content[f"{FOLDER}/stimuli.csv"])
        results = fmpy.read_csv(str(tmp_path / "results.csv"))
        kappa = results["kappa"]
        assert kappa[0] == 0 and kappa[-1] == 1 and np.sum(np.diff(kappa) != 0) == 1
        load = fmpy.read_csv(str(tmp_path / "stimuli.csv"))["leg1_grf" if naming == "flat"
                                                            else "leg[1].grf"]  # fmt: skip
        assert load[kappa == 1].max() > 10
        g1 = results["leg1_g1" if naming == "flat" else "leg[1].g1"]
        assert np.abs(g1[kappa == 0]).max() == 0 and np.abs(g1[kappa == 1]).max() > 100 * TOLERANCE


def test_reference_follows_the_own_start_values_of_a_build(tmp_path: Path) -> None:
    settings = {"Ts": 0.01, "xi": 0.05, "robot_weight": 30.0}
    fmu = cached_fmu(BuildOptions(platforms=(host_platform(),), settings=settings))
    differences = reproduced(fmu, tmp_path)
    assert max(differences.values()) <= TOLERANCE, differences
    stored = BuildOptions(platforms=(host_platform(),), gait=(3.0, 3.1, 0.1))
    assert max(reproduced(cached_fmu(stored), tmp_path).values()) <= TOLERANCE


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("w11", 1.41),
        ("B_f", 0.05),
        ("alpha", 0.8),
        ("a2", 0.12),
        ("Ts", 0.01),
        # seen only once the couplings are on
        ("xi", 0.03),
        ("feedback_kept", 0.3),
        ("coupling_sign", 2),
        ("phi_frozen", False),
    ],
)
def test_reference_shows_a_wrong_parameter(
    fmu4: Path, tmp_path: Path, name: str, value: float
) -> None:
    differences = reproduced(fmu4, tmp_path, **{name: value})
    assert max(differences.values()) > 1000 * TOLERANCE
