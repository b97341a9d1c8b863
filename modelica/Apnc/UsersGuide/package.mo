within Apnc;
package UsersGuide "User's guide"
  extends Icons.Information;
  annotation (preferredView="info", Documentation(info="<html>
<h4>What it is</h4>
<p>Every leg has an oscillator that moves its hip and knee. The load on the foot, compared with the
load that the leg's own motion lets it expect, slows or speeds the oscillator; through the body of
the robot the legs then fall into a gait, without being told which. When the relative phases have
settled, neural couplings store them and keep the gait when loads are missing or wrong.</p>
<h4>How to connect a robot</h4>
<ol>
<li>Load on each foot [N] to grf; legs 1 right front, 2 right hind, 3 left front, 4 left hind.</li>
<li>theta_hip and theta_knee [rad], added to the reference pose, to the servos.</li>
<li>MI sets the stepping rate, turn steers; both may be constant.</li>
<li>robot_weight [N] is the parameter to set first.</li>
</ol>
<p>Another number of legs: n, the right ones first. Positive rotations swing the leg forward and lift
the foot.</p>
<h4>Native and external</h4>
<p><a href=\"modelica://Apnc.Blocks.Controller\">Blocks.Controller</a> is Modelica through and
through. <a href=\"modelica://Apnc.Blocks.ControllerC\">Blocks.ControllerC</a> calls the C code of
the FMU instead: fewer variables, faster.</p>
</html>"));
end UsersGuide;
