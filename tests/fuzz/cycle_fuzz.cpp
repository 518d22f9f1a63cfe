// A servo loop whose device, clock, estimator, model and user do anything whatever, period by period: what leaves for
// the device is finite and within its limits; outside of running it is the safe command, and so is the last; safe is
// left only by a reset and a start that were asked for; every period is counted.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <dashpot/servo/servo_loop.hpp>

namespace {

using namespace dashpot;

// The input, consumed byte by byte; zeros behind its end.
class choices {
 public:
  choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  std::uint64_t word() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return bits;
  }
  // Any double there is, or one near `usual`.
  double number(double usual) {
    if (byte() % 16 != 0) return usual + 1e-4 * (byte() - 128);
    const std::uint64_t bits = word();
    double any;
    std::memcpy(&any, &bits, sizeof any);
    return any;
  }
  bool is_over() const { return at_ >= size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

void require(bool holds) {
  if (!holds) std::abort();
}

struct any_model {
  using scalar = double;
  static constexpr double sample_period = 0.001;
  static constexpr motion port_motion = motion::translation;
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char *device = "", *device_digest = "", *estimator = "";
    static constexpr unsigned loop_delay = 0;
  };
  void reset(double) noexcept {}
  command<double> output(double position, double velocity) noexcept {
    return {what.number(3), what.number(100 * position + velocity)};
  }
  void update() noexcept {}
  double stored_energy() const noexcept { return 0; }
  choices& what;
};

struct any_estimate {
  double update(double) noexcept { return what.number(0); }
  void reset(double) noexcept {}
  const char* name() const noexcept { return ""; }
  choices& what;
};

class any_device {
 public:
  any_device(choices& what, const device_description& description) : what_(what), description_(description) {}

  device_status read(device_sample& sample) noexcept {
    sample.position = position_ = what_.number(std::isfinite(position_) ? position_ : 0);
    sequence_ += what_.byte() % 8 != 0 ? 1 : static_cast<std::uint32_t>(what_.word());
    sample.sequence = sequence_;
    sample.timestamp_ns = what_.word();
    sample.report = {what_.byte() % 2 != 0, what_.byte() % 4u, {what_.number(0), what_.number(1)}};
    if (what_.byte() % 32 == 0) sample.report.commands_ago = static_cast<unsigned>(what_.word());
    return status();
  }
  device_status write(const actuation& command) noexcept {
    const motor_description& motor = description_.motor;
    require(std::isfinite(command.motor_torque) && std::isfinite(command.brake_damping));
    require(motor.max_torque == 0 || std::abs(command.motor_torque) <= motor.max_torque);
    require(command.brake_damping >= 0 && command.brake_damping <= description_.brake.max_damping);
    last = command;
    return status();
  }
  device_status reset() noexcept { return status(); }
  const char* cause() const noexcept { return "whatever"; }
  const device_description& description() const noexcept { return description_; }

  actuation last;

 private:
  device_status status() {
    return what_.byte() % 16 != 0 ? device_status::ok : static_cast<device_status>(what_.byte() % 6);
  }

  choices& what_;
  device_description description_;
  double position_ = 0;
  std::uint32_t sequence_ = 0;
};

// Oversleeps, and finds the machine suspended. Asks for what a user may ask for between two periods.
class any_clock {
 public:
  static constexpr bool is_real = false;

  explicit any_clock(choices& what) : what_(&what) {}
  void start(double period) noexcept { grid_ = period_grid(period); }
  wake_up wait() noexcept {
    const std::uint8_t how = what_->byte();
    now_ = grid_.next_release() + (how % 16 == 0 ? what_->byte() * std::int64_t{1'000'000} : how);
    if (how == 255) now_ += static_cast<std::int64_t>(what_->word() >> 8);
    wake_up woken = grid_.arrive(now_);
    if (how == 254) woken.asleep = static_cast<std::int64_t>(what_->word() >> 1);
    return woken;
  }
  std::int64_t now() const noexcept { return now_; }

 private:
  choices* what_;
  period_grid grid_{1};
  std::int64_t now_ = 0;
};

device_description description_of(choices& what) {
  device_description device;
  device.loop.missed_deadlines_allowed = what.byte() % 4 == 0 ? static_cast<unsigned>(what.word()) : what.byte() % 8;
  device.loop.delay_samples = what.byte() % 66;
  device.loop.jitter = what.byte() * 1e-6;
  device.encoder = {what.byte() % 2 * 1e-5, quantiser::floor, -0.5, 0.5, what.byte() % 4 * 1.0};
  device.motor.max_torque = what.byte() % 4 * 2.0;
  device.motor.saturation_allowed = what.byte() % 2 * 0.01;
  device.brake.kind = what.byte() % 4 == 0 ? brake_kind::none : brake_kind::eddy_current;
  device.brake.max_damping = 20;
  device.brake.coil_lag = what.byte() % 2 * 0.002;
  device.brake.safe_damping = 7.5;
  return device;
}

// What the records and the requests together must tell.
struct witness {
  bool was_safe = false;
  bool reset_asked = false;
  bool start_asked = true;
  std::uint64_t records = 0;

  void see(const telemetry_record& record, const device_description& device) {
    ++records;
    // What the device answers to a command is known when the command has left: the safe one is the next.
    if (record.state != servo_state::running && record.tripped != fault::device_error)
      require(record.motor_torque == 0 && record.brake_damping == device.brake.safe_damping);
    if (was_safe && record.state == servo_state::running) require(reset_asked && start_asked);
    if (record.state == servo_state::safe && !was_safe) reset_asked = start_asked = false;
    was_safe = record.state == servo_state::safe;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  choices what(data, size);
  const device_description description = description_of(what);
  any_device device(what, description);
  any_model model{what};
  any_estimate estimator{what};
  servo_options options;
  options.duration = 0.001 * static_cast<double>(size / 16 + 1);
  options.outputs.log = nullptr;
  options.telemetry_capacity = 1;
  options.command.actuator = {what.byte() % 2 != 0, what.byte() % 2 != 0};
  options.command.energy = what.byte() % 2 != 0 ? energy_policy::raise_brake : energy_policy::observe;
  witness seen;
  servo_control* control = nullptr;
  options.outputs.observe = [&](const telemetry_record& record) {
    seen.see(record, description);
    const std::uint8_t request = what.byte();
    if (request % 8 == 1) control->reset(), seen.reset_asked = true;
    if (request % 8 == 2) control->start(), seen.start_asked = true;
    if (request == 255) control->stop();
  };
  servo_loop loop(model, device, estimator, options, any_clock(what));
  control = &loop.control();
  const servo_summary summary = loop.run();
  require(summary.periods == seen.records);
  require(device.last.motor_torque == 0 && device.last.brake_damping == description.brake.safe_damping);
  require(!summary.safe_confirmed || summary.left_safe);
  return 0;
}
