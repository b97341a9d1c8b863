within Apnc.Blocks;
block Oscillator "Oscillator: the central pattern generator of one leg"
  extends Interfaces.HeldBlock;
  extends Parameters.Oscillator;
  Interfaces.RealInput MI(unit="1") "modulatory input"
    annotation (Placement(transformation(extent={{-140,47},{-100,87}})));
  Interfaces.RealInput f1(unit="1") "feedback to N1, subtracted"
    annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput f2(unit="1") "feedback to N2, subtracted"
    annotation (Placement(transformation(extent={{-140,-7},{-100,33}})));
  Interfaces.RealInput g1(unit="1") "coupling to N1, added"
    annotation (Placement(transformation(extent={{-140,-33},{-100,7}})));
  Interfaces.RealInput g2(unit="1") "coupling to N2, added"
    annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.BooleanInput touchDown "true: the activations are set instead"
    annotation (Placement(transformation(extent={{-140,-87},{-100,-47}})));
  Interfaces.RealOutput o1(unit="1", start=o1_start) "output of neuron N1"
    annotation (Placement(transformation(extent={{100,30},{120,50}})));
  Interfaces.RealOutput o2(unit="1", start=o2_start) "output of neuron N2"
    annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
protected
  discrete Real o1_next(start=o1_start, fixed=true) "o1 at the next tick";
  discrete Real o2_next(start=o2_start, fixed=true) "o2 at the next tick";
equation
  when sample(startTime, Ts) then
    o1 = if hold then o1_start else pre(o1_next);
    o2 = if hold then o2_start else pre(o2_next);
    o1_next = if hold then o1_start
      elseif touchDown then tanh(Constants.A1_AT_TOUCH_DOWN)
      else tanh(w11 * o1 + (w12_0 + MI) * o2 + bias - f1 + g1);
    o2_next = if hold then o2_start
      elseif touchDown then tanh(Constants.A2_AT_TOUCH_DOWN)
      else tanh(w11 * o2 - (w12_0 + MI) * o1 + bias - f2 + g2);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Oscillator", textColor={24,42,66})}),
    Documentation(info="<html>
<p>a<sub>1</sub>(n+1) = w<sub>11</sub> o<sub>1</sub>(n) + w<sub>12</sub> o<sub>2</sub>(n) -
f<sub>1</sub>(n) + g<sub>1</sub>(n),<br>
a<sub>2</sub>(n+1) = w<sub>11</sub> o<sub>2</sub>(n) - w<sub>12</sub> o<sub>1</sub>(n) -
f<sub>2</sub>(n) + g<sub>2</sub>(n),<br>
o<sub>i</sub>(n) = tanh a<sub>i</sub>(n), w<sub>12</sub> = w12_0 + MI (Eq. 1-3, 18).</p>
<p>The cycle is not a circle and turns clockwise in the (o<sub>1</sub>, o<sub>2</sub>) plane.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 1-3.</p>
</html>"));
end Oscillator;
