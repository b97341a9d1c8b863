within Apnc;
package Interfaces "Connectors and partial blocks"
  extends Icons.Package;

  connector RealInput = input Real "Real input"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={0,0,127}, fillPattern=FillPattern.Solid)}));

  connector RealOutput = output Real "Real output"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}));

  connector BooleanInput = input Boolean "Boolean input"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={255,0,255}, fillColor={255,0,255}, fillPattern=FillPattern.Solid)}));

  connector BooleanOutput = output Boolean "Boolean output"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={255,0,255}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}));

  connector IntegerInput = input Integer "Integer input"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={255,127,0}, fillColor={255,127,0}, fillPattern=FillPattern.Solid)}));

  connector IntegerOutput = output Integer "Integer output"
    annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
          Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={255,127,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}));

  partial block SampledBlock "Block that acts at startTime, startTime + Ts, startTime + 2 Ts, ..."
    extends Icons.Block;
    extends Parameters.Sampling;
    parameter Types.Time startTime=0.0 "time of the first tick" annotation (Dialog(group="Sampling"));
  end SampledBlock;

  partial block HeldBlock "Sampled block whose state is held at its start while hold is true"
    extends SampledBlock;
    BooleanInput hold "true: the state stays at its start"
      annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90, origin={0,-120})));
  end HeldBlock;

  annotation (Documentation(info="<html>
<p>The connectors are plain Real, Boolean and Integer with a direction, so those of the Modelica
Standard Library connect to them.</p>
</html>"));
end Interfaces;
