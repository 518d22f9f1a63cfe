// A needle is pushed 30 mm deep at a steady speed and drawn back, through three layers of which two hold it by
// friction, on a device that is simulated. Writes what was felt as a table, and ends with 1 if that is not the sum of
// the layers.
#include <cmath>
#include <cstdio>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <needle_in_layers.hpp>
#include <needle_trainer_device.hpp>

using described = dashpot::devices::needle_trainer;

using needle = dashpot::generated::needle_in_layers;

constexpr double speed = 12.5e-3, reversal = 2.4, end = 4.8;  // [m/s], [s], [s]
constexpr double skin = 0.6, muscle = 0.9, drag = 5;          // [N], [N], [N·s/m], as the network has them

// Each layer by itself, long after both slips slide: friction against the motion, drag, and the liver's Zener body,
// whose damper B2 is wound up by its whole force B2·speed.
double closed_form(double position, double direction) {
  const double per_pascal = 2 * 3.141592653589793 * 30e-3 / std::log(20e-3 / 0.6e-3);  // [m]
  return direction * (skin + muscle + (drag + 7.3 * per_pascal) * speed) + 1160 * per_pascal * position;
}

double force_of(const dashpot::telemetry_record& r) { return r.motor_force + r.damping * r.velocity; }  // [N]

int main(int, char** arguments) {
  needle law;
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.prescribed = true;  // a machine pushes
  scene.intended = dashpot::simulated::through({{0, 0}, {reversal, speed * reversal}, {end, 0}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  std::vector<dashpot::telemetry_record> felt;
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.require_certified = true;
  options.duration = end;
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  const auto run = dashpot::servo_loop(law, device, estimator, options, dashpot::simulated_clock{}).run();

  // Where both slips slide. The estimate of the velocity may be off by one count in its window of ten samples, the
  // position by one count: drag and liver answer that too.
  const double count = facts.encoder.step, window = 10 * facts.loop.sample_period;  // [m], [s]
  const double allowed = (drag + 0.4) * count / window + 200 * count;               // [N]
  double worst = 0;                                                                 // [N]
  for (const auto& record : felt) {
    const double since = record.time < reversal ? record.time : record.time - reversal;  // [s]
    if (since * speed < 6e-3 || record.time > end - 0.1) continue;
    const double error = force_of(record) - closed_form(record.position, record.time < reversal ? 1 : -1);
    worst = std::fmax(worst, std::fabs(error));
  }
  const auto at = [&](double time) { return felt.at(static_cast<std::size_t>(time / facts.loop.sample_period)); };
  const double in = 20e-3 / speed, out = reversal + 10e-3 / speed;  // [s]
  std::printf("going in at 20 mm   %+.3f N\n", force_of(at(in)));
  std::printf("drawn back at 20 mm %+.3f N\n", force_of(at(out)));
  std::printf("two frictions of %.1f N in all turn round: %.1f N between them, without drag\n", skin + muscle,
              force_of(at(in)) - force_of(at(out)) - 2 * drag * speed);
  std::printf("from the sum of the layers it differs by less than one count of the encoder makes: %s\n",
              worst <= allowed ? "yes" : "no");
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,position [mm],force [N]\n", table);
    for (std::size_t k = 0; k < felt.size(); k += 40) {
      std::fprintf(table, "needle,%.3f,%.3f\n", felt[k].position * 1e3, force_of(felt[k]));
    }
    std::fclose(table);
  }
  return run.left_safe && run.faults.total() == 0 && worst <= allowed ? 0 : 1;
}
