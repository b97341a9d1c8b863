within Apnc;
package Constants "Constants of the controller; generated from the reference, do not edit"
  extends Icons.Package;

  constant Real PI=3.14159265358979323846 "ratio of a circle's circumference to its diameter";
  constant Real NEVER=1e60 "larger than any load or command: nothing came before";
  constant Real LARGEST=1.7976931348623157e308 "largest number";
  constant Integer KERNELS=20 "number of radial basis functions of the forward model";
  constant Real MOST_WEIGHTS=1000.0 "a load above so many times the weight is none";
  constant Real FORGOTTEN=1e-200 "gains below this count as zero";
  constant Real A1_AT_TOUCH_DOWN=1.0 "activation a1 that touch-down sets (phase_reset)";
  constant Real A2_AT_TOUCH_DOWN=0.0 "activation a2 that touch-down sets (phase_reset)";
  constant Real KERNEL_WIDTH=0.04 "distance squared of a kernel's 1/e";
  constant Real OVERLAP=1.15 "mean of the kernels' sum over the angle of the cycle";
  constant Real CENTRES_1[KERNELS]={0.85, 0.87, 0.88, 0.57, 0.27, 0.0, -0.28, -0.64, -0.79, -0.83, -0.85, -0.87, -0.88, -0.57, -0.27, 0.0, 0.28, 0.64, 0.79, 0.83} "kernels' centres along o1";
  constant Real CENTRES_2[KERNELS]={0.0, 0.28, 0.64, 0.79, 0.83, 0.85, 0.87, 0.88, 0.57, 0.27, 0.0, -0.28, -0.64, -0.79, -0.83, -0.85, -0.87, -0.88, -0.57, -0.27} "kernels' centres along o2";
  constant Real MI_START=0.08 "MI until it was a number";
  constant Real MI_MIN=0.0 "MI is limited to this";
  constant Real MI_MAX=1.0 "MI is limited to this";
  constant Real TURN_START=0.0 "turn until it was a number";
  constant Real TURN_MIN=-1.0 "turn is limited to this";
  constant Real TURN_MAX=1.0 "turn is limited to this";
end Constants;
