within Apnc.Functions;
function kernels "Radial basis functions of the forward model"
  extends Icons.Function;
  input Real o1 "output of neuron N1";
  input Real o2 "output of neuron N2";
  output Real kernel[Constants.KERNELS] "one per centre";
algorithm
  kernel := {exp(-((o1 - Constants.CENTRES_1[k]) * (o1 - Constants.CENTRES_1[k])
    + (o2 - Constants.CENTRES_2[k]) * (o2 - Constants.CENTRES_2[k])) / Constants.KERNEL_WIDTH)
    for k in 1:Constants.KERNELS};
  annotation (Documentation(info="<html>
<p>phi<sub>k</sub> = exp(-|o - c<sub>k</sub>|<sup>2</sup> / KERNEL_WIDTH), c<sub>k</sub> along the
cycle of the oscillator at MI = 0.08.</p>
<p>Source: Thor et al. 2020.</p>
</html>"));
end kernels;
