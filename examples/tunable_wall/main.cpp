// A wall at 10 mm whose stiffness and damping a user interface moves while a hand leans on it, for two seconds of real
// time. The user interface is this thread, the servo loop another. Ends with 1 if a value arrived torn, or not at all.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <tunable_wall.hpp>
#include <wall_trainer_device.hpp>
#include "newest.hpp"

using described = dashpot::devices::wall_trainer;

using wall = dashpot::generated::tunable_wall;

// What the user interface hands over: where its sliders are, and a running number.
struct setting {
  wall::parameters sliders;
  unsigned number = 0;
};
constexpr unsigned at_rest = ~0u;  // they stand at 300 N/m and 3 N·s/m

// Both sliders follow the number, up and down, so that it can be told whether a setting arrived whole.
setting setting_of(unsigned number) {
  const unsigned place = number / 100 % 2000;
  setting result;
  result.number = number;
  result.sliders.viscosity = number == at_rest ? 3 : 1e-3 * (place < 1000 ? place : 2000 - place);  // [N·s/m]
  result.sliders.stiffness = 100 * result.sliders.viscosity;                                        // [N/m]
  return result;
}

// The law as the loop sees it: between two samples, when the command has left, it takes what the user interface has
// put.
class wall_with_sliders : public wall {
 public:
  explicit wall_with_sliders(newest<setting>& from) noexcept : from_(from) {}

  void update() noexcept {
    wall::update();
    const unsigned before = wanted_.number;
    if (!from_.take(wanted_)) return;
    const wall::parameters whole = setting_of(wanted_.number).sliders;
    if (wanted_.sliders.viscosity != whole.viscosity || wanted_.sliders.stiffness != whole.stiffness) ++torn_;
    if (wanted_.number < before) ++out_of_order_;
    set(wanted_.sliders);
    ++taken_;
  }

  const setting& wanted() const noexcept { return wanted_; }
  unsigned taken() const noexcept { return taken_; }
  unsigned torn() const noexcept { return torn_; }
  unsigned out_of_order() const noexcept { return out_of_order_; }

 private:
  newest<setting>& from_;
  setting wanted_;
  unsigned taken_ = 0, torn_ = 0, out_of_order_ = 0;
};

int main(int, char** arguments) {
  newest<setting> sliders;
  wall_with_sliders law(sliders);
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.user = dashpot::simulated::firm_hand();
  scene.intended = dashpot::simulated::smoothly_through({{0, 0}, {0.5, 25e-3}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  std::vector<dashpot::telemetry_record> felt;
  felt.reserve(4000);
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.duration = 2;  // [s]
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  dashpot::servo_loop loop(law, device, estimator, options);
  const dashpot::stop_on_signals ctrl_c(loop.control());

  dashpot::servo_summary run;
  std::atomic<bool> over{false};
  std::thread servo([&] {
    run = loop.run();
    over = true;
  });
  // The sliders go up and down for a second, far more often than the loop looks; then they stand.
  const auto begin = std::chrono::steady_clock::now();
  for (unsigned number = 0; !over; std::this_thread::sleep_for(std::chrono::microseconds(400))) {
    const bool stand = std::chrono::steady_clock::now() - begin > std::chrono::seconds(1);
    for (int nudge = 0; nudge < 1000; ++nudge) sliders.put(setting_of(stand ? at_rest : ++number));
  }
  servo.join();

  const bool last_arrived = law.wanted().number == at_rest && !felt.empty() && felt.back().damping == 3;
  std::printf("values taken while it ran: %s, torn: %u, out of order: %u\n", law.taken() > 10 ? "many" : "too few",
              law.torn(), law.out_of_order());
  std::printf("energy that the wall gave to the hand: %s\n", run.lowest_energy >= 0 ? "none" : "some");
  std::printf("the last value has arrived, and the device was left safe: %s\n",
              last_arrived && run.left_safe && run.faults.total() == 0 ? "yes" : "no");
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,time [s],force on the hand [N]\n", table);
    for (std::size_t k = 0; k < felt.size(); k += 10) {
      std::fprintf(table, "wall,%.3f,%.4f\n", felt[k].time, felt[k].motor_force + felt[k].damping * felt[k].velocity);
    }
    std::fclose(table);
  }
  const bool arrived = last_arrived && law.taken() > 10 && law.torn() == 0 && law.out_of_order() == 0;
  return arrived && run.lowest_energy >= 0 && run.left_safe && run.faults.total() == 0 ? 0 : 1;
}
