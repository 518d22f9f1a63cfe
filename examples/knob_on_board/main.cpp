// A knob on a board at the other end of a wire: a friction that gives before it slides, and a drag. The board is real,
// or its firmware under an emulator. Writes what was felt as a table, and ends with 1 if that is not friction and drag.
//
//     knob unix:board.sock [TABLE.csv]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <dashpot/board/board_device.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include <knob.hpp>
#include <knob_board_device.hpp>

using described = dashpot::devices::knob_board;

using knob = dashpot::generated::knob;

// The same by hand, from the positions that the loop has read: the rubber is wound up by 1.2 kN/m, and slides at 1.2 N.
// The motor makes friction, and of the drag what the brake leaves.
double largest_difference(const std::vector<dashpot::telemetry_record>& felt) {
  double friction = 0, last = felt.front().position, worst = 0;  // [N], [m], [N]; relaxed where it begins
  for (const auto& record : felt) {
    friction = std::clamp(friction + 1200 * (record.position - last), -1.2, 1.2);
    last = record.position;
    const double drag = (3 + knob::added_damping - record.damping) * record.velocity;  // [N]
    worst = std::fmax(worst, std::fabs(record.motor_force - friction - drag));
  }
  return worst;
}

int main(int count, char** arguments) {
  if (count < 2) return std::fputs("usage: knob URL [TABLE.csv]\n", stderr), 2;
  std::string error;
  auto stream = dashpot::board::open_transport(arguments[1], error);
  if (!stream) return std::fprintf(stderr, "%s\n", error.c_str()), 1;
  const dashpot::device_description facts = described::description();
  dashpot::board_options patient;
  patient.start_time = 30'000;  // [ms]: an emulator may have to wait for the computer
  dashpot::board_device device(std::move(*stream), facts, patient);
  if (!device.start(error)) return std::fprintf(stderr, "%s\n", error.c_str()), 1;

  knob law;
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  std::vector<dashpot::telemetry_record> felt;
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.require_certified = true;
  options.duration = 2.5;  // [s]
  options.farewell = 30;   // [s]
  options.outputs.observe = [&](const dashpot::telemetry_record& record) {
    if (record.fresh && record.state == dashpot::servo_state::running) felt.push_back(record);
  };
  dashpot::servo_loop loop(law, device, estimator, options);
  const dashpot::stop_on_signals ctrl_c(loop.control());
  const dashpot::servo_summary run = loop.run();

  const auto by_position = [](const auto& one, const auto& other) { return one.position < other.position; };
  const auto [least, most] = std::minmax_element(felt.begin(), felt.end(), by_position);
  const double worst = felt.empty() ? 1 : largest_difference(felt);
  const bool turned = !felt.empty() && most->position - least->position > 5e-3;
  const bool safe = run.left_safe && run.safe_confirmed && run.faults.total() == 0;
  std::printf("turned by the hand on it: %s\n", turned ? "yes" : "no");
  std::printf("friction and drag as by hand, to a nanonewton: %s\n", worst < 1e-9 ? "yes" : "no");
  std::printf("the board confirms that it was left safe: %s\n", safe ? "yes" : "no");
  if (std::FILE* table = count > 2 ? std::fopen(arguments[2], "w") : nullptr) {
    std::fputs("curve,at the rim [mm],motor and brake [N]\n", table);
    for (std::size_t k = 0; k < felt.size(); k += 4) {
      const double force = felt[k].motor_force + felt[k].damping * felt[k].velocity;  // [N]
      std::fprintf(table, "knob,%.3f,%.4f\n", felt[k].position * 1e3, force);
    }
    std::fclose(table);
  }
  return turned && safe && worst < 1e-9 ? 0 : 1;
}
