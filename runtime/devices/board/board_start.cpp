#include <dashpot/board/board_device.hpp>

#include <cmath>
#include <cstdio>
#include <algorithm>
#include <limits>

#include "described_parts.hpp"

namespace dashpot {
namespace {

constexpr std::uint64_t nanoseconds_per_millisecond = 1'000'000;
// For one answer, before the question is repeated [ms]; doubled each time, so that a slow board is not asked ever
// faster than it answers.
constexpr int first_patience = 50;
constexpr int longest_patience = 800;

// Products of the same numbers in another order differ in the last digits; no other encoder differs by so little.
constexpr double step_tolerance = 1e-9;

std::uint32_t to_nanoseconds(double seconds) noexcept {
  return static_cast<std::uint32_t>(std::llround(seconds * 1e9));
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

struct units {
  const char* step;
  const char* torque;
  const char* damping;
};

units units_of(motion kind) noexcept {
  return kind == motion::rotation ? units{" rad", " N m", " N m s/rad"} : units{" m", " N", " N s/m"};
}

std::string compare(const std::string& what, double board, double described, const char* unit) {
  return what + " of the board is " + text_of(board) + unit + ", the device file says " + text_of(described) + unit;
}

// " of joint 2", where there is more than one.
std::string which(const char* part, unsigned number, unsigned count) {
  return count == 1 ? "" : " of " + std::string(part) + " " + std::to_string(number + 1);
}

std::string difference_of_joint(double step, double max_torque, const device_description& described,
                                const std::string& which) {
  const units unit = units_of(described.motion);
  const double described_step = described.encoder.step;
  if (!(std::fabs(step - described_step) <= step_tolerance * std::fabs(described_step)))
    return compare("encoder step" + which, step, described_step, unit.step);
  if (!(max_torque >= 0)) return "the board's largest motor effort" + which + " is no number";
  if (described.motor.max_torque == 0 && max_torque < std::numeric_limits<double>::infinity())
    return "largest motor effort" + which + " of the board is " + text_of(max_torque) + unit.torque +
           ", the device file states no 'max_torque', which means any";
  if (max_torque < static_cast<double>(static_cast<float>(described.motor.max_torque)))
    return compare("largest motor effort" + which, max_torque, described.motor.max_torque, unit.torque);
  return {};
}

std::string difference_of_brake(double max_damping, double described, const char* unit, const std::string& which) {
  if (!(max_damping >= 0)) return "the board's largest damping" + which + " is no number";
  if (max_damping < static_cast<double>(static_cast<float>(described)))
    return compare("largest damping" + which, max_damping, described, unit);
  return {};
}

// How the board differs from the described one; empty if it does not. A board that can do more is accepted.
template <unsigned Axes>
std::string difference(const board::basic_description_message<Axes>& board,
                       const typename board::loop_types<Axes>::description& described) {
  const motion kind = board::described_joint(described, 0).motion;
  if (board.motion != kind) return "one of board and device file turns, the other slides";
  for (unsigned j = 0; j < Axes; ++j) {
    const std::string found =
        difference_of_joint(board::nth(board.encoder_step, j), static_cast<double>(board::nth(board.max_torque, j)),
                            board::described_joint(described, j), which("joint", j, Axes));
    if (!found.empty()) return found;
  }
  for (unsigned i = 0; i < board::brakes_of<Axes>; ++i) {
    const std::string found = difference_of_brake(static_cast<double>(board::nth(board.max_damping, i)),
                                                  board::described_brake(described, i).max_damping,
                                                  units_of(kind).damping, which("brake", i, board::brakes_of<Axes>));
    if (!found.empty()) return found;
  }
  return {};
}

const char* meaning(board::verdict verdict) noexcept {
  switch (verdict) {
    case board::verdict::accepted: return "accepted";
    case board::verdict::period_too_short: return "its shortest period is longer than the loop's";
    case board::verdict::watchdog_needed:
      return "a board that the host controls needs a watchdog of one period or more";
    case board::verdict::damping_out_of_range: return "the safe damping is more than its brake can make";
    case board::verdict::no_model: return "its firmware was built without a model";
    case board::verdict::model_period_differs: return "its model was compiled for another period than the loop's";
    case board::verdict::no_such_choice: return "it does not know this sampling with this controller";
    case board::verdict::speed_limit_wrong: return "the speed limit is negative or no number";
  }
  return "for a reason this host does not know";
}

}  // namespace

template <unsigned Axes>
bool basic_board_device<Axes>::start(std::string& error) {
  started_ = false;
  samples_.restart();
  for (unsigned j = 0; j < Axes; ++j) board::nth(counters_, j).restart();
  gauge_.restart();
  commands_this_session_ = 0;
  configures_sent_ = configures_answered_ = 0;
  deadline_ =
      board::monotonic_nanoseconds() + static_cast<std::uint64_t>(options_.start_time) * nanoseconds_per_millisecond;
  started_ = greet(error) && configure(error) && set_running(error);
  fresh_ = false;
  backlog_ = started_ && options_.sampling == board::sampling::free_running;
  return started_;
}

template <unsigned Axes>
bool basic_board_device<Axes>::greet(std::string& error) {
  description_of_board_.reset();
  of_other_axes_ = false;
  const auto greeting = [] { return board::hello_message(); };
  if (!ask_until(greeting, [this] { return description_of_board_.has_value() || of_other_axes_; }))
    return explain_silence("hello", error);
  if (description_of_board_) {
    error = difference<Axes>(*description_of_board_, description_);
  } else {
    error = Axes == 1 ? "the board has two axes, the device file one" : "the board has one axis, the device file two";
  }
  return error.empty();
}

template <unsigned Axes>
bool basic_board_device<Axes>::configure(std::string& error) {
  board::basic_configure_message<Axes> wish;
  wish.period = to_nanoseconds(board::described_loop(description_).sample_period);
  for (unsigned i = 0; i < board::brakes_of<Axes>; ++i)
    board::nth(wish.safe_damping, i) = static_cast<float>(board::described_brake(description_, i).safe_damping);
  for (unsigned j = 0; j < Axes; ++j)
    board::nth(wish.max_speed, j) = static_cast<float>(board::described_joint(description_, j).encoder.max_speed);
  wish.watchdog_periods = watchdog_periods();
  wish.sampling = options_.sampling;
  wish.controller = options_.controller;
  configured_.reset();
  const auto ask_again = [this, &wish] { return ++configures_sent_, wish; };
  if (!ask_until(ask_again, [this] { return configured_.has_value(); })) return explain_silence("configure", error);
  hear_of_every_configuration();
  if (configured_->verdict == board::verdict::accepted) return true;
  error = std::string("the board refuses the configuration: ") + meaning(configured_->verdict);
  return false;
}

// Every repeated configure makes the board idle once more and raises its number of stops: a reset sent between two of
// their answers would be undone. The wait for answers that were lost is bounded.
template <unsigned Axes>
void basic_board_device<Axes>::hear_of_every_configuration() {
  const std::uint64_t enough = board::monotonic_nanoseconds() + longest_patience * nanoseconds_per_millisecond;
  const std::uint64_t end = std::min(enough, deadline_);
  while (configures_answered_ < configures_sent_ && !link_.closed() && board::monotonic_nanoseconds() < end) {
    link_.stream().wait_readable(first_patience);
    receive();
  }
}

// The number of stops is the newest that the board has told, each time: a late configure may have raised it meanwhile.
template <unsigned Axes>
bool basic_board_device<Axes>::set_running(std::string& error) {
  fresh_ = false;
  const auto question = [this] { return board::reset_message{stops_}; };
  const auto runs = [this] {
    return fresh_ && newest_.state == board::board_state::running && newest_.stops == stops_;
  };
  return ask_until(question, runs) || explain_silence("reset", error);
}

template <unsigned Axes>
std::uint16_t basic_board_device<Axes>::watchdog_periods() const noexcept {
  if (options_.watchdog_periods) return *options_.watchdog_periods;
  const double periods = 2.0 * board::described_loop(description_).missed_deadlines_allowed + 2;
  return static_cast<std::uint16_t>(std::min(periods, 65535.0));
}

template <unsigned Axes>
template <class Question, class Answered>
bool basic_board_device<Axes>::ask_until(Question&& question, Answered&& answered) {
  for (int patience = first_patience; !link_.closed() && board::monotonic_nanoseconds() < deadline_;
       patience = std::min(2 * patience, longest_patience)) {
    link_.send(question());
    const std::uint64_t repeat = board::monotonic_nanoseconds() + patience * nanoseconds_per_millisecond;
    while (!link_.closed() && board::monotonic_nanoseconds() < std::min(repeat, deadline_)) {
      link_.stream().wait_readable(first_patience);
      receive();
      if (answered()) return true;
    }
  }
  return false;
}

// What came instead of the answer is the best hint that there is.
template <unsigned Axes>
bool basic_board_device<Axes>::explain_silence(const char* question, std::string& error) const {
  const board::decoder_statistics& seen = link_.statistics();
  error = std::string("no answer to ") + question;
  if (link_.closed()) {
    error += ": the stream was closed";
  } else if (seen.foreign_version != 0) {
    error += ": the board speaks protocol version " + std::to_string(seen.other_version) + ", this host " +
             std::to_string(board::protocol_version);
  } else if (seen.received == 0 && seen.discarded_bytes != 0) {
    error += ": " + std::to_string(seen.discarded_bytes) + " bytes came, but no frame; another baud rate?";
  }
  return false;
}

template bool basic_board_device<1>::start(std::string&);
template bool basic_board_device<arm_axes>::start(std::string&);

}  // namespace dashpot
