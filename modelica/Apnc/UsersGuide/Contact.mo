within Apnc.UsersGuide;
class Contact "Licence and contact"
  extends Icons.Information;
  annotation (preferredView="info", Documentation(info="<html>
<p>Copyright the APNC developers, licence BSD-3-Clause. Questions and mistakes found: the issue
tracker of the project.</p>
</html>"));
end Contact;
