#include "axes/workspace_bound.hpp"

#include <algorithm>
#include <optional>

#include "axes/best_first.hpp"
#include "axes/curvature.hpp"
#include "axes/weighed.hpp"
#include "network/match.hpp"

namespace dashpot::compiler::axes {

Interval motor_force(const PortLoad& load, const Interval& depth, const Interval& over_workspace) {
  const Interval more = Interval(-load.estimated, load.estimated) + Interval(-load.yields, load.yields);
  const Interval springs(load.grounded), relaxing(load.relaxing),
      pressed = max(depth - Interval(load.surface), Interval(0));
  const Interval force = load.unilateral ? (springs + relaxing) * pressed + more
                                         : springs * depth + relaxing * (depth - over_workspace) + more;
  if (load.unilateral && pressed.high == 0) return Interval(0);
  const auto clamped = [&](double end) { return std::clamp(end, -load.clamp, load.clamp); };
  return {clamped(load.unilateral ? 0 : force.low), clamped(force.high)};
}

namespace {

// One end of M over a box of joints: slope w + offset.
struct ForceForm {
  double slope;
  Interval offset;

  template <typename S>
  S at(const S& depth) const {
    return S(slope) * depth + S(offset);
  }
};

// Both ends of M, or one where they are the same: of a spring alone, whose force is that of its depth. If nothing
// clamps and no surface lies in the box, they are affine in the depth, else constants that bound M over the box. What
// is needed is convex in M, so that the ends are enough.
std::vector<ForceForm> force_ends(const PortLoad& load, const Interval& depth, const Interval& range) {
  const Interval force = motor_force(load, depth, range);
  const double stiffness = load.grounded + load.relaxing;
  const Interval more = Interval(load.yields) + Interval(load.estimated), relaxing(load.relaxing);
  if (force.low > -load.clamp && force.high < load.clamp) {
    if (!load.unilateral && load.relaxing == 0 && more.high == 0) return {ForceForm{stiffness, Interval(0)}};
    if (!load.unilateral) {
      return {ForceForm{stiffness, -(relaxing * Interval(range.high) + more)},
              ForceForm{stiffness, more - relaxing * Interval(range.low)}};
    }
    if (depth.low >= load.surface)
      return {ForceForm{0, Interval(0)}, ForceForm{stiffness, more - Interval(stiffness) * Interval(load.surface)}};
  }
  return {ForceForm{0, Interval(force.low)}, ForceForm{0, Interval(force.high)}};
}

// Whether the map's own curvature can only lessen the sum: that of a ball or a band that pushes outward (M ≥ 0), and
// the other way round for a cavity.
bool is_lessened_by_bend(const PortMap& map, const Interval& force) {
  return match(
      map, [](const Plane&) { return false; },
      [&](const Circle& circle) { return circle.sign < 0 ? force.high <= 0 : force.low >= 0; },
      [&](const Band&) { return force.low >= 0; }, [](const Grid&) { return false; });
}

// An upper bound of Jᵀ ∇w ∇wᵀ J where the direction of ∇w is not known, as at a centre and on a line.
template <typename S>
std::optional<Symmetric<S>> steepest(const PortMap& map, const Pose<S>& at) {
  using Bound = std::optional<Symmetric<S>>;
  return match(
      map, [](const Plane&) -> Bound { return std::nullopt; },
      [&](const Circle&) -> Bound {
        return at_joints(at, Symmetric<S>{S(1), S(0), S(1)});
      },
      [&](const Band& band) -> Bound { return outer(at_joints(at, constant<S>(band.normal))); },
      [](const Grid&) -> Bound { return std::nullopt; });
}

// Joints when a force is commanded, and all that they reach while it is held.
struct Region {
  Pair<Sloped> from;
  TipMotion reached;
};

Pair<Sloped> moved(const Pair<Sloped>& from, const Pair<double>& by) {
  Pair<Sloped> result = from;
  for (const std::size_t j : {0u, 1u})
    if (by[j] > 0) result[j] = result[j] + variable(Interval(-by[j], by[j]), 2 + j);
  return result;
}

// The largest movement of the tip.
Pair<double> reach_of_tip(const Arm& arm, const Pair<Sloped>& joints, const Pair<double>& reach) {
  const Pair<Sloped> reached = moved(joints, reach);
  const Pose<Interval> moves = pose(arm, Box{reached[0].value, reached[1].value});
  const auto along = [&](std::size_t i) {
    return (abs(moves.column[0][i]) * Interval(reach[0]) + abs(moves.column[1][i]) * Interval(reach[1])).high;
  };
  return {along(0), along(1)};
}

// Nothing where the part has to be halved before this is known.
std::optional<Region> region_over(const Arm& arm, const Box& tip, const Pair<double>& reach) {
  const Pair<Sloped> at = variables(tip);
  const std::optional<Pair<Sloped>> joints = enclosed_joints(arm, at);
  if (!joints) return std::nullopt;
  if (reach == Pair<double>{0, 0}) return Region{*joints, tip_motion(arm, *joints, at)};
  const Pair<Sloped> there = moved(at, reach_of_tip(arm, *joints, reach));
  const std::optional<Pair<Sloped>> reached = enclosed_joints(arm, there);
  if (!reached) return std::nullopt;
  return Region{*joints, tip_motion(arm, *reached, there)};
}

// |H| = α H + β W, with the |λ| of H v = λ W v: of λ1 ≤ λ2 not of one sign α = (λ1 + λ2)/(λ2 − λ1) and β = −2 λ1
// λ2/(λ2 − λ1); else α = ±1 and β = 0. Nothing where λ1 and λ2 may be alike.
std::optional<Symmetric<Sloped>> absolute(const Symmetric<Sloped>& h, const Pair<double>& weight) {
  const Sloped first(weight[0]), second(weight[1]);
  const Sloped a = h.xx / first, c = h.yy / second, b_squared = square(h.xy) / (first * second);
  const Sloped apart = square(a - c) + Sloped(4) * b_squared;
  if (!(sqrt(apart.value).low > 0)) return std::nullopt;
  const Sloped inverse = Sloped(1) / sqrt(apart);
  const Sloped alpha = max(min((a + c) * inverse, Sloped(1)), Sloped(-1));
  const Sloped beta = max(Sloped(2) * (b_squared - a * c) * inverse, Sloped(0));
  return alpha * h + beta * Symmetric<Sloped>{first, Sloped(0), second};
}

// The same for any place in the reach, whichever place there other terms are taken at.
Sloped anywhere_reached(const Sloped& a) {
  const double most = (abs(a.slope[2]) + abs(a.slope[3])).high;
  return {a.value, a.middle + Interval(-most, most), {a.slope[0], a.slope[1]}};
}

// Upper bounds of `times` |N|, for products of displacements at different samples, each with an N of its own: by ‖N‖ W,
// and by |N| itself where it is known.
std::vector<Symmetric<Sloped>> latenesses_of(double times, const Symmetric<Sloped>& n, const Pair<double>& weight) {
  if (times == 0) return {{Sloped(0), Sloped(0), Sloped(0)}};
  const double late = times * size_of(n, weight) * (1 + 1e-12);
  std::vector<Symmetric<Sloped>> all{{Sloped(late * weight[0]), Sloped(0), Sloped(late * weight[1])}};
  if (const auto size = absolute(n, weight)) {
    const Symmetric<Sloped> paid = Sloped(times * (1 + 1e-12)) * *size;
    all.push_back({anywhere_reached(paid.xx), anywhere_reached(paid.xy), anywhere_reached(paid.yy)});
  }
  return all;
}

// The port without its spring k0, if that spring's force is always k0 w; else the whole port.
PortLoad beside_field(const PortLoad& load) {
  PortLoad rest = load;
  if (load.unilateral || load.clamp < unlimited) return rest;
  rest.held = max(Interval(load.held) - Interval(0.5) * Interval(load.grounded), Interval(0)).high;
  rest.grounded = 0;
  return rest;
}

// The bound that asks for the least.
Symmetric<Sloped> least_of(const std::vector<Symmetric<Sloped>>& enough, const Pair<double>& weight) {
  if (enough.size() == 1) return enough.front();
  std::size_t best = 0;
  double least = infinity;
  for (std::size_t i = 0; i < enough.size(); ++i) {
    const double x = weighed(enough[i], weight).x;
    if (x < least) best = i, least = x;
  }
  return enough[best];
}

class PortNeed {
 public:
  PortNeed(const PortLoad& load, const Interval& range) : load_(load), rest_(beside_field(load)), range_(range) {}

