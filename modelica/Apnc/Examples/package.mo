within Apnc;
package Examples "Models that run as they are"
  extends Icons.Package;
end Examples;
