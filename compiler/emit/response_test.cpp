#include "emit/response_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/motor_limits.hpp"
#include "discretise/rounding.hpp"
#include "emit/banner.hpp"
#include "law/cost.hpp"
#include "linear/motion_map.hpp"
#include "source/wrapped_text.hpp"

namespace dashpot::compiler {
namespace {

// How far rounding may take the force from the closed form, relative to the peak: the modes' bound, one roundoff for
// each of the products and sums of a sample, and in double as many for the closed form's own.
double test_tolerance(const UpdateLaw& law) {
  const double roundoff = unit_roundoff(law.scalar);
  const Cost cost = cost_of(law, law.output);
  return law.relative_error_bound + roundoff * double(2 * (8 + cost.additions + cost.multiplications));
}

// Relative error of the force: the map's tables and their evaluation, plus the law behind the map.
double curve_tolerance(const UpdateLaw& law) { return test_tolerance(law) + 64 * unit_roundoff(law.scalar); }

// The largest force that the motor can hold in its first sample, if the law keeps to the motor's limits.
double largest_held(const Compilation& c) {
  double force = std::numeric_limits<double>::infinity();
  for (const double limit : {c.certificate.loop.max_force, largest_change(c.certificate.loop)})
    if (limit > 0 && c.law.sheds()) force = std::min(force, limit);
  return force;
}

Fields rest_at(double depth, double force, double allowed, double stiffness) {
  return {{"depth", fmt::format("{:#}", depth)},
          {"force", fmt::format("{:#}", force)},
          {"allowed", fmt::format("{:#}", allowed)},
          {"stiffness", fmt::format("{:#}", stiffness)}};
}

struct RestForce {
  double force, allowed, stiffness;  // [N], [N], the steepest up to there [N/m]
};

RestForce rest_on_spring(const Compilation& c, double depth) {
  const double stiffness = to_double(c.form.linear.static_stiffness);
  return {stiffness * depth, test_tolerance(c.law) * stiffness * depth, stiffness};
}

// On the file's own curve.
RestForce rest_on_curve(const Compilation& c, double depth) {
  const MotionMap& map = *c.network.map;
  const StaticCurve& curve = *c.network.static_curve;
  const double kept = to_double(c.form.linear.static_stiffness) / map.stiffness;  // for a curve of instantaneous force
  const double largest = kept * to_double(force_at(curve, Real(map.reach)));
  const double steepest = map.largest_tangent(0, depth),
               stiffness =
                   kept * map.stiffness * (steepest * steepest + map.value_at(depth) * map.largest_curvature(0, depth));
  return {kept * to_double(force_at(curve, Real(depth))),
          map.static_error * largest + curve_tolerance(c.law) * stiffness * depth, stiffness};
}

// Where the test lets the law rest: half a unit deep, or no deeper than the motor holds. A power of two is exact in
// every scalar.
std::vector<Fields> rest_on_spring(const Compilation& c) {
  constexpr double deepest = 0.5;
  const double stiffness = to_double(c.form.linear.static_stiffness), held = largest_held(c);
  const double depth = stiffness > 0 && std::isfinite(held)
                           ? std::min(deepest, std::exp2(std::floor(std::log2(held / stiffness)) - 1))
                           : deepest;
  return {rest_at(depth, stiffness * depth, test_tolerance(c.law) * stiffness, stiffness)};
}

// Depths from the end of the curve's cubics inwards, each half of the one before.
std::vector<Fields> rests_on_curve(const Compilation& c) {
  constexpr int halvings = 6;
  std::vector<Fields> rests;
  for (int i = 0; i <= halvings; ++i) {
    const double depth = std::ldexp(c.network.map->reach, -i);
    const RestForce rest = rest_on_curve(c, depth);
    if (2 * rest.force <= largest_held(c)) rests.push_back(rest_at(depth, rest.force, rest.allowed, rest.stiffness));
  }
  return rests;
}

// Where ports act side by side: their forces at rest, from as far in as one of them is known inwards by halves.
std::vector<Fields> rests_of_ports(const Compilation& c) {
  constexpr int halvings = 6;
  double deepest = 0;
  for (const Compilation& port : c.ports) {
    const double surface = port.network.surface();
    if (port.network.map) deepest = std::max(deepest, surface + port.network.map->reach);
  }
  if (deepest == 0) deepest = 0.5;  // springs alone: any depth is fine
  std::vector<Fields> rests;
  for (int i = 0; i <= halvings; ++i) {
    const double depth = std::ldexp(deepest, -i);
    double force = 0, allowed = 0, steepness = 0;
    bool is_held = true;
    for (const Compilation& port : c.ports) {
      const double in = port.network.pushed_in(depth);
      const RestForce rest = port.network.map ? rest_on_curve(port, in) : rest_on_spring(port, in);
      const bool is_clamped = port.certificate.limits.rule == LimitRule::clamps;
      const double most = is_clamped ? port.certificate.loop.max_force : largest_held(port);
      is_held = is_held && 2 * rest.force <= most;
      force += rest.force;
      allowed += rest.allowed + test_tolerance(c.law) * rest.force;
      steepness += rest.stiffness;
    }
    if (is_held) rests.push_back(rest_at(depth, force, allowed, steepness));
  }
  return rests;
}

// Steps within one sample to places where cubics meet, from the map's end inwards by halves, as far as the motor makes
// them: k w w′ is there the force of the file's curve, and ½ k w² its work.
std::vector<Fields> jumps_on_curve(const Compilation& c) {
  constexpr int halvings = 5;  // of a map with the fewest cubics
  const MotionMap& map = *c.network.map;
  const StaticCurve& curve = *c.network.static_curve;
  const double period = 1 / c.rate, brake = c.decomposition.choice().damping;
  double stiffness = to_double(c.form.linear.static_stiffness) +
                     (std::abs(to_double(c.form.linear.feedthrough_damping) - brake)) / period;
  for (const Mode& mode : c.form.linear.modes) stiffness += to_double(mode.stiffness);
  std::vector<Fields> jumps;
  for (int i = 0; i <= halvings; ++i) {
    const double depth = std::ldexp(map.reach, -i), last = std::min(depth + map.width(), map.reach);
    const Real force = force_at(curve, Real(depth)), work = work_between(curve, Real(0), Real(depth));
    const double share = to_double(Real(force / map.stiffness));
    if (!(2 * share * stiffness <= largest_held(c))) continue;
    const double steepest = map.largest_tangent(depth - map.width(), last),
                 bend = map.largest_curvature(depth - map.width(), last);
    jumps.push_back(
        {{"depth", fmt::format("{:#}", depth)},
         {"share", fmt::format("{:#}", share)},
         {"speed", fmt::format("{:#}", to_double(Real(2 * work / (force * period))))},
         {"scale", fmt::format("{:#}", to_double(Real(force * force / (2 * map.stiffness * work))))},
         {"slope", fmt::format("{:#}", steepest * steepest + bend * std::max(map.value_at(depth), steepest * depth))}});
  }
  return jumps;
}

}  // namespace

std::string why_no_motion_is_played(const Compilation& c) {
  const bool is_limited = c.network.map ? jumps_on_curve(c).empty() : c.law.sheds();
  const char* const what = !c.ports.empty()       ? "several ports"
                           : c.form.has_slips()   ? "slips"
                           : is_limited           ? "a motor at its limits"
                           : mixes_schemes(c.law) ? "elements by backward Euler beside exact ones"
                                                  : nullptr;
  return what ? fmt::format("with {} a force along it has no closed form", what) : "";
}

CodeModel response_test_model(const Compilation& c, const std::string& log1p) {
  CodeModel model;
  Fields& fields = model.fields;
  fields["name"] = c.network.name;
  const std::string why_none = why_no_motion_is_played(c);
  model.lists["about"] = as_list(wrapped_text(
      why_none.empty()
          ? fmt::format("Tests {} against the closed forms of its network{}", c.network.name,
                        c.network.map ? " behind its static curve" : "")
          : fmt::format(
                "Tests {} at rest, and with NaN and infinite samples. No force along a motion is checked, because {}; "
                "'dashpot simulate' says what the force of any motion is",
                c.network.name, why_none),
      112, 0));
  fields["scheme"] = name_of(c.law.scheme);
  fields["rate"] = fmt::format("{:#}", c.rate);
  fields["start"] = fmt::format("{:#}", c.network.surface());
  model.lists["rests"] = !c.ports.empty() ? rests_of_ports(c) : c.network.map ? rests_on_curve(c) : rest_on_spring(c);
  for (const char* list : {"closed_forms", "modes", "ramps", "curve", "jumps"}) model.lists[list];
  if (!why_none.empty()) return model;
  const LinearForm& linear = c.form.linear;
  model.lists["closed_forms"].push_back(
      {{"static_stiffness", fmt::format("{:#}", to_double(linear.static_stiffness))},
       {"feedthrough_damping", fmt::format("{:#}", to_double(linear.feedthrough_damping))},
       {"decays", c.law.scheme == Scheme::exact ? "rate * period" : log1p + "(rate * period)"}});
  for (const Mode& mode : linear.modes)
    model.lists["modes"].push_back({{"stiffness", fmt::format("{:#}", to_double(mode.stiffness))},
                                    {"relaxation_rate", fmt::format("{:#}", to_double(mode.relaxation_rate))}});
  if (c.network.map) {
    model.lists["curve"].push_back({{"tolerance", fmt::format("{:#}", curve_tolerance(c.law))},
                                    {"damping", fmt::format("{:#}", c.decomposition.choice().damping)}});
    model.lists["jumps"] = jumps_on_curve(c);
  } else {
    model.lists["ramps"].push_back({{"tolerance", fmt::format("{:#}", test_tolerance(c.law))}});
  }
  return model;
}

}  // namespace dashpot::compiler
