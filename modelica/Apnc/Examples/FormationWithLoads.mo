within Apnc.Examples;
model FormationWithLoads "Loads bring the legs into a trot, and memory keeps it without them"
  extends Icons.Example;
  parameter Types.Time lost=20.0 "from then on the sensors show no load";
  Blocks.Controller controller "with the set of Lilibot"
    annotation (Placement(transformation(extent={{-80,-40},{0,40}})));
  RockingTrunk body "what the legs feel each other through"
    annotation (Placement(transformation(extent={{30,-20},{70,20}})));
equation
  connect(controller.theta_hip, body.theta_hip)
    annotation (Line(points={{2,37.6},{16,37.6},{16,8},{26,8}}, color={0,0,127}));
  connect(controller.theta_knee, body.theta_knee)
    annotation (Line(points={{2,32.8},{12,32.8},{12,-8},{26,-8}}, color={0,0,127}));
  for leg in 1:4 loop
    controller.grf[leg] = if time < lost then body.grf[leg] else 0.0;
  end for;
  controller.MI = 0.08;
  controller.turn = 0.0;
  controller.reset = false;
  annotation (experiment(StartTime=0, StopTime=30, Interval=0.016666666666666666), Documentation(info="<html>
<p>All legs start alike. The centre of mass lies a little off the middle, so loads differ, and within
about five seconds the phases settle at a trot: controller.phi tends to pi, pi, 0, controller.d falls
and controller.kappa becomes 1. At 20 s the sensors fail; the stored relations keep the trot.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, sections 3.2.1 and 3.2.2.</p>
</html>"));
end FormationWithLoads;
