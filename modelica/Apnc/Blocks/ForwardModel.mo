within Apnc.Blocks;
block ForwardModel "Forward model: the load that the own motion lets expect"
  extends Interfaces.HeldBlock;
  extends Parameters.ForwardModel;
  Interfaces.RealInput theta_hip(quantity="Angle", unit="rad") "command of the hip joint"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealOutput grf_expected(unit="1") "expected load over half the weight"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
protected
  discrete Real G(unit="1") "1 while the leg should stand";
  discrete Real grf_expected_next(start=0.0, fixed=true) "expected load at the next tick";
  discrete Real theta_hip_before(start=Constants.NEVER, fixed=true) "command at the tick before";
equation
  when sample(startTime, Ts) then
    grf_expected = if hold then 0.0 else pre(grf_expected_next);
    G = if theta_hip <= pre(theta_hip_before) then 1.0 else 0.0;
    grf_expected_next = if hold then 0.0 else alpha * (rho * G + (1.0 - rho) * grf_expected);
    theta_hip_before = if hold then Constants.NEVER else theta_hip;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Forward model", textColor={24,42,66})}),
    Documentation(info="<html>
<p>F<sup>e</sup>(n+1) = alpha (rho G(n) + (1 - rho) F<sup>e</sup>(n)) with G = 1 while the hip command
does not rise, else 0 (Eq. 10-11). The text speaks of the knee, the equation takes theta<sub>1</sub>,
the hip.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 10-11.</p>
</html>"));
end ForwardModel;
