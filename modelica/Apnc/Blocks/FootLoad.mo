within Apnc.Blocks;
block FootLoad "Foot load: the load as the circuits see it"
  extends Interfaces.SampledBlock;
  extends Parameters.FootLoad;
  Interfaces.RealInput grf(quantity="Force", unit="N") "load on the foot"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealOutput F(unit="1") "load over half the weight"
    annotation (Placement(transformation(extent={{100,30},{120,50}})));
  Interfaces.BooleanOutput fault "true: the load is unusable"
    annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
equation
  when sample(startTime, Ts) then
    fault = not (grf >= 0.0 and grf <= Constants.MOST_WEIGHTS * robot_weight);
    F = min((if fault then 0.0 else grf * (2.0 / robot_weight)), F_max);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Foot load", textColor={24,42,66})}),
    Documentation(info="<html>
<p>F = min(grf / (robot_weight / 2), F_max). A load that is not finite, negative or above 1000
weights counts as zero and raises fault.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, text below Eq. 5.</p>
</html>"));
end FootLoad;
