"""The controller: one tick of all blocks, in the order of the paper."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from apnc_core import (
    dual_rate_learner,
    forward_model,
    load,
    motor_neurons,
    neural_coupling,
    oscillator,
    phase_reset,
    sensory_feedback,
    tegotae,
)
from apnc_core.elementary import wrap
from apnc_core.enumerations import CouplingSign, ForwardModel, KappaRule, Method, PhaseMeasure
from apnc_core.interface import Inputs, Outputs, Parameters
from apnc_core.phase_acquisition import PeakMeasure, VectorMeasure
from apnc_core.phase_estimation import Stability, Switch
from apnc_core.types import Array
from apnc_core.variables import variable_named


@dataclass
class Circuits:
    """State of the legs' circuits, arrays of shape (n,); all legs start alike.

    ``theta_before`` is the command at n - 1 [rad] that the forward model takes. ``learned`` is the
    change of its kernels' weights since the start, shape (n, KERNELS).
    """

    o1: Array
    o2: Array
    K_f: Array
    K_s: Array
    grf_expected: Array
    theta_before: Array
    F_before: Array
    learned: Array

    @classmethod
    def start(cls, n_legs: int, p: Parameters) -> Circuits:
        """Start state; a robot that already stands does not touch down in the first tick."""

        def alike(value: float) -> Array:
            return np.full(n_legs, value)

        return cls(
            alike(p.o1_start),
            alike(p.o2_start),
            alike(0.0),
            alike(0.0),
            alike(0.0),
            alike(math.inf),
            alike(math.inf),
            np.zeros((n_legs, forward_model.KERNELS)),
        )


@dataclass
class StoredGait:
    """The stored gait: relative phases phi_1k [rad], and whether one is stored."""

    phi: Array
    on: bool = False


@dataclass
class Controller:
    """Adaptive neural controller of a legged robot, the readable reference of the FMU.

    Args:
        p: parameters.
        n_legs: number of legs, the right ones first.

    Raises:
        ValueError: ``phi_stored`` does not have ``n_legs - 1`` values.

    Pitfall: parameters are not checked against their ranges here; the FMU does that.
    """

    p: Parameters = field(default_factory=Parameters)
    n_legs: int = 4

    def __post_init__(self) -> None:
        """Start with the state that ``fmi2Reset`` gives the FMU."""
        relations = self.n_legs - 1
        if len(self.p.phi_stored) not in (0, relations):
            raise ValueError(
                f"phi_stored has {len(self.p.phi_stored)} values; "
                f"{self.n_legs} legs take {relations} or none"
            )
        phi = np.array(self.p.phi_stored if self.p.stored else [], dtype=np.float64)
        self.stored = StoredGait(phi if phi.size else np.zeros(relations), self.p.stored)
        self.ticks = 0
        self.MI = _start("MI")
        self.turn = _start("turn")
        self._restart()

    def _restart(self) -> None:
        self.circuits = Circuits.start(self.n_legs, self.p)
        peak = self.p.phase_measure == PhaseMeasure.peak
        self.acquisition: PeakMeasure | VectorMeasure = (
            PeakMeasure(self.n_legs) if peak else VectorMeasure(self.n_legs)
        )
        self.stability = Stability(self.n_legs, self.p.N)
        self.switch = Switch()

    def tick(self, inputs: Inputs) -> Outputs:
        """Run tick n.

        Args:
            inputs: loads and commands at the tick.

        Returns:
            Outputs at n. Joint commands depend on the state and on ``turn`` only, so a load acts
            on them from the next tick on.
        """
        p, c = self.p, self.circuits
        self.MI = _limited("MI", inputs.MI, self.MI)
        self.turn = _limited("turn", inputs.turn, self.turn)
        grf = np.asarray(inputs.grf, dtype=np.float64)
        F, fault = load.normalise(grf, p.robot_weight, p.F_max)
        scale = motor_neurons.amplitude_scale(self.turn, self.n_legs, p)
        self.ticks += 1
        if inputs.reset or (p.MI_zero_resets and self.MI == 0.0):
            return self._hold(scale, fault)

        theta_hip, theta_knee = motor_neurons.command(c.o1, c.o2, scale, p)
        if p.forward_model == ForwardModel.radial_basis:
            c.grf_expected, c.learned = forward_model.expect_learned(c.learned, c.o1, c.o2, F, p)

        angle = self.acquisition.update(c.o1, c.o2, p)
        d = self.stability.update(angle)
        kappa = self._kappa(angle, d)
        g1, g2 = self._coupling(angle, kappa)

        gamma = self._gain(kappa)
        f1, f2 = sensory_feedback.feedback(gamma, F, c.o1, c.o2)

        a1, a2 = oscillator.activation(c.o1, c.o2, self.MI, p)
        a1, a2 = a1 - f1 + g1, a2 - f2 + g2
        if p.method == Method.phase_reset:
            down = phase_reset.touched_down(F, c.F_before, p)
            at_touch_down = phase_reset.ACTIVATION_AT_TOUCH_DOWN
            a1, a2 = np.where(down, at_touch_down[0], a1), np.where(down, at_touch_down[1], a2)

        outputs = Outputs(
            theta_hip=theta_hip,
            theta_knee=theta_knee,
            o1=c.o1,
            o2=c.o2,
            gamma=gamma,
            grf_expected=c.grf_expected,
            f1=f1,
            f2=f2,
            g1=g1,
            g2=g2,
            fault=fault,
            phi=wrap(angle, -0.5 * math.pi),
            phi_memory=self.stored.phi,
            d=d,
            kappa=kappa,
            tick=self.ticks,
            K_f=c.K_f,
            K_s=c.K_s,
        )
        copy = theta_knee if p.forward_model == ForwardModel.low_pass_knee else theta_hip
        self._advance(copy, F, a1, a2)
        return outputs

    def _gain(self, kappa: float) -> Array:
        if self.p.method == Method.tegotae:
            return tegotae.gain(self.n_legs, self.p)
        if self.p.method == Method.phase_reset:
            return np.zeros(self.n_legs)
        gamma = dual_rate_learner.gain(self.circuits.K_f, self.circuits.K_s)
        return self.p.feedback_kept * gamma if kappa > 0.0 else gamma

    def _kappa(self, angle: Array, d: float) -> float:
        settled = self.switch.settled(d, self.p)
        if self.p.method != Method.apnc:
            return 0.0
        if settled and not self.stored.on:
            self.stored = StoredGait(wrap(angle, -0.5 * math.pi), True)
        if self.p.kappa_rule == KappaRule.printed:
            self.stored.on = settled
        return 1.0 if self.stored.on else 0.0

    def _coupling(self, angle: Array, kappa: float) -> tuple[Array, Array]:
        if kappa == 0.0:
            return np.zeros(self.n_legs), np.zeros(self.n_legs)
        p = self.p
        phi = self.stored.phi if p.phi_frozen else angle
        sign = 1.0 if p.coupling_sign == CouplingSign.printed else -1.0
        g1 = neural_coupling.couple(self.circuits.o1, phi, p.xi)
        g2 = neural_coupling.couple(self.circuits.o2, phi, p.xi)
        return sign * g1, sign * g2

    def _advance(self, theta: Array, F: Array, a1: Array, a2: Array) -> None:
        p, c = self.p, self.circuits
        if p.method in (Method.apnc, Method.apc):
            e = dual_rate_learner.error(F, c.grf_expected)
            c.K_f, c.K_s = dual_rate_learner.learn(c.K_f, c.K_s, e, p)
        if p.forward_model != ForwardModel.radial_basis:
            G = forward_model.stance_expected(theta, c.theta_before)
            c.grf_expected = forward_model.expect(c.grf_expected, G, p)
        c.theta_before = theta
        c.F_before = F
        c.o1, c.o2 = oscillator.output(a1), oscillator.output(a2)

    def _hold(self, scale: Array, fault: np.ndarray) -> Outputs:
        self._restart()
        c = self.circuits
        theta_hip, theta_knee = motor_neurons.command(c.o1, c.o2, scale, self.p)
        zero = np.zeros(self.n_legs)
        on = self.stored.on and self.p.method == Method.apnc
        return Outputs(
            theta_hip=theta_hip,
            theta_knee=theta_knee,
            o1=c.o1,
            o2=c.o2,
            gamma=zero,
            grf_expected=zero,
            f1=zero,
            f2=zero,
            g1=zero,
            g2=zero,
            fault=fault,
            phi=np.zeros(self.n_legs - 1),
            phi_memory=self.stored.phi,
            d=0.0,
            kappa=1.0 if on else 0.0,
            tick=self.ticks,
            K_f=zero,
            K_s=zero,
        )


def _start(name: str) -> float:
    start = variable_named(name).start
    assert start is not None
    return float(start)


def _limited(name: str, value: float, held: float) -> float:
    """``value`` limited to the range of its variable; ``held`` if it is not a number."""
    variable = variable_named(name)
    assert variable.min is not None and variable.max is not None
    if not math.isfinite(value):
        return held
    return min(max(value, variable.min), variable.max)
