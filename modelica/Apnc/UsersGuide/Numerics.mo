within Apnc.UsersGuide;
class Numerics "Ticks and numbers"
  extends Icons.Information;
  annotation (preferredView="info", Documentation(info="<html>
<p>All blocks act at startTime, startTime + Ts, startTime + 2 Ts, ... (when sample(startTime, Ts))
and hold their outputs in between. Blocks that work together need the same Ts and startTime. Nothing
in the package is continuous, so no solver setting changes its numbers.</p>
<p>The blocks compute in the order of the FMU. Differences in the last bit of tanh, sin, cos and atan
between two mathematical libraries stay small while the gait is stable; under loads that contradict
the stored gait the coupled oscillators are chaotic and the differences grow.</p>
<p>The window of the mean (Eq. 14) is an array of N rows that shifts at every tick, N (n - 1)
variables; the external variant keeps it in C.</p>
</html>"));
end Numerics;
