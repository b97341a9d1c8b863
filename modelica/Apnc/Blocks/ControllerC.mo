within Apnc.Blocks;
block ControllerC
  "The controller in C, for speed; generated from the table of variables, do not edit"
  extends Interfaces.Controller;
protected
  External.State state=External.State(
      n,
      Ts,
      robot_weight,
      F_max,
      method,
      w11,
      w12_0,
      bias,
      o1_start,
      o2_start,
      a1,
      a2,
      b1,
      b2,
      turn_gain,
      A_f,
      B_f,
      A_s,
      B_s,
      alpha,
      rho,
      forward_model,
      rbf_rate,
      phase_measure,
      phase_filter,
      N,
      sigma,
      kappa_rule,
      kappa_hold,
      xi,
      feedback_kept,
      coupling_sign,
      phi_frozen,
      MI_zero_resets,
      stored,
      phi_stored,
      gamma_tegotae,
      grf_reset)
    "circuits and memory of the C core";
  Integer k(start=0, fixed=true) "number of the tick";
equation
  when sample(startTime, Ts) then
    k = pre(k) + 1;
    tick = k;
    (theta_hip, theta_knee, o1, o2, gamma, grf_expected, f1, f2, g1, g2, fault, phi, phi_memory, d, kappa, K_f, K_s) =
      External.step(state, k, grf, MI, turn, reset, n);
  end when;
  annotation (Documentation(info="<html>
<p>The same inputs, outputs and parameters as
<a href=\"modelica://Apnc.Blocks.Controller\">Controller</a>, but the C code of the FMU does the
work: an ExternalObject holds the state, one call per tick. The tool compiles the header
Resources/Include/apnc_modelica.h; nothing is linked. The number of legs is fixed when that header
is compiled: 4, or what the macro APNC_LEGS says (-DAPNC_LEGS=6). Another n is an error at the
start.</p>
</html>"));
end ControllerC;