  // For both ends of M: what is needed over joints as it stands, and the tightest of several upper bounds; both include
  // what delay adds beside `field`.
  struct Ends {
    std::vector<Symmetric<Sloped>> as_it_stands, tightest;
    bool has_a_choice = false;                                 // if not, both are the same
    Symmetric<Sloped> field{Sloped(0), Sloped(0), Sloped(0)};  // k0 (g gᵀ + w H)
  };

  Ends over(const TipMotion& there, int delay, const Pair<double>& weight) const {
    const Depth<Sloped> depth = axes::depth(load_.map, there.pose.tip);
    if (load_.unilateral && depth.value.value.high <= load_.surface) return {};
    const Interval force = motor_force(load_, depth.value.value, range_);
    const Symmetric<Sloped> carried = depth.gradient[0] * there.bends[0] + depth.gradient[1] * there.bends[1];
    const Symmetric<Sloped> own = at_joints(there.pose, bend(load_.map, there.pose.tip));
    const Symmetric<Sloped> hessian = carried + own, steepness = outer(at_joints(there.pose, depth.gradient));
    const Sloped held(Interval(load_.held) + Interval(2 * delay) * Interval(rest_.held));
    const Symmetric<Sloped> squared = held * steepness;
    const std::optional<Symmetric<Sloped>> steep = steepest(load_.map, there.pose);
    const bool lessened = is_lessened_by_bend(load_.map, force);
    const double late_force = delay * abs(motor_force(rest_, depth.value.value, range_)).high;
    const std::vector<Symmetric<Sloped>> latenesses = latenesses_of(late_force, hessian, weight);
    Ends ends;
    ends.has_a_choice = steep || lessened;
    if (rest_.grounded < load_.grounded) ends.field = Sloped(load_.grounded) * (steepness + depth.value * hessian);
    for (const ForceForm& form : force_ends(load_, depth.value.value, range_)) {
      const Sloped half = Sloped(0.5) * form.at(depth.value);
      std::vector<Symmetric<Sloped>> stands, enough;
      for (const Symmetric<Sloped>& lateness : latenesses) {
        const Symmetric<Sloped> all = half * hessian + lateness;
        stands.push_back(squared + all);
        enough.push_back(squared + all);
        if (steep) enough.push_back(held * *steep + all);
        if (lessened) {
          const Symmetric<Sloped> less = half * carried + lateness;
          enough.push_back(squared + less);
          if (steep) enough.push_back(held * *steep + less);
        }
      }
      ends.as_it_stands.push_back(least_of(stands, weight));
      ends.tightest.push_back(ends.has_a_choice ? least_of(enough, weight) : ends.as_it_stands.back());
    }
    return ends;
  }

