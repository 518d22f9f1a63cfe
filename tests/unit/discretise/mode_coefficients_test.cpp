// The constants of one mode against 100-digit arithmetic.
#include "discretise/mode_coefficients.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace {

using namespace dashpot::compiler;
using Reference =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

// Ten roundings of the 50 digits that the constants are derived in, times what the constant makes of those of its
// input.
void expect_equal(const Real& found, const Reference& expected, const char* what, const Reference& condition = 1) {
  EXPECT_LE(abs(Reference(found) - expected), Reference("1e-48") * condition * abs(expected))
      << what << " is " << found;
}

struct Case {
  const char* stiffness;
  const char* rate;
  const char* period;
};

// λh from 1e-18 to 1e6: a relaxation of thirty million years at 1 kHz, and one gone within a microsecond of it.
const Case cases[] = {{"3", "1e-15", "1e-3"},  {"1e4", "1e-5", "1e-5"}, {"0.5", "10", "1e-3"},
                      {"7e-4", "1e3", "1e-3"}, {"12", "45", "1"},       {"2", "1e9", "1e-3"}};

// Fails if e^{−λh} or what is made of it loses digits, at slow relaxations above all: 1 − a is tiny there.
TEST(ModeCoefficients, ExactScheme) {
  for (const Case& c : cases) {
    const Mode mode{Real(c.stiffness), Real(c.rate), 1, {}};
    const Real h(c.period);
    const Reference x = Reference(mode.relaxation_rate) * Reference(h);
    const Reference a = exp(Reference(-x));
    const ModeCoefficients found = mode_coefficients(mode, Scheme::exact, StateInput::position, h);
    expect_equal(found.decay, a, "a", 1 + x);
    expect_equal(found.loss, 1 - a, "α");
    expect_equal(found.position_gain, Reference(mode.stiffness) * (1 - a) / x, "c");
    EXPECT_EQ(found.velocity_gain, 0);
  }
}

// Fails if the backward Euler scheme is not the paper's: a = 1/(1 + λh), c = k a.
TEST(ModeCoefficients, BackwardEulerScheme) {
  for (const Case& c : cases) {
    const Mode mode{Real(c.stiffness), Real(c.rate), 1, {}};
    const Real h(c.period);
    const Reference a = 1 / (1 + Reference(mode.relaxation_rate) * Reference(h));
    const ModeCoefficients found = mode_coefficients(mode, Scheme::backward_euler, StateInput::position, h);
    expect_equal(found.decay, a, "a");
    expect_equal(found.loss, 1 - a, "α");
    expect_equal(found.position_gain, Reference(mode.stiffness) * a, "c");
  }
}

// Fails if the drive is lost or doubled between position and velocity: a displacement Δu in one sample is a velocity
// Δu/h.
TEST(ModeCoefficients, TheDriveIsShared) {
  const Mode mode{8, 10, Real("0.25"), {}};
  const Real h("0.001");
  const Real whole = mode_coefficients(mode, Scheme::backward_euler, StateInput::position, h).position_gain;
  const ModeCoefficients by_velocity = mode_coefficients(mode, Scheme::backward_euler, StateInput::velocity, h);
  EXPECT_EQ(by_velocity.position_gain, 0);
  EXPECT_LT(abs(by_velocity.velocity_gain - whole * h), Real("1e-48"));
  const ModeCoefficients nodal = mode_coefficients(mode, Scheme::backward_euler, StateInput::nodal, h);
  EXPECT_LT(abs(nodal.position_gain - whole / 4), Real("1e-48"));
  EXPECT_LT(abs(nodal.velocity_gain - whole * h * 3 / 4), Real("1e-48"));
}

}  // namespace
