#include "z_width.hpp"

#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <fmt/format.h>

#include <cmath>

#include "chosen.hpp"
#include "evaluated_law.hpp"

namespace dashpot::paper {
namespace {

double least_stiffness() { return chosen_list("map.stiffness").front(); }
double most_stiffness() { return chosen_list("map.stiffness").back(); }

compiler::Device rig_at(double rate, const velocity_description& velocity) {
  compiler::Device device = rig();
  device.description.loop.sample_period = 1 / rate;
  device.description.loop.jitter = 0;  // statement (b) is about periodic samples
  device.description.velocity = velocity;
  // b is constant on this map: what the coil does when it is switched on is no part of it.
  device.description.brake.coil_lag = device.description.brake.slew = 0;
  return device;
}

std::string network(const MapPlace& place, double stiffness) {
  return place.kind == WallKind::kelvin ? kelvin_element(stiffness, place.damping)
                                        : maxwell_element(stiffness, place.damping);
}

// The law of one wall: b and state input as decided for the rig, without what a certificate would add.
struct Wall {
  compiler::Device device;
  Compiled law;
  double brake;  // b [N·s/m]
};

Wall wall_of(const MapPlace& place, double stiffness) {
  Wall wall{rig_at(place.rate, place.realisation.estimator.velocity), nullptr, 0};
  compiler::Choices choices;
  choices.decomposition = place.realisation.decomposition;
  const Compiled decided = compiled(network(place, stiffness), choices, wall.device);
  const compiler::Candidate& candidate = decided->decomposition.choice();
  choices.rate = place.rate;
  choices.decomposition = wall.brake = candidate.damping;
  choices.state_input = candidate.state_input;
  wall.law = compiled(network(place, stiffness), choices);
  return wall;
}

bool is_certified(const Wall& wall) {
  const compiler::SampledLoop loop = loop_around(wall.law, wall.device);
  const compiler::PassivityBound bound = compiler::passivity_bound(compiler::motor_constants(wall.law->law), loop);
  return bound.proof != compiler::Proof::none && compiler::missing_damping(bound, loop, wall.brake) == 0;
}

// K ≤ 2 f_c/Δ (Abbott & Okamura 2005): beyond, friction does not pay for the encoder's steps.
double quantisation_stiffness() {
  const device_description& plant = rig().description;
  return 2 * plant.mechanics.coulomb_friction / plant.arm_radius / (plant.encoder.step * plant.arm_radius);
}

struct Outcome {
  bool settled;
  double lowest_energy;  // [J]
};

// A tool that flies into the wall, which holds it on both sides; nobody's hand, or somebody's.
Outcome bounce(const Wall& wall, const simulated::hand& user) {
  const device_description& plant = wall.device.description;
  const double speed = chosen("map.speed"), escape = chosen("map.escape") * speed, rest = chosen("map.rest") * speed;
  simulated::scenario scene;
  scene.user = user;
  scene.initial_velocity = speed;
  scene.gain = simulated::brake_gain::lowest;
  simulated_device device(plant, scene);
  any_estimator<double> estimator(plant.velocity, plant.loop.sample_period, plant.encoder.step);
  actuator<double> drive(plant, motion::translation);
  const auto law = law_of(wall.law)();
  const transmission<double>& gear = drive.gear();
  Outcome outcome{true, 0};
  const long last = std::lround(chosen("map.duration") / plant.loop.sample_period);
  device_sample sample;
  for (long k = 0; k <= last; ++k) {
    device.read(sample);
    if (k == 0) estimator.reset(sample.position), law->reset(gear.tool_motion(sample.position));
    const double velocity = gear.tool_motion(estimator.update(sample));
    device.write(drive.drive(law->output(gear.tool_motion(sample.position), velocity), velocity).demand());
    law->update();
    const simulated::energy_ledger& energy = device.ledger();
    outcome.lowest_energy =
        std::min(outcome.lowest_energy, energy.brake + energy.friction + energy.damping - energy.motor);
    const double now = std::abs(gear.tool_motion(device.truth().velocity));
    const bool is_late = 10 * k > 9 * last;
    if (now > escape || (is_late && now > rest)) outcome.settled = false;
    if (now > escape) break;
  }
  return outcome;
}

// The largest stiffness for which `holds` is true, where it is for all below. 0 where it never is.
template <class Claim>
double largest_stiffness(Claim holds) {
  double low = least_stiffness(), high = most_stiffness();
  if (!holds(low)) return 0;
  if (holds(high)) return high;
  for (double i = 0; i < chosen("map.halvings"); ++i) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

const char* name_of(WallKind kind) { return kind == WallKind::kelvin ? "kelvin" : "maxwell"; }

// `thinned`: a whole decade apart.
std::vector<double> dampings(bool thinned) {
  const double steps = chosen("map.steps");
  std::vector<double> values;
  for (double i = 0; i <= steps * chosen("map.decades"); i += thinned ? steps : 1)
    values.push_back(chosen("map.least_damping") * std::pow(10, i / steps));
  return values;
}

void add_places(std::vector<MapPlace>& places, WallKind kind, const WallRealisation& realisation, bool thinned) {
  const std::vector<double> rates = chosen_list("map.rates");
  for (const double rate : rates) {
    if (thinned && rate != rates.front() && rate != rates.back()) continue;
    for (const double damping : dampings(thinned)) places.push_back({kind, rate, realisation, damping});
  }
}

}  // namespace

double lowest_energy_of(const MapPlace& place, double stiffness) {
  return bounce(wall_of(place, stiffness), simulated::no_hand()).lowest_energy;
}

std::string MapPlace::key() const {
  return fmt::format("{},{},{},{},{:.6g}", name_of(kind), rate, realisation.decomposition, realisation.estimator.name,
                     damping);
}

std::vector<MapPlace> map_places(bool thinned) {
  const std::vector<NamedEstimator> estimators = compared_estimators();
  const NamedEstimator& paper = estimators[1];
  std::vector<MapPlace> places;
  for (std::size_t i = 0; i < estimators.size(); ++i)
    if (!thinned || i < 2)
      add_places(places, WallKind::kelvin, {estimators[i].name, "virtual", estimators[i]}, thinned);
  add_places(places, WallKind::kelvin, {"dual channel", "paper", paper}, thinned);
  for (const char* name : {"virtual", "paper", "quietest-passive", "velocity-free"})
    if (!thinned) add_places(places, WallKind::maxwell, {name, name, paper}, thinned);
  return places;
}

MapPoint measure(const MapPlace& place) {
  MapPoint point;
  point.stable = largest_stiffness(
      [&](double stiffness) { return bounce(wall_of(place, stiffness), simulated::no_hand()).settled; });
  point.certified = largest_stiffness([&](double stiffness) { return is_certified(wall_of(place, stiffness)); });
  point.certified = std::min(point.certified, quantisation_stiffness());
  if (point.certified == 0) return point;
  for (const double share : {1.0, 0.1})
    for (const simulated::hand& user : {simulated::no_hand(), simulated::relaxed_hand(), simulated::stiff_grasp()}) {
      const Wall wall = wall_of(place, std::max(least_stiffness(), share * point.certified));
      point.lowest_energy = std::min(point.lowest_energy, bounce(wall, user).lowest_energy);
      ++point.certified_runs;
    }
  return point;
}

}  // namespace dashpot::paper
