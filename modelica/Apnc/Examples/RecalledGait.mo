within Apnc.Examples;
model RecalledGait "A stored gait comes back without loads"
  extends Icons.Example;
  Blocks.Controller controller(stored=true, phi_stored={3.11, 3.17, 0.04})
    "remembers a trot, as measured"
    annotation (Placement(transformation(extent={{0,-40},{80,40}})));
equation
  for leg in 1:controller.n loop
    controller.grf[leg] = 0.0;
  end for;
  controller.MI = if time < 2.0 then 0.0 else 0.08;
  controller.turn = 0.0;
  controller.reset = false;
  annotation (experiment(StartTime=0, StopTime=20, Interval=0.016666666666666666), Documentation(info="<html>
<p>The neural couplings hold the relative phases of a trot, the feet report nothing. MI = 0 holds the
oscillators at their common start for 2 s; then they start in phase, and the couplings alone bring
back the gait: phi tends to phi_memory. Plot controller.o1 and controller.phi. Source: Sun, Dai &amp;
Manoonpong 2023, Fig. 12.</p>
</html>"));
end RecalledGait;
