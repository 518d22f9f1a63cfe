#include "axes/workspace_bound.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>

#include "axes/curvature.hpp"

namespace dashpot::compiler::axes {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A part of a workspace or of joint ranges, and what it needs; more where it has to be halved before that is known.
struct Part {
  Box box;
  double need;

  bool operator<(const Part& other) const { return need < other.need; }
};

using Parts = std::priority_queue<Part>;

// The largest x over the members N of an interval matrix with x W ≥ N: at a corner, where the diagonal is largest and
// the coupling farthest from 0,
//
//     x = ½(a + c) + √(¼(a − c)² + b²),     a = N11/W1, c = N22/W2, b² = N12²/(W1 W2)
Interval weighed(const Symmetric<Interval>& n, const Pair<double>& weight) {
  const Interval first(weight[0]), second(weight[1]);
  const Interval a = Interval(n.xx.high) / first, c = Interval(n.yy.high) / second;
  const Interval coupling = Interval(abs(n.xy).high);
  return Interval(0.5) * (a + c) + sqrt(square(Interval(0.5) * (a - c)) + square(coupling) / (first * second));
}

// ‖H‖ against W: the larger of weighed(H) and weighed(−H).
double size_of(const Symmetric<Interval>& h, const Pair<double>& weight) {
  return std::max(weighed(h, weight).high, weighed(Interval(-1) * h, weight).high);
}

}  // namespace

