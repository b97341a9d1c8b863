within Apnc.UsersGuide;
class Variables "Variables; generated from the table of variables, do not edit"
  extends Icons.Information;
  annotation (preferredView="info", Documentation(info="<html>
<h4>Inputs</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>name</th><th>unit</th><th>default</th><th>paper</th><th>range</th><th>Eq.</th><th>what it is</th><th>source</th></tr>
<tr><td>grf[n]</td><td>N</td><td>0.0</td><td></td><td></td><td>5</td><td>load on the foot; a value that is not finite, negative or above 1000 weights counts as zero and raises fault</td><td></td></tr>
<tr><td>MI</td><td>1</td><td>0.08</td><td></td><td>0 ... 1</td><td>3</td><td>modulatory input: sets the stepping frequency; limited to its range</td><td>paper</td></tr>
<tr><td>turn</td><td>1</td><td>0.0</td><td></td><td>-1 ... 1</td><td>4</td><td>steering, positive turns left: scales the amplitudes of the right legs up and of the left legs down; limited to its range</td><td></td></tr>
<tr><td>reset</td><td></td><td>false</td><td></td><td></td><td></td><td>while true, oscillators, learners and forward models stay at their start state; the stored gait is kept</td><td></td></tr>
</table>
<h4>Outputs</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>name</th><th>unit</th><th>default</th><th>paper</th><th>range</th><th>Eq.</th><th>what it is</th><th>source</th></tr>
<tr><td>theta_hip[n]</td><td>rad</td><td></td><td></td><td></td><td>4</td><td>command of the hip joint, relative to the reference pose</td><td></td></tr>
<tr><td>theta_knee[n]</td><td>rad</td><td></td><td></td><td></td><td>4</td><td>command of the knee joint, relative to the reference pose</td><td></td></tr>
<tr><td>o1[n]</td><td>1</td><td></td><td></td><td>-1 ... 1</td><td>2</td><td>output of neuron N1</td><td></td></tr>
<tr><td>o2[n]</td><td>1</td><td></td><td></td><td>-1 ... 1</td><td>2</td><td>output of neuron N2</td><td></td></tr>
<tr><td>gamma[n]</td><td>1</td><td></td><td></td><td></td><td>5, 9</td><td>gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), times feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines</td><td></td></tr>
<tr><td>grf_expected[n]</td><td>1</td><td></td><td></td><td></td><td>10</td><td>expected load over half the weight</td><td></td></tr>
<tr><td>f1[n]</td><td>1</td><td></td><td></td><td></td><td>5</td><td>sensory feedback to neuron N1</td><td></td></tr>
<tr><td>f2[n]</td><td>1</td><td></td><td></td><td></td><td>5</td><td>sensory feedback to neuron N2</td><td></td></tr>
<tr><td>g1[n]</td><td>1</td><td></td><td></td><td></td><td>17</td><td>neural coupling to neuron N1, as added to its activation</td><td></td></tr>
<tr><td>g2[n]</td><td>1</td><td></td><td></td><td></td><td>17</td><td>neural coupling to neuron N2, as added to its activation</td><td></td></tr>
<tr><td>fault[n]</td><td></td><td></td><td></td><td></td><td></td><td>true while the load input of the leg cannot be used</td><td></td></tr>
<tr><td>phi[n - 1]</td><td>rad</td><td></td><td></td><td></td><td>12</td><td>relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2)</td><td></td></tr>
<tr><td>phi_memory[n - 1]</td><td>rad</td><td></td><td></td><td></td><td>17</td><td>stored gait that is held now: relative phase phi_1k; zero while no gait is stored</td><td></td></tr>
<tr><td>d</td><td>rad</td><td></td><td></td><td></td><td>15</td><td>distance of the relative phases from their mean</td><td></td></tr>
<tr><td>kappa</td><td>1</td><td></td><td></td><td>0 ... 1</td><td>16</td><td>1 while the neural couplings are on, else 0</td><td></td></tr>
<tr><td>tick</td><td></td><td></td><td></td><td></td><td>1</td><td>number of ticks run since the start</td><td></td></tr>
</table>
<h4>Parameters</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>name</th><th>unit</th><th>default</th><th>paper</th><th>range</th><th>Eq.</th><th>what it is</th><th>source</th></tr>
<tr><td>Ts</td><td>s</td><td>0.016666666666666666</td><td></td><td>0.0001 ... 1</td><td></td><td>time between two ticks of the controller</td><td>paper: 60 Hz</td></tr>
<tr><td>robot_weight</td><td>N</td><td>24.525</td><td></td><td>0.001 ... 1e+06</td><td>5</td><td>weight of the robot; half of it normalises the load</td><td>Lilibot: 2.5 kg</td></tr>
<tr><td>F_max</td><td>1</td><td>1.0</td><td></td><td>0 ... 2000</td><td>5</td><td>limit of the load over half the weight; a higher load, as in an impact or under a payload, counts as this value</td><td>paper: loads are normalised to [0, 1)</td></tr>
<tr><td>method</td><td></td><td>Method.apnc</td><td></td><td></td><td></td><td>controller that runs</td><td></td></tr>
<tr><td>w11</td><td>1</td><td>1.4</td><td></td><td>0 ... 5</td><td>3</td><td>self-weight of both neurons, w11 = w22</td><td>paper</td></tr>
<tr><td>w12_0</td><td>1</td><td>0.21</td><td></td><td>0 ... 2</td><td>3</td><td>cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12</td><td>paper</td></tr>
<tr><td>bias</td><td>1</td><td>0.0</td><td></td><td>-1 ... 1</td><td>1</td><td>bias added to both activations; the paper has none</td><td>paper</td></tr>
<tr><td>o1_start</td><td>1</td><td>0.01</td><td>0.01</td><td>-1 ... 1</td><td>2</td><td>start output of neuron N1, the same for every leg</td><td>authors' code</td></tr>
<tr><td>o2_start</td><td>1</td><td>0.01</td><td>0.01</td><td>-1 ... 1</td><td>2</td><td>start output of neuron N2, the same for every leg</td><td>authors' code</td></tr>
<tr><td>a1</td><td>rad</td><td>0.14</td><td>0.14</td><td>0 ... 1.6</td><td>4</td><td>slope of the motor neuron of the hip</td><td>authors' robot data</td></tr>
<tr><td>a2</td><td>rad</td><td>0.15</td><td>0.14</td><td>0 ... 1.6</td><td>4</td><td>slope of the motor neuron of the knee</td><td>found by search for this robot, docs/decisions/presets.md</td></tr>
<tr><td>b1</td><td>rad</td><td>-0.2</td><td>-0.2</td><td>-1.6 ... 1.6</td><td>4</td><td>offset of the motor neuron of the hip</td><td>authors' robot data</td></tr>
<tr><td>b2</td><td>rad</td><td>-0.2</td><td>-0.2</td><td>-1.6 ... 1.6</td><td>4</td><td>offset of the motor neuron of the knee</td><td>authors' robot data</td></tr>
<tr><td>turn_gain</td><td>1</td><td>1.0</td><td></td><td>0 ... 1</td><td>4</td><td>relative change of the amplitudes at full steering</td><td>the largest</td></tr>
<tr><td>A_f</td><td>1</td><td>0.57</td><td></td><td>0 ... 1</td><td>7</td><td>retention of the fast learner</td><td>paper</td></tr>
<tr><td>B_f</td><td>1</td><td>0.17</td><td>0.002</td><td>0 ... 1</td><td>7</td><td>learning rate of the fast learner</td><td>found by search for this robot, docs/decisions/presets.md</td></tr>
<tr><td>A_s</td><td>1</td><td>0.99</td><td></td><td>0 ... 1</td><td>8</td><td>retention of the slow learner</td><td>paper</td></tr>
<tr><td>B_s</td><td>1</td><td>0.0002</td><td>0.0002</td><td>0 ... 1</td><td>8</td><td>learning rate of the slow learner</td><td>paper</td></tr>
<tr><td>alpha</td><td>1</td><td>0.9</td><td></td><td>0 ... 1</td><td>10</td><td>scale of the expected load</td><td>paper</td></tr>
<tr><td>rho</td><td>1</td><td>0.99</td><td></td><td>0 ... 1</td><td>10</td><td>shape of the expected load</td><td>paper</td></tr>
<tr><td>forward_model</td><td></td><td>ForwardModel.low_pass_hip</td><td></td><td></td><td>10, 11</td><td>how the expected load is computed</td><td>paper</td></tr>
<tr><td>rbf_rate</td><td>1</td><td>0.02</td><td></td><td>0 ... 1</td><td>10</td><td>learning rate of the radial-basis forward model</td><td>chosen, docs/decisions/radial-basis.md</td></tr>
<tr><td>phase_measure</td><td></td><td>PhaseMeasure.vector</td><td>PhaseMeasure.peak</td><td></td><td>12</td><td>how the relative phases are measured; the paper prints peak</td><td>authors' code</td></tr>
<tr><td>phase_filter</td><td>1</td><td>0.05</td><td>0.05</td><td>0.0001 ... 1</td><td>12</td><td>share of the new value per tick in the low-pass filter of the vector phase measure</td><td>authors' code, docs/decisions/phase-measure.md</td></tr>
<tr><td>N</td><td></td><td>50</td><td></td><td>1 ... 256</td><td>14</td><td>ticks in the mean of the relative phases</td><td>paper</td></tr>
<tr><td>sigma</td><td>rad</td><td>0.4</td><td></td><td>0 ... 10</td><td>16</td><td>threshold of d below which the phases count as stable</td><td>paper</td></tr>
<tr><td>kappa_rule</td><td></td><td>KappaRule.armed</td><td>KappaRule.printed</td><td></td><td>16</td><td>when the couplings switch on; the paper prints Eq. 16</td><td>authors' code arms kappa; the hold is chosen</td></tr>
<tr><td>kappa_hold</td><td></td><td>200</td><td></td><td>1 ... 1e+06</td><td>16</td><td>ticks that d stays at or below sigma before kappa switches on</td><td>chosen, docs/decisions/kappa-rule.md</td></tr>
<tr><td>xi</td><td>1</td><td>0.01</td><td>0.01</td><td>0 ... 1</td><td>17</td><td>gain of the neural communication</td><td>paper</td></tr>
<tr><td>feedback_kept</td><td>1</td><td>0.1</td><td>1.0</td><td>0 ... 1</td><td>5</td><td>share of the sensory feedback that remains while the couplings are on; the equations have 1</td><td>sections 3.2.1 and 4.3 let gamma become small once the couplings are on</td></tr>
<tr><td>coupling_sign</td><td></td><td>CouplingSign.reversed</td><td>CouplingSign.printed</td><td></td><td>18</td><td>sign of the coupling term; the paper prints plus</td><td>authors' code</td></tr>
<tr><td>phi_frozen</td><td></td><td>true</td><td>false</td><td></td><td>17</td><td>true: the couplings use the phases measured when kappa switched on; false: the phases measured now, as printed in Eq. 17</td><td>authors' code</td></tr>
<tr><td>MI_zero_resets</td><td></td><td>true</td><td>false</td><td></td><td>3</td><td>true: MI = 0 acts as reset; false: the oscillators keep running with w12 = w12_0, as printed in Eq. 3</td><td>authors' code</td></tr>
<tr><td>stored</td><td></td><td>false</td><td></td><td></td><td>17</td><td>true: start with the stored gait phi_stored and the couplings on</td><td></td></tr>
<tr><td>phi_stored[n - 1]</td><td>rad</td><td>0.0</td><td></td><td>-7 ... 7</td><td>17</td><td>stored gait at the start: relative phase phi_1k, used if stored is true</td><td></td></tr>
<tr><td>gamma_tegotae</td><td>1</td><td>0.015</td><td></td><td>0 ... 10</td><td>5</td><td>fixed feedback gain of the Tegotae baseline</td><td>authors' code: 0.03 for a load over the whole weight, not over its half</td></tr>
<tr><td>grf_reset</td><td>1</td><td>0.4</td><td></td><td>0 ... 10</td><td></td><td>load over a quarter of the weight at which a rising load resets the phase (phase-resetting baseline)</td><td>authors' code</td></tr>
</table>
<h4>Local variables</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>name</th><th>unit</th><th>default</th><th>paper</th><th>range</th><th>Eq.</th><th>what it is</th><th>source</th></tr>
<tr><td>K_f[n]</td><td>1</td><td></td><td></td><td></td><td>7</td><td>state of the fast learner</td><td></td></tr>
<tr><td>K_s[n]</td><td>1</td><td></td><td></td><td></td><td>8</td><td>state of the slow learner</td><td></td></tr>
</table>
</html>"));
end Variables;
