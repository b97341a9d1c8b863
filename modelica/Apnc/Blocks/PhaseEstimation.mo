within Apnc.Blocks;
block PhaseEstimation "Phase estimation: are the relations settled?"
  extends Interfaces.HeldBlock;
  extends Parameters.Legs;
  extends Parameters.KappaRule;
  extends Parameters.PhaseEstimation;
  Interfaces.RealInput angle[n - 1](each quantity="Angle", each unit="rad")
    "angles of the relations"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealOutput phi[n - 1](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "relative phases in [-pi/2, 3 pi/2)"
    annotation (Placement(transformation(extent={{100,43},{120,63}})));
  Interfaces.RealOutput d(quantity="Angle", unit="rad") "distance of the phases from their mean"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Interfaces.BooleanOutput settled "true: the couplings may switch on"
    annotation (Placement(transformation(extent={{100,-63},{120,-43}})));
protected
  discrete Real angle_before[n - 1](each start=0.0, each fixed=true) "angles one tick ago";
  discrete Real unwrapped[n - 1](each start=0.0, each fixed=true) "relative phases without wraps";
  discrete Real deviation[n - 1] "distance from the mean, per relation";
  discrete Real window[N, n - 1](each start=0.0, each fixed=true) "relative phases of the last N ticks";
  Boolean armed(start=false, fixed=true) "d has exceeded sigma";
  Integer calm(start=0, fixed=true) "ticks with d at or below sigma since";
equation
  when sample(startTime, Ts) then
    phi = if hold then zeros(n - 1) else Functions.wrap(angle, -0.5 * Constants.PI);
    unwrapped = if hold then zeros(n - 1)
      else pre(unwrapped) + Functions.wrap(angle - pre(angle_before), -Constants.PI);
    angle_before = if hold then zeros(n - 1) else angle;
    deviation = if hold then zeros(n - 1) else unwrapped - Functions.mean(pre(window));
    window = if hold then zeros(N, n - 1) else cat(1, pre(window[2:N, :]), {unwrapped});
    d = sqrt(deviation * deviation);
    armed = not hold and (pre(armed) or d > sigma);
    calm = if armed and d <= sigma then pre(calm) + 1 else 0;
    settled = not hold
      and (if kappa_rule == Types.KappaRule.printed then d <= sigma else calm >= kappa_hold);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Phase estimation", textColor={24,42,66})}),
    Documentation(info="<html>
<p>d(n) = |Phi(n) - mean(Phi(n-1) ... Phi(n-N))| over unwrapped phases (Eq. 13-15). Rule
<i>printed</i>: settled while d &lt;= sigma (Eq. 16); it is true from the first tick, as all phases
start at zero. Rule <i>armed</i>: d has exceeded sigma once and has then stayed at or below it for
kappa_hold ticks.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 13-16.</p>
</html>"));
end PhaseEstimation;
