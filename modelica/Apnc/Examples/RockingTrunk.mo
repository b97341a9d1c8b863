within Apnc.Examples;
block RockingTrunk "A trunk that heaves, rolls and pitches on four springy legs"
  extends Icons.Block;
  Interfaces.RealInput theta_hip[4](each quantity="Angle", each unit="rad")
    "commands of the hip joints, legs RF, RH, LF, LH"
    annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput theta_knee[4](each quantity="Angle", each unit="rad")
    "commands of the knee joints"
    annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.RealOutput grf[4](each quantity="Force", each unit="N", each start=mass * gravity / 4, each fixed=true)
    "loads on the feet, as the sensors show them"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  parameter Real mass(unit="kg")=2.5 "mass of the robot";
  parameter Real gravity(unit="m/s2")=9.81 "acceleration of gravity";
  parameter Real J_roll(unit="kg.m2")=0.012 "moment of inertia about the long axis";
  parameter Real J_pitch(unit="kg.m2")=0.020 "moment of inertia about the cross axis";
  parameter Real x[4](each unit="m")={0.083, -0.101, 0.083, -0.101} "feet ahead of the centre of mass";
  parameter Real y[4](each unit="m")={-0.068, -0.068, 0.064, 0.064} "feet to the left of it";
  parameter Real femur(unit="m")=0.070 "hip to knee";
  parameter Real tibia(unit="m")=0.085 "knee to foot";
  parameter Types.Angle femur_angle(displayUnit="deg")=0.7504915783575618 "back of vertical, at command 0";
  parameter Types.Angle tibia_angle(displayUnit="deg")=0.8552113334772213 "forward of vertical, at command 0";
  parameter Real c(unit="N/m")=4000.0 "stiffness of a leg along the vertical, servos and foot";
  parameter Real d(unit="N.s/m")=160.0 "damping of a leg along the vertical";
  parameter Types.Time T_servo=0.03 "lag of a servo";
  parameter Types.Time T_sensor=0.03 "lag of a load sensor";
  Types.Angle hip[4](each start=-0.35, each fixed=true) "hip angles";
  Types.Angle knee[4](each start=0.05, each fixed=true) "knee angles";
  Real height(unit="m", start=0.1, fixed=true) "of the trunk";
  Types.Angle roll(start=0.0, fixed=true) "right side down is positive";
  Types.Angle pitch(start=0.0, fixed=true) "front down is positive";
  Real v(unit="m/s", start=0.0, fixed=true) "rate of height";
  Real w_roll(unit="rad/s", start=0.0, fixed=true) "rate of roll";
  Real w_pitch(unit="rad/s", start=0.0, fixed=true) "rate of pitch";
protected
  Real pressed[4](each unit="m") "legs compressed by, negative: the foot is in the air";
  Real rate[4](each unit="m/s") "rate of pressed";
  Types.Force force[4] "on the feet";
equation
  der(hip) = (theta_hip - hip) / T_servo;
  der(knee) = (theta_knee - knee) / T_servo;
  for i in 1:4 loop
    pressed[i] = femur * cos(femur_angle - hip[i]) + tibia * cos(tibia_angle + hip[i] + knee[i])
      - (height + y[i] * roll - x[i] * pitch);
    rate[i] = femur * sin(femur_angle - hip[i]) * (theta_hip[i] - hip[i]) / T_servo
      - tibia * sin(tibia_angle + hip[i] + knee[i]) * (theta_hip[i] - hip[i] + theta_knee[i] - knee[i]) / T_servo
      - (v + y[i] * w_roll - x[i] * w_pitch);
    force[i] = noEvent(if pressed[i] > 0.0 and c * pressed[i] + d * rate[i] > 0.0
      then c * pressed[i] + d * rate[i] else 0.0);
    der(grf[i]) = (force[i] - grf[i]) / T_sensor;
  end for;
  der(height) = v;
  der(roll) = w_roll;
  der(pitch) = w_pitch;
  mass * der(v) = sum(force) - mass * gravity;
  J_roll * der(w_roll) = y * force;
  J_pitch * der(w_pitch) = -x * force;
  annotation (
    Icon(graphics={
        Rectangle(extent={{-60,10},{60,50}}, lineColor={24,42,66}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Line(points={{-50,10},{-40,0},{-60,-15},{-40,-30},{-50,-40}}, color={24,42,66}),
        Line(points={{50,10},{60,0},{40,-15},{60,-30},{50,-40}}, color={24,42,66}),
        Line(points={{-80,-40},{80,-40}}, color={24,42,66})}),
    Documentation(info="<html>
<p>The least body in which a gait forms: a rigid trunk with three freedoms, four legs whose length
follows the joint commands with a lag, springs and dampers that only push. It knows no forward
motion, no slip and no obstacles; use the plant of the project for those. Lengths and angles are
Lilibot's, stiffness and inertia of its size.</p>
<p>Why the diagonals get together: the trunk follows the legs in heave, roll and pitch, but cannot
warp, so a diagonal that steps alone carries the load of both.</p>
</html>"));
end RockingTrunk;
