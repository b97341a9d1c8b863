within Apnc.Functions;
function wrap "Angles that are at most a turn off, brought into [low, low + 2 pi)"
  extends Icons.Function;
  input Types.Angle angle[:] "angles";
  input Types.Angle low "lower end";
  output Types.Angle wrapped[size(angle, 1)] "the same directions";
algorithm
  wrapped := {if angle[r] < low then angle[r] + 2.0 * Constants.PI
    elseif angle[r] < low + 2.0 * Constants.PI then angle[r]
    else angle[r] - 2.0 * Constants.PI for r in 1:size(angle, 1)};
end wrap;
