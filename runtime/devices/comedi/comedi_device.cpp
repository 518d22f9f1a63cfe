#include <dashpot/comedi/comedi_device.hpp>

#include <comedilib.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace dashpot {
namespace {

std::string number(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value);
  return digits;
}

std::string of_comedi() { return comedi_strerror(comedi_errno()); }

std::uint64_t now() noexcept {
  std::timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000u + static_cast<std::uint64_t>(time.tv_nsec);
}

comedi_insn instruction(unsigned kind, unsigned subdevice, unsigned channel_and_range, lsampl_t* data) noexcept {
  comedi_insn made{};
  made.insn = kind;
  made.n = 1;
  made.data = data;
  made.subdev = subdevice;
  made.chanspec = channel_and_range;
  return made;
}

comedi_insn write_to(const comedi_output& output, lsampl_t* data) noexcept {
  return instruction(INSN_WRITE, output.subdevice, CR_PACK(output.channel, output.range, output.reference), data);
}

bool fail(std::string& error, std::string text) {
  error = std::move(text);
  return false;
}

}  // namespace

comedi_device::comedi_device(comedi_wiring wiring, const device_description& description)
    : wiring_(std::move(wiring)), description_(description) {}

comedi_device::~comedi_device() { close(); }

unsigned comedi_device::scale::sample(double voltage) const noexcept {
  const double within = voltage < low ? low : voltage > high ? high : voltage;
  return static_cast<unsigned>(std::lround((within - low) / (high - low) * most));
}

bool comedi_device::start(std::string& error) {
  close();
  if (!check_description(error) || !open_card(error)) return false;
  const bool is_ready = find_output("motor", wiring_.motor, motor_, error) &&
                        (!has_brake() || find_output("brake", wiring_.brake, brake_, error)) && check_reach(error) &&
                        arm_counter(error);
  const actuation first = safe();
  unsigned counts = 0;
  if (is_ready && run_list(&first, &counts)) {
    last_counts_ = counts;
    position_ = 0;
    samples_ = 0;
    has_pending_ = false;
    cause_ = "";
    return true;
  }
  if (is_ready) error = "the card '" + wiring_.file + "' refuses to read and write: " + of_comedi();
  comedi_close(card_);
  card_ = nullptr;
  return false;
}

bool comedi_device::check_description(std::string& error) const {
  const device_description& d = description_;
  if (!(d.encoder.step > 0)) return fail(error, "the device states no encoder resolution; a count has to be one of it");
  if (!(d.motor.torque_constant > 0) || !(std::fabs(wiring_.motor.current_per_volt) > 0))
    return fail(error,
                "the motor's volts are not known: state torque_constant in the device, current_per_volt in the wiring");
  if (!(d.motor.max_torque > 0)) return fail(error, "the device states no max_torque; an output in volts has an end");
  if (d.loop.delay_samples > 1)
    return fail(error, "the device states a delay of " + std::to_string(d.loop.delay_samples) +
                           " samples; a card has 0, or 1 with one list of instructions a cycle");
  if (!has_brake()) return true;
  const std::vector<brake_point>& points = wiring_.brake_points;
  if (points.empty() &&
      (!(d.brake.damping_per_current_squared > 0) || !(std::fabs(wiring_.brake.current_per_volt) > 0)))
    return fail(error,
                "the brake's volts are not known: state damping_per_current_squared in the device and "
                "current_per_volt in the wiring, or measured brake_points");
  if (points.empty()) return true;
  if (points.size() < 2 || points.front().damping != 0)
    return fail(error, "brake_points begin with a damping of 0, and are two at least");
  const bool rises = points.back().voltage > points.front().voltage;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (!(points[i].damping > points[i - 1].damping) ||
        !(rises ? points[i].voltage > points[i - 1].voltage : points[i].voltage < points[i - 1].voltage))
      return fail(error, "brake_points have to grow in damping, and in voltage go one way");
  if (points.back().damping < d.brake.max_damping)
    return fail(error, "brake_points end at " + number(points.back().damping) + ", below the device's max_damping of " +
                           number(d.brake.max_damping));
  return true;
}

