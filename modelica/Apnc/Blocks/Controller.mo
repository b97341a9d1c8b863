within Apnc.Blocks;
block Controller "The adaptive neural controller of a legged robot"
  extends Interfaces.Controller;
  Commands commands(
    Ts=Ts,
    startTime=startTime,
    MI_zero_resets=MI_zero_resets) "inputs within their ranges"
    annotation (Placement(transformation(extent={{-96,-14},{-68,14}})));
  Leg leg[n](
    each Ts=Ts,
    each startTime=startTime,
    each w11=w11,
    each w12_0=w12_0,
    each bias=bias,
    each o1_start=o1_start,
    each o2_start=o2_start,
    each a1=a1,
    each a2=a2,
    each b1=b1,
    each b2=b2,
    each turn_gain=turn_gain,
    each robot_weight=robot_weight,
    each F_max=F_max,
    each method=method,
    each feedback_kept=feedback_kept,
    each gamma_tegotae=gamma_tegotae,
    each A_f=A_f,
    each B_f=B_f,
    each A_s=A_s,
    each B_s=B_s,
    each alpha=alpha,
    each rho=rho,
    each forward_model=forward_model,
    each rbf_rate=rbf_rate,
    each grf_reset=grf_reset,
    right={i <= div(n, 2) for i in 1:n}) "the legs, the right ones first"
    annotation (Placement(transformation(extent={{-47,22},{-19,50}})));
  PhaseAcquisition acquisition(
    Ts=Ts,
    startTime=startTime,
    n=n,
    phase_measure=phase_measure,
    phase_filter=phase_filter) "relative phases"
    annotation (Placement(transformation(extent={{-14,-68},{14,-40}})));
  PhaseEstimation estimation(
    Ts=Ts,
    startTime=startTime,
    n=n,
    kappa_rule=kappa_rule,
    N=N,
    sigma=sigma,
    kappa_hold=kappa_hold) "are they settled?"
    annotation (Placement(transformation(extent={{24,-68},{52,-40}})));
  NeuralCoupling coupling(
    Ts=Ts,
    startTime=startTime,
    n=n,
    method=method,
    kappa_rule=kappa_rule,
    xi=xi,
    coupling_sign=coupling_sign,
    phi_frozen=phi_frozen,
    stored=stored,
    phi_stored=phi_stored) "couplings to the stored gait"
    annotation (Placement(transformation(extent={{63,-32},{91,-4}})));
