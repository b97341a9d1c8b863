within Apnc.Functions;
function couple "Coupling term of one neuron of every leg (Eq. 17)"
  extends Icons.Function;
  input Real o[:] "outputs of the neuron, one per leg";
  input Types.Angle phi[:] "relations phi_1k, one per leg from the second on";
  input Real gain "gain xi with the sign of the coupling";
  output Real g[size(o, 1)] "coupling terms";
protected
  Types.Angle first[size(o, 1)] = cat(1, {0.0}, phi) "relation of every leg to leg 1";
  Real sin_x[size(o, 1)] = {sin(o[k]) * cos(first[k]) + cos(o[k]) * sin(first[k]) for k in 1:size(o, 1)};
  Real cos_x[size(o, 1)] = {cos(o[k]) * cos(first[k]) - sin(o[k]) * sin(first[k]) for k in 1:size(o, 1)};
algorithm
  g := {gain * (sin_x[k] * sum(cos_x) - cos_x[k] * sum(sin_x)) for k in 1:size(o, 1)};
  annotation (Documentation(info="<html>
<p>g<sup>l</sup> = xi sum<sub>k</sub> sin(o<sup>l</sup> - o<sup>k</sup> - phi<sub>lk</sub>) with
phi<sub>lk</sub> = phi<sub>1k</sub> - phi<sub>1l</sub>. With x<sup>l</sup> = o<sup>l</sup> +
phi<sub>1l</sub> the sum factors into sin x<sup>l</sup> sum<sub>k</sub> cos x<sup>k</sup> - cos
x<sup>l</sup> sum<sub>k</sub> sin x<sup>k</sup>: one sine and cosine per leg, not per pair.</p>
</html>"));
end couple;