 private:
  const PortLoad& load_;
  PortLoad rest_;
  Interval range_;
};

constexpr std::size_t most_sums = 64;  // over each part of the workspace: of six ports with two ends each

// One matrix that is no less than either end, so that their mean and what they differ by at most are enough.
Symmetric<Sloped> above_both(const Symmetric<Sloped>& one, const Symmetric<Sloped>& other, const Pair<double>& weight) {
  const Symmetric<Sloped> mean = Sloped(0.5) * (one + other);
  std::vector<Symmetric<Sloped>> enough;
  for (const Symmetric<Sloped>& half : latenesses_of(0.5, one - other, weight)) enough.push_back(mean + half);
  return least_of(enough, weight);
}

// Each of `sums` plus each of `ends`, of which there are one or two; where that would be too many sums, plus a bound of
// both ends.
std::vector<Symmetric<Sloped>> with_each(const std::vector<Symmetric<Sloped>>& sums,
                                         const std::vector<Symmetric<Sloped>>& ends, const Pair<double>& weight) {
  if (ends.empty()) return sums;
  if (sums.empty()) return ends;
  if (sums.size() * ends.size() > most_sums && ends.size() == 2)
    return with_each(sums, {above_both(ends[0], ends[1], weight)}, weight);
  std::vector<Symmetric<Sloped>> result;
  for (const Symmetric<Sloped>& sum : sums)
    for (const Symmetric<Sloped>& end : ends) result.push_back(sum + end);
  return result;
}

class Search {
 public:
  Search(const Arm& arm, const std::vector<PortLoad>& loads, const Box& workspace, const SampledLoop& loop,
         const Pair<double>& weight, const GivenDamping& given)
      : arm_(arm), workspace_(workspace), loop_(loop), weight_(weight), given_(given) {
    for (const PortLoad& load : loads) ports_.emplace_back(load, range_of(load.map, workspace));
  }

