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
    phi_stored=phi_stored) "memory of the relations"
    annotation (Placement(transformation(extent={{63,-32},{91,-4}})));
equation
  for i in 1:n loop
    leg[i].MI = commands.MI_used;
    leg[i].turn = commands.turn_used;
    leg[i].hold = commands.hold;
    leg[i].kappa = coupling.kappa;
  end for;
  acquisition.hold = commands.hold;
  estimation.hold = commands.hold;
  coupling.hold = commands.hold;
  K_f = leg.K_f;
  K_s = leg.K_s;
  connect(MI, commands.MI)
    annotation (Line(points={{-110,27},{-101.8,27},{-101.8,7.42},{-98.8,7.42}}, color={0,0,127}));
  connect(turn, commands.turn)
    annotation (Line(points={{-110,-26},{-102.8,-26},{-102.8,0},{-98.8,0}}, color={0,0,127}));
  connect(reset, commands.reset)
    annotation (Line(points={{-110,-80},{-103.8,-80},{-103.8,-7.42},{-98.8,-7.42}}, color={255,0,255}));
  connect(grf, leg.grf)
    annotation (Line(points={{-110,80},{-55.8,80},{-55.8,45.38},{-49.8,45.38}}, color={0,0,127}));
  connect(leg.o1, acquisition.o1)
    annotation (Line(points={{-18.3,42.16},{-23.8,42.16},{-23.8,-48.4},{-16.8,-48.4}}, color={0,0,127}));
  connect(leg.o2, acquisition.o2)
    annotation (Line(points={{-18.3,40.06},{-24.8,40.06},{-24.8,-59.6},{-16.8,-59.6}}, color={0,0,127}));
  connect(acquisition.angle, estimation.angle)
    annotation (Line(points={{15.4,-54},{18.2,-54},{18.2,-54},{21.2,-54}}, color={0,0,127}));
  connect(leg.o1, coupling.o1)
    annotation (Line(points={{-18.3,42.16},{56.2,42.16},{56.2,-9.04},{60.2,-9.04}}, color={0,0,127}));
  connect(leg.o2, coupling.o2)
    annotation (Line(points={{-18.3,40.06},{55.2,40.06},{55.2,-13.52},{60.2,-13.52}}, color={0,0,127}));
  connect(acquisition.angle, coupling.angle)
    annotation (Line(points={{15.4,-54},{54.2,-54},{54.2,-18},{60.2,-18}}, color={0,0,127}));
  connect(estimation.phi, coupling.phi)
    annotation (Line(points={{53.4,-46.58},{53.2,-46.58},{53.2,-22.48},{60.2,-22.48}}, color={0,0,127}));
  connect(estimation.settled, coupling.settled)
    annotation (Line(points={{53.4,-61.42},{52.2,-61.42},{52.2,-26.96},{60.2,-26.96}}, color={255,0,255}));
  connect(coupling.g1, leg.g1)
    annotation (Line(points={{92.4,-9.6},{94.4,-9.6},{94.4,-92},{-52.8,-92},{-52.8,30.4},{-49.8,30.4}}, color={0,0,127}));
  connect(coupling.g2, leg.g2)
    annotation (Line(points={{92.4,-15.2},{94.4,-15.2},{94.4,-90},{-52.8,-90},{-52.8,26.62},{-49.8,26.62}}, color={0,0,127}));
  connect(leg.theta_hip, theta_hip)
    annotation (Line(points={{-18.3,46.22},{100,46.22},{100,94},{105,94}}, color={0,0,127}));
  connect(leg.theta_knee, theta_knee)
    annotation (Line(points={{-18.3,44.12},{99,44.12},{99,82},{105,82}}, color={0,0,127}));
  connect(leg.o1, o1)
    annotation (Line(points={{-18.3,42.16},{98,42.16},{98,69},{105,69}}, color={0,0,127}));
  connect(leg.o2, o2)
    annotation (Line(points={{-18.3,40.06},{97,40.06},{97,57},{105,57}}, color={0,0,127}));
  connect(leg.gamma, gamma)
    annotation (Line(points={{-18.3,38.1},{102,38.1},{102,44},{105,44}}, color={0,0,127}));
  connect(leg.grf_expected, grf_expected)
    annotation (Line(points={{-18.3,36},{101,36},{101,32},{105,32}}, color={0,0,127}));
  connect(leg.f1, f1)
    annotation (Line(points={{-18.3,33.9},{100,33.9},{100,19},{105,19}}, color={0,0,127}));
  connect(leg.f2, f2)
    annotation (Line(points={{-18.3,31.94},{99,31.94},{99,7},{105,7}}, color={0,0,127}));
  connect(leg.fault, fault)
    annotation (Line(points={{-18.3,29.84},{98,29.84},{98,-31},{105,-31}}, color={255,0,255}));
  connect(coupling.g1, g1)
    annotation (Line(points={{92.4,-9.6},{97,-9.6},{97,-6},{105,-6}}, color={0,0,127}));
  connect(coupling.g2, g2)
    annotation (Line(points={{92.4,-15.2},{102,-15.2},{102,-18},{105,-18}}, color={0,0,127}));
  connect(estimation.phi, phi)
    annotation (Line(points={{53.4,-46.58},{101,-46.58},{101,-43},{105,-43}}, color={0,0,127}));
  connect(coupling.phi_memory, phi_memory)
    annotation (Line(points={{92.4,-20.8},{100,-20.8},{100,-56},{105,-56}}, color={0,0,127}));
  connect(estimation.d, d)
    annotation (Line(points={{53.4,-54},{99,-54},{99,-68},{105,-68}}, color={0,0,127}));
  connect(coupling.kappa, kappa)
    annotation (Line(points={{92.4,-26.4},{98,-26.4},{98,-81},{105,-81}}, color={0,0,127}));
  connect(commands.tick, tick)
    annotation (Line(points={{-66.6,-8.4},{97,-8.4},{97,-94},{105,-94}}, color={255,127,0}));
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
