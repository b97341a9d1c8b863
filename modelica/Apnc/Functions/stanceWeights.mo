within Apnc.Functions;
function stanceWeights "Weights with which the radial basis functions start"
  extends Icons.Function;
  input Real alpha "scale of the expected load";
  output Real weight[Constants.KERNELS] "one per centre";
algorithm
  weight := {(if Constants.CENTRES_2[k] < 0.0 then alpha / Constants.OVERLAP else 0.0)
    for k in 1:Constants.KERNELS};
  annotation (Documentation(info="<html>
<p>alpha over the kernels' sum where the centre lies in stance, o<sub>2</sub> &lt; 0, and 0 in swing:
the expectation of Eq. 10-11.</p>
</html>"));
end stanceWeights;
