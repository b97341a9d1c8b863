within Apnc.Interfaces;
partial block Controller
  "Parameters, inputs and outputs of the controller; generated from the table, do not edit"
  extends SampledBlock;
  extends Parameters.Method;
  extends Parameters.Commands;
  extends Parameters.FootLoad;
  extends Parameters.Oscillator;
  extends Parameters.MotorNeurons;
  extends Parameters.SensoryFeedback;
  extends Parameters.DualRateLearner;
  extends Parameters.ForwardModel;
  extends Parameters.TouchDown;
  extends Parameters.PhaseAcquisition;
  extends Parameters.KappaRule;
  extends Parameters.PhaseEstimation;
  extends Parameters.NeuralCoupling;
  RealInput grf[n](each quantity="Force", each unit="N", each start=0.0)
    "load on the foot; a value that is not finite, negative or above 1000 weights counts as zero and raises fault (Eq. 5)"
    annotation (Placement(transformation(extent={{-120,70},{-100,90}})));
  RealInput MI(unit="1", min=0.0, max=1.0, start=0.08)
    "modulatory input: sets the stepping frequency; limited to its range (Eq. 3)"
    annotation (Placement(transformation(extent={{-120,17},{-100,37}})));
  RealInput turn(unit="1", min=-1.0, max=1.0, start=0.0)
    "steering, positive turns left: scales the amplitudes of the right legs up and of the left legs down; limited to its range (Eq. 4)"
    annotation (Placement(transformation(extent={{-120,-36},{-100,-16}})));
  BooleanInput reset(start=false)
    "while true, oscillators, learners and forward models stay at their start state; the stored gait is kept"
    annotation (Placement(transformation(extent={{-120,-90},{-100,-70}})));
  RealOutput theta_hip[n](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "command of the hip joint, relative to the reference pose (Eq. 4)"
    annotation (Placement(transformation(extent={{100,89},{110,99}})));
  RealOutput theta_knee[n](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "command of the knee joint, relative to the reference pose (Eq. 4)"
    annotation (Placement(transformation(extent={{100,77},{110,87}})));
  RealOutput o1[n](each unit="1", each min=-1.0, each max=1.0)
    "output of neuron N1 (Eq. 2)"
    annotation (Placement(transformation(extent={{100,64},{110,74}})));
  RealOutput o2[n](each unit="1", each min=-1.0, each max=1.0)
    "output of neuron N2 (Eq. 2)"
    annotation (Placement(transformation(extent={{100,52},{110,62}})));
  RealOutput gamma[n](each unit="1")
    "gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), times feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines (Eq. 5, 9)"
    annotation (Placement(transformation(extent={{100,39},{110,49}})));
  RealOutput grf_expected[n](each unit="1")
    "expected load over half the weight (Eq. 10)"
    annotation (Placement(transformation(extent={{100,27},{110,37}})));
  RealOutput f1[n](each unit="1")
    "sensory feedback to neuron N1 (Eq. 5)"
    annotation (Placement(transformation(extent={{100,14},{110,24}})));
  RealOutput f2[n](each unit="1")
    "sensory feedback to neuron N2 (Eq. 5)"
    annotation (Placement(transformation(extent={{100,2},{110,12}})));
  RealOutput g1[n](each unit="1")
    "neural coupling to neuron N1, as added to its activation (Eq. 17)"
    annotation (Placement(transformation(extent={{100,-11},{110,-1}})));
  RealOutput g2[n](each unit="1")
    "neural coupling to neuron N2, as added to its activation (Eq. 17)"
    annotation (Placement(transformation(extent={{100,-23},{110,-13}})));
  BooleanOutput fault[n]
    "true while the load input of the leg cannot be used"
    annotation (Placement(transformation(extent={{100,-36},{110,-26}})));
  RealOutput phi[n - 1](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2) (Eq. 12)"
    annotation (Placement(transformation(extent={{100,-48},{110,-38}})));
  RealOutput phi_memory[n - 1](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "stored gait that is held now: relative phase phi_1k; zero while no gait is stored (Eq. 17)"
    annotation (Placement(transformation(extent={{100,-61},{110,-51}})));
  RealOutput d(quantity="Angle", unit="rad")
    "distance of the relative phases from their mean (Eq. 15)"
    annotation (Placement(transformation(extent={{100,-73},{110,-63}})));
  RealOutput kappa(unit="1", min=0.0, max=1.0)
    "1 while the neural couplings are on, else 0 (Eq. 16)"
    annotation (Placement(transformation(extent={{100,-86},{110,-76}})));
  IntegerOutput tick
    "number of ticks run since the start (Eq. 1)"
    annotation (Placement(transformation(extent={{100,-99},{110,-89}})));
  Real K_f[n](each unit="1")
    "state of the fast learner (Eq. 7)";
  Real K_s[n](each unit="1")
    "state of the slow learner (Eq. 8)";
  annotation (Icon(graphics={
    Text(
      extent={{-96,74},{-30,86}},
      textString="grf",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Left),
    Text(
      extent={{-96,21},{-30,33}},
      textString="MI",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Left),
    Text(
      extent={{-96,-32},{-30,-20}},
      textString="turn",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Left),
    Text(
      extent={{-96,-86},{-30,-74}},
      textString="reset",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Left),
    Text(
      extent={{10,89},{96,99}},
      textString="theta_hip",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,77},{96,87}},
      textString="theta_knee",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,64},{96,74}},
      textString="o1",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,52},{96,62}},
      textString="o2",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,39},{96,49}},
      textString="gamma",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,27},{96,37}},
      textString="grf_expected",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,14},{96,24}},
      textString="f1",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,2},{96,12}},
      textString="f2",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-11},{96,-1}},
      textString="g1",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-23},{96,-13}},
      textString="g2",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-36},{96,-26}},
      textString="fault",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-48},{96,-38}},
      textString="phi",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-61},{96,-51}},
      textString="phi_memory",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-73},{96,-63}},
      textString="d",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-86},{96,-76}},
      textString="kappa",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right),
    Text(
      extent={{10,-99},{96,-89}},
      textString="tick",
      textColor={0,0,127},
      horizontalAlignment=TextAlignment.Right)}));
end Controller;
