#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/box_motor.hpp"
#include "certify/box_numbers.hpp"
#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

class BoxEnergy : private BoxNumbers {
 public:
  explicit BoxEnergy(const UpdateLaw& law)
      : BoxNumbers(*law.tunable), scalar_(law.scalar), period_(law.sample_period) {}

  // Whether no relaxation gives more work than its spring stores, for all parameters in their ranges.
  bool relaxations_give_no_energy() const {
    return std::all_of(tables_.parts.begin(), tables_.parts.end(), [&](const BlockPart& part) {
      if (part.kind != PartKind::relaxation) return true;
      if (const auto& fixed = tables_.fixed[static_cast<std::size_t>(part.spring)])
        return gives_no_energy(Rational(fixed->loss), Rational(fixed->share));
      if (!tables_.is_exact) return true;  // (1 − φ)² + φ² ≤ 1, φ of 0 … 1
      const Affine spring = stiffness(part.spring), damper = number(part.damping);
      return exact_gives_no_energy(ratio(least(spring), most(damper)), ratio(most(spring), least(damper)));
    });
  }

 private:
  // a² + (1 − φ)² ≤ 1, with a = 1 − α: checked exactly for emitted constants.
  static bool gives_no_energy(const Rational& loss, const Rational& share) {
    return loss * (2 - loss) >= (1 - share) * (1 - share);
  }

  // The same for every x = λh between two ends, with the α and φ that the law computes, off by 64 units of roundoff at
  // most. α rises with x and φ falls: on an interval the least α stands against the least φ. Below 1e-9, α > x/2 and 1
  // − φ < x; beyond 700, α = 1 in double.
  bool exact_gives_no_energy(double low, double high) const {
    const double outward = 1 - 64 * unit_roundoff(scalar_);
    for (double x = std::max(low, 1e-9); x < std::min(high, 700.0); x *= interval_)
      if (!gives_no_energy(Rational(-std::expm1(-x) * outward),
                           Rational(-std::expm1(-interval_ * x) / (interval_ * x) * outward)))
        return false;
    return true;
  }
  static constexpr double interval_ = 1.05;

  // k h/B, for the ends of intervals; they need not be sharp
  double ratio(const Rational& stiffness, const Rational& damping) const {
    return damping > 0 ? Rational(stiffness * period_ / damping).convert_to<double>()
                       : std::numeric_limits<double>::infinity();
  }

  ScalarType scalar_;
  Rational period_;
};

}  // namespace

EnergyLemma check_energy_lemma_over_box(const UpdateLaw& law) {
  EnergyLemma lemma;
  lemma.applies = lemma.over_box = true;
  lemma.with_slips = !law.tunable->yields.empty();
  lemma.holds = BoxEnergy(law).relaxations_give_no_energy();
  return lemma;
}

}  // namespace dashpot::compiler
