component brake_current "The current with which an eddy-current brake makes a wanted damping";
description """
The damping of an eddy-current brake is proportional to the square of its coil's current: b = kappa i^2, so i = sqrt(b / kappa).
More than \\fBmax-current\\fR is not commanded; \\fBsaturated\\fR then says that the tool feels less damping than it should.""";
pin in float damping "that is wanted: N s/m, or N m s/rad";
pin out float current "for the amplifier of the coil [A]";
pin out bit saturated "more damping is wanted than max_current makes";
param rw float kappa = 1 "of the calibration: N s/(m A^2), or N m s/(rad A^2)";
param rw float max_current = 0 "of coil and amplifier [A]";
function _ fp "once a period, between the law's output and the amplifier's";
author "dashpot";
license "Apache-2.0";
;;
#include <rtapi_math.h>

FUNCTION(_) {
  const double wanted = (damping > 0 && kappa > 0) ? sqrt(damping / kappa) : 0;
  saturated = wanted > max_current;
  current = saturated ? max_current : wanted;
}
