within Apnc.Blocks;
block MotorNeurons "Motor neurons: from oscillator outputs to joint commands"
  extends Interfaces.SampledBlock;
  extends Parameters.MotorNeurons;
  parameter Boolean right=true "true: a leg of the right side" annotation (Dialog(group="MotorNeurons"));
  Interfaces.RealInput o1(unit="1") "output of neuron N1"
    annotation (Placement(transformation(extent={{-140,33},{-100,73}})));
  Interfaces.RealInput o2(unit="1") "output of neuron N2"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealInput turn(unit="1") "steering, positive turns left"
    annotation (Placement(transformation(extent={{-140,-73},{-100,-33}})));
  Interfaces.RealOutput theta_hip(quantity="Angle", unit="rad", displayUnit="deg")
    "command of the hip joint"
    annotation (Placement(transformation(extent={{100,30},{120,50}})));
  Interfaces.RealOutput theta_knee(quantity="Angle", unit="rad", displayUnit="deg")
    "command of the knee joint"
    annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
protected
  discrete Real scale(unit="1") "factor on the slopes";
equation
  when sample(startTime, Ts) then
    scale = if right then 1.0 + turn_gain * turn else 1.0 - turn_gain * turn;
    theta_hip = scale * a1 * o1 + b1;
    theta_knee = scale * a2 * o2 + b2;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Motor neurons", textColor={24,42,66})}),
    Documentation(info="<html>
<p>theta<sub>i</sub> = s a<sub>i</sub> o<sub>i</sub> + b<sub>i</sub> (Eq. 4), relative to the
reference pose of the robot; s = 1 + turn_gain turn on the right and 1 - turn_gain turn on the left
(section 3.3: steeper slopes on the right turn the robot to the left).</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 4.</p>
</html>"));
end MotorNeurons;
