within Apnc.Blocks;
block SensoryFeedback "Sensory feedback: how the foot load acts on the oscillator"
  extends Interfaces.HeldBlock;
  extends Parameters.Method;
  extends Parameters.SensoryFeedback;
  Interfaces.RealInput learned(unit="1") "gain that the dual-rate learner found"
    annotation (Placement(transformation(extent={{-140,44},{-100,84}})));
  Interfaces.RealInput kappa(unit="1") "1 while the neural couplings are on"
    annotation (Placement(transformation(extent={{-140,12},{-100,52}})));
  Interfaces.RealInput F(unit="1") "load over half the weight"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealInput o1(unit="1") "output of neuron N1"
    annotation (Placement(transformation(extent={{-140,-52},{-100,-12}})));
  Interfaces.RealInput o2(unit="1") "output of neuron N2"
    annotation (Placement(transformation(extent={{-140,-84},{-100,-44}})));
  Interfaces.RealOutput gamma(unit="1") "gain of the feedback"
    annotation (Placement(transformation(extent={{100,43},{120,63}})));
  Interfaces.RealOutput f1(unit="1") "feedback to neuron N1"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Interfaces.RealOutput f2(unit="1") "feedback to neuron N2"
    annotation (Placement(transformation(extent={{100,-63},{120,-43}})));
equation
  when sample(startTime, Ts) then
    gamma = if hold or method == Types.Method.phase_reset then 0.0
      elseif method == Types.Method.tegotae then gamma_tegotae
      elseif kappa > 0.0 then feedback_kept * learned
      else learned;
    f1 = if hold then 0.0 else gamma * F * cos(o1);
    f2 = if hold then 0.0 else gamma * F * sin(o2);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Sensory feedback", textColor={24,42,66})}),
    Documentation(info="<html>
<p>f<sub>1</sub> = gamma F cos o<sub>1</sub>, f<sub>2</sub> = gamma F sin o<sub>2</sub> (Eq. 5).
The gain is the learner's; while the neural couplings are on the share feedback_kept of it; fixed for
the Tegotae baseline (Owaki et al. 2012); zero for the phase-resetting baseline.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 5.</p>
</html>"));
end SensoryFeedback;
