within Apnc.Blocks;
block ForwardModel "Forward model: the load that the own motion lets expect"
  extends Interfaces.HeldBlock;
  extends Parameters.ForwardModel;
  Interfaces.RealInput theta_hip(quantity="Angle", unit="rad") "command of the hip joint"
    annotation (Placement(transformation(extent={{-140,60},{-100,100}})));
  Interfaces.RealInput theta_knee(quantity="Angle", unit="rad") "command of the knee joint"
    annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Interfaces.RealInput o1(unit="1") "output of neuron N1"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealInput o2(unit="1") "output of neuron N2"
    annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  Interfaces.RealInput F(unit="1") "load over half the weight"
    annotation (Placement(transformation(extent={{-140,-100},{-100,-60}})));
  Interfaces.RealOutput grf_expected(unit="1") "expected load over half the weight"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
protected
  final parameter Integer kernels=20 "Constants.KERNELS, as a number: not every tool evaluates it in a size";
  discrete Real G(unit="1") "1 while the leg should stand";
  discrete Real grf_expected_next(start=0.0, fixed=true) "expected load at the next tick";
  discrete Real theta(quantity="Angle", unit="rad") "command that is copied";
  discrete Real theta_before(start=Constants.NEVER, fixed=true) "command at the tick before";
  discrete Real kernel[kernels] "radial basis functions";
  discrete Real learned[kernels](each start=0.0, each fixed=true) "change of their weights";
equation
  when sample(startTime, Ts) then
    kernel = if forward_model == Types.ForwardModel.radial_basis then Functions.kernels(o1, o2)
      else zeros(kernels);
    grf_expected = if hold then 0.0
      elseif forward_model == Types.ForwardModel.radial_basis
        then (Functions.stanceWeights(alpha) + pre(learned)) * kernel
      else pre(grf_expected_next);
    learned = if hold then zeros(kernels)
      else pre(learned) + rbf_rate * (F - grf_expected) * kernel;
    theta = if forward_model == Types.ForwardModel.low_pass_knee then theta_knee else theta_hip;
    G = if theta <= pre(theta_before) then 1.0 else 0.0;
    grf_expected_next = if hold then 0.0 else alpha * (rho * G + (1.0 - rho) * grf_expected);
    theta_before = if hold then Constants.NEVER else theta;
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Forward model", textColor={24,42,66})}),
    Documentation(info="<html>
<p>F<sup>e</sup>(n+1) = alpha (rho G(n) + (1 - rho) F<sup>e</sup>(n)) with G = 1 while the hip command
does not rise, else 0 (Eq. 10-11). The text speaks of the knee, the equation takes theta<sub>1</sub>,
the hip: <i>low_pass_knee</i> and <i>low_pass_hip</i>.</p>
<p><i>radial_basis</i>: F<sup>e</sup> = sum<sub>k</sub> w<sub>k</sub> phi<sub>k</sub>, Gaussian kernels
phi<sub>k</sub> along the cycle of the oscillator; w<sub>k</sub> starts at the expectation of Eq. 10-11
and learns, w<sub>k</sub> + rbf_rate (F - F<sup>e</sup>) phi<sub>k</sub>.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, section 2.1.2 and Eq. 10-11; Thor et al. 2020.</p>
</html>"));
end ForwardModel;
