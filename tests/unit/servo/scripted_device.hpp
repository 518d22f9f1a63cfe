// A device that moves as it is told to by a closed form, whatever is commanded, and remembers every command. A test
// disturbs it from outside, period by period.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <dashpot/device.hpp>

namespace dashpot::tests {

// 1 kHz, 10 µm encoder, three missed deadlines allowed, every limit stated; the numbers are those of a small device.
inline device_description scripted_description() {
  device_description device;
  device.loop = {0.001, 0.0001, 0, 0.1, 30, 0, 3};
  device.encoder = {1e-5, quantiser::floor, -0.1, 0.1, 2.0};
  device.motor.max_torque = 8.0;
  device.motor.saturation_allowed = 0.01;
  device.brake.kind = brake_kind::eddy_current;
  device.brake.max_damping = 20.0;
  device.brake.safe_damping = 7.5;
  return device;
}

class scripted_device {
 public:
  using disturbance = std::function<device_status(std::size_t, device_sample&)>;
  using refusal = std::function<device_status(std::size_t)>;

  explicit scripted_device(const device_description& description = scripted_description())
      : description_(description) {}

  void on_read(disturbance disturb) { disturb_ = std::move(disturb); }
  void on_write(refusal refuse) { refuse_ = std::move(refuse); }

  device_status read(device_sample& sample) noexcept {
    const std::size_t read = reads_++;
    sample.position = position_at(read);
    sample.velocity = 0;
    sample.sequence = static_cast<std::uint32_t>(reads_);
    sample.timestamp_ns = read * 1'000'000;
    return disturb_ ? disturb_(read, sample) : device_status::ok;
  }

  device_status write(const actuation& wanted) noexcept {
    written_.push_back(wanted);
    return refuse_ ? refuse_(written_.size() - 1) : device_status::ok;
  }

  const device_description& description() const noexcept { return description_; }
  std::size_t reads() const noexcept { return reads_; }
  const std::vector<actuation>& written() const noexcept { return written_; }  // [k]: after read k

 private:
  // 30 mm at 2 Hz and 1 mm at 17 Hz: 0.48 m/s at most, quantised down.
  double position_at(std::size_t read) const {
    const double time = static_cast<double>(read) * description_.loop.sample_period;
    const double position = 0.03 * std::sin(12.566 * time) + 0.001 * std::sin(106.8 * time);
    return std::floor(position / description_.encoder.step) * description_.encoder.step;
  }

  device_description description_;
  disturbance disturb_;
  refusal refuse_;
  std::size_t reads_ = 0;
  std::vector<actuation> written_;
};

}  // namespace dashpot::tests
