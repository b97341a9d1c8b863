within Apnc.Functions;
function vectorAngles "Angles of vectors in [-pi, pi], 0 for the zero vector"
  extends Icons.Function;
  input Real y[:] "second components";
  input Real x[size(y, 1)] "first components";
  output Types.Angle angle[size(y, 1)] "angles";
algorithm
  angle := {if x[r] > 0.0 then atan(y[r] / x[r])
    elseif x[r] < 0.0 then atan(y[r] / x[r]) + (if y[r] < 0.0 then -Constants.PI else Constants.PI)
    elseif y[r] > 0.0 then 0.5 * Constants.PI
    elseif y[r] < 0.0 then -0.5 * Constants.PI
    else 0.0 for r in 1:size(y, 1)};
  annotation (Documentation(info="<html>
<p>Like atan2, but by the arc tangent of the quotient, as the FMU does, so that both give the same
bits.</p>
</html>"));
end vectorAngles;
