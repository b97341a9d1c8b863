within Apnc.Blocks;
block NeuralCoupling "Neural coupling: the stored relations act on the oscillators"
  extends Interfaces.HeldBlock;
  extends Parameters.Method;
  extends Parameters.KappaRule;
  extends Parameters.NeuralCoupling;
  Interfaces.RealInput o1[n](each unit="1") "outputs of the neurons N1"
    annotation (Placement(transformation(extent={{-140,44},{-100,84}})));
  Interfaces.RealInput o2[n](each unit="1") "outputs of the neurons N2"
    annotation (Placement(transformation(extent={{-140,12},{-100,52}})));
  Interfaces.RealInput angle[n - 1](each quantity="Angle", each unit="rad")
    "angles measured now"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.RealInput phi[n - 1](each quantity="Angle", each unit="rad")
    "relative phases, stored when settled"
    annotation (Placement(transformation(extent={{-140,-52},{-100,-12}})));
  Interfaces.BooleanInput settled "true: the couplings may switch on"
    annotation (Placement(transformation(extent={{-140,-84},{-100,-44}})));
  Interfaces.RealOutput g1[n](each unit="1") "coupling to the neurons N1"
    annotation (Placement(transformation(extent={{100,50},{120,70}})));
  Interfaces.RealOutput g2[n](each unit="1") "coupling to the neurons N2"
    annotation (Placement(transformation(extent={{100,10},{120,30}})));
  Interfaces.RealOutput phi_memory[n - 1](each quantity="Angle", each unit="rad", each displayUnit="deg")
    "stored relations"
    annotation (Placement(transformation(extent={{100,-30},{120,-10}})));
  Interfaces.RealOutput kappa(unit="1") "1 while the couplings are on"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
protected
  final parameter Real gain = if coupling_sign == Types.CouplingSign.printed then xi else -xi
    "gain with its sign";
  discrete Real stored_gait[n - 1](start=if stored then phi_stored else zeros(n - 1), each fixed=true)
    "stored relations";
  Boolean on(start=stored, fixed=true) "relations are stored and in use";
equation
  when sample(startTime, Ts) then
    stored_gait = if method == Types.Method.apnc and settled and not pre(on) then phi
      else pre(stored_gait);
    on = if hold or method <> Types.Method.apnc then pre(on)
      elseif kappa_rule == Types.KappaRule.printed then settled
      else pre(on) or settled;
    phi_memory = stored_gait;
    kappa = if on and method == Types.Method.apnc then 1.0 else 0.0;
    g1 = if hold or kappa <= 0.0 then zeros(n)
      else Functions.couple(o1, if phi_frozen then stored_gait else angle, gain);
    g2 = if hold or kappa <= 0.0 then zeros(n)
      else Functions.couple(o2, if phi_frozen then stored_gait else angle, gain);
  end when;
  annotation (
    Icon(graphics={Text(extent={{-96,-30},{96,30}}, textString="Neural coupling", textColor={24,42,66})}),
    Documentation(info="<html>
<p>g<sup>l</sup> = xi sum<sub>k</sub> sin(o<sup>l</sup> - o<sup>k</sup> - phi<sub>lk</sub>) (Eq. 17),
with the sign of coupling_sign: the printed plus (Eq. 18) does not recover a stored gait, minus does.
phi is frozen when kappa switches on; a coupling to the phases measured now holds nothing. The stored gait
survives hold.</p>
<p>For relations of exactly 0 and pi and equal oscillators the sum is zero: exact relations cannot
start recall; measured ones are never exact.</p>
<p>Source: Sun, Dai &amp; Manoonpong 2023, Eq. 17-18.</p>
</html>"));
end NeuralCoupling;
