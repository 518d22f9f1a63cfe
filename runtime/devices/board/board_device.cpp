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
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

board_device::board_device(board::transport stream, const device_description& description,
                           board_options options) noexcept
    : link_(std::move(stream)),
      description_(description),
      options_(options),
      late_limit_(dashpot::late_limit(options, description.loop)) {}

device_status board_device::read(device_sample& sample) noexcept {
  if (!started_) return device_status::disconnected;
  const std::uint32_t damage_before = damage(link_.statistics());
  const std::uint32_t overtaken_before = overtaken(samples_.statistics());
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
  const device_status status = send(message, commands_sent_);
  if (status != device_status::ok) return status;
  ++commands_sent_;
  return sane ? device_status::ok : device_status::fault;
}

device_status board_device::reset() noexcept {
  return started_ ? send(board::reset_message{newest_.stops}) : device_status::disconnected;
}

device_status board_device::ask_statistics() noexcept {
  return started_ ? send(board::ask_statistics_message()) : device_status::disconnected;
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

void board_device::receive() noexcept {
  link_.receive([this](const board::frame& from) { take(from); });
}

// A board says nothing that only a host may say: such a frame is an echo, and no answer.
void board_device::take(const board::frame& from) noexcept {
  switch (from.type) {
    case board::message_type::sample: return take_sample(from);
    case board::message_type::description: return keep(from, description_of_board_);
    case board::message_type::configured: return keep(from, configured_);
    case board::message_type::statistics: return keep(from, counts_of_board_);
    default: return;
  }
}

void board_device::take_sample(const board::frame& from) noexcept {
  const bool first = !sampled_;
  if (samples_.note(from.sequence) != board::arrival::fresh) return;
  const std::int32_t before = newest_.counts;
  newest_ = board::decode<board::sample_message>(from);
  const auto moved =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(newest_.counts) - static_cast<std::uint32_t>(before));
  counts_ = first ? newest_.counts : counts_ + moved;
  sampled_ = true;
  fresh_ = true;
}

device_status board_device::hand_out(device_sample& sample) noexcept {
  fresh_ = false;
  reads_in_vain_ = 0;
  sample.counts = counts_;
  sample.position = static_cast<double>(counts_) * description_.encoder.step;
  sample.timestamp_ns = newest_.timestamp;
  sample.edge_time_ns = newest_.edge_time;
  sample.sequence = samples_.newest();
  if (newest_.state != board::board_state::running) return device_status::fault;
  if (gauge_.lateness(newest_.timestamp, options_.now()) <= late_limit_) return device_status::ok;
  ++delayed_;
  return device_status::stale;
}

}  // namespace dashpot
