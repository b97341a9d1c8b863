within Apnc;
package Blocks "The controller and the blocks of the paper it is made of"
  extends Icons.Package;
  annotation (Documentation(info="<html>
<p>At tick n a block shows its outputs from its state at n and its inputs at n, and then makes the
state at n + 1; variables called <i>..._next</i> are that state. Outputs hold until the next
tick.</p>
</html>"));
end Blocks;
