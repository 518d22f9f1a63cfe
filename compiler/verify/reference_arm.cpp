#include "verify/reference_arm.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "certify/slip_motor.hpp"
#include "network/disjoint_sets.hpp"
#include "network/law.hpp"
#include "network/match.hpp"
#include "network/stuck_and_open_slips.hpp"
#include "verify/reference_grid.hpp"
#include "verify/reference_slips.hpp"
#include "verify/reference_tree.hpp"

namespace dashpot::compiler {
namespace {

constexpr int places_a_side = 10;
constexpr std::size_t most_combined_ports = 6;  // with more ports, all are taken at the same end of their forces

// Central differences of order h² of what is smooth over lengths of 1 mm: in 100 digits good to about 45.
const Reference difference_step{"1e-25"};

ReferencePair plus(const ReferencePair& a, const ReferencePair& b) { return {a[0] + b[0], a[1] + b[1]}; }
ReferencePair times(double length, const ReferencePair& direction) {
  return {Reference(length) * direction[0], Reference(length) * direction[1]};
}
ReferencePair direction_of(const Reference& angle) { return {cos(angle), sin(angle)}; }
// Cosine and sine of the sum of two angles.
ReferencePair turned_by(const ReferencePair& a, const ReferencePair& b) {
  return {a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]};
}

// Around the left elbow: from the direction to the right one by the angle at it in the triangle of the elbows and the
// tip, whose cosine is half the elbows' distance by the distal length.
ReferencePair five_bar_tip(const axes::Arm& arm, const ReferencePair& left_way, const ReferencePair& right_way) {
  const Reference side = Reference(arm.base) / 2;
  const ReferencePair left = plus({-side, 0}, times(arm.proximal, left_way));
  const ReferencePair right = plus({side, 0}, times(arm.proximal, right_way));
  const Reference dx = right[0] - left[0], dy = right[1] - left[1];
  const Reference apart = sqrt(Reference(dx * dx + dy * dy));
  const Reference cosine = apart / (2 * Reference(arm.distal));
  const ReferencePair at_elbow{cosine, sqrt(Reference(1 - cosine * cosine))};
  return plus(left, times(arm.distal, turned_by({dx / apart, dy / apart}, at_elbow)));
}

// Of joints of which the directions are known; of sliding ones `q` itself.
ReferencePair tip_of(const axes::Arm& arm, const ReferencePair& q, const ReferencePair& first,
                     const ReferencePair& second) {
  switch (arm.kind) {
    case axes::Kinematics::serial: return plus(times(arm.proximal, first), times(arm.distal, turned_by(first, second)));
    case axes::Kinematics::parallelogram: return plus(times(arm.proximal, first), times(arm.distal, second));
    case axes::Kinematics::five_bar: return five_bar_tip(arm, first, second);
    case axes::Kinematics::cartesian: break;
  }
  return q;
}

// Tips where each joint is a step behind, at, and a step ahead of where it is.
using NearTips = std::array<std::array<ReferencePair, 3>, 3>;

NearTips near_tips(const axes::Arm& arm, const ReferencePair& q) {
  std::array<std::array<Reference, 3>, 2> angle;
  std::array<std::array<ReferencePair, 3>, 2> direction;
  for (std::size_t joint = 0; joint < 2; ++joint) {
    for (std::size_t i = 0; i < 3; ++i) {
      angle[joint][i] = q[joint] + difference_step * Reference(int(i) - 1);
      direction[joint][i] = direction_of(angle[joint][i]);
    }
  }
  NearTips tips;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      tips[i][k] = tip_of(arm, {angle[0][i], angle[1][k]}, direction[0][i], direction[1][k]);
  return tips;
}

Reference depth_at(const axes::PortMap& map, const ReferencePair& tip) {
  const Reference blunt = Reference(axes::blunting) * Reference(axes::blunting);
  const auto from = [&](const axes::Pair<double>& point) {
    return ReferencePair{tip[0] - Reference(point[0]), tip[1] - Reference(point[1])};
  };
  return match(
      map,
      [&](const axes::Plane& plane) -> Reference {
        return Reference(plane.offset) + Reference(plane.slope[0]) * tip[0] + Reference(plane.slope[1]) * tip[1];
      },
      [&](const axes::Circle& circle) -> Reference {
        const auto [x, y] = from(circle.centre);
        return Reference(circle.sign) * (Reference(circle.radius) - sqrt(Reference(x * x + y * y + blunt)));
      },
      [&](const axes::Band& band) -> Reference {
        const auto [x, y] = from(band.through);
        const Reference across = Reference(band.normal[0]) * x + Reference(band.normal[1]) * y;
        return Reference(band.radius) - sqrt(Reference(across * across + blunt));
      },
      [](const axes::Grid&) -> Reference { throw std::logic_error("a grid's depth is that of its own cubics"); });
}

struct SymmetricReference {
  Reference xx = 0, xy = 0, yy = 0;

