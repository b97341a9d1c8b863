within Apnc;
package External "The C core as an external object"
  extends Icons.Package;
  annotation (Documentation(info="<html>
<p>Resources/Include holds two headers: apnc_modelica.h, which the functions here include, and
apnc_core.h, the C core in one file without external names. The tool finds both by the annotation
IncludeDirectory; nothing is linked but the mathematical library of C.</p>
</html>"));
end External;
