within Apnc;
package Icons "Icons"

  partial package Package "Icon of a package"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Rectangle(
            extent={{-100,-100},{100,100}},
            radius=25,
            lineColor={24,42,66},
            fillColor={244,247,251},
            fillPattern=FillPattern.Solid),
          Line(points={{-70,0},{-45,45},{-15,45},{15,-45},{45,-45},{70,0}}, color={0,114,178}, thickness=1,
            smooth=Smooth.Bezier)}));
  end Package;

  partial package Types "Icon of the package of types"
    extends Package;
  end Types;

  partial class Information "Icon of a page of the user's guide"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Ellipse(extent={{-90,-90},{90,90}}, lineColor={0,114,178}, fillColor={244,247,251},
            fillPattern=FillPattern.Solid),
          Text(extent={{-60,-60},{60,60}}, textString="i", textColor={0,114,178})}));
  end Information;

  partial model Example "Icon of a model that runs"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Ellipse(extent={{-100,-100},{100,100}}, lineColor={24,42,66}, fillColor={255,255,255},
            fillPattern=FillPattern.Solid),
          Polygon(points={{-36,60},{64,0},{-36,-60},{-36,60}}, lineColor={0,114,178},
            fillColor={0,114,178}, fillPattern=FillPattern.Solid)}));
  end Example;

  partial block Block "Icon of a sampled block"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Rectangle(extent={{-100,-100},{100,100}}, lineColor={24,42,66}, fillColor={244,247,251},
            fillPattern=FillPattern.Solid),
          Text(extent={{-150,110},{150,150}}, textString="%name", textColor={0,0,255})}));
  end Block;

  partial function Function "Icon of a function"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Ellipse(extent={{-100,-100},{100,100}}, lineColor={0,114,178}, fillColor={255,255,255},
            fillPattern=FillPattern.Solid),
          Text(extent={{-80,-80},{80,80}}, textString="f", textColor={0,114,178})}));
  end Function;
end Icons;
