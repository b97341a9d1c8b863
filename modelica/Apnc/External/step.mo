within Apnc.External;
impure function step "Tick number k of the C core; generated from the table, do not edit"
  extends Icons.Function;
  input State state "circuits and memory";
  input Integer k "number of this tick; the same again repeats the tick, as an event iteration may";
  input Types.Force grf[n] "load on the foot; a value that is not finite, negative or above 1000 weights counts as zero and raises fault (Eq. 5)";
  input Real MI "modulatory input: sets the stepping frequency; limited to its range (Eq. 3)";
  input Real turn "steering, positive turns left: scales the amplitudes of the right legs up and of the left legs down; limited to its range (Eq. 4)";
  input Boolean reset "while true, oscillators, learners and forward models stay at their start state; the stored gait is kept";
  input Integer n "number of legs";
  output Types.Angle theta_hip[n] "command of the hip joint, relative to the reference pose (Eq. 4)";
  output Types.Angle theta_knee[n] "command of the knee joint, relative to the reference pose (Eq. 4)";
  output Real o1[n] "output of neuron N1 (Eq. 2)";
  output Real o2[n] "output of neuron N2 (Eq. 2)";
  output Real gamma[n] "gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), times feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines (Eq. 5, 9)";
  output Real grf_expected[n] "expected load over half the weight (Eq. 10)";
  output Real f1[n] "sensory feedback to neuron N1 (Eq. 5)";
  output Real f2[n] "sensory feedback to neuron N2 (Eq. 5)";
  output Real g1[n] "neural coupling to neuron N1, as added to its activation (Eq. 17)";
  output Real g2[n] "neural coupling to neuron N2, as added to its activation (Eq. 17)";
  output Boolean fault[n] "true while the load input of the leg cannot be used";
  output Types.Angle phi[n - 1] "relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2) (Eq. 12)";
  output Types.Angle phi_memory[n - 1] "stored gait that is held now: relative phase phi_1k; zero while no gait is stored (Eq. 17)";
  output Types.Angle d "distance of the relative phases from their mean (Eq. 15)";
  output Real kappa "1 while the neural couplings are on, else 0 (Eq. 16)";
  output Real K_f[n] "state of the fast learner (Eq. 7)";
  output Real K_s[n] "state of the slow learner (Eq. 8)";
external "C" apnc_modelica_step(
    state,
    k,
    grf,
    MI,
    turn,
    reset,
    theta_hip,
    theta_knee,
    o1,
    o2,
    gamma,
    grf_expected,
    f1,
    f2,
    g1,
    g2,
    fault,
    phi,
    phi_memory,
    d,
    kappa,
    K_f,
    K_s)
  annotation (
    Include="#include \"apnc_modelica.h\"",
    IncludeDirectory="modelica://Apnc/Resources/Include");
end step;
