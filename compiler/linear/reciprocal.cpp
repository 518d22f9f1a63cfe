// Zeros of D(s) on the negative real axis, which interlace its poles, and the partial fractions of s/D(s).
#include <boost/math/tools/toms748_solve.hpp>

#include <vector>

#include "linear/linear_form.hpp"

namespace dashpot::compiler {
namespace {

// D(−x) times the factors (λ_low − x), (λ_high − x) of the two poles that bound an interval, so that it is finite and
// changes sign between them.
class RegularisedStiffness {
 public:
  RegularisedStiffness(const LinearForm& form, std::size_t low, std::size_t high)
      : form_(form), low_(low), high_(high) {}

  Real operator()(const Real& x) const {
    Real rest = form_.static_stiffness - form_.feedthrough_damping * x;
    for (std::size_t i = 0; i < form_.modes.size(); ++i)
      if (i != low_ && i != high_) rest -= form_.modes[i].stiffness * x / (form_.modes[i].relaxation_rate - x);
    const Real to_low = gap(low_, x), to_high = gap(high_, x);
    return rest * to_low * to_high - x * (numerator(low_) * to_high + numerator(high_) * to_low);
  }

 private:
  Real gap(std::size_t i, const Real& x) const {
    return i < form_.modes.size() ? Real(form_.modes[i].relaxation_rate - x) : Real(1);
  }
  Real numerator(std::size_t i) const { return i < form_.modes.size() ? form_.modes[i].stiffness : Real(0); }

  const LinearForm& form_;
  std::size_t low_, high_;
};

constexpr std::size_t no_pole = static_cast<std::size_t>(-1);

Real zero_between(const LinearForm& form, std::size_t low, std::size_t high, const Real& from, const Real& to) {
  const RegularisedStiffness f(form, low, high);
  std::uintmax_t iterations = 1000;
  const auto close = [](const Real& a, const Real& b) -> bool { return abs(b - a) <= Real("1e-46") * abs(b); };
  const auto [a, b] = boost::math::tools::toms748_solve(f, from, to, close, iterations);
  return (a + b) / 2;
}

// Beyond the fastest pole D(−x) falls to −∞ with −b∞ x.
Real zero_above(const LinearForm& form) {
  const std::size_t last = form.modes.size() - 1;
  const Real from = form.modes[last].relaxation_rate;
  Real to = 2 * from + 2 * glass_stiffness(form) / form.feedthrough_damping;
  const RegularisedStiffness f(form, last, no_pole);
  const bool sign_at_pole = f(from) > 0;
  while ((f(to) > 0) == sign_at_pole) to *= 2;
  return zero_between(form, last, no_pole, from, to);
}

std::vector<Real> zeros(const LinearForm& form) {
  const std::size_t count = form.modes.size();
  const bool is_solid = form.static_stiffness > 0, has_feedthrough = form.feedthrough_damping > 0;
  if (count == 0)
    return is_solid && has_feedthrough ? std::vector<Real>{form.static_stiffness / form.feedthrough_damping}
                                       : std::vector<Real>{};
  std::vector<Real> found;
  if (is_solid) found.push_back(zero_between(form, no_pole, 0, 0, form.modes[0].relaxation_rate));
  for (std::size_t i = 0; i + 1 < count; ++i)
    found.push_back(zero_between(form, i, i + 1, form.modes[i].relaxation_rate, form.modes[i + 1].relaxation_rate));
  if (has_feedthrough) found.push_back(zero_above(form));
  return found;
}

// D′(s) at s = −x
Real slope(const LinearForm& form, const Real& x) {
  Real sum = form.feedthrough_damping;
  for (const Mode& mode : form.modes) {
    const Real gap = mode.relaxation_rate - x;
    sum += mode.stiffness * mode.relaxation_rate / (gap * gap);
  }
  return sum;
}

}  // namespace

LinearForm reciprocal(const LinearForm& form) {
  LinearForm inverse;
  if (form.static_stiffness == 0) inverse.static_stiffness = 1 / zero_frequency_damping(form);
  if (form.feedthrough_damping == 0) inverse.feedthrough_damping = 1 / glass_stiffness(form);
  for (const Real& zero : zeros(form)) inverse.modes.push_back({1 / slope(form, zero), zero, 1, {}});
  return inverse;
}

}  // namespace dashpot::compiler
