within Apnc.Blocks;
block DualRateLearner "Dual-rate learner: tunes the gain of the feedback"
  extends Interfaces.HeldBlock;
  extends Parameters.Method;
  extends Parameters.DualRateLearner;
  Interfaces.RealInput F(unit="1") "load over half the weight"
    annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput grf_expected(unit="1") "expected load over half the weight"
    annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.RealOutput gamma(unit="1") "gain of the feedback"
    annotation (Placement(transformation(extent={{100,43},{120,63}})));
  Interfaces.RealOutput K_f(unit="1") "state of the fast learner"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Interfaces.RealOutput K_s(unit="1") "state of the slow learner"
    annotation (Placement(transformation(extent={{100,-63},{120,-43}})));
protected
  final parameter Boolean learns = method == Types.Method.apnc or method == Types.Method.apc
    "the baselines do not learn";
  discrete Real e(unit="1") "error";
  discrete Real K_f_new(unit="1") "fast learner before forgetting";
  discrete Real K_s_new(unit="1") "slow learner before forgetting";
  discrete Real K_f_next(start=0.0, fixed=true) "K_f at the next tick";
  discrete Real K_s_next(start=0.0, fixed=true) "K_s at the next tick";
equation
  when sample(startTime, Ts) then
    K_f = if hold then 0.0 else pre(K_f_next);
    K_s = if hold then 0.0 else pre(K_s_next);
    gamma = K_f + K_s;
    e = max(F - grf_expected, 0.0);
    K_f_new = A_f * K_f + B_f * e;
    K_s_new = A_s * K_s + B_s * e;
    K_f_next = if hold or K_f_new < Constants.FORGOTTEN then 0.0
      elseif learns then K_f_new else K_f;
    K_s_next = if hold or K_s_new < Constants.FORGOTTEN then 0.0
      elseif learns then K_s_new else K_s;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Dual-rate learner", textColor={24,42,66})}),
    Documentation(info="<html>
<p>e = max(F - F<sup>e</sup>, 0), K<sub>f</sub>(n+1) = A<sub>f</sub> K<sub>f</sub>(n) + B<sub>f</sub>
e(n), K<sub>s</sub>(n+1) = A<sub>s</sub> K<sub>s</sub>(n) + B<sub>s</sub> e(n), gamma = K<sub>f</sub> +
K<sub>s</sub> (Eq. 6-9). Under a constant error, K tends to B e / (1 - A).</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 6-9.</p>
</html>"));
end DualRateLearner;
