within Apnc.Blocks;
block TouchDown "Touch-down: when the phase-resetting baseline restarts the cycle"
  extends Interfaces.HeldBlock;
  extends Parameters.Method;
  extends Parameters.TouchDown;
  Interfaces.RealInput F(unit="1") "load over half the weight"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.BooleanOutput touchDown "true at the tick of touch-down"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
protected
  discrete Real F_before(start=Constants.NEVER, fixed=true) "load at the tick before";
equation
  when sample(startTime, Ts) then
    touchDown = method == Types.Method.phase_reset
      and pre(F_before) < 0.5 * grf_reset and F >= 0.5 * grf_reset;
    F_before = if hold then Constants.NEVER else F;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Touch-down", textColor={24,42,66})}),
    Documentation(info="<html>
<p>True for the method phase_reset at the tick at which the load rises through grf_reset quarters of
the weight. A robot that already stands does not touch down.</p>
<p>Source: Aoi et al. 2011, Nomura et al. 2009, in the form the paper compares with.</p>
</html>"));
end TouchDown;
