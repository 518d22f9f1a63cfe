#include "axes/brake_share.hpp"

#include <algorithm>

namespace dashpot::compiler::axes {
namespace {

struct Weighed {
  double value, area;
};

// The value below which half of the area lies.
double median(std::vector<Weighed> values) {
  std::sort(values.begin(), values.end(), [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
  double all = 0, below = 0;
  for (const Weighed& one : values) all += one.area;
  for (const Weighed& one : values) {
    below += one.area;
    if (below >= all / 2) return one.value;
  }
  return 0;
}

double least(const std::vector<Weighed>& values) {
  return std::min_element(values.begin(), values.end(),
                          [](const Weighed& a, const Weighed& b) { return a.value < b.value; })
      ->value;
}

double mean(const std::vector<Weighed>& values) {
  double all = 0, sum = 0;
  for (const Weighed& one : values) all += one.area, sum += one.area * one.value;
  return sum / all;
}

}  // namespace

Share share_at(const Arm& arm, const Pair<double>& joints, const std::vector<Brake>& brakes, BrakeRule rule,
               const TipDamping& wanted) {
  const Pose<double> at = pose(arm, joints);
  const Symmetric<double> target = at_joints(at, wanted(at.tip)), motion = isotropic_motion(at.column);
  const std::vector<double> dampings = choose(rule, brakes, target, motion);
  const Symmetric<double> made = made_by(brakes, dampings);
  const auto heat = [&](const Symmetric<double>& m) {
    return motion.xx * m.xx + 2 * motion.xy * m.xy + motion.yy * m.yy;
  };
  return {heat(made) / heat(target), eigenvalues(made, target)[0], is_delay_proof(made, target)};
}

ShareMap share_map(const Arm& arm, const std::vector<Place>& places, const std::vector<Brake>& brakes, BrakeRule rule,
                   const TipDamping& wanted) {
  std::vector<Weighed> alike, direction, proof;
  for (const Place& place : places) {
    const Share share = share_at(arm, place.joints, brakes, rule, wanted);
    alike.push_back({share.alike, place.area});
    direction.push_back({share.worst_direction, place.area});
    proof.push_back({share.delay_proof ? 1.0 : 0.0, place.area});
  }
  std::size_t worst = 0;
  for (std::size_t i = 0; i < alike.size(); ++i) worst = alike[i].value < alike[worst].value ? i : worst;
  return {mean(alike),
          median(alike),
          alike[worst].value,
          median(direction),
          least(direction),
          mean(proof),
          pose(arm, places[worst].joints).tip};
}

}  // namespace dashpot::compiler::axes
