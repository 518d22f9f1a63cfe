#include <dashpot/board/board_device.hpp>

#include <cmath>
#include <limits>
#include <utility>

#include <time.h>

namespace dashpot {
namespace {

bool fits_float(double value) noexcept {
  return std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

std::int64_t late_limit(const board_options& options, const loop_description& loop) noexcept {
  const double periods = 1.0 + static_cast<double>(loop.missed_deadlines_allowed);
  const double limit = options.late_limit > 0 ? options.late_limit : periods * loop.sample_period;
  return std::llround(limit * 1e9);
}

std::uint32_t damage(const board::decoder_statistics& counts) noexcept {
  return counts.corrupted + counts.discarded_bytes;
}

std::uint32_t overtaken(const board::sequence_statistics& counts) noexcept { return counts.repeated + counts.late; }

template <class Message>
void keep(const board::frame& from, std::optional<Message>& last) noexcept {
  last = board::decode<Message>(from);
}

}  // namespace

std::uint64_t board::monotonic_nanoseconds() noexcept {
  timespec now = {};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

board_device::board_device(board::transport stream, const device_description& description,
                           board_options options) noexcept
    : link_(std::move(stream)),
      description_(description),
      options_(options),
      late_limit_(dashpot::late_limit(options, description.loop)),
      next_command_(options.first_command) {}

device_status board_device::read(device_sample& sample) noexcept {
  if (!started_) return device_status::disconnected;
  const std::uint32_t damage_before = damage(link_.statistics());
  const std::uint32_t overtaken_before = overtaken(samples_.statistics());
  if (backlog_) drop_backlog();
  receive();
  if (fresh_) return hand_out(sample);
  ++reads_in_vain_;
  if (link_.closed()) return device_status::disconnected;
  if (damage(link_.statistics()) != damage_before) return device_status::corrupted;
  const bool too_long = reads_in_vain_ > description_.loop.missed_deadlines_allowed;
  return too_long || overtaken(samples_.statistics()) != overtaken_before ? device_status::stale
                                                                          : device_status::no_data;
}

device_status board_device::write(const actuation& command) noexcept {
  if (!started_) return device_status::disconnected;
  const bool sane = fits_float(command.motor_torque) && fits_float(command.brake_damping);
  const actuation sent = sane ? command : actuation{0, description_.brake.safe_damping};
  const board::command_message message = {static_cast<float>(sent.motor_torque),
                                          static_cast<float>(sent.brake_damping)};
  const device_status status = send(message, next_command_);
  if (status != device_status::ok) return status;
  ++next_command_;
  ++commands_sent_;
  if (commands_this_session_ != ~std::uint32_t{0}) ++commands_this_session_;
  return sane ? device_status::ok : device_status::fault;
}

device_status board_device::reset() noexcept {
  gauge_.restart();  // after a stall, or a clock that was set, lateness is counted from here
  return started_ ? send(board::reset_message{stops_}) : device_status::disconnected;
}

device_status board_device::ask_statistics() noexcept {
  return started_ ? send(board::ask_statistics_message()) : device_status::disconnected;
}

const char* board_device::cause() const noexcept {
  if (newest_.state == board::board_state::running) return "the board is running";
  switch (newest_.cause) {
    case board::stop_cause::none: return "the board is idle: it was switched on or configured since the start";
    case board::stop_cause::host_silent: return "the board's watchdog: no command came for too long";
    case board::stop_cause::bad_command: return "a command that came to the board is not a number";
    case board::stop_cause::bad_model_command: return "the board's own model returned what is not a number";
    case board::stop_cause::overspeed: return "the board's own model: the speed limit is exceeded";
    case board::stop_cause::encoder_jump: return "the board's own model: the encoder jumped";
    case board::stop_cause::commands_anew: return "commands came to the board that began to count anew";
  }
  return "the board stopped for a reason that this host does not know";
}

board_statistics board_device::statistics() const noexcept {
  return {link_.statistics(), samples_.statistics(), delayed_, commands_sent_, link_.dropped()};
}

template <class Message>
device_status board_device::send(const Message& message, std::uint32_t sequence) noexcept {
  const bool left = link_.send(message, sequence);
  if (link_.closed()) return device_status::disconnected;
  return left ? device_status::ok : device_status::stale;
}

bool board_device::receive() noexcept {
  return link_.receive([this](const board::frame& from) { take(from); });
}

// A board that runs freely has gone on since start(), until the stream was full: even the newest that waits may be old.
// Not without end.
void board_device::drop_backlog() noexcept {
  for (int rounds = 64; rounds > 0 && receive(); --rounds) {}
  samples_.restart();
  fresh_ = backlog_ = false;
}

// A board says nothing that only a host may say: such a frame is an echo, and no answer.
void board_device::take(const board::frame& from) noexcept {
  switch (from.type) {
    case board::message_type::sample: return take_sample(from);
    case board::message_type::description: return keep(from, description_of_board_);
    case board::message_type::configured: return take_configured(from);
    case board::message_type::statistics: return keep(from, counts_of_board_);
    default: return;
  }
}

void board_device::take_configured(const board::frame& from) noexcept {
  keep(from, configured_);
  stops_ = configured_->stops;
  ++configures_answered_;
}

// The loop knows samples by numbers that only grow: where the board begins anew, by the next.
void board_device::take_sample(const board::frame& from) noexcept {
  const std::uint32_t before = samples_.newest();
  const board::arrival came = samples_.note(from.sequence);
  if (came != board::arrival::fresh && came != board::arrival::anew) return;
  const std::uint32_t step = from.sequence - before;
  handed_out_ += came == board::arrival::fresh && step <= board::sequence_tracker::longest_gap ? step : 1;
  newest_ = board::decode<board::sample_message>(from);
  stops_ = newest_.stops;
  counter_.follow(newest_.counts);
  fresh_ = true;
}

// Where the board says 0 it may have heard of no command yet. Where it does not run, no command is in force, and none
// that is still under way will be.
device_report board_device::report() const noexcept {
  if (newest_.state != board::board_state::running)
    return {true, 0, {static_cast<double>(newest_.motor_torque), static_cast<double>(newest_.brake_damping)}};
  const std::uint32_t ago = next_command_ - 1 - newest_.command_sequence;
  return {newest_.command_sequence != 0 && ago < commands_this_session_,
          ago,
          {static_cast<double>(newest_.motor_torque), static_cast<double>(newest_.brake_damping)}};
}

device_status board_device::hand_out(device_sample& sample) noexcept {
  fresh_ = false;
  reads_in_vain_ = 0;
  sample.counts = counter_.value();
  sample.position = static_cast<double>(counter_.value()) * description_.encoder.step;
  sample.timestamp_ns = newest_.timestamp;
  sample.edge_time_ns = newest_.edge_time;
  sample.sequence = handed_out_;
  sample.report = report();
  if (newest_.state != board::board_state::running) return device_status::fault;
  if (gauge_.lateness(newest_.timestamp, options_.now()) <= late_limit_) return device_status::ok;
  ++delayed_;
  return device_status::stale;
}

}  // namespace dashpot
