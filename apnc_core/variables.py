"""The table of variables: names, units, ranges, defaults and sources are written here alone.

``python -m build_fmu.generate`` writes the files that are made from it and kept in the repository,
``TARGETS`` in ``build_fmu/generate.py`` and ``build_fmu/modelica.py``: header and table in C,
``apnc_core/interface.py``, the page of variables and parts of the Modelica package. The model
description is made from it when an FMU is built.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from apnc_core.enumerations import (
    ENUMERATIONS,
    CouplingSign,
    ForwardModel,
    KappaRule,
    Method,
    PhaseMeasure,
)
from apnc_core.schema import VR_STRIDE, Causality, Scalar, Shape, Type, Variable, scalars_of
from apnc_core.variable_numbers import VARIABLE_NUMBERS

__all__ = [
    "N_WINDOW_MAX", "TABLE", "Scalar", "scalars", "value_reference", "variable_named",
    "variables_of",
]  # fmt: skip

N_WINDOW_MAX: Final = 256
"""Largest averaging window of Eq. 14 [ticks]; fixes the size of the C state."""


def _input(name: str, symbol: str, description: str, **rest: object) -> Variable:
    return Variable(name, symbol, description, Causality.input, **_with(rest, "continuous"))


def _parameter(name: str, symbol: str, description: str, **rest: object) -> Variable:
    return Variable(name, symbol, description, Causality.parameter, **_with(rest, "tunable"))


def _output(name: str, symbol: str, description: str, **rest: object) -> Variable:
    return Variable(name, symbol, description, Causality.output, **_with(rest, "discrete"))


def _local(name: str, symbol: str, description: str, **rest: object) -> Variable:
    return Variable(name, symbol, description, Causality.local, **_with(rest, "discrete"))


def _with(rest: dict[str, object], variability: str) -> dict[str, Any]:
    return {"variability": variability, **rest}


_PAPER = "paper"
_ROBOT = "authors' robot data"
_SEARCH = "found by search for this robot, docs/decisions/presets.md"
_METHOD, _MODEL, _MEASURE, _RULE, _SIGN = ENUMERATIONS

TABLE: Final[tuple[Variable, ...]] = (
    _input(
        "grf", "F", "load on the foot; a value that is not finite, negative or above 1000 weights "
        "counts as zero and raises fault",
        shape=Shape.leg, start=0.0, unit="N", nominal=10.0, equation="5",
    ),
    _input(
        "MI", "MI", "modulatory input: sets the stepping frequency; limited to its range",
        start=0.08, unit="1", min=0.0, max=1.0, nominal=0.1, equation="3", source=_PAPER,
    ),
    _input(
        "turn", "", "steering, positive turns left: scales the amplitudes of the right legs up "
        "and of the left legs down; limited to its range",
        start=0.0, unit="1", min=-1.0, max=1.0, nominal=1.0, equation="4",
    ),
    _input(
        "reset", "", "while true, oscillators, learners and forward models stay at their start "
        "state; the stored gait is kept",
        type=Type.boolean, variability="discrete", start=False,
    ),
    _parameter(
        "Ts", "T_s", "time between two ticks of the controller",
        variability="fixed", start=1 / 60, unit="s", min=1e-4, max=1.0, nominal=0.01,
        source="paper: 60 Hz",
    ),
    _parameter(
        "robot_weight", "m g", "weight of the robot; half of it normalises the load",
        start=24.525, unit="N", min=1e-3, max=1e6, nominal=10.0, equation="5",
        source="Lilibot: 2.5 kg",
    ),
    _parameter(
        "F_max", "", "limit of the load over half the weight; a higher load, as in an impact or "
        "under a payload, counts as this value",
        start=1.0, unit="1", min=0.0, max=2000.0, nominal=1.0, equation="5",
        source="paper: loads are normalised to [0, 1)",
    ),
    _parameter(
        "method", "", "controller that runs", type=Type.enumeration, enumeration=_METHOD,
        start=Method.apnc,
    ),
    _parameter(
        "w11", "w_11", "self-weight of both neurons, w11 = w22",
        start=1.4, unit="1", min=0.0, max=5.0, nominal=1.0, equation="3", source=_PAPER,
    ),
    _parameter(
        "w12_0", "w_12", "cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12",
        start=0.21, unit="1", min=0.0, max=2.0, nominal=0.1, equation="3", source=_PAPER,
    ),
    _parameter(
        "bias", "", "bias added to both activations; the paper has none",
        start=0.0, unit="1", min=-1.0, max=1.0, nominal=0.01, equation="1", source=_PAPER,
    ),
    _parameter(
        "o1_start", "o_1(0)", "start output of neuron N1, the same for every leg",
        variability="fixed", start=0.01, paper=0.01, unit="1", min=-1.0, max=1.0, nominal=0.1,
        equation="2", source="authors' code",
    ),
    _parameter(
        "o2_start", "o_2(0)", "start output of neuron N2, the same for every leg",
        variability="fixed", start=0.01, paper=0.01, unit="1", min=-1.0, max=1.0, nominal=0.1,
        equation="2", source="authors' code",
    ),
    _parameter(
        "a1", "a_1", "slope of the motor neuron of the hip",
        start=0.14, paper=0.14, unit="rad", min=0.0, max=1.6, nominal=0.1, equation="4",
        source=_ROBOT,
    ),
    _parameter(
        "a2", "a_2", "slope of the motor neuron of the knee",
        start=0.15, paper=0.14, unit="rad", min=0.0, max=1.6, nominal=0.1, equation="4",
        source=_SEARCH,
    ),
    _parameter(
        "b1", "b_1", "offset of the motor neuron of the hip",
        start=-0.2, paper=-0.2, unit="rad", display_unit="deg", min=-1.6, max=1.6, nominal=0.1,
        equation="4", source=_ROBOT,
    ),
    _parameter(
        "b2", "b_2", "offset of the motor neuron of the knee",
        start=-0.2, paper=-0.2, unit="rad", display_unit="deg", min=-1.6, max=1.6, nominal=0.1,
        equation="4", source=_ROBOT,
    ),
    _parameter(
        "turn_gain", "", "relative change of the amplitudes at full steering",
        start=1.0, unit="1", min=0.0, max=1.0, nominal=1.0, equation="4",
        source="the largest",
    ),
    _parameter(
        "A_f", "A_f", "retention of the fast learner",
        start=0.57, unit="1", min=0.0, max=1.0, nominal=1.0, equation="7", source=_PAPER,
    ),
    _parameter(
        "B_f", "B_f", "learning rate of the fast learner",
        start=0.17, paper=0.002, unit="1", min=0.0, max=1.0, nominal=0.01, equation="7",
        source=_SEARCH,
    ),
    _parameter(
        "A_s", "A_s", "retention of the slow learner",
        start=0.99, unit="1", min=0.0, max=1.0, nominal=1.0, equation="8", source=_PAPER,
    ),
    _parameter(
        "B_s", "B_s", "learning rate of the slow learner",
        start=0.0002, paper=0.0002, unit="1", min=0.0, max=1.0, nominal=0.001, equation="8",
        source=_PAPER,
    ),
    _parameter(
        "alpha", "alpha", "scale of the expected load",
        start=0.9, unit="1", min=0.0, max=1.0, nominal=1.0, equation="10", source=_PAPER,
    ),
    _parameter(
        "rho", "rho", "shape of the expected load",
        start=0.99, unit="1", min=0.0, max=1.0, nominal=1.0, equation="10", source=_PAPER,
    ),
    _parameter(
        "forward_model", "", "how the expected load is computed", type=Type.enumeration,
        enumeration=_MODEL, variability="fixed", start=ForwardModel.low_pass_hip,
        equation="10, 11", source=_PAPER,
    ),
    _parameter(
        "rbf_rate", "eta", "learning rate of the radial-basis forward model",
        start=0.02, unit="1", min=0.0, max=1.0, nominal=0.01, equation="10",
        source="chosen, docs/decisions/radial-basis.md",
    ),
    _parameter(
        "phase_measure", "", "how the relative phases are measured; the paper prints peak",
        type=Type.enumeration, enumeration=_MEASURE, variability="fixed",
        start=PhaseMeasure.vector, paper=PhaseMeasure.peak, equation="12", source="authors' code",
    ),
    _parameter(
        "phase_filter", "", "share of the new value per tick in the low-pass filter of the vector "
        "phase measure",
        start=0.05, paper=0.05, unit="1", min=1e-4, max=1.0, nominal=0.1, equation="12",
        source="authors' code, docs/decisions/phase-measure.md",
    ),
    _parameter(
        "N", "N", "ticks in the mean of the relative phases", type=Type.integer,
        variability="fixed", start=50, min=1, max=N_WINDOW_MAX, equation="14", source=_PAPER,
    ),
    _parameter(
        "sigma", "sigma", "threshold of d below which the phases count as stable",
        start=0.4, unit="rad", min=0.0, max=10.0, nominal=0.1, equation="16", source=_PAPER,
    ),
    _parameter(
        "kappa_rule", "", "when the couplings switch on; the paper prints Eq. 16",
        type=Type.enumeration, enumeration=_RULE, start=KappaRule.armed, paper=KappaRule.printed,
        equation="16", source="authors' code arms kappa; the hold is chosen",
    ),
    _parameter(
        "kappa_hold", "", "ticks that d stays at or below sigma before kappa switches on",
        type=Type.integer, start=200, min=1, max=1_000_000, equation="16",
        source="chosen, docs/decisions/kappa-rule.md",
    ),
    _parameter(
        "xi", "xi", "gain of the neural communication",
        start=0.01, paper=0.01, unit="1", min=0.0, max=1.0, nominal=0.01, equation="17",
        source=_PAPER,
    ),
    _parameter(
        "feedback_kept", "", "share of the sensory feedback that remains while the couplings are "
        "on; the equations have 1",
        start=0.1, paper=1.0, unit="1", min=0.0, max=1.0, nominal=1.0, equation="5",
        source="sections 3.2.1 and 4.3 let gamma become small once the couplings are on",
    ),
    _parameter(
        "coupling_sign", "", "sign of the coupling term; the paper prints plus",
        type=Type.enumeration, enumeration=_SIGN, start=CouplingSign.reversed,
        paper=CouplingSign.printed, equation="18", source="authors' code",
    ),
    _parameter(
        "phi_frozen", "", "true: the couplings use the phases measured when kappa switched on; "
        "false: the phases measured now, as printed in Eq. 17",
        type=Type.boolean, start=True, paper=False, equation="17", source="authors' code",
    ),
    _parameter(
        "MI_zero_resets", "", "true: MI = 0 acts as reset; false: the oscillators keep running "
        "with w12 = w12_0, as printed in Eq. 3",
        type=Type.boolean, start=True, paper=False, equation="3", source="authors' code",
    ),
    _parameter(
        "stored", "", "true: start with the stored gait phi_stored and the couplings on",
        type=Type.boolean, variability="fixed", start=False, equation="17",
    ),
    _parameter(
        "phi_stored", "phi_1k", "stored gait at the start: relative phase phi_1k, used if "
        "stored is true",
        shape=Shape.relation, variability="fixed", start=0.0, unit="rad", display_unit="deg",
        min=-7.0, max=7.0, nominal=1.0, equation="17",
    ),
    _parameter(
        "gamma_tegotae", "", "fixed feedback gain of the Tegotae baseline",
        start=0.015, unit="1", min=0.0, max=10.0, nominal=0.1, equation="5",
        source="authors' code: 0.03 for a load over the whole weight, not over its half",
    ),
    _parameter(
        "grf_reset", "", "load over a quarter of the weight at which a rising load resets the "
        "phase (phase-resetting baseline)",
        start=0.4, unit="1", min=0.0, max=10.0, nominal=1.0, source="authors' code",
    ),
    _output(
        "theta_hip", "theta_1", "command of the hip joint, relative to the reference pose",
        shape=Shape.leg, unit="rad", display_unit="deg", nominal=0.1,
        initial_from=("a1", "b1", "o1_start"), equation="4",
    ),
    _output(
        "theta_knee", "theta_2", "command of the knee joint, relative to the reference pose",
        shape=Shape.leg, unit="rad", display_unit="deg", nominal=0.1,
        initial_from=("a2", "b2", "o2_start"), equation="4",
    ),
    _output(
        "o1", "o_1", "output of neuron N1", shape=Shape.leg, unit="1", min=-1.0, max=1.0,
        nominal=1.0, initial_from=("o1_start",), equation="2",
    ),
    _output(
        "o2", "o_2", "output of neuron N2", shape=Shape.leg, unit="1", min=-1.0, max=1.0,
        nominal=1.0, initial_from=("o2_start",), equation="2",
    ),
    _output(
        "gamma", "gamma", "gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), "
        "times feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines",
        shape=Shape.leg, unit="1", nominal=0.01, equation="5, 9",
    ),
    _output(
        "grf_expected", "F^e", "expected load over half the weight", shape=Shape.leg, unit="1",
        nominal=1.0, equation="10",
    ),
    _output(
        "f1", "f_1", "sensory feedback to neuron N1", shape=Shape.leg, unit="1", nominal=0.01,
        equation="5",
    ),
    _output(
        "f2", "f_2", "sensory feedback to neuron N2", shape=Shape.leg, unit="1", nominal=0.01,
        equation="5",
    ),
    _output(
        "g1", "g_1", "neural coupling to neuron N1, as added to its activation", shape=Shape.leg,
        unit="1", nominal=0.01, equation="17",
    ),
    _output(
        "g2", "g_2", "neural coupling to neuron N2, as added to its activation", shape=Shape.leg,
        unit="1", nominal=0.01, equation="17",
    ),
    _output(
        "fault", "", "true while the load input of the leg cannot be used",
        type=Type.boolean, shape=Shape.leg,
    ),
    _output(
        "phi", "phi_1k", "relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2)",
        shape=Shape.relation, unit="rad", display_unit="deg", nominal=1.0, equation="12",
    ),
    _output(
        "phi_memory", "phi_1k", "stored gait that is held now: relative phase phi_1k; zero while "
        "no gait is stored", shape=Shape.relation, unit="rad", display_unit="deg", nominal=1.0,
        initial_from=("stored", "phi_stored"), equation="17",
    ),
    _output("d", "d", "distance of the relative phases from their mean", unit="rad", nominal=0.1,
            equation="15"),
    _output("kappa", "kappa", "1 while the neural couplings are on, else 0", unit="1", min=0.0,
            max=1.0, nominal=1.0, initial_from=("method", "stored"), equation="16"),
    _output("tick", "n", "number of ticks run since the start", type=Type.integer, equation="1"),
    _local("K_f", "K_f", "state of the fast learner", shape=Shape.leg, unit="1", nominal=0.01,
           equation="7"),
    _local("K_s", "K_s", "state of the slow learner", shape=Shape.leg, unit="1", nominal=0.01,
           equation="8"),
)  # fmt: skip


def scalars(n_legs: int = 4, naming: str = "structured") -> Iterator[Scalar]:
    """All scalar variables of the controller, see :func:`apnc_core.schema.scalars_of`.

    Args:
        n_legs: number of legs, 2 to 64.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``).

    Raises:
        ValueError: number of legs or naming outside what is allowed.
    """
    return scalars_of(TABLE, VARIABLE_NUMBERS, n_legs, naming)


def value_reference(name: str) -> int:
    """Value reference of the first entry of a variable.

    Raises:
        KeyError: the variable has no number yet; ``python -m build_fmu.generate`` gives it one.
    """
    return VR_STRIDE * VARIABLE_NUMBERS[name]


def variables_of(causality: Causality) -> tuple[Variable, ...]:
    """The variables of one causality, in the order of the table."""
    return tuple(v for v in TABLE if v.causality is causality)


def variable_named(name: str) -> Variable:
    """The variable of that name.

    Raises:
        KeyError: no such variable.
    """
    for variable in TABLE:
        if variable.name == name:
            return variable
    raise KeyError(f"no variable '{name}' in the table")