  void add(const Reference& share, const SymmetricReference& other) {
    xx += share * other.xx, xy += share * other.xy, yy += share * other.yy;
  }
};

// λ of m v = λ W v, the least and the largest.
ReferencePair eigenvalues(const SymmetricReference& m, const axes::Pair<double>& weight) {
  const Reference first = m.xx / Reference(weight[0]), second = m.yy / Reference(weight[1]);
  const Reference coupled = m.xy * m.xy / (Reference(weight[0]) * Reference(weight[1]));
  const Reference middle = (first + second) / 2, half = (first - second) / 2;
  const Reference out = sqrt(Reference(half * half + coupled));
  return {middle - out, middle + out};
}

// α m + β W, which has the eigenvalues of m without their signs.
SymmetricReference without_signs(const SymmetricReference& m, const axes::Pair<double>& weight) {
  const ReferencePair lambda = eigenvalues(m, weight);
  const Reference apart = lambda[1] - lambda[0];
  Reference alpha = lambda[1] < 0 ? -1 : 1;
  if (apart > 0) alpha = (abs(lambda[1]) - abs(lambda[0])) / apart;
  SymmetricReference result;
  result.add(alpha, m);
  result.add(abs(lambda[1]) - alpha * lambda[1], {weight[0], 0, weight[1]});
  return result;
}

// A function of the joints, its gradient and its Hessian.
struct Differences {
  Reference value;
  ReferencePair gradient;
  SymmetricReference hessian;
};

Differences differences(const std::function<Reference(const ReferencePair&)>& of_tip, const NearTips& tips) {
  const Reference& h = difference_step;
  const auto at = [&](std::size_t first, std::size_t second) { return of_tip(tips[first][second]); };
  const Reference here = at(1, 1), ahead = at(2, 1), behind = at(0, 1), above = at(1, 2), below = at(1, 0);
  const Reference crossed = at(2, 2) - at(2, 0) - at(0, 2) + at(0, 0);
  return {here,
          {(ahead - behind) / (2 * h), (above - below) / (2 * h)},
          {(ahead - 2 * here + behind) / (h * h), crossed / (4 * h * h), (above - 2 * here + below) / (h * h)}};
}

// The force that a port may ask of the motors.
struct PortForce {
  const Port* port;
  std::optional<ReferenceGrid> grid;  // if its map is a grid
  Reference held = 0;                 // S [N/m]
  Reference grounded = 0;             // k0 [N/m]
  Reference relaxing = 0;             // Σ k of the modes, and of springs that reach ground round slips [N/m]
  Reference yields = 0;               // a force that the slips can hold beside these [N]
  Reference least = 0, most = 0;      // w at the places [m]
};

Reference depth_of(const PortForce& force, const ReferencePair& tip) {
  return force.grid ? force.grid->depth(tip[0], tip[1]) : depth_at(force.port->map, tip);
}

// S of slips and contacts: a motor that has to make a damper's force holds it for a period.
Reference held_behind_slips(const ReferenceCut& cut, const LawFacts& facts) {
  return cut.stiffness + cut.of_motor() * Reference(facts.rate);
}

// The slips of a part hold the weakest slip's force on the path where that is largest, if not more. Where springs or
// dampers reach ground round them, they hold a part of it that depends on these: none is counted.
Reference held_by_slips(const Network& network) {
  Reference sum = 0;
  for (const std::vector<std::size_t>& part : parts_between_ends(network)) {
    DisjointSets joined(network.nodes.size());
    std::vector<std::size_t> slips;
    const auto join = [&](std::size_t i) { joined.unite(network.elements[i].a, network.elements[i].b); };
    const auto yield = [&](std::size_t i) { return yield_force_of(network.elements[i].law); };
    for (std::size_t i : part)
      if (is_slip(network.elements[i].law)) slips.push_back(i);
      else join(i);
    if (joined.find(tool) == joined.find(ground)) continue;
    std::sort(slips.begin(), slips.end(), [&](std::size_t a, std::size_t b) { return yield(a) > yield(b); });
    for (std::size_t i : slips) {
      join(i);
      if (joined.find(tool) != joined.find(ground)) continue;
      sum += Reference(yield(i));
      break;
    }
  }
  return sum;
}

PortForce force_of(const AxesCompilation& c, std::size_t i) {
  const Compilation& compiled = c.ports[i];
  const Network& network = compiled.network;
  const double prompt = lateness(compiled.certificate.loop);  // on an ideal device
  const LawFacts facts = facts_of_port(c, i);
  PortForce force{&c.network.ports[i], std::nullopt};
  if (const auto* grid = std::get_if<axes::Grid>(&force.port->map)) force.grid.emplace(*grid);
  const SlipDecomposition& slips = compiled.decomposition.slips;
  const ReferenceTree tree = rendered_tree(reference_tree(network), network, slips);
  force.grounded = tree.linear.static_stiffness;
  const ReferenceForm open = tree.has_slips() ? reference_form(with_open_slips(network)) : tree.linear;
  force.relaxing = open.static_stiffness - tree.linear.static_stiffness;
  for (const ReferenceMode& mode : open.modes) force.relaxing += mode.stiffness;
  force.yields = held_by_slips(network);
  force.held = tree.has_slips() || network.contact
                   ? held_behind_slips(reference_cut(tree, network, slips, facts, prompt), facts)
                   : reference_cut(tree.linear, facts).stiffness;
  return force;
}

// Both ends of M where the port is pushed; none where it is not.
std::vector<Reference> ends_of(const PortForce& force, const Reference& depth) {
  if (const std::optional<Contact>& contact = force.port->network.contact) {
    const Reference pressed = depth - Reference(contact->at);
    if (pressed <= 0) return {};
    return {0, (force.grounded + force.relaxing) * pressed + force.yields};
  }
  const Reference spring = force.grounded * depth;
  return {spring + force.relaxing * (depth - force.most) - force.yields,
          spring + force.relaxing * (depth - force.least) + force.yields};
}

class Places {
 public:
  explicit Places(const AxesCompilation& c) : c_(c) {
    const axes::Box& workspace = c.device.workspace;
    for (int i = 0; i < places_a_side; ++i)
      for (int k = 0; k < places_a_side; ++k)
        add({share(workspace[0], double(i) / (places_a_side - 1)),
             share(workspace[1], double(k) / (places_a_side - 1))});
    add(c.certificate.worst);
    for (std::size_t i = 0; i < c.ports.size(); ++i) {
      forces_.push_back(force_of(c, i));
      PortForce& force = forces_.back();
      for (std::size_t k = 0; k < joints_.size(); ++k) {
        const Reference depth = depth_of(force, reference_tip(c.device.arm, joints_[k]));
        force.least = k == 0 ? depth : std::min(force.least, depth);
        force.most = k == 0 ? depth : std::max(force.most, depth);
      }
    }
  }