bool comedi_device::open_card(std::string& error) {
  card_ = comedi_open(wiring_.file.c_str());
  return card_ != nullptr || fail(error, "cannot open '" + wiring_.file + "': " + of_comedi());
}

bool comedi_device::find_output(const char* what, const comedi_output& output, scale& found, std::string& error) {
  const std::string name = std::string("subdevice ") + std::to_string(output.subdevice) + ", channel " +
                           std::to_string(output.channel) + " of '" + wiring_.file + "'";
  if (comedi_get_subdevice_type(card_, output.subdevice) != COMEDI_SUBD_AO)
    return fail(error, std::string("the ") + what + " is wired to " + name + ", which is no analogue output");
  const comedi_range* range = comedi_get_range(card_, output.subdevice, output.channel, output.range);
  const lsampl_t most = comedi_get_maxdata(card_, output.subdevice, output.channel);
  if (range == nullptr || most == 0)
    return fail(error, std::string("the ") + what + " is wired to " + name + ", which has no range " +
                           std::to_string(output.range) + ": " + of_comedi());
  if (range->unit != UNIT_volt || !(range->min <= 0) || !(range->max >= 0) || !(range->max > range->min))
    return fail(error, std::string("the range of the ") + what + "'s output is not one in volts that holds 0");
  found = {range->min, range->max, most};
  return true;
}

bool comedi_device::check_reach(std::string& error) const {
  const motor_description& motor = description_.motor;
  const double needed = motor.max_torque / motor.torque_constant / std::fabs(wiring_.motor.current_per_volt);
  if (needed > motor_.high || -needed < motor_.low)
    return fail(error, "max_torque needs +-" + number(needed) + " V, and the motor's output has " + number(motor_.low) +
                           " to " + number(motor_.high) + " V; choose another range, or a smaller max_torque");
  if (!has_brake()) return true;
  for (const double damping : {0.0, description_.brake.safe_damping, description_.brake.max_damping}) {
    const double voltage = brake_voltage(damping);
    if (voltage < brake_.low || voltage > brake_.high)
      return fail(error, "a damping of " + number(damping) + " needs " + number(voltage) +
                             " V, and the brake's output has " + number(brake_.low) + " to " + number(brake_.high) +
                             " V; choose another range, or a smaller max_damping");
  }
  return true;
}

bool comedi_device::arm_counter(std::string& error) {
  const comedi_counter& counter = wiring_.counter;
  if (comedi_get_subdevice_type(card_, counter.subdevice) != COMEDI_SUBD_COUNTER)
    return fail(error, "subdevice " + std::to_string(counter.subdevice) + " of '" + wiring_.file + "' is no counter");
  most_counts_ = comedi_get_maxdata(card_, counter.subdevice, counter.channel);
  const double modulus = most_counts_ + 1.0;
  const device_description& d = description_;
  const double counts =
      d.encoder.max_speed * d.loop.sample_period * (1 + d.loop.missed_deadlines_allowed) / d.encoder.step;
  if (most_counts_ == 0 || (modulus > 1 && 2 * counts >= modulus))
    return fail(error, "the counter wraps at " + number(modulus) + " counts; at max_speed " + number(counts) +
                           " pass while deadlines are missed, which has to be less than half of that");
  if (!counter.is_configured) return true;
  if (comedi_reset_channel(card_, counter.subdevice, counter.channel) < 0 ||
      comedi_set_counter_mode(card_, counter.subdevice, counter.channel, counter.mode) < 0 ||
      comedi_arm_channel(card_, counter.subdevice, counter.channel, NI_GPCT_ARM_IMMEDIATE) < 0)
    return fail(error, "the counter does not take its mode: " + of_comedi());
  return true;
}

double comedi_device::brake_voltage(double damping) const noexcept {
  const std::vector<brake_point>& points = wiring_.brake_points;
  if (!has_brake()) return 0;
  if (points.empty())
    return std::sqrt(damping / description_.brake.damping_per_current_squared) / wiring_.brake.current_per_volt;
  std::size_t i = 1;
  while (i + 1 < points.size() && damping > points[i].damping) ++i;
  const double low = std::sqrt(points[i - 1].damping), high = std::sqrt(points[i].damping);
  const double share = (std::sqrt(damping) - low) / (high - low);
  return points[i - 1].voltage + share * (points[i].voltage - points[i - 1].voltage);
}

