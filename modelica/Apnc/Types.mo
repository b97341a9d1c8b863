within Apnc;
package Types "Physical quantities and choices; generated from the table of variables, do not edit"
  extends Icons.Types;

  type Force = Real(
    final quantity="Force",
    final unit="N");

  type Angle = Real(
    final quantity="Angle",
    final unit="rad");

  type Time = Real(
    final quantity="Time",
    final unit="s");

  type Method = enumeration(
    apnc "adaptive physical and neural communication, Eq. 1-18",
    apc "adaptive physical communication only, Eq. 1-11",
    tegotae "Tegotae baseline: Eq. 5 with a fixed gain",
    phase_reset "phase-resetting baseline: activations set to (1, 0) at touch-down")
    "Controller that runs";

  type ForwardModel = enumeration(
    low_pass_hip "low-pass filter of the stance of the hip command, Eq. 10-11 as printed",
    low_pass_knee "Eq. 10-11 with the knee command, as the text of section 2.1.2 has it",
    radial_basis "radial basis functions of (o1, o2) that learn the load")
    "How the expected load is computed";

  type PhaseMeasure = enumeration(
    vector "angle between the vectors (o1, o2) of two legs, low-pass filtered",
    peak "times of the peaks of o1, Eq. 12")
    "How the relative phases are measured";

  type KappaRule = enumeration(
    armed "on after d has exceeded sigma and then stayed at or below it for kappa_hold ticks",
    printed "Eq. 16 as printed: on whenever d is at or below sigma")
    "When the neural couplings switch on";

  type CouplingSign = enumeration(
    reversed "g subtracted: recovers the stored gait",
    printed "g added, as printed in Eq. 18")
    "Sign of the coupling term g in Eq. 18";

  annotation (Documentation(info="<html>
<p>Units follow SI. The package brings its own types so that it needs no other library; a connector
of the Modelica Standard Library plugs into one of this package, as both are Real.</p>
</html>"));
end Types;
