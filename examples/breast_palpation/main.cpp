// A finger presses a breast phantom twice, with a lump in it and without, on a device that is simulated. Writes what it
// felt as a table, and ends with 1 if that is not what the networks answer.
#include <cmath>
#include <cstdio>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <breast_with_lump.hpp>
#include <breast_without_lump.hpp>
#include <palpation_trainer_device.hpp>

using described = dashpot::devices::palpation_trainer;

using records = std::vector<dashpot::telemetry_record>;

constexpr double surface = 4e-3;                       // [m], as the networks have it
constexpr double fat = 8 * 3250 / 3.0 * 8e-3;          // [N/m], the layer above
constexpr double deep_fat = 8 * 3250 / 3.0 * 12e-3;    // [N/m], the layer on the chest wall
constexpr double deep_lump = 8 * 10400 / 3.0 * 12e-3;  // [N/m]
constexpr double in_series(double k, double j) { return k * j / (k + j); }

double force_of(const dashpot::telemetry_record& r) { return r.motor_force + r.damping * r.velocity; }  // [N]

// A firm hand wants to go 18 mm deep, stays for a second and comes back.
template <class Law>
dashpot::servo_summary palpate(records& felt) {
  Law phantom;
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.user = dashpot::simulated::firm_hand();
  scene.intended = dashpot::simulated::smoothly_through({{0, 0}, {0.8, 18e-3}, {2.2, 18e-3}, {3, 0}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.require_certified = true;
  options.duration = 3.4;  // [s]
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  return dashpot::servo_loop(phantom, device, estimator, options, dashpot::simulated_clock{}).run();
}

// At rest in the tissue the springs alone push back, one behind the other; beside it nothing does.
bool is_right(const dashpot::servo_summary& run, const records& felt, double stiffness) {
  const dashpot::device_description facts = described::description();
  const double step = facts.encoder.step, period = facts.loop.sample_period;
  const dashpot::telemetry_record& held = felt.at(static_cast<std::size_t>(2.2 / period));
  const double closed_form = stiffness * (held.position - surface);  // [N]
  // What one count of the encoder makes of the springs' force and, through the estimated velocity, of the brake's [N].
  const double one_count = stiffness * step + held.damping * step / (facts.velocity.window * period);
  bool free_is_free = true;
  for (const auto& record : felt) free_is_free &= record.position > surface - step || record.motor_force == 0;
  std::printf("%.2f mm deep: %.4f N, by the springs alone %.4f N\n", (held.position - surface) * 1e3, force_of(held),
              closed_form);
  return run.left_safe && run.faults.total() == 0 && run.lowest_energy >= 0 && free_is_free &&
         std::fabs(force_of(held) - closed_form) <= one_count;
}

void write(std::FILE* table, const char* name, const records& felt) {
  for (std::size_t k = 0; k < felt.size(); k += 40) {
    std::fprintf(table, "%s,%.3f,%.4f\n", name, felt[k].position * 1e3, force_of(felt[k]));
  }
}

int main(int, char** arguments) {
  records with, without;
  const auto one = palpate<dashpot::generated::breast_with_lump>(with);
  const auto other = palpate<dashpot::generated::breast_without_lump>(without);
  const double lump = in_series(fat, deep_lump), no_lump = in_series(fat, deep_fat);
  std::printf("with the lump     ");
  bool right = is_right(one, with, lump);
  std::printf("without           ");
  right = is_right(other, without, no_lump) && right;
  std::printf("the lump feels %.0f %% harder\n", (lump / no_lump - 1) * 100);
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,position [mm],force [N]\n", table);
    write(table, "with the lump", with);
    write(table, "without", without);
    std::fclose(table);
  }
  return right ? 0 : 1;
}
