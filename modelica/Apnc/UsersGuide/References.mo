within Apnc.UsersGuide;
class References "References"
  extends Icons.Information;
  annotation (preferredView="info", Documentation(info="<html>
<ul>
<li>Sun, T., Dai, Z., Manoonpong, P. (2023): Robust and reusable self-organized locomotion of legged
robots under adaptive physical and neural communications. Front. Neural Circuits 17:1111285. The
equations, numbered as there.</li>
<li>Owaki, D. et al. (2012): Simple robot suggests physical interlimb communication is essential for
quadruped walking. J. R. Soc. Interface 10. The Tegotae baseline.</li>
<li>Aoi, S. et al. (2011): Hysteresis in the gait transition of a quadruped investigated using simple
body mechanical and oscillator network models. Phys. Rev. E 83. The phase-resetting baseline.</li>
</ul>
</html>"));
end References;