  NeededDamping run(double tolerance, int most) {
    const auto is_enough = [&](double need) { return is_close(need, tolerance); };
    const double need = best_first(
        workspace_, most, [&](const Box& box) { return measured(box); }, is_enough);
    return {need, attained_, at_, is_enough(need)};
  }

 private:
  bool is_close(double need, double tolerance) const { return need - attained_ <= tolerance * scale_; }

  // The need is also evaluated at the place of a part where it would be largest if the entries were linear.
  double measured(const Box& box) {
    const std::optional<Region> region = region_over(arm_, box, loop_.reach);
    if (!region) return infinity;
    const Largest part = need_over(*region, nullptr);
    if (!(part.x > attained_)) return attained_;
    const std::optional<Region> there = region_over(arm_, constant<Interval>(place_in(box, part)), loop_.reach);
    if (!there) return part.x;
    const double limit = need_over(*there, &scale_).x;
    if (limit > attained_) attained_ = limit, at_ = {there->from[0].middle.middle(), there->from[1].middle.middle()};
    return std::max(part.x, limit);
  }

  // Over all sums of ends, as they stand or the tightest of each port: which of the two is less differs from part to
  // part.
  Largest need_over(const Region& region, double* scale) const {
    const Symmetric<Sloped> none{Sloped(0), Sloped(0), Sloped(0)};
    std::vector<Symmetric<Sloped>> stands, tightest;
    Symmetric<Sloped> field = none;
    bool has_a_choice = false;
    for (const PortNeed& port : ports_) {
      const PortNeed::Ends ends = port.over(region.reached, loop_.delay, weight_);
      stands = with_each(stands, ends.as_it_stands, weight_);
      tightest = with_each(tightest, ends.tightest, weight_);
      has_a_choice = has_a_choice || ends.has_a_choice;
      field = field + ends.field;
    }
    const Symmetric<Sloped> given = given_ ? given_(region.from) : none;
    Largest least{infinity};
    for (const Symmetric<Sloped>& late : latenesses_of(loop_.delay, field, weight_)) {
      const Largest one = largest(with_each(stands, {late}, weight_), given, scale);
      const Largest other = has_a_choice ? largest(with_each(tightest, {late}, weight_), given, nullptr) : one;
      least = std::min({least, one, other}, [](const Largest& a, const Largest& b) { return a.x < b.x; });
    }
    return least;
  }

  Largest largest(const std::vector<Symmetric<Sloped>>& sums, const Symmetric<Sloped>& given, double* scale) const {
    Largest most{-infinity};
    for (const Symmetric<Sloped>& sum : sums) {
      const Symmetric<Sloped> wanted = Sloped(loop_.longest_period) * sum;
      if (scale != nullptr) *scale = std::max(*scale, weighed(wanted, weight_).x);
      const Largest need = weighed(wanted - given, weight_);
      if (!(need.x <= most.x)) most = need.x < infinity ? need : Largest{infinity};  // also for a NaN
    }
    return most;
  }

  const Arm& arm_;
  const Box& workspace_;
  std::vector<PortNeed> ports_;
  const SampledLoop& loop_;
  const Pair<double>& weight_;
  const GivenDamping& given_;
  double attained_ = -infinity, scale_ = 0;
  Pair<double> at_{0, 0};
};

// An upper bound of sign·w over a workspace, to the tolerance.
double most_of(const PortMap& map, const Box& workspace, double sign, double tolerance) {
  const auto most = [&](const Box& box) {
    const Interval depth = axes::depth(map, box).value;
    return sign > 0 ? depth.high : -depth.low;
  };
  double attained = -infinity;
  const auto measured = [&](const Box& box) {
    attained = std::max(attained, sign * depth(map, middle_of(box)).value);
    return most(box);
  };
  return best_first(workspace, most_boxes, measured, [&](double need) { return need - attained <= tolerance; });
}

}  // namespace

Interval range_of(const PortMap& map, const Box& workspace) {
  const double tolerance = 1e-3 * depth(map, workspace).value.width();
  return {-most_of(map, workspace, -1, tolerance), most_of(map, workspace, 1, tolerance)};
}

NeededDamping needed_damping(const Arm& arm, const Box& workspace, const std::vector<PortLoad>& loads,
                             const SampledLoop& loop, const Pair<double>& weight, const GivenDamping& given,
                             double tolerance, int boxes) {
  return Search(arm, loads, workspace, loop, weight, given).run(tolerance, boxes);
}

}  // namespace dashpot::compiler::axes
