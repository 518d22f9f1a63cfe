// Damping of an eddy-current brake from its geometry: (3) of Gosline & Hayward 2009.
#pragma once

namespace dashpot::compiler {

struct EddyBrake {
  double thickness;    // d, of the blade [m]
  double pole_length;  // l, across the motion [m]
  double pole_width;   // w, along the motion [m]
  double field;        // B, in the gap [T]
  double resistivity;  // ρ, of the blade [Ω·m]
};

// α of a rectangular pole over an endless sheet (Heald 1988, Am. J. Phys. 56:521): with A = w/l,
// α = 1 − (1/2π) [4 atan A + A ln(1 + 1/A²) − (1/A) ln(1 + A²)]; one half for a square pole. It is the mean of
// k_x²/|k|² over the pole's spectrum, x along the motion: the voltage drives the currents across the motion, and a pole
// that is long there leaves them the shorter way back.
double return_path_correction(double pole_length, double pole_width);

// b = α d l w B²/ρ [N·s/m], where the field meets the blade.
double linear_damping(const EddyBrake& brake, double correction);

}  // namespace dashpot::compiler
