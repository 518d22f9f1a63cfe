// A knee's ligament on a test rig that turns: 15 degrees in half a second, held for six. Writes the torque as a table,
// and ends with 1 if it does not relax as its series says.
#include <cmath>
#include <cstdio>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <knee_ligament.hpp>
#include <knee_rig_device.hpp>

using described = dashpot::devices::knee_rig;

using ligament = dashpot::generated::knee_ligament;

constexpr double pi = 3.141592653589793;
constexpr double angle = 15 * pi / 180, ramp = 0.5, end = 6.5;      // [rad], [s], [s]
constexpr double stiffness = 0.1 * 242e3 * 15e-3 * 15e-3;           // [N·m/rad], at once
constexpr double weight[] = {0.15, 0.10}, relaxation[] = {0.3, 5};  // [1], [s]

// After a ramp of constant speed, held at `angle` since time `ramp`: each term has relaxed while it was wound up, and
// since.
double closed_form(double time) {
  double torque = angle * (1 - weight[0] - weight[1]);
  for (int i = 0; i < 2; ++i) {
    const double tau = relaxation[i];
    torque += weight[i] * angle * tau / ramp * (1 - std::exp(-ramp / tau)) * std::exp(-(time - ramp) / tau);
  }
  return stiffness * torque;
}

double torque_of(const dashpot::telemetry_record& r) { return r.motor_force + r.damping * r.velocity; }  // [N·m]

int main(int, char** arguments) {
  ligament law;
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.prescribed = true;  // the rig turns the joint, whatever torque that takes
  scene.intended = dashpot::simulated::through({{0, 0}, {ramp, angle}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  std::vector<dashpot::telemetry_record> felt;
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.require_certified = true;
  options.duration = end;
  options.telemetry_capacity = 1u << 10;
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  const auto run = dashpot::servo_loop(law, device, estimator, options, dashpot::simulated_clock{}).run();

  const auto at = [&](double time) { return felt.at(static_cast<std::size_t>(time / facts.loop.sample_period + 0.5)); };
  const double one_count =
      2 * stiffness * facts.encoder.step;  // [N·m]: the encoder rounds down, and a sample may be late
  bool right = run.left_safe && run.faults.total() == 0;
  for (const double time : {0.6, 1.0, 2.0, 6.0}) {
    std::printf("%3.1f s: %.4f N m, the series says %.4f N m\n", time, torque_of(at(time)), closed_form(time));
    right = right && std::fabs(torque_of(at(time)) - closed_form(time)) <= one_count;
  }
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,time [s],torque [N m]\n", table);
    for (std::size_t k = 0; k < felt.size(); k += 100) {
      std::fprintf(table, "felt,%.3f,%.4f\n", felt[k].time, torque_of(felt[k]));
    }
    for (double time = 0.6; time < end; time += 0.1) {
      std::fprintf(table, "the series,%.3f,%.4f\n", time, closed_form(time));
    }
    std::fclose(table);
  }
  return right ? 0 : 1;
}
