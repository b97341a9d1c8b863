within Apnc.Blocks;
block Leg "Leg: the circuits of one leg"
  extends Interfaces.SampledBlock;
  extends Parameters.Method;
  extends Parameters.FootLoad;
  extends Parameters.Oscillator;
  extends Parameters.MotorNeurons;
  extends Parameters.SensoryFeedback;
  extends Parameters.DualRateLearner;
  extends Parameters.ForwardModel;
  extends Parameters.TouchDown;
  parameter Boolean right=true "true: a leg of the right side" annotation (Dialog(group="MotorNeurons"));
  Interfaces.RealInput grf(quantity="Force", unit="N") "load on the foot"
    annotation (Placement(transformation(extent={{-220,-70},{-200,-50}}), iconTransformation(extent={{-140,47},{-100,87}})));
  Interfaces.RealInput MI(unit="1") "modulatory input"
    annotation (Placement(transformation(extent={{-220,70},{-200,90}}), iconTransformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput turn(unit="1") "steering, positive turns left"
    annotation (Placement(transformation(extent={{-220,90},{-200,110}}), iconTransformation(extent={{-140,-7},{-100,33}})));
  Interfaces.RealInput kappa(unit="1") "1 while the neural couplings are on"
    annotation (Placement(transformation(extent={{-220,10},{-200,30}}), iconTransformation(extent={{-140,-33},{-100,7}})));
  Interfaces.RealInput g1(unit="1") "coupling to neuron N1"
    annotation (Placement(transformation(extent={{-220,50},{-200,70}}), iconTransformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.RealInput g2(unit="1") "coupling to neuron N2"
    annotation (Placement(transformation(extent={{-220,30},{-200,50}}), iconTransformation(extent={{-140,-87},{-100,-47}})));
  Interfaces.BooleanInput hold "true: the circuits stay at their start"
    annotation (Placement(transformation(extent={{-220,-130},{-200,-110}}), iconTransformation(extent={{-20,-20},{20,20}}, rotation=90, origin={0,-120})));
  Interfaces.RealOutput theta_hip(quantity="Angle", unit="rad", displayUnit="deg")
    "command of the hip joint"
    annotation (Placement(transformation(extent={{200,110},{220,130}}), iconTransformation(extent={{100,68},{110,78}})));
  Interfaces.RealOutput theta_knee(quantity="Angle", unit="rad", displayUnit="deg")
    "command of the knee joint"
    annotation (Placement(transformation(extent={{200,86},{220,106}}), iconTransformation(extent={{100,53},{110,63}})));
  Interfaces.RealOutput o1(unit="1") "output of neuron N1"
    annotation (Placement(transformation(extent={{200,62},{220,82}}), iconTransformation(extent={{100,39},{110,49}})));
  Interfaces.RealOutput o2(unit="1") "output of neuron N2"
    annotation (Placement(transformation(extent={{200,38},{220,58}}), iconTransformation(extent={{100,24},{110,34}})));
  Interfaces.RealOutput gamma(unit="1") "gain of the sensory feedback"
    annotation (Placement(transformation(extent={{200,14},{220,34}}), iconTransformation(extent={{100,10},{110,20}})));
  Interfaces.RealOutput grf_expected(unit="1") "expected load over half the weight"
    annotation (Placement(transformation(extent={{200,-10},{220,10}}), iconTransformation(extent={{100,-5},{110,5}})));
  Interfaces.RealOutput f1(unit="1") "feedback to neuron N1"
    annotation (Placement(transformation(extent={{200,-34},{220,-14}}), iconTransformation(extent={{100,-20},{110,-10}})));
  Interfaces.RealOutput f2(unit="1") "feedback to neuron N2"
    annotation (Placement(transformation(extent={{200,-58},{220,-38}}), iconTransformation(extent={{100,-34},{110,-24}})));
  Interfaces.BooleanOutput fault "true: the load is unusable"
    annotation (Placement(transformation(extent={{200,-82},{220,-62}}), iconTransformation(extent={{100,-49},{110,-39}})));
  Interfaces.RealOutput K_f(unit="1") "state of the fast learner"
    annotation (Placement(transformation(extent={{200,-106},{220,-86}}), iconTransformation(extent={{100,-63},{110,-53}})));
  Interfaces.RealOutput K_s(unit="1") "state of the slow learner"
    annotation (Placement(transformation(extent={{200,-130},{220,-110}}), iconTransformation(extent={{100,-78},{110,-68}})));
  FootLoad footLoad(
    Ts=Ts,
    startTime=startTime,
    robot_weight=robot_weight,
    F_max=F_max) "load over half the weight"
    annotation (Placement(transformation(extent={{-170,-80},{-130,-40}})));
  TouchDown touchDown(
    Ts=Ts,
    startTime=startTime,
    method=method,
    grf_reset=grf_reset) "phase-resetting baseline"
    annotation (Placement(transformation(extent={{-110,-80},{-70,-40}})));
  Oscillator oscillator(
    Ts=Ts,
    startTime=startTime,
    w11=w11,
    w12_0=w12_0,
    bias=bias,
    o1_start=o1_start,
    o2_start=o2_start) "central pattern generator"
    annotation (Placement(transformation(extent={{-80,40},{-40,80}})));
  MotorNeurons motorNeurons(
    Ts=Ts,
    startTime=startTime,
    a1=a1,
    a2=a2,
    b1=b1,
    b2=b2,
    turn_gain=turn_gain,
    right=right) "joint commands"
    annotation (Placement(transformation(extent={{0,60},{40,100}})));
  ForwardModel forwardModel(
    Ts=Ts,
    startTime=startTime,
    alpha=alpha,
    rho=rho,
    forward_model=forward_model,
    rbf_rate=rbf_rate) "expected load"
    annotation (Placement(transformation(extent={{40,0},{80,40}})));
  DualRateLearner learner(
    Ts=Ts,
    startTime=startTime,
    method=method,
    A_f=A_f,
    B_f=B_f,
    A_s=A_s,
    B_s=B_s) "gain of the feedback"
    annotation (Placement(transformation(extent={{90,-60},{130,-20}})));
  SensoryFeedback feedback(
    Ts=Ts,
    startTime=startTime,
    method=method,
    feedback_kept=feedback_kept,
    gamma_tegotae=gamma_tegotae) "feedback of the load"
    annotation (Placement(transformation(extent={{140,0},{180,40}})));
equation
  connect(hold, touchDown.hold)
    annotation (Line(points={{-210,-120},{-90,-120},{-90,-84}}, color={255,0,255}));
  connect(hold, oscillator.hold)
    annotation (Line(points={{-210,-120},{-60,-120},{-60,36}}, color={255,0,255}));
  connect(hold, forwardModel.hold)
    annotation (Line(points={{-210,-120},{60,-120},{60,-4}}, color={255,0,255}));
  connect(hold, learner.hold)
    annotation (Line(points={{-210,-120},{110,-120},{110,-64}}, color={255,0,255}));
  connect(hold, feedback.hold)
    annotation (Line(points={{-210,-120},{160,-120},{160,-4}}, color={255,0,255}));
  connect(grf, footLoad.grf)
    annotation (Line(points={{-210,-60},{-180,-60},{-180,-60},{-174,-60}}, color={0,0,127}));
  connect(footLoad.F, touchDown.F)
    annotation (Line(points={{-128,-52},{-122,-52},{-122,-60},{-114,-60}}, color={255,0,255}));
  connect(footLoad.F, learner.F)
    annotation (Line(points={{-128,-52},{76,-52},{76,-32},{86,-32}}, color={0,0,127}));
  connect(footLoad.F, feedback.F)
    annotation (Line(points={{-128,-52},{124,-52},{124,20},{136,20}}, color={0,0,127}));
  connect(MI, oscillator.MI)
    annotation (Line(points={{-210,80},{-88,80},{-88,73.4},{-84,73.4}}, color={0,0,127}));
  connect(g1, oscillator.g1)
    annotation (Line(points={{-210,60},{-90,60},{-90,57.4},{-84,57.4}}, color={0,0,127}));
  connect(g2, oscillator.g2)
    annotation (Line(points={{-210,40},{-92,40},{-92,52},{-84,52}}, color={0,0,127}));
  connect(touchDown.touchDown, oscillator.touchDown)
    annotation (Line(points={{-68,-60},{-58,-60},{-58,46.6},{-84,46.6}}, color={255,0,255}));
  connect(oscillator.o1, motorNeurons.o1)
    annotation (Line(points={{-38,68},{-16,68},{-16,90.6},{-4,90.6}}, color={0,0,127}));
  connect(oscillator.o2, motorNeurons.o2)
    annotation (Line(points={{-38,52},{-8,52},{-8,80},{-4,80}}, color={0,0,127}));
  connect(turn, motorNeurons.turn)
    annotation (Line(points={{-210,100},{-10,100},{-10,69.4},{-4,69.4}}, color={0,0,127}));
  connect(motorNeurons.theta_hip, forwardModel.theta_hip)
    annotation (Line(points={{42,88},{50,88},{50,48},{30,48},{30,36},{36,36}}, color={0,0,127}));
  connect(motorNeurons.theta_knee, forwardModel.theta_knee)
    annotation (Line(points={{42,72},{52,72},{52,46},{28,46},{28,28},{36,28}}, color={0,0,127}));
  connect(oscillator.o1, forwardModel.o1)
    annotation (Line(points={{-38,68},{24,68},{24,20},{36,20}}, color={0,0,127}));
  connect(oscillator.o2, forwardModel.o2)
    annotation (Line(points={{-38,52},{22,52},{22,12},{36,12}}, color={0,0,127}));
  connect(footLoad.F, forwardModel.F)
    annotation (Line(points={{-128,-52},{26,-52},{26,4},{36,4}}, color={0,0,127}));
  connect(forwardModel.grf_expected, learner.grf_expected)
    annotation (Line(points={{82,20},{76,20},{76,-48},{86,-48}}, color={0,0,127}));
  connect(learner.gamma, feedback.learned)
    annotation (Line(points={{132,-29.4},{124,-29.4},{124,32.8},{136,32.8}}, color={0,0,127}));
  connect(kappa, feedback.kappa)
    annotation (Line(points={{-210,20},{132,20},{132,26.4},{136,26.4}}, color={0,0,127}));
  connect(oscillator.o1, feedback.o1)
    annotation (Line(points={{-38,68},{130,68},{130,13.6},{136,13.6}}, color={0,0,127}));
  connect(oscillator.o2, feedback.o2)
    annotation (Line(points={{-38,52},{128,52},{128,7.2},{136,7.2}}, color={0,0,127}));
  connect(feedback.f1, oscillator.f1)
    annotation (Line(points={{182,20},{192,20},{192,68},{-84,68}}, color={0,0,127}));
  connect(feedback.f2, oscillator.f2)
    annotation (Line(points={{182,9.4},{194,9.4},{194,62.6},{-84,62.6}}, color={0,0,127}));
  connect(motorNeurons.theta_hip, theta_hip)
    annotation (Line(points={{42,88},{206,88},{206,120},{210,120}}, color={0,0,127}));
  connect(motorNeurons.theta_knee, theta_knee)
    annotation (Line(points={{42,72},{204,72},{204,96},{210,96}}, color={0,0,127}));
  connect(oscillator.o1, o1)
    annotation (Line(points={{-38,68},{202,68},{202,72},{210,72}}, color={0,0,127}));
  connect(oscillator.o2, o2)
    annotation (Line(points={{-38,52},{200,52},{200,48},{210,48}}, color={0,0,127}));
  connect(feedback.gamma, gamma)
    annotation (Line(points={{182,30.6},{198,30.6},{198,24},{210,24}}, color={0,0,127}));
  connect(forwardModel.grf_expected, grf_expected)
    annotation (Line(points={{82,20},{206,20},{206,0},{210,0}}, color={0,0,127}));
  connect(feedback.f1, f1)
    annotation (Line(points={{182,20},{204,20},{204,-24},{210,-24}}, color={0,0,127}));
  connect(feedback.f2, f2)
    annotation (Line(points={{182,9.4},{202,9.4},{202,-48},{210,-48}}, color={0,0,127}));
  connect(footLoad.fault, fault)
    annotation (Line(points={{-128,-68},{200,-68},{200,-72},{210,-72}}, color={255,0,255}));
  connect(learner.K_f, K_f)
    annotation (Line(points={{132,-40},{198,-40},{198,-96},{210,-96}}, color={0,0,127}));
  connect(learner.K_s, K_s)
    annotation (Line(points={{132,-50.6},{206,-50.6},{206,-120},{210,-120}}, color={0,0,127}));
  annotation (
    Icon(graphics={Text(extent={{-90,-30},{90,30}}, textString="Leg", textColor={24,42,66})}),
    Diagram(coordinateSystem(extent={{-200,-120},{200,130}})),
    Documentation(info="<html>
<p>One leg: oscillator, motor neurons and the loop from the foot load back to the oscillator, whose
gain the dual-rate learner tunes with the error between the load and the forward model's expectation
(Eq. 1-11). Legs meet only in the couplings g<sub>1</sub>, g<sub>2</sub>, and through the robot.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Fig. 3 and Eq. 1-11.</p>
</html>"));
end Leg;
