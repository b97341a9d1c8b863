within Apnc.External;
class State "State of the C core; generated from the table of variables, do not edit"
  extends ExternalObject;

  function constructor "Fresh controller"
    extends Icons.Function;
    input Integer n "number of legs";
    input Types.Time Ts "time between two ticks of the controller";
    input Types.Force robot_weight "weight of the robot; half of it normalises the load (Eq. 5)";
    input Real F_max "limit of the load over half the weight; a higher load, as in an impact or under a payload, counts as this value (Eq. 5)";
    input Types.Method method "controller that runs";
    input Real w11 "self-weight of both neurons, w11 = w22 (Eq. 3)";
    input Real w12_0 "cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12 (Eq. 3)";
    input Real bias "bias added to both activations; the paper has none (Eq. 1)";
    input Real o1_start "start output of neuron N1, the same for every leg (Eq. 2)";
    input Real o2_start "start output of neuron N2, the same for every leg (Eq. 2)";
    input Types.Angle a1 "slope of the motor neuron of the hip (Eq. 4)";
    input Types.Angle a2 "slope of the motor neuron of the knee (Eq. 4)";
    input Types.Angle b1 "offset of the motor neuron of the hip (Eq. 4)";
    input Types.Angle b2 "offset of the motor neuron of the knee (Eq. 4)";
    input Real turn_gain "relative change of the amplitudes at full steering (Eq. 4)";
    input Real A_f "retention of the fast learner (Eq. 7)";
    input Real B_f "learning rate of the fast learner (Eq. 7)";
    input Real A_s "retention of the slow learner (Eq. 8)";
    input Real B_s "learning rate of the slow learner (Eq. 8)";
    input Real alpha "scale of the expected load (Eq. 10)";
    input Real rho "shape of the expected load (Eq. 10)";
    input Types.ForwardModel forward_model "how the expected load is computed (Eq. 10, 11)";
    input Real rbf_rate "learning rate of the radial-basis forward model (Eq. 10)";
    input Types.PhaseMeasure phase_measure "how the relative phases are measured; the paper prints peak (Eq. 12)";
    input Real phase_filter "share of the new value per tick in the low-pass filter of the vector phase measure (Eq. 12)";
    input Integer N "ticks in the mean of the relative phases (Eq. 14)";
    input Types.Angle sigma "threshold of d below which the phases count as stable (Eq. 16)";
    input Types.KappaRule kappa_rule "when the couplings switch on; the paper prints Eq. 16 (Eq. 16)";
    input Integer kappa_hold "ticks that d stays at or below sigma before kappa switches on (Eq. 16)";
    input Real xi "gain of the neural communication (Eq. 17)";
    input Real feedback_kept "share of the sensory feedback that remains while the couplings are on; the equations have 1 (Eq. 5)";
    input Types.CouplingSign coupling_sign "sign of the coupling term; the paper prints plus (Eq. 18)";
    input Boolean phi_frozen "true: the couplings use the phases measured when kappa switched on; false: the phases measured now, as printed in Eq. 17 (Eq. 17)";
    input Boolean MI_zero_resets "true: MI = 0 acts as reset; false: the oscillators keep running with w12 = w12_0, as printed in Eq. 3 (Eq. 3)";
    input Boolean stored "true: start with the stored gait phi_stored and the couplings on (Eq. 17)";
    input Types.Angle phi_stored[n - 1] "stored gait at the start: relative phase phi_1k, used if stored is true (Eq. 17)";
    input Real gamma_tegotae "fixed feedback gain of the Tegotae baseline (Eq. 5)";
    input Real grf_reset "load over a quarter of the weight at which a rising load resets the phase (phase-resetting baseline)";
    output State state "circuits and memory";
  external "C" state = apnc_modelica_new(
      n,
      Ts,
      robot_weight,
      F_max,
      method,
      w11,
      w12_0,
      bias,
      o1_start,
      o2_start,
      a1,
      a2,
      b1,
      b2,
      turn_gain,
      A_f,
      B_f,
      A_s,
      B_s,
      alpha,
      rho,
      forward_model,
      rbf_rate,
      phase_measure,
      phase_filter,
      N,
      sigma,
      kappa_rule,
      kappa_hold,
      xi,
      feedback_kept,
      coupling_sign,
      phi_frozen,
      MI_zero_resets,
      stored,
      phi_stored,
      gamma_tegotae,
      grf_reset)
    annotation (
      Include="#include \"apnc_modelica.h\"",
      IncludeDirectory="modelica://Apnc/Resources/Include");
  end constructor;

  function destructor "Frees the state"
    extends Icons.Function;
    input State state "circuits and memory";
  external "C" apnc_modelica_free(state)
    annotation (
      Include="#include \"apnc_modelica.h\"",
      IncludeDirectory="modelica://Apnc/Resources/Include");
  end destructor;
end State;
