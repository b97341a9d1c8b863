within Apnc.Blocks;
block PhaseAcquisition "Phase acquisition: relative phases of legs 1 and k"
  extends Interfaces.HeldBlock;
  extends Parameters.Legs;
  extends Parameters.PhaseAcquisition;
  Interfaces.RealInput o1[n](each unit="1") "outputs of the neurons N1"
    annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput o2[n](each unit="1") "outputs of the neurons N2"
    annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.RealOutput angle[n - 1](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "angles of the relations in [-pi, pi]"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
protected
  discrete Real re[n - 1](each start=0.0, each fixed=true) "low-passed product of the vectors (o1, o2)";
  discrete Real im[n - 1](each start=0.0, each fixed=true) "low-passed product of the vectors (o1, o2)";
  discrete Real o1_before[n](each start=Constants.NEVER, each fixed=true)
    "o1 one tick ago";
  discrete Real o1_before2[n](each start=Constants.NEVER, each fixed=true)
    "o1 two ticks ago";
  discrete Real t_peak[n](each start=-1.0, each fixed=true) "ticks at the last peak, negative: none yet";
  discrete Real period(start=0.0, fixed=true) "ticks between two peaks of leg 1, 0: unknown";
  discrete Real now(start=0.0, fixed=true) "ticks since the circuits started";
equation
  when sample(startTime, Ts) then
    re = if hold then zeros(n - 1)
      else pre(re) + phase_filter * (o1[1] * o1[2:n] + o2[1] * o2[2:n] - pre(re));
    im = if hold then zeros(n - 1)
      else pre(im) + phase_filter * (o2[1] * o1[2:n] - o1[1] * o2[2:n] - pre(im));
    t_peak = if hold then fill(-1.0, n)
      else Functions.peakTimes(pre(o1_before2), pre(o1_before), o1, pre(now) - 1.0, pre(t_peak));
    period = if hold then 0.0
      elseif pre(t_peak[1]) >= 0.0 and t_peak[1] > pre(t_peak[1]) then t_peak[1] - pre(t_peak[1])
      else pre(period);
    o1_before2 = if hold then fill(Constants.NEVER, n) else pre(o1_before);
    o1_before = if hold then fill(Constants.NEVER, n) else o1;
    now = if hold then 0.0 else pre(now) + 1.0;
    angle = if hold then zeros(n - 1)
      elseif phase_measure == Types.PhaseMeasure.vector then Functions.vectorAngles(im, re)
      else Functions.peakAngles(t_peak, period);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Phase acquisition", textColor={24,42,66})}),
    Documentation(info="<html>
<p>phi<sub>1k</sub> is positive when leg k leads leg 1 (Eq. 12). Measure <i>vector</i>: angle of the
low-passed complex product of (o<sub>1</sub>, o<sub>2</sub>) of legs 1 and k; products are low-passed,
not angles, as an angle cannot be averaged where it wraps. Measure <i>peak</i>, the paper's letter:
phi<sub>1k</sub> = 2 pi (t<sub>p</sub><sup>1</sup> - t<sub>p</sub><sup>k</sup>) / T from the times of
the peaks of o<sub>1</sub>; it resolves 2 pi over the ticks per period.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 12.</p>
</html>"));
end PhaseAcquisition;
