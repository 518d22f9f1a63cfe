#include <dashpot/board/board_device.hpp>

#include <cmath>
#include <cstdio>
#include <algorithm>
#include <limits>

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

std::string compare(const char* what, double board, double described, const char* unit) {
  return std::string(what) + " of the board is " + text_of(board) + unit + ", the device file says " +
         text_of(described) + unit;
}

// What makes the board another one than the described; empty where nothing does. A board that can do more is welcome.
std::string difference(const board::description_message& board, const device_description& described) {
  if (board.motion != described.motion) return "one of board and device file turns, the other slides";
  const units unit = units_of(described.motion);
  const double step = described.encoder.step;
  if (!(std::fabs(board.encoder_step - step) <= step_tolerance * std::fabs(step)))
    return compare("encoder step", board.encoder_step, step, unit.step);
  if (!(board.max_torque >= 0)) return "the board's largest motor effort is no number";
  if (!(board.max_damping >= 0)) return "the board's largest damping is no number";
  if (described.motor.max_torque == 0 && board.max_torque < std::numeric_limits<float>::infinity())
    return "largest motor effort of the board is " + text_of(static_cast<double>(board.max_torque)) + unit.torque +
           ", the device file states no 'max_torque', which means any";
  if (board.max_torque < static_cast<float>(described.motor.max_torque))
    return compare("largest motor effort", static_cast<double>(board.max_torque), described.motor.max_torque,
                   unit.torque);
  if (board.max_damping < static_cast<float>(described.brake.max_damping))
    return compare("largest damping", static_cast<double>(board.max_damping), described.brake.max_damping,
                   unit.damping);
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

bool board_device::start(std::string& error) {
  started_ = false;
  samples_.restart();
  counter_.restart();
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

bool board_device::greet(std::string& error) {
  description_of_board_.reset();
  const auto greeting = [] { return board::hello_message(); };
  if (!ask_until(greeting, [this] { return description_of_board_.has_value(); }))
    return explain_silence("hello", error);
  error = difference(*description_of_board_, description_);
  return error.empty();
}

bool board_device::configure(std::string& error) {
  board::configure_message wish;
  wish.period = to_nanoseconds(description_.loop.sample_period);
  wish.safe_damping = static_cast<float>(description_.brake.safe_damping);
  wish.max_speed = static_cast<float>(description_.encoder.max_speed);
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

// Every configure that was repeated makes the board idle once more, with another number of stops: a reset between two
// of their answers would be undone. A board that lost some is not waited for without end.
void board_device::hear_of_every_configuration() {
  const std::uint64_t enough = board::monotonic_nanoseconds() + longest_patience * nanoseconds_per_millisecond;
  const std::uint64_t end = std::min(enough, deadline_);
  while (configures_answered_ < configures_sent_ && !link_.closed() && board::monotonic_nanoseconds() < end) {
    link_.stream().wait_readable(first_patience);
    receive();
  }
}

// The number of stops is the newest that the board has told, each time: a late configure may have raised it meanwhile.
bool board_device::set_running(std::string& error) {
  fresh_ = false;
  const auto question = [this] { return board::reset_message{stops_}; };
  const auto runs = [this] {
    return fresh_ && newest_.state == board::board_state::running && newest_.stops == stops_;
  };
  return ask_until(question, runs) || explain_silence("reset", error);
}

std::uint16_t board_device::watchdog_periods() const noexcept {
  if (options_.watchdog_periods) return *options_.watchdog_periods;
  const double periods = 2.0 * description_.loop.missed_deadlines_allowed + 2;
  return static_cast<std::uint16_t>(std::min(periods, 65535.0));
}

template <class Question, class Answered>
bool board_device::ask_until(Question&& question, Answered&& answered) {
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
bool board_device::explain_silence(const char* question, std::string& error) const {
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

}  // namespace dashpot
