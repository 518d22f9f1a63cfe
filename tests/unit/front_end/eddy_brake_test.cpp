// The return path of the eddy currents against the integral that it is.
#include <gtest/gtest.h>

#include <cmath>

#include "commands/eddy_brake.hpp"

namespace dashpot::compiler {
namespace {

constexpr double half_turn = 3.14159265358979323846;

double square_of_sinc(double x) { return x == 0 ? 1 : std::pow(std::sin(x) / x, 2); }

// In an endless sheet ∇·J = 0 leaves of the voltage v B across the motion the share k_x²/|k|² of every plane wave, x
// along the motion. Its mean over the spectrum sinc²(k_x w/2) sinc²(k_y l/2) of a pole is, with x = k_x w/2, y = k_y
// l/2,
//     α = (1/π²) ∫∫ x²/(x² + r² y²) sinc² x sinc² y dx dy,     r = w/l.
// Midpoints up to a limit L in both directions; beyond it sin² is ½ on average, and what is left falls as 1/L.
double mean_over_spectrum(double length, double width, double limit) {
  const double r = width / length, step = 0.05;
  double sum = 0;
  for (double x = step / 2; x < limit; x += step) {
    double over_y = 0;
    for (double y = step / 2; y < limit; y += step) over_y += square_of_sinc(y) / (x * x + r * r * y * y);
    sum += std::pow(std::sin(x), 2) * over_y;
  }
  return 4 * sum * step * step / (half_turn * half_turn);
}

// Fails if a pole that is long across the motion is taken for one that is long along it.
TEST(EddyBrake, ReturnPathIsTheMeanOverThePolesSpectrum) {
  for (const auto& [length, width] :
       {std::pair(4.0, 1.0), std::pair(2.0, 1.0), std::pair(1.0, 1.0), std::pair(1.0, 2.0), std::pair(1.0, 4.0)}) {
    // Richardson: the rest falls as 1/L.
    const double near = mean_over_spectrum(length, width, 20 * half_turn),
                 far = mean_over_spectrum(length, width, 40 * half_turn);
    EXPECT_NEAR(return_path_correction(length, width), 2 * far - near, 1e-3) << length << " across, " << width;
  }
}

// Fails if the printed values of a pole of 4:1, or that both ways of laying it share the whole, are lost.
TEST(EddyBrake, AcrossAndAlong) {
  EXPECT_NEAR(return_path_correction(4, 1), 0.770, 5e-4);
  EXPECT_NEAR(return_path_correction(1, 4), 0.230, 5e-4);
  EXPECT_NEAR(return_path_correction(1, 1), 0.5, 1e-15);
  for (const double shape : {1.1, 3.0, 17.0})
    EXPECT_NEAR(return_path_correction(shape, 1) + return_path_correction(1, shape), 1, 1e-14);
}

}  // namespace
}  // namespace dashpot::compiler