actuation comedi_device::within_limits(const actuation& command) const noexcept {
  const double torque = description_.motor.max_torque;
  const double damping = has_brake() ? description_.brake.max_damping : 0;
  return {std::fmin(std::fmax(command.motor_torque, -torque), torque),
          std::fmin(std::fmax(command.brake_damping, 0.0), damping)};
}

std::pair<double, double> comedi_device::voltages(const actuation& command) const noexcept {
  const actuation given = within_limits(command);
  return {given.motor_torque / description_.motor.torque_constant / wiring_.motor.current_per_volt,
          brake_voltage(given.brake_damping)};
}

// Outputs first, so that a counter that fails keeps no command from leaving.
bool comedi_device::run_list(const actuation* command, unsigned* counts) noexcept {
  lsampl_t motor = 0, brake = 0, counter = 0;
  comedi_insn instructions[3];
  comedi_insnlist list{0, instructions};
  if (command != nullptr) {
    const auto [motor_voltage, brake_voltage] = voltages(*command);
    motor = motor_.sample(motor_voltage);
    brake = has_brake() ? brake_.sample(brake_voltage) : 0;
    instructions[list.n_insns++] = write_to(wiring_.motor, &motor);
    if (has_brake()) instructions[list.n_insns++] = write_to(wiring_.brake, &brake);
  }
  if (counts != nullptr)
    instructions[list.n_insns++] =
        instruction(INSN_READ, wiring_.counter.subdevice, CR_PACK(wiring_.counter.channel, 0, 0), &counter);
  if (comedi_do_insnlist(card_, &list) != static_cast<int>(list.n_insns)) return false;
  if (command != nullptr) in_force_ = within_limits(*command);
  if (counts != nullptr) *counts = counter;
  return true;
}

device_status comedi_device::refused(const char* what) noexcept {
  const bool is_gone = errno == ENODEV || errno == EBADF;
  cause_ = what;
  has_pending_ = false;
  const actuation last = safe();
  run_list(&last, nullptr);
  return is_gone ? device_status::disconnected : device_status::fault;
}

// The counter moves by less than half of its range from one reading to the next.
void comedi_device::take_counts(unsigned counts) noexcept {
  const std::int64_t modulus = static_cast<std::int64_t>(most_counts_) + 1;
  std::int64_t moved = static_cast<std::int64_t>(counts) - static_cast<std::int64_t>(last_counts_);
  if (moved >= modulus / 2) moved -= modulus;
  if (moved < -(modulus / 2)) moved += modulus;
  position_ += moved;
  last_counts_ = counts;
}

device_status comedi_device::read(device_sample& sample) noexcept {
  if (card_ == nullptr) return device_status::disconnected;
  unsigned counts = 0;
  errno = 0;
  if (!run_list(has_pending_ ? &pending_ : nullptr, &counts)) return refused("the card refuses to read its counter");
  has_pending_ = false;
  take_counts(counts);
  sample = {};
  sample.counts = position_;
  sample.position = static_cast<double>(position_) * description_.encoder.step;
  sample.timestamp_ns = now();
  sample.sequence = ++samples_;
  sample.report = {true, 0, in_force_};
  return device_status::ok;
}

device_status comedi_device::write(const actuation& command) noexcept {
  if (card_ == nullptr) return device_status::disconnected;
  errno = 0;
  if (!std::isfinite(command.motor_torque) || !std::isfinite(command.brake_damping))
    return refused("the command is NaN or infinite");
  const actuation last = safe();
  const bool ends = command.motor_torque == last.motor_torque && command.brake_damping == last.brake_damping;
  has_pending_ = description_.loop.delay_samples == 1 && !ends;
  if (has_pending_) pending_ = command;
  else if (!run_list(&command, nullptr)) return refused("the card refuses to write its outputs");
  return device_status::ok;
}

void comedi_device::close() noexcept {
  if (card_ == nullptr) return;
  const actuation last = safe();
  run_list(&last, nullptr);
  comedi_close(card_);
  card_ = nullptr;
  cause_ = "the card is closed";
}

}  // namespace dashpot
