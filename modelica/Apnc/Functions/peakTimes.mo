within Apnc.Functions;
function peakTimes "Times of the last peaks of o1"
  extends Icons.Function;
  input Real before2[:] "o1 two ticks ago";
  input Real before[size(before2, 1)] "o1 one tick ago";
  input Real o1[size(before2, 1)] "o1 now";
  input Real t "ticks one tick ago";
  input Real t_peak[size(before2, 1)] "ticks at the last peaks known before";
  output Real updated[size(before2, 1)] "ticks at the last peaks";
algorithm
  updated := {if before2[k] < before[k] and before[k] >= o1[k] then t else t_peak[k]
    for k in 1:size(before2, 1)};
end peakTimes;
