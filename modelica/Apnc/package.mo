package Apnc "Adaptive neural control of legged robots (Sun, Dai & Manoonpong 2023)"
  extends Icons.Package;
  annotation (
    version="0.1.0",
    versionDate="2026-01-01",
    Documentation(info="<html>
<p>The controller that lets the legs of a robot find their gait from foot loads alone, and then keep
it from memory, as sampled blocks in Modelica. Start with
<a href=\"modelica://Apnc.Examples.RecalledGait\">Examples.RecalledGait</a>; read
<a href=\"modelica://Apnc.UsersGuide\">UsersGuide</a> before connecting a robot of your own.</p>
</html>"));
end Apnc;