Interval motor_force(const PortLoad& load, const Interval& depth, const Interval& over_workspace) {
  const Interval more = Interval(-load.estimated, load.estimated) + Interval(-load.yields, load.yields);
  const Interval springs(load.grounded), relaxing(load.relaxing), pressed = max(depth, Interval(0));
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

// Both ends of M. Where nothing clamps and no surface lies in the box they go with the depth; else they are whatever
// they can be in the box. What is needed is convex in M, so that the ends are enough.
Pair<ForceForm> force_ends(const PortLoad& load, const Interval& depth, const Interval& range) {
  const Interval force = motor_force(load, depth, range);
  const double stiffness = load.grounded + load.relaxing;
  const Interval more = Interval(load.yields) + Interval(load.estimated), relaxing(load.relaxing);
  if (force.low > -load.clamp && force.high < load.clamp) {
    if (!load.unilateral) {
      return {ForceForm{stiffness, -(relaxing * Interval(range.high) + more)},
              ForceForm{stiffness, more - relaxing * Interval(range.low)}};
    }
    if (depth.low >= 0) return {ForceForm{0, Interval(0)}, ForceForm{stiffness, more}};
  }
  return {ForceForm{0, Interval(force.low)}, ForceForm{0, Interval(force.high)}};
}

// A ball or a band pushes outward (M ≥ 0) where it bends away, a cavity the other way round: what it bends of itself
// can only lessen the sum.
bool is_lessened_by_bend(const PortMap& map, const Interval& force) {
  const Circle* circle = std::get_if<Circle>(&map);
  if (circle != nullptr && circle->sign < 0) return force.high <= 0;
  return (circle != nullptr || std::holds_alternative<Band>(map)) && force.low >= 0;
}

// What Jᵀ ∇w ∇wᵀ J is no more than where the direction of ∇w is open, as at a centre and on a line.
template <typename S>
std::optional<Symmetric<S>> steepest(const PortMap& map, const Pose<S>& at) {
  if (const Band* band = std::get_if<Band>(&map)) return outer(at_joints(at, constant<S>(band->normal)));
  if (std::holds_alternative<Circle>(map)) return at_joints(at, Symmetric<S>{S(1), S(0), S(1)});
  return std::nullopt;
}

// Of one port: matrices of which each is no less than S g gᵀ + ½ M H, and what delay needs of it.
template <typename S>
struct PortTerms {
  std::vector<Symmetric<S>> enough;
  Symmetric<S> hessian;
};

template <typename S>
PortTerms<S> terms(const PortLoad& load, const ForceForm& form, int delay, bool lessened, const Arm& arm,
                   const Pair<S>& joints) {
  const Pose<S> at = pose(arm, joints);
  const Pair<Symmetric<S>> bends = curvature(arm, joints);
  const Depth<S> there = depth(load.map, at.tip);
  const S held(load.held * (1 + 2 * delay)), half = S(0.5) * form.at(there.value);
  const Symmetric<S> carried = there.gradient[0] * bends[0] + there.gradient[1] * bends[1];
  const Symmetric<S> all = carried + at_joints(at, bend(load.map, at.tip));
  const Symmetric<S> squared = held * outer(at_joints(at, there.gradient));
  PortTerms<S> result{{squared + half * all}, all};
  if (lessened) result.enough.push_back(squared + half * carried);
  if (const auto steep = steepest(load.map, at)) {
    result.enough.push_back(held * *steep + half * all);
    if (lessened) result.enough.push_back(held * *steep + half * carried);
  }
  return result;
}

// Joints of a part of a workspace and all that they reach from there.
struct Region {
  EnclosedJoints joints;
  Slopes apart;

  Box box() const { return {joints.over[0].value, joints.over[1].value}; }
};

Region reached_from(const EnclosedJoints& from, const Slopes& apart, const Pair<double>& reach) {
  Region region{from, apart};
  for (const std::size_t j : {0u, 1u}) {
    const Interval way(-reach[j], reach[j]);
    region.joints.over[j].value = from.over[j].value + way;
    region.joints.over[j].slope[2 + j] = Interval(1);
    region.apart[2 + j] = way;
  }
  return region;
}

class PortNeed {
 public:
  PortNeed(const PortLoad& load, const Interval& range) : load_(load), range_(range) {}

  // For both ends of M what is needed, as it stands or the tightest of what is enough, over a box of joints, with n |M|
  // ‖H‖ W. One where both are the same.
  std::vector<Symmetric<Interval>> over(const Arm& arm, const Region& region, int delay, const Pair<double>& weight,
                                        bool as_it_stands) const {
    const Interval depth = axes::depth(load_.map, pose(arm, region.box()).tip).value;
    if (load_.unilateral && depth.high <= 0) return {};
    const Interval force = motor_force(load_, depth, range_);
    const bool lessened = is_lessened_by_bend(load_.map, force);
    std::vector<Symmetric<Interval>> ends;
    for (const ForceForm& form : force_ends(load_, depth, range_)) {
      const PortTerms<Sloped> sloped = terms(load_, form, delay, lessened, arm, region.joints.over);
      const PortTerms<Interval> middle = terms(load_, form, delay, lessened, arm, region.joints.in_middle);
      ends.push_back(as_it_stands ? centred(sloped.enough[0], middle.enough[0], region.apart)
                                  : tightest(sloped, middle, region.apart, weight));
      if (delay == 0) continue;
      const double size = size_of(centred(sloped.hessian, middle.hessian, region.apart), weight);
      const Interval late = Interval(delay) * Interval(abs(force).high) * Interval(size);
      ends.back() =
          ends.back() + Symmetric<Interval>{late * Interval(weight[0]), Interval(0), late * Interval(weight[1])};
    }
    return ends;
  }

 private:
  static Symmetric<Interval> tightest(const PortTerms<Sloped>& sloped, const PortTerms<Interval>& middle,
                                      const Slopes& apart, const Pair<double>& weight) {
    Symmetric<Interval> best = centred(sloped.enough[0], middle.enough[0], apart);
    for (std::size_t i = 1; i < sloped.enough.size(); ++i) {
      const Symmetric<Interval> other = centred(sloped.enough[i], middle.enough[i], apart);
      if (!(weighed(best, weight).high <= weighed(other, weight).high)) best = other;
    }
    return best;
  }

  const PortLoad& load_;
  Interval range_;
};

// Every sum of one of either.
std::vector<Symmetric<Interval>> with_each(const std::vector<Symmetric<Interval>>& sums,
                                           const std::vector<Symmetric<Interval>>& ends) {
  if (ends.empty()) return sums;
  std::vector<Symmetric<Interval>> result;
  for (const Symmetric<Interval>& sum : sums) {
    for (const Symmetric<Interval>& end : ends) result.push_back(sum + end);
  }
  return result;
}

class Search {
 public:
  Search(const Arm& arm, const std::vector<PortLoad>& loads, const Box& workspace, const SampledLoop& loop,
         const Pair<double>& weight, const GivenDamping& given)
      : arm_(arm), loop_(loop), weight_(weight), given_(given) {
    for (const PortLoad& load : loads) ports_.emplace_back(load, range_of(load.map, workspace));
  }

  template <typename ToJoints>
  NeededDamping run(const Box& whole, const ToJoints& joints_of, double tolerance, int most) {
    Parts open;
    open.push(measured(whole, joints_of));
    for (int boxes = 1; boxes < most && !is_close(open.top().need, tolerance); boxes += 2) {
      const Part worst = open.top();
      open.pop();
      for (const Box& half : halves(worst.box, whole)) open.push(measured(half, joints_of));
    }
    return {open.top().need, attained_, at_, is_close(open.top().need, tolerance)};
  }

 private:
  bool is_close(double need, double tolerance) const { return need - attained_ <= tolerance * scale_; }

  template <typename ToJoints>
  Part measured(const Box& box, const ToJoints& joints_of) {
    const std::optional<EnclosedJoints> joints = joints_of(box);
    if (!joints) return {box, infinity};
    const Box middle = joints->in_middle;
    const double limit = need_over({{Sloped(middle[0]), Sloped(middle[1])}, middle}, {}, true);
    if (limit > attained_) attained_ = limit, at_ = middle_of(middle);
    return {box, std::max(need_over(*joints, apart_in(box), false), limit)};
  }

  double need_over(const EnclosedJoints& joints, const Slopes& apart, bool at_a_point) {
    const Region region = reached_from(joints, apart, loop_.reach);
    const Box from{joints.over[0].value, joints.over[1].value};
    // Port by port the tightest may not be so in the sum.
    return std::min(largest(region, from, true, at_a_point), largest(region, from, false, false));
  }

  double largest(const Region& region, const Box& from, bool as_it_stands, bool sets_scale) {
    std::vector<Symmetric<Interval>> sums{{Interval(0), Interval(0), Interval(0)}};
    for (const PortNeed& port : ports_) {
      sums = with_each(sums, port.over(arm_, region, loop_.delay, weight_, as_it_stands));
    }
    double most = -infinity;
    for (const Symmetric<Interval>& sum : sums) {
      const Symmetric<Interval> wanted = Interval(loop_.longest_period) * sum;
      if (sets_scale) scale_ = std::max(scale_, weighed(wanted, weight_).high);
      const double need = weighed(given_ ? wanted - given_(from) : wanted, weight_).high;
      most = need < infinity ? std::max(most, need) : infinity;  // where an enclosure has no numbers, too
    }
    return most;
  }

  const Arm& arm_;
  std::vector<PortNeed> ports_;
  const SampledLoop& loop_;
  const Pair<double>& weight_;
  const GivenDamping& given_;
  double attained_ = -infinity, scale_ = 0;
  Pair<double> at_{0, 0};
};

// The largest of sign·w over a workspace, and no less.
double most_of(const PortMap& map, const Box& workspace, double sign, double tolerance) {
  const auto most = [&](const Box& box) {
    const Interval depth = axes::depth(map, box).value;
    return sign > 0 ? depth.high : -depth.low;
  };
  Parts open;
  open.push({workspace, most(workspace)});
  double attained = -infinity;
  for (int boxes = 1; boxes < most_boxes && open.top().need - attained > tolerance; boxes += 2) {
    const Part best = open.top();
    open.pop();
    for (const Box& half : halves(best.box, workspace)) {
      attained = std::max(attained, sign * depth(map, middle_of(half)).value);
      open.push({half, most(half)});
    }
  }
  return open.top().need;
}

}  // namespace

Interval range_of(const PortMap& map, const Box& workspace) {
  const double tolerance = 1e-3 * depth(map, workspace).value.width();
  return {-most_of(map, workspace, -1, tolerance), most_of(map, workspace, 1, tolerance)};
}

NeededDamping needed_damping(const Arm& arm, const Box& workspace, const std::vector<PortLoad>& loads,
                             const SampledLoop& loop, const Pair<double>& weight, const GivenDamping& given,
                             double tolerance, int boxes) {
  const auto joints_of = [&](const Box& tip) { return enclosed_joints(arm, tip); };
  return Search(arm, loads, workspace, loop, weight, given).run(workspace, joints_of, tolerance, boxes);
}

NeededDamping needed_over_joints(const Arm& arm, const Box& joints, const std::vector<PortLoad>& loads,
                                 const Box& workspace, const SampledLoop& loop, const Pair<double>& weight,
                                 const GivenDamping& given, double tolerance, int boxes) {
  const auto joints_of = [](const Box& box) {
    return std::optional(EnclosedJoints{variables(box), constant<Interval>(middle_of(box))});
  };
  return Search(arm, loads, workspace, loop, weight, given).run(joints, joints_of, tolerance, boxes);
}

}  // namespace dashpot::compiler::axes