  NeedAtPlaces need() const {
    NeedAtPlaces result{joints_.size()};
    for (const ReferencePair& joints : joints_) {
      const Reference here = need_at(joints);
      if (here > result.most) result.most = here, result.tip = reference_tip(c_.device.arm, joints);
    }
    return result;
  }

 private:
  // A place a little inside the range, so that rounding in the search for joints leads to no place outside.
  static double share(const axes::Interval& range, double along) {
    constexpr double inset = 1e-6;
    return range.low + range.width() * (inset + along * (1 - 2 * inset));
  }

  // The joints come from the compiler; they count if they put the tip inside the workspace.
  void add(const axes::Pair<double>& tip) {
    const std::optional<axes::Pair<double>> joints = axes::joints_at(c_.device.arm, tip);
    if (!joints) return;
    const ReferencePair exact{(*joints)[0], (*joints)[1]}, there = reference_tip(c_.device.arm, exact);
    for (std::size_t i = 0; i < 2; ++i)
      if (there[i] < c_.device.workspace[i].low || there[i] > c_.device.workspace[i].high) return;
    joints_.push_back(exact);
  }

  // Of T_max (Σ [S g gᵀ + ½ M H] + n (|K| + Σ [2 S_R g gᵀ + |R| |H|])), whichever ends the ports' forces are at: K = Σ
  // k0 (g gᵀ + w H) of springs that no contact lets go, R and S_R what there is of M and S beside them.
  Reference need_at(const ReferencePair& joints) const {
    const Reference delay = Reference(c_.device.loop().delay_samples);
    SymmetricReference sum, springs;
    std::vector<std::vector<SymmetricReference>> turned;  // of each pushed port, by the end of its force
    const NearTips tips = near_tips(c_.device.arm, joints);
    for (const PortForce& force : forces_) {
      const Differences w = differences([&](const ReferencePair& tip) { return depth_of(force, tip); }, tips);
      const std::vector<Reference> ends = ends_of(force, w.value);
      if (ends.empty()) continue;
      const auto& [first, second] = w.gradient;
      const SymmetricReference steepness{first * first, first * second, second * second};
      const Reference stays = force.port->network.contact ? Reference(0) : force.grounded;
      springs.add(stays, steepness);
      springs.add(stays * w.value, w.hessian);
      sum.add(force.held + 2 * delay * (force.held - stays / 2), steepness);
      const SymmetricReference turning = without_signs(w.hessian, c_.certificate.weight);
      turned.emplace_back();
      for (const Reference& end : ends) {
        SymmetricReference one;
        one.add(end / 2, w.hessian);
        one.add(delay * abs(Reference(end - stays * w.value)), turning);
        turned.back().push_back(one);
      }
    }
    sum.add(delay, without_signs(springs, c_.certificate.weight));
    const Reference longest = Reference(c_.device.loop().sample_period) + Reference(c_.device.loop().jitter);
    return longest * largest_sum(sum, turned);
  }

