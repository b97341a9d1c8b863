within Apnc.Examples;
model Steering "Steps of speed and direction"
  extends Icons.Example;
  Blocks.Controller controller(stored=true, phi_stored={3.11, 3.17, 0.04})
    "remembers a trot, as measured"
    annotation (Placement(transformation(extent={{0,-40},{80,40}})));
equation
  for leg in 1:controller.n loop
    controller.grf[leg] = 0.0;
  end for;
  controller.MI = if time < 10.0 then 0.08 else 0.15;
  controller.turn = if time < 12.0 then 0.0 elseif time < 16.0 then 1.0 else -1.0;
  controller.reset = false;
  annotation (experiment(StartTime=0, StopTime=20, Interval=0.016666666666666666), Documentation(info="<html>
<p>The steps come faster from 10 s on. At 12 s the robot turns left: the hip commands of the right
legs, 1 and 2, swing wider and those of the left ones, 3 and 4, less; at 16 s the other way. Plot
controller.theta_hip.</p>
</html>"));
end Steering;
