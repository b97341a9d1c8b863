within Apnc.Functions;
function peakAngles "Relative phases in [-pi, pi) from the times of the peaks (Eq. 12)"
  extends Icons.Function;
  input Real t_peak[:] "ticks at the last peak of every leg, negative: none yet";
  input Real period "ticks between two peaks of leg 1, 0: unknown";
  output Types.Angle angle[size(t_peak, 1) - 1] "angles of the relations";
protected
  Real T = if period > 0.0 then period else 1.0 "divisor";
  Types.Angle lag[size(t_peak, 1) - 1] = {if period > 0.0 and t_peak[r + 1] >= 0.0
    then 2.0 * Constants.PI * ((t_peak[1] - t_peak[r + 1]) / T) else 0.0
    for r in 1:size(t_peak, 1) - 1} "angles, however far off";
algorithm
  angle := {lag[r] - 2.0 * Constants.PI * floor((lag[r] + Constants.PI) / (2.0 * Constants.PI))
    for r in 1:size(t_peak, 1) - 1};
end peakAngles;
