// An instrument is pushed through a trocar into a liver and drawn back, on a device that is simulated. Writes what was
// felt as a table, and ends with 1 if at rest that is not the liver's curve and the seal's friction.
#include <cmath>
#include <cstdio>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <liver_through_trocar.hpp>
#include <trocar_trainer_device.hpp>

using described = dashpot::devices::trocar_trainer;
using records = std::vector<dashpot::telemetry_record>;

constexpr double surface = 10e-3, friction = 0.3;  // [m], [N], as the network has them
constexpr double rubber = 300;                     // [N/m]

// 1.5 N at 20 mm, steeper by e every 12.5 mm [N]
double curve(double depth) { return 1.5 * std::expm1(80 * depth) / std::expm1(80 * 20e-3); }

// The rubber winds up until it slips: what it holds after the first `count` samples [N].
double seal(const records& felt, std::size_t count) {
  double held = 0;
  for (std::size_t k = 1; k < count; ++k)
    held = std::fmin(std::fmax(held + rubber * (felt[k].position - felt[k - 1].position), -friction), friction);
  return held;
}

double force_of(const dashpot::telemetry_record& r) { return r.motor_force + r.damping * r.velocity; }  // [N]

// At rest no damper acts; what may be off is what one count of the encoder makes, and the curve by 0.05 % of its most.
bool is_right(const records& all, std::size_t sample) {
  const dashpot::telemetry_record& felt = all.at(sample);
  const dashpot::device_description facts = described::description();
  const double depth = std::fmax(felt.position - surface, 0), step = facts.encoder.step;
  const double expected = curve(depth) + seal(all, sample + 1);
  const double by_count = curve(depth + step) - curve(depth) + rubber * step +
                          felt.damping * step / (facts.velocity.window * facts.loop.sample_period);
  std::printf("%5.2f mm deep: %7.4f N, by the closed form %7.4f N\n", felt.position * 1e3, force_of(felt), expected);
  return std::fabs(force_of(felt) - expected) <= by_count + 5e-4 * curve(20e-3);
}

int main(int, char** arguments) {
  dashpot::generated::liver_through_trocar law;
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.user = dashpot::simulated::firm_hand();
  scene.intended = dashpot::simulated::smoothly_through({{0, 0}, {1, 30e-3}, {2.5, 30e-3}, {3.5, 0}, {4.5, 0}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  records felt;
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.require_certified = true;
  options.duration = 4.5;  // [s]
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  const dashpot::servo_summary run =
      dashpot::servo_loop(law, device, estimator, options, dashpot::simulated_clock{}).run();

  std::printf("pushed in  ");
  bool right = is_right(felt, static_cast<std::size_t>(2.4 / facts.loop.sample_period));
  std::printf("drawn back ");
  right = is_right(felt, felt.size() - 1) && right;
  std::printf("energy that the instrument gave to the hand: %s\n", run.lowest_energy >= 0 ? "none" : "some");
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,position [mm],force [N]\n", table);
    for (std::size_t k = 0; k < felt.size(); k += 60)
      std::fprintf(table, "%s,%.3f,%.4f\n", k * facts.loop.sample_period < 2.45 ? "in" : "out", felt[k].position * 1e3,
                   force_of(felt[k]));
    std::fclose(table);
  }
  return right && run.left_safe && run.faults.total() == 0 && run.lowest_energy >= 0 ? 0 : 1;
}
