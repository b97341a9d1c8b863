within Apnc;
package Functions "Functions that several blocks need"
  extends Icons.Package;
end Functions;
