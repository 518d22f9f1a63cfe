#include <dashpot/board/board_device.hpp>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <time.h>

#include "described_parts.hpp"

namespace dashpot {
namespace {

bool fits_float(double value) noexcept {
  return std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

template <unsigned Axes, class Actuation>
bool fits_float(const Actuation& command) noexcept {
  bool fits = true;
  for (unsigned j = 0; j < Axes; ++j) fits = fits && fits_float(board::nth(command.motor_torque, j));
  for (unsigned i = 0; i < board::brakes_of<Axes>; ++i) fits = fits && fits_float(board::nth(command.brake_damping, i));
  return fits;
}

// Between an actuation and a message.
template <unsigned Axes, class Into, class From>
Into converted(const From& from) noexcept {
  Into into;
  for (unsigned j = 0; j < Axes; ++j) {
    auto& torque = board::nth(into.motor_torque, j);
    torque = static_cast<std::remove_reference_t<decltype(torque)>>(board::nth(from.motor_torque, j));
  }
  for (unsigned i = 0; i < board::brakes_of<Axes>; ++i) {
    auto& damping = board::nth(into.brake_damping, i);
    damping = static_cast<std::remove_reference_t<decltype(damping)>>(board::nth(from.brake_damping, i));
  }
  return into;
}

actuation safe_actuation(const device_description& device) noexcept { return {0, device.brake.safe_damping}; }

std::int64_t late_limit(const board_options& options, const loop_description& loop) noexcept {
  const double periods = 1.0 + static_cast<double>(loop.missed_deadlines_allowed);
  const double limit = options.late_limit > 0 ? options.late_limit : periods * loop.sample_period;
  return std::llround(limit * 1e9);
}

std::uint32_t damage(const board::decoder_statistics& counts) noexcept {
  return counts.corrupted + counts.discarded_bytes;
}

std::uint32_t overtaken(const board::sequence_statistics& counts) noexcept { return counts.repeated + counts.late; }

template <unsigned Axes>
constexpr unsigned other_axes = Axes == 1 ? arm_axes : 1;

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

template <unsigned Axes>
basic_board_device<Axes>::basic_board_device(board::transport stream, const description_type& description,
                                             board_options options) noexcept
    : link_(std::move(stream)),
      description_(description),
      options_(options),
      late_limit_(dashpot::late_limit(options, board::described_loop(description))),
      next_command_(options.first_command) {}

template <unsigned Axes>
device_status basic_board_device<Axes>::read(sample_type& sample) noexcept {
  if (!started_) return device_status::disconnected;
  const std::uint32_t damage_before = damage(link_.statistics());
  const std::uint32_t overtaken_before = overtaken(samples_.statistics());
  if (backlog_) drop_backlog();
  receive();
  if (fresh_) return hand_out(sample);
  ++reads_in_vain_;
  if (link_.closed()) return device_status::disconnected;
  if (damage(link_.statistics()) != damage_before) return device_status::corrupted;
  const bool too_long = reads_in_vain_ > board::described_loop(description_).missed_deadlines_allowed;
  return too_long || overtaken(samples_.statistics()) != overtaken_before ? device_status::stale
                                                                          : device_status::no_data;
}

template <unsigned Axes>
device_status basic_board_device<Axes>::write(const actuation_type& command) noexcept {
  if (!started_) return device_status::disconnected;
  const bool sane = fits_float<Axes>(command);
  const actuation_type sent = sane ? command : safe_actuation(description_);
  const auto message = converted<Axes, board::basic_command_message<Axes>>(sent);
  const device_status status = send(message, next_command_);
  if (status != device_status::ok) return status;
  ++next_command_;
  ++commands_sent_;
  if (commands_this_session_ != ~std::uint32_t{0}) ++commands_this_session_;
  return sane ? device_status::ok : device_status::fault;
}

template <unsigned Axes>
device_status basic_board_device<Axes>::reset() noexcept {
  gauge_.restart();  // after a stall, or a clock that was set, lateness is counted from here
  return started_ ? send(board::reset_message{stops_}) : device_status::disconnected;
}

template <unsigned Axes>
device_status basic_board_device<Axes>::ask_statistics() noexcept {
  return started_ ? send(board::ask_statistics_message()) : device_status::disconnected;
}

template <unsigned Axes>
const char* basic_board_device<Axes>::cause() const noexcept {
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

template <unsigned Axes>
board_statistics basic_board_device<Axes>::statistics() const noexcept {
  return {link_.statistics(), samples_.statistics(), delayed_, commands_sent_, link_.dropped()};
}

template <unsigned Axes>
template <class Message>
device_status basic_board_device<Axes>::send(const Message& message, std::uint32_t sequence) noexcept {
  const bool left = link_.send(message, sequence);
  if (link_.closed()) return device_status::disconnected;
  return left ? device_status::ok : device_status::stale;
}

template <unsigned Axes>
bool basic_board_device<Axes>::receive() noexcept {
  return link_.receive([this](const board::frame& from) { take(from); });
}

// A board that runs freely has sent samples since start(), until the stream was full: even the newest that waits may be
// old. The number of reads is bounded.
template <unsigned Axes>
void basic_board_device<Axes>::drop_backlog() noexcept {
  for (int rounds = 64; rounds > 0 && receive(); --rounds) {}
  samples_.restart();
  fresh_ = backlog_ = false;
}

// A frame that only a host may send is an echo, not an answer of the board.
template <unsigned Axes>
void basic_board_device<Axes>::take(const board::frame& from) noexcept {
  switch (from.type) {
    case board::basic_sample_message<Axes>::type: return take_sample(from);
    case board::basic_description_message<Axes>::type: return keep(from, description_of_board_);
    case board::basic_description_message<other_axes<Axes>>::type: of_other_axes_ = true; return;
    case board::message_type::configured: return take_configured(from);
    case board::message_type::statistics: return keep(from, counts_of_board_);
    default: return;
  }
}

template <unsigned Axes>
void basic_board_device<Axes>::take_configured(const board::frame& from) noexcept {
  keep(from, configured_);
  stops_ = configured_->stops;
  ++configures_answered_;
}

// The loop's sample numbers only grow: if the board begins to count anew, the loop's go on with the next.
template <unsigned Axes>
void basic_board_device<Axes>::take_sample(const board::frame& from) noexcept {
  const std::uint32_t before = samples_.newest();
  const board::arrival came = samples_.note(from.sequence);
  if (came != board::arrival::fresh && came != board::arrival::anew) return;
  const std::uint32_t step = from.sequence - before;
  handed_out_ += came == board::arrival::fresh && step <= board::sequence_tracker::longest_gap ? step : 1;
  newest_ = board::decode<board::basic_sample_message<Axes>>(from);
  stops_ = newest_.stops;
  for (unsigned j = 0; j < Axes; ++j) board::nth(counters_, j).follow(board::nth(newest_.counts, j));
  fresh_ = true;
}

// If the board reports command 0, it may not have received one yet. If it is not running, no command is in force, nor
// will one be that is still under way.
template <unsigned Axes>
typename basic_board_device<Axes>::report_type basic_board_device<Axes>::report() const noexcept {
  const auto applied = converted<Axes, actuation_type>(newest_);
  if (newest_.state != board::board_state::running) return {true, 0, applied};
  const std::uint32_t ago = next_command_ - 1 - newest_.command_sequence;
  return {newest_.command_sequence != 0 && ago < commands_this_session_, ago, applied};
}

template <unsigned Axes>
device_status basic_board_device<Axes>::hand_out(sample_type& sample) noexcept {
  fresh_ = false;
  reads_in_vain_ = 0;
  for (unsigned j = 0; j < Axes; ++j) {
    const std::int64_t counts = board::nth(counters_, j).value();
    board::nth(sample.counts, j) = counts;
    board::nth(sample.position, j) = static_cast<double>(counts) * board::described_joint(description_, j).encoder.step;
    board::nth(sample.edge_time_ns, j) = board::nth(newest_.edge_time, j);
  }
  sample.timestamp_ns = newest_.timestamp;
  sample.sequence = handed_out_;
  sample.report = report();
  if (newest_.state != board::board_state::running) return device_status::fault;
  if (gauge_.lateness(newest_.timestamp, options_.now()) <= late_limit_) return device_status::ok;
  ++delayed_;
  return device_status::stale;
}

template class basic_board_device<1>;
template class basic_board_device<arm_axes>;

}  // namespace dashpot