  Reference largest_sum(const SymmetricReference& sum,
                        const std::vector<std::vector<SymmetricReference>>& turned) const {
    const bool each = turned.size() <= most_combined_ports;
    Reference most = 0;
    for (std::size_t pattern = 0; pattern < (each ? std::size_t(1) << turned.size() : 2); ++pattern) {
      SymmetricReference all = sum;
      for (std::size_t i = 0; i < turned.size(); ++i) all.add(1, turned[i][each ? pattern >> i & 1 : pattern]);
      most = std::max(most, eigenvalues(all, c_.certificate.weight)[1]);
    }
    return most;
  }

  const AxesCompilation& c_;
  std::vector<ReferencePair> joints_;
  std::vector<PortForce> forces_;
};

}  // namespace

ReferencePair reference_tip(const axes::Arm& arm, const ReferencePair& q) {
  return tip_of(arm, q, direction_of(q[0]), direction_of(q[1]));
}

LawFacts facts_of_port(const AxesCompilation& c, std::size_t port) {
  return {c.rate, c.law.scheme, c.law.scalar, StateInput::position, c.ports[port].decomposition.choice().damping};
}

std::optional<NeedAtPlaces> need_at_places(const AxesCompilation& c) {
  if (c.device.workspace[0].width() == 0) return std::nullopt;
  return Places(c).need();
}

}  // namespace dashpot::compiler
