#include "certify/box_hold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/box_numbers.hpp"
#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

constexpr double largest_hold = 0.5462;  // largest ψ of the exact scheme, at kT/b = 1.65
constexpr double infinite = std::numeric_limits<double>::infinity();

class Held : private BoxNumbers {
 public:
  explicit Held(const UpdateLaw& law)
      : BoxNumbers(*law.tunable), period_(law.sample_period), margin_(1 + 64 * unit_roundoff(law.scalar)) {}

  BoxHold find(bool sheds) const {
    BoxHold hold;
    for (const BlockPart& part : parts_of(tables_.blocks.front())) {
      hold.has_meshes = hold.has_meshes || part.kind == PartKind::mesh;
      if (part.kind == PartKind::relaxation) hold.relaxations.push_back(relaxation(part));
      if (part.kind != PartKind::spring) continue;
      hold.static_stiffness = largest(stiffness(part.spring));
      if (sheds || is_tunable(stiffness(part.spring))) hold.static_slack = tables_.head.map.largest_change;
    }
    for (int i = 0; i < static_cast<int>(tables_.springs.size()); ++i)
      hold.can_soften = hold.can_soften || is_tunable(stiffness(i));
    for (const TunableYield& yield : tables_.yields) hold.yield_forces += largest_yield(yield);
    return hold;
  }

 private:
  double largest(const Affine& f) const { return most(f).convert_to<double>() * margin_; }

  static bool is_tunable(const Affine& f) {
    return std::any_of(f.factors.begin(), f.factors.end(), [](const Rational& factor) { return factor != 0; });
  }

  // All of these rise with k and with b; the last one is b/T.
  HeldRelaxation relaxation(const BlockPart& part) const {
    const Affine spring = stiffness(part.spring);
    const double k = largest(spring), b = largest(number(part.damping));
    if (const auto& fixed = tables_.fixed[static_cast<std::size_t>(part.spring)])
      return of(k, fixed->share, fixed->loss);
    const double x = b > 0 ? k * period_ / b : infinite;
    const double loss = tables_.is_exact ? -std::expm1(-x) : std::isinf(x) ? 1 : x / (1 + x);
    const double share = std::isinf(x) || x == 0 ? double(x == 0) : loss / x;
    HeldRelaxation held = of(k, share, loss);
    const double least_damping = least(number(part.damping)).convert_to<double>();
    const double largest_ratio = least_damping > 0 ? k * period_ / least_damping * margin_ : infinite;
    const double most_loss = -std::expm1(-largest_ratio);
    const double quickest = largest_ratio > 1   ? largest_hold
                            : largest_ratio > 0 ? hold_of(most_loss / largest_ratio, most_loss)
                                                : 0.5;
    held.hold = k * (tables_.is_exact ? quickest : 0.5) * margin_;
    held.turning = k * margin_;  // 1 − aφ ≤ 1 − a²
    held.per_way = b / period_ * margin_;
    if (is_tunable(spring)) held.stiffness = infinite;
    return held;
  }

  static double hold_of(double share, double loss) {
    const double apart = share - (1 - loss);
    return 0.5 + 0.5 * apart * apart / (loss * (2 - loss));
  }

  HeldRelaxation of(double k, double share, double loss) const {
    const double lost = loss * (2 - loss);  // 1 − a²
    if (!(lost > 0)) return {k / 2, k, infinite, k, infinite};
    return {k * hold_of(share, loss) * margin_, k * (1 - (1 - loss) * share) / lost * margin_, k / (2 * lost) * margin_,
            k, k * share / loss * margin_};
  }

  double largest_yield(const TunableYield& yield) const {
    double weakest = infinite;
    for (const int cut : cuts_of(yield)) weakest = std::min(weakest, largest(number(cut)));
    return std::max(weakest, yield.least);
  }

  double period_, margin_;
};

}  // namespace

BoxHold box_hold(const UpdateLaw& law, bool sheds) { return Held(law).find(sheds); }

}  // namespace dashpot::compiler