equation
  for i in 1:n loop
    connect(commands.MI_used, leg[i].MI)
      annotation (Line(points={{-66.3,5.6},{-58,5.6},{-58,42},{-49.8,42}}, color={0,0,127}));
    connect(commands.turn_used, leg[i].turn)
      annotation (Line(points={{-66.3,1.9},{-56,1.9},{-56,38},{-49.8,38}}, color={0,0,127}));
    connect(commands.hold, leg[i].hold)
      annotation (Line(points={{-66.3,-1.9},{-33,-1.9},{-33,19.2}}, color={255,0,255}));
    connect(coupling.kappa, leg[i].kappa)
      annotation (Line(points={{92,-26},{94,-26},{94,-84},{-54,-84},{-54,34},{-49.8,34}}, color={0,0,127}));
    connect(grf[i], leg[i].grf)
      annotation (Line(points={{-110,80},{-55.8,80},{-55.8,45.38},{-49.8,45.38}}, color={0,0,127}));
    connect(coupling.g1[i], leg[i].g1)
      annotation (Line(points={{92.4,-9.6},{94.4,-9.6},{94.4,-86},{-52.8,-86},{-52.8,30.4},{-49.8,30.4}}, color={0,0,127}));
    connect(coupling.g2[i], leg[i].g2)
      annotation (Line(points={{92.4,-15.2},{94.4,-15.2},{94.4,-92},{-52.8,-92},{-52.8,26.62},{-49.8,26.62}}, color={0,0,127}));
  end for;
  acquisition.o1 = leg.o1;
  acquisition.o2 = leg.o2;
  coupling.o1 = leg.o1;
  coupling.o2 = leg.o2;
  theta_hip = leg.theta_hip;
  theta_knee = leg.theta_knee;
  o1 = leg.o1;
  o2 = leg.o2;
  gamma = leg.gamma;
  grf_expected = leg.grf_expected;
  f1 = leg.f1;
  f2 = leg.f2;
  fault = leg.fault;
  K_f = leg.K_f;
  K_s = leg.K_s;
  connect(MI, commands.MI)
    annotation (Line(points={{-110,27},{-101.8,27},{-101.8,7.42},{-98.8,7.42}}, color={0,0,127}));
  connect(turn, commands.turn)
    annotation (Line(points={{-110,-26},{-102.8,-26},{-102.8,0},{-98.8,0}}, color={0,0,127}));
  connect(reset, commands.reset)
    annotation (Line(points={{-110,-80},{-103.8,-80},{-103.8,-7.42},{-98.8,-7.42}}, color={255,0,255}));
  connect(commands.hold, acquisition.hold)
    annotation (Line(points={{-66.6,-2.8},{-63.6,-2.8},{-63.6,-73.8},{0,-73.8},{0,-70.8}}, color={255,0,255}));
  connect(commands.hold, estimation.hold)
    annotation (Line(points={{-66.6,-2.8},{-63.6,-2.8},{-63.6,-73.8},{38,-73.8},{38,-70.8}}, color={255,0,255}));
  connect(commands.hold, coupling.hold)
    annotation (Line(points={{-66.6,-2.8},{-63.6,-2.8},{-63.6,-37.8},{77,-37.8},{77,-34.8}}, color={255,0,255}));
  connect(acquisition.angle, estimation.angle)
    annotation (Line(points={{15.4,-54},{15.2,-54},{15.2,-54},{21.2,-54}}, color={0,0,127}));
  connect(acquisition.angle, coupling.angle)
    annotation (Line(points={{15.4,-54},{57.2,-54},{57.2,-18},{60.2,-18}}, color={0,0,127}));
  connect(estimation.phi, coupling.phi)
    annotation (Line(points={{53.4,-46.58},{56.2,-46.58},{56.2,-22.48},{60.2,-22.48}}, color={0,0,127}));
  connect(estimation.settled, coupling.settled)
    annotation (Line(points={{53.4,-61.42},{55.2,-61.42},{55.2,-26.96},{60.2,-26.96}}, color={255,0,255}));
  connect(coupling.g1, g1)
    annotation (Line(points={{92.4,-9.6},{100,-9.6},{100,-6},{105,-6}}, color={0,0,127}));
  connect(coupling.g2, g2)
    annotation (Line(points={{92.4,-15.2},{99,-15.2},{99,-18},{105,-18}}, color={0,0,127}));
  connect(estimation.phi, phi)
    annotation (Line(points={{53.4,-46.58},{98,-46.58},{98,-43},{105,-43}}, color={0,0,127}));
  connect(coupling.phi_memory, phi_memory)
    annotation (Line(points={{92.4,-20.8},{97,-20.8},{97,-56},{105,-56}}, color={0,0,127}));
  connect(estimation.d, d)
    annotation (Line(points={{53.4,-54},{102,-54},{102,-68},{105,-68}}, color={0,0,127}));
  connect(coupling.kappa, kappa)
    annotation (Line(points={{92.4,-26.4},{101,-26.4},{101,-81},{105,-81}}, color={0,0,127}));
  connect(commands.tick, tick)
    annotation (Line(points={{-66.6,-8.4},{100,-8.4},{100,-94},{105,-94}}, color={255,127,0}));
  annotation (Documentation(info="<html>
<p>The FMU of the project in Modelica, with its names, units and defaults; no C is needed. Feed the
loads of the feet [N], legs 1 RF, 2 RH, 3 LF, 4 LH (right ones first, n legs), and add the joint
commands to the reference pose of the robot.</p>
<p>At every tick the outputs follow from the state; a load acts on the joint commands from the next
tick on, so no algebraic loop arises. Between ticks the outputs hold.</p>
<p>The method chooses among the paper's controllers: <i>apnc</i> (loads and neural couplings),
<i>apc</i> (loads alone), <i>tegotae</i> and <i>phase_reset</i> (the baselines).</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Front. Neural Circuits 17:1111285, Eq. 1-18.</p>
</html>"));
end Controller;
