within Apnc.Blocks;
block Commands "Commands: inputs within their ranges, and when the circuits are held"
  extends Interfaces.SampledBlock;
  extends Parameters.Commands;
  Interfaces.RealInput MI(unit="1") "modulatory input"
    annotation (Placement(transformation(extent={{-140,33},{-100,73}})));
  Interfaces.RealInput turn(unit="1") "steering, positive turns left"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.BooleanInput reset "true: hold the circuits"
    annotation (Placement(transformation(extent={{-140,-73},{-100,-33}})));
  Interfaces.RealOutput MI_used(unit="1", start=Constants.MI_START, fixed=true) "MI within its range"
    annotation (Placement(transformation(extent={{100,50},{120,70}})));
  Interfaces.RealOutput turn_used(unit="1", start=Constants.TURN_START, fixed=true) "turn within its range"
    annotation (Placement(transformation(extent={{100,10},{120,30}})));
  Interfaces.BooleanOutput hold "true: the circuits stay at their start"
    annotation (Placement(transformation(extent={{100,-30},{120,-10}})));
  Interfaces.IntegerOutput tick(start=0, fixed=true) "number of ticks run"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
equation
  when sample(startTime, Ts) then
    MI_used = if abs(MI) <= Constants.LARGEST then min(max(MI, Constants.MI_MIN), Constants.MI_MAX)
      else pre(MI_used);
    turn_used = if abs(turn) <= Constants.LARGEST then min(max(turn, Constants.TURN_MIN), Constants.TURN_MAX)
      else pre(turn_used);
    hold = reset or MI_zero_resets and MI_used <= Constants.MI_MIN;
    tick = pre(tick) + 1;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Commands", textColor={24,42,66})}),
    Documentation(info="<html>
<p>MI and turn are limited to their ranges; a value that is no number leaves what was there before.
With MI_zero_resets, MI = 0 acts as reset: the oscillators would otherwise run on (Eq. 3 has
w<sub>12</sub> = 0.21 there), while the paper's Fig. 12 shows them stopped.</p>
</html>"));
end Commands;
