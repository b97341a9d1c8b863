within Apnc;
package Parameters "Parameters by block; generated from the table of variables, do not edit"
  extends Icons.Package;

  record Legs "Structure"
    parameter Integer n(min=2, max=64)=4 "number of legs, the right ones first"
      annotation (Evaluate=true, Dialog(group="Structure"));
  end Legs;

  record Sampling "Parameters: Sampling"
    parameter Types.Time Ts(min=0.0001, max=1.0)=0.016666666666666666
      "time between two ticks of the controller"
      annotation (Dialog(group="Sampling"));
  end Sampling;

  record Method "Parameters: Method"
    parameter Types.Method method=Types.Method.apnc
      "controller that runs"
      annotation (Dialog(group="Method"));
  end Method;

  record Commands "Parameters: Commands"
    parameter Boolean MI_zero_resets=true
      "true: MI = 0 acts as reset; false: the oscillators keep running with w12 = w12_0, as printed in Eq. 3 (Eq. 3)"
      annotation (Dialog(group="Commands"));
  end Commands;

  record FootLoad "Parameters: FootLoad"
    parameter Types.Force robot_weight(min=0.001, max=1000000.0)=24.525
      "weight of the robot; half of it normalises the load (Eq. 5)"
      annotation (Dialog(group="FootLoad"));
    parameter Real F_max(unit="1", min=0.0, max=2000.0)=1.0
      "limit of the load over half the weight; a higher load, as in an impact or under a payload, counts as this value (Eq. 5)"
      annotation (Dialog(group="FootLoad"));
  end FootLoad;

  record Oscillator "Parameters: Oscillator"
    parameter Real w11(unit="1", min=0.0, max=5.0)=1.4
      "self-weight of both neurons, w11 = w22 (Eq. 3)"
      annotation (Dialog(group="Oscillator"));
    parameter Real w12_0(unit="1", min=0.0, max=2.0)=0.21
      "cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12 (Eq. 3)"
      annotation (Dialog(group="Oscillator"));
    parameter Real bias(unit="1", min=-1.0, max=1.0)=0.0
      "bias added to both activations; the paper has none (Eq. 1)"
      annotation (Dialog(group="Oscillator"));
    parameter Real o1_start(unit="1", min=-1.0, max=1.0)=0.01
      "start output of neuron N1, the same for every leg (Eq. 2)"
      annotation (Dialog(group="Oscillator"));
    parameter Real o2_start(unit="1", min=-1.0, max=1.0)=0.01
      "start output of neuron N2, the same for every leg (Eq. 2)"
      annotation (Dialog(group="Oscillator"));
  end Oscillator;

  record MotorNeurons "Parameters: MotorNeurons"
    parameter Types.Angle a1(min=0.0, max=1.6)=0.14
      "slope of the motor neuron of the hip (Eq. 4)"
      annotation (Dialog(group="MotorNeurons"));
    parameter Types.Angle a2(min=0.0, max=1.6)=0.15
      "slope of the motor neuron of the knee (Eq. 4)"
      annotation (Dialog(group="MotorNeurons"));
    parameter Types.Angle b1(displayUnit="deg", min=-1.6, max=1.6)=-0.2
      "offset of the motor neuron of the hip (Eq. 4)"
      annotation (Dialog(group="MotorNeurons"));
    parameter Types.Angle b2(displayUnit="deg", min=-1.6, max=1.6)=-0.2
      "offset of the motor neuron of the knee (Eq. 4)"
      annotation (Dialog(group="MotorNeurons"));
    parameter Real turn_gain(unit="1", min=0.0, max=1.0)=1.0
      "relative change of the amplitudes at full steering (Eq. 4)"
      annotation (Dialog(group="MotorNeurons"));
  end MotorNeurons;

  record SensoryFeedback "Parameters: SensoryFeedback"
    parameter Real feedback_kept(unit="1", min=0.0, max=1.0)=0.1
      "share of the sensory feedback that remains while the couplings are on; the equations have 1 (Eq. 5)"
      annotation (Dialog(group="SensoryFeedback"));
    parameter Real gamma_tegotae(unit="1", min=0.0, max=10.0)=0.015
      "fixed feedback gain of the Tegotae baseline (Eq. 5)"
      annotation (Dialog(group="SensoryFeedback"));
  end SensoryFeedback;

  record DualRateLearner "Parameters: DualRateLearner"
    parameter Real A_f(unit="1", min=0.0, max=1.0)=0.57
      "retention of the fast learner (Eq. 7)"
      annotation (Dialog(group="DualRateLearner"));
    parameter Real B_f(unit="1", min=0.0, max=1.0)=0.17
      "learning rate of the fast learner (Eq. 7)"
      annotation (Dialog(group="DualRateLearner"));
    parameter Real A_s(unit="1", min=0.0, max=1.0)=0.99
      "retention of the slow learner (Eq. 8)"
      annotation (Dialog(group="DualRateLearner"));
    parameter Real B_s(unit="1", min=0.0, max=1.0)=0.0002
      "learning rate of the slow learner (Eq. 8)"
      annotation (Dialog(group="DualRateLearner"));
  end DualRateLearner;

  record ForwardModel "Parameters: ForwardModel"
    parameter Real alpha(unit="1", min=0.0, max=1.0)=0.9
      "scale of the expected load (Eq. 10)"
      annotation (Dialog(group="ForwardModel"));
    parameter Real rho(unit="1", min=0.0, max=1.0)=0.99
      "shape of the expected load (Eq. 10)"
      annotation (Dialog(group="ForwardModel"));
    parameter Types.ForwardModel forward_model=Types.ForwardModel.low_pass_hip
      "how the expected load is computed (Eq. 10, 11)"
      annotation (Dialog(group="ForwardModel"));
    parameter Real rbf_rate(unit="1", min=0.0, max=1.0)=0.02
      "learning rate of the radial-basis forward model (Eq. 10)"
      annotation (Dialog(group="ForwardModel"));
  end ForwardModel;

  record TouchDown "Parameters: TouchDown"
    parameter Real grf_reset(unit="1", min=0.0, max=10.0)=0.4
      "load over a quarter of the weight at which a rising load resets the phase (phase-resetting baseline)"
      annotation (Dialog(group="TouchDown"));
  end TouchDown;

  record PhaseAcquisition "Parameters: PhaseAcquisition"
    parameter Types.PhaseMeasure phase_measure=Types.PhaseMeasure.vector
      "how the relative phases are measured; the paper prints peak (Eq. 12)"
      annotation (Dialog(group="PhaseAcquisition"));
    parameter Real phase_filter(unit="1", min=0.0001, max=1.0)=0.05
      "share of the new value per tick in the low-pass filter of the vector phase measure (Eq. 12)"
      annotation (Dialog(group="PhaseAcquisition"));
  end PhaseAcquisition;

  record KappaRule "Parameters: KappaRule"
    parameter Types.KappaRule kappa_rule=Types.KappaRule.armed
      "when the couplings switch on; the paper prints Eq. 16 (Eq. 16)"
      annotation (Dialog(group="KappaRule"));
  end KappaRule;

  record PhaseEstimation "Parameters: PhaseEstimation"
    parameter Integer N(min=1, max=256)=50
      "ticks in the mean of the relative phases (Eq. 14)"
      annotation (Evaluate=true, Dialog(group="PhaseEstimation"));
    parameter Types.Angle sigma(min=0.0, max=10.0)=0.4
      "threshold of d below which the phases count as stable (Eq. 16)"
      annotation (Dialog(group="PhaseEstimation"));
    parameter Integer kappa_hold(min=1, max=1000000)=200
      "ticks that d stays at or below sigma before kappa switches on (Eq. 16)"
      annotation (Dialog(group="PhaseEstimation"));
  end PhaseEstimation;

  record NeuralCoupling "Parameters: NeuralCoupling"
    extends Legs;
    parameter Real xi(unit="1", min=0.0, max=1.0)=0.01
      "gain of the neural communication (Eq. 17)"
      annotation (Dialog(group="NeuralCoupling"));
    parameter Types.CouplingSign coupling_sign=Types.CouplingSign.reversed
      "sign of the coupling term; the paper prints plus (Eq. 18)"
      annotation (Dialog(group="NeuralCoupling"));
    parameter Boolean phi_frozen=true
      "true: the couplings use the phases measured when kappa switched on; false: the phases measured now, as printed in Eq. 17 (Eq. 17)"
      annotation (Dialog(group="NeuralCoupling"));
    parameter Boolean stored=false
      "true: start with the stored gait phi_stored and the couplings on (Eq. 17)"
      annotation (Dialog(group="NeuralCoupling"));
    parameter Types.Angle phi_stored[n - 1](each displayUnit="deg", each min=-7.0, each max=7.0)=fill(0.0, n - 1)
      "stored gait at the start: relative phase phi_1k, used if stored is true (Eq. 17)"
      annotation (Dialog(group="NeuralCoupling"));
  end NeuralCoupling;

  annotation (Documentation(info="<html>
<p>Every parameter stands here once, with its default, unit and range. The blocks extend the record
of their name. The defaults are those with which Lilibot walks; see
<a href=\"modelica://Apnc.Presets.Paper\">Presets.Paper</a> for the printed ones.</p>
</html>"));
end Parameters;
