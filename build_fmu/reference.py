"""Reference experiment inside the FMU, in the layout of the layered standard FMI-LS-REF.

With the stimuli and results a user checks an import in any tool. The results come from the Python
reference of the controller, not from the binaries that they check.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from lxml import etree

from apnc_core.controller import Controller
from apnc_core.interface import Inputs, Outputs, Parameters
from apnc_core.schema import Causality, Type
from apnc_core.variables import Scalar, scalars
from build_fmu.options import BuildOptions

FOLDER: Final = "extra/org.fmi-standard.fmi-ls-ref"
TICKS: Final = 1080
"""Length of the experiment: 18 s at 60 Hz."""
TOLERANCE: Final = 1e-6
"""Results are written with six decimals, so they do not depend on the machine."""

_LS: Final = "http://fmi-standard.org/fmi-ls-manifest"
_TICKS_PER_S: Final = 60
_STRIDE_HZ: Final = 1.2
_STEERED_S: Final = (6, 8)
_LIFTED_S: Final = (9, 14.5)
"""Without loads the phases settle and the couplings switch on; then the robot stands again."""
_RESULTS: Final = (
    "theta_hip", "theta_knee", "gamma", "grf_expected", "phi", "g1", "d", "kappa", "tick",
)  # fmt: skip


def reference_files(options: BuildOptions) -> dict[str, bytes]:
    """Manifest, experiment, stimuli and results by their path in the FMU.

    Args:
        options: number of legs, naming and start values; FMI 2.0 only.
    """
    p = options.parameters()
    members = list(scalars(options.legs, options.naming))
    inputs = [m for m in members if m.variable.causality is Causality.input]
    shown = [m for m in members if m.variable.name in _RESULTS]
    stimuli = _stimuli(inputs, options.legs)
    return {
        f"{FOLDER}/fmi-ls-manifest.xml": _manifest(),
        f"{FOLDER}/experiments.exp": _experiments(p.Ts),
        f"{FOLDER}/stimuli.csv": _csv(inputs, stimuli, p.Ts),
        f"{FOLDER}/results.csv": _csv(shown, _results(p, inputs, shown, stimuli), p.Ts),
    }


def _stimuli(inputs: list[Scalar], legs: int) -> list[list[float]]:
    """Trotting loads, steering, a robot lifted off the ground and set down; rounded as written."""
    samples = []
    for n in range(TICKS + 1):
        t = n / _TICKS_PER_S
        lifted = _LIFTED_S[0] <= t < _LIFTED_S[1]
        sample = []
        for m in inputs:
            if m.variable.name == "grf":
                diagonal = (m.element + (m.element >= (legs + 1) // 2)) % 2
                lift = np.sin(2 * np.pi * _STRIDE_HZ * t + np.pi * diagonal + 0.1 * m.element)
                sample.append(0.0 if lifted else round(15.0 * max(0.0, float(lift)), 6))
            elif m.variable.name == "MI":
                sample.append(0.15)
            elif m.variable.name == "turn":
                sample.append(0.5 if _STEERED_S[0] <= t < _STEERED_S[1] else 0.0)
            else:
                sample.append(0.0)
        samples.append(sample)
    return samples


def _results(
    p: Parameters, inputs: list[Scalar], shown: list[Scalar], stimuli: list[list[float]]
) -> list[list[float]]:
    """What is read before the first step and after each step."""
    legs = sum(m.variable.name == "grf" for m in inputs)
    controller = Controller(p, legs)
    place = {(m.variable.name, m.element): i for i, m in enumerate(inputs)}
    grf = [place["grf", leg] for leg in range(legs)]
    samples: list[list[float]] = []
    for given in stimuli[:-1]:
        loads = np.array([given[i] for i in grf])
        outputs = controller.tick(
            Inputs(loads, given[place["MI", 0]], given[place["turn", 0]], reset=False)
        )
        samples.append(_sample(outputs, shown))
    # before the first step the outputs are those of tick 0, which none of the loads has touched
    start = Controller(p, legs).tick(Inputs(np.zeros(legs), reset=True))
    first = _sample(replace(start, tick=0), shown)
    return [first, *samples]


def _sample(outputs: Outputs, shown: list[Scalar]) -> list[float]:
    values = []
    for m in shown:
        value = np.atleast_1d(getattr(outputs, m.variable.name))
        values.append(float(value[m.element]))
    return values


def _csv(members: list[Scalar], samples: list[list[float]], Ts: float) -> bytes:
    lines = [",".join(["time", *(m.name for m in members)])]
    for n, sample in enumerate(samples):
        texts = [
            f"{value + 0.0:.6f}" if m.variable.type is Type.real else str(int(value))
            for m, value in zip(members, sample, strict=True)
        ]
        lines.append(",".join([repr(n * Ts), *texts]))
    # minus zero reads like a mistake
    return ("\n".join(lines) + "\n").replace("-0.000000", "0.000000").encode()


def _manifest() -> bytes:
    names = {"fmi-ls": _LS}
    root = etree.Element("fmiReferences", nsmap=names)
    root.set(f"{{{_LS}}}fmi-ls-name", "org.fmi-standard.fmi-ls-ref")
    root.set(f"{{{_LS}}}fmi-ls-version", "1.0.0-alpha.1")
    root.set(
        f"{{{_LS}}}fmi-ls-description",
        "Layered Standard providing information on related files included in an FMU.",
    )
    for source, role, kind, description in (
        ("experiments.exp", "experiment/smoke-test", "application/x-ma-hs-experiments",
         "trotting loads, steering, couplings on"),
        ("stimuli.csv", "testcase", "text/csv", "inputs of the experiment, held in between"),
        ("results.csv", "result", "text/csv", "outputs of the experiment after each step"),
        ("../../documentation/index.html", "document", "text/html", "what this FMU is"),
    ):  # fmt: skip
        etree.SubElement(
            root, "Related", source=source, role=role, type=kind, description=description
        )
    return _xml(root)


def _experiments(Ts: float) -> bytes:
    root = etree.Element("Experiments", name="Smoke test", description="Is the import right?")
    experiment = etree.SubElement(
        root,
        "Experiment",
        name="trot",
        description="trotting loads, steering, no load until the couplings switch on, loads again",
        tolerance=repr(TOLERANCE),
    )
    etree.SubElement(
        experiment,
        "TransientSimulation",
        startTime="0",
        stopTime=repr(TICKS * Ts),
        stepSize=repr(Ts),
    )
    etree.SubElement(experiment, "Stimuli", source="stimuli.csv", type="text/csv")
    etree.SubElement(experiment, "References", source="results.csv", type="text/csv")
    return _xml(root)


def _xml(root: etree._Element) -> bytes:
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text
