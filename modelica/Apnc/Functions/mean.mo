within Apnc.Functions;
function mean "Mean of every column"
  extends Icons.Function;
  input Real window[:, :] "one row per tick";
  output Real average[size(window, 2)] "mean of every column";
algorithm
  average := {sum(window[:, r]) / size(window, 1) for r in 1:size(window, 2)};
end mean;
