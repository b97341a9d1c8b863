"""Parameters, inputs and outputs of the controller, one field per variable of the table.

Generated from ``apnc_core/variables.py`` by ``python -m build_fmu.generate``; do not edit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from apnc_core.enumerations import CouplingSign, ForwardModel, KappaRule, Method, PhaseMeasure
from apnc_core.types import Array


@dataclass(frozen=True)
class Parameters:
    """Parameters; the defaults are the preset ``lilibot``.

    Attributes:
        Ts: time between two ticks of the controller ([s]).
        robot_weight: weight of the robot; half of it normalises the load ([N], Eq. 5).
        F_max: limit of the load over half the weight; a higher load, as in an impact or under a
            payload, counts as this value (Eq. 5).
        method: controller that runs.
        w11: self-weight of both neurons, w11 = w22 (Eq. 3).
        w12_0: cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12 (Eq. 3).
        bias: bias added to both activations; the paper has none (Eq. 1).
        o1_start: start output of neuron N1, the same for every leg (Eq. 2).
        o2_start: start output of neuron N2, the same for every leg (Eq. 2).
        a1: slope of the motor neuron of the hip ([rad], Eq. 4).
        a2: slope of the motor neuron of the knee ([rad], Eq. 4).
        b1: offset of the motor neuron of the hip ([rad], Eq. 4).
        b2: offset of the motor neuron of the knee ([rad], Eq. 4).
        turn_gain: relative change of the amplitudes at full steering (Eq. 4).
        A_f: retention of the fast learner (Eq. 7).
        B_f: learning rate of the fast learner (Eq. 7).
        A_s: retention of the slow learner (Eq. 8).
        B_s: learning rate of the slow learner (Eq. 8).
        alpha: scale of the expected load (Eq. 10).
        rho: shape of the expected load (Eq. 10).
        forward_model: how the expected load is computed (Eq. 10, 11).
        rbf_rate: learning rate of the radial-basis forward model (Eq. 10).
        phase_measure: how the relative phases are measured; the paper prints peak (Eq. 12).
        phase_filter: share of the new value per tick in the low-pass filter of the vector phase
            measure (Eq. 12).
        N: ticks in the mean of the relative phases (Eq. 14).
        sigma: threshold of d below which the phases count as stable ([rad], Eq. 16).
        kappa_rule: when the couplings switch on; the paper prints Eq. 16 (Eq. 16).
        kappa_hold: ticks that d stays at or below sigma before kappa switches on (Eq. 16).
        xi: gain of the neural communication (Eq. 17).
        feedback_kept: share of the sensory feedback that remains while the couplings are on; the
            equations have 1 (Eq. 5).
        coupling_sign: sign of the coupling term; the paper prints plus (Eq. 18).
        phi_frozen: true: the couplings use the phases measured when kappa switched on; false: the
            phases measured now, as printed in Eq. 17 (Eq. 17).
        MI_zero_resets: true: MI = 0 acts as reset; false: the oscillators keep running with w12 =
            w12_0, as printed in Eq. 3 (Eq. 3).
        stored: true: start with the stored gait phi_stored and the couplings on (Eq. 17).
        phi_stored: stored gait at the start: relative phase phi_1k, used if stored is true ([rad],
            n - 1 values, or empty for zeros, Eq. 17).
        gamma_tegotae: fixed feedback gain of the Tegotae baseline (Eq. 5).
        grf_reset: load over a quarter of the weight at which a rising load resets the phase
            (phase-resetting baseline).
    """

    Ts: float = 0.016666666666666666
    robot_weight: float = 24.525
    F_max: float = 1.0
    method: Method = Method.apnc
    w11: float = 1.4
    w12_0: float = 0.21
    bias: float = 0.0
    o1_start: float = 0.01
    o2_start: float = 0.01
    a1: float = 0.14
    a2: float = 0.15
    b1: float = -0.2
    b2: float = -0.2
    turn_gain: float = 1.0
    A_f: float = 0.57
    B_f: float = 0.17
    A_s: float = 0.99
    B_s: float = 0.0002
    alpha: float = 0.9
    rho: float = 0.99
    forward_model: ForwardModel = ForwardModel.low_pass_hip
    rbf_rate: float = 0.02
    phase_measure: PhaseMeasure = PhaseMeasure.vector
    phase_filter: float = 0.05
    N: int = 50
    sigma: float = 0.4
    kappa_rule: KappaRule = KappaRule.armed
    kappa_hold: int = 200
    xi: float = 0.01
    feedback_kept: float = 0.1
    coupling_sign: CouplingSign = CouplingSign.reversed
    phi_frozen: bool = True
    MI_zero_resets: bool = True
    stored: bool = False
    phi_stored: tuple[float, ...] = ()
    gamma_tegotae: float = 0.015
    grf_reset: float = 0.4


@dataclass(frozen=True)
class Inputs:
    """Inputs of one tick.

    Attributes:
        grf: load on the foot; a value that is not finite, negative or above 1000 weights counts as
            zero and raises fault ([N], shape (n,), Eq. 5).
        MI: modulatory input: sets the stepping frequency; limited to its range (Eq. 3).
        turn: steering, positive turns left: scales the amplitudes of the right legs up and of the
            left legs down; limited to its range (Eq. 4).
        reset: while true, oscillators, learners and forward models stay at their start state; the
            stored gait is kept.
    """

    grf: Array
    MI: float = 0.08
    turn: float = 0.0
    reset: bool = False


@dataclass(frozen=True)
class Outputs:
    """Outputs and local variables of one tick.

    Attributes:
        theta_hip: command of the hip joint, relative to the reference pose ([rad], shape (n,), Eq.
            4).
        theta_knee: command of the knee joint, relative to the reference pose ([rad], shape (n,),
            Eq. 4).
        o1: output of neuron N1 (shape (n,), Eq. 2).
        o2: output of neuron N2 (shape (n,), Eq. 2).
        gamma: gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), times
            feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines (shape
            (n,), Eq. 5, 9).
        grf_expected: expected load over half the weight (shape (n,), Eq. 10).
        f1: sensory feedback to neuron N1 (shape (n,), Eq. 5).
        f2: sensory feedback to neuron N2 (shape (n,), Eq. 5).
        g1: neural coupling to neuron N1, as added to its activation (shape (n,), Eq. 17).
        g2: neural coupling to neuron N2, as added to its activation (shape (n,), Eq. 17).
        fault: true while the load input of the leg cannot be used (shape (n,)).
        phi: relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2) ([rad], shape (n
            - 1,), Eq. 12).
        phi_memory: stored gait that is held now: relative phase phi_1k; zero while no gait is
            stored ([rad], shape (n - 1,), Eq. 17).
        d: distance of the relative phases from their mean ([rad], Eq. 15).
        kappa: 1 while the neural couplings are on, else 0 (Eq. 16).
        tick: number of ticks run since the start (Eq. 1).
        K_f: state of the fast learner (shape (n,), Eq. 7).
        K_s: state of the slow learner (shape (n,), Eq. 8).
    """

    theta_hip: Array
    theta_knee: Array
    o1: Array
    o2: Array
    gamma: Array
    grf_expected: Array
    f1: Array
    f2: Array
    g1: Array
    g2: Array
    fault: NDArray[np.bool_]
    phi: Array
    phi_memory: Array
    d: float
    kappa: float
    tick: int
    K_f: Array
    K_s: Array
