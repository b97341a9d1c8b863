within Apnc;
package Presets "Controllers with named sets of parameters; generated from the table, do not edit"
  extends Icons.Package;

  block Paper = Blocks.Controller(
    o1_start=0.01,
    o2_start=0.01,
    a1=0.14,
    a2=0.14,
    b1=-0.2,
    b2=-0.2,
    B_f=0.002,
    B_s=0.0002,
    phase_measure=Types.PhaseMeasure.peak,
    phase_filter=0.05,
    kappa_rule=Types.KappaRule.printed,
    xi=0.01,
    feedback_kept=1.0,
    coupling_sign=Types.CouplingSign.printed,
    phi_frozen=false,
    MI_zero_resets=false)
    "The constants and rules as the paper prints them";

  annotation (Documentation(info="<html>
<p>Blocks.Controller itself has the set with which Lilibot walks. The printed set does not form a
gait on that robot; docs/formation.md of the project says why.</p>
</html>"));
end Presets;
