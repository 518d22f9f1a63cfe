// A device that exists only as numbers, with the interface of real ones (device.hpp).
//
// Time belongs to the device: the first read() is the sample at time 0, every later one goes on by one sample period
// (plus the drawn jitter, 0 … loop.jitter), whatever the wall clock says. What write() asks for takes effect at the
// sample just read, loop.delay_samples later where the device says so, and stays until it is replaced. The same
// description, scenario and calls give the same bytes. Nothing allocates after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include <dashpot/device.hpp>
#include <dashpot/simulated/compliant_plant.hpp>
#include <dashpot/simulated/energy_ledger.hpp>
#include <dashpot/simulated/plant.hpp>
#include <dashpot/simulated/scenario.hpp>
#include <dashpot/simulated/sample_clock.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>

namespace dashpot {

class simulated_device {
 public:
  // Throws std::invalid_argument with refusal()'s words where they are not null.
  explicit simulated_device(const device_description& device, simulated::scenario scene = {});

  // Why these two make no simulation, one clause; null where they do.
  static const char* refusal(const device_description& device, const simulated::scenario& scene) noexcept;

  device_status read(device_sample& sample) noexcept;

  // A demand that is not finite is answered with `fault` and replaced by the safe command: motor 0, brake at
  // safe_damping. Any other is cut to what motor and brake can do.
  device_status write(const actuation& demand) noexcept;

  const device_description& description() const noexcept { return description_; }

  // What only a simulation can know: the truth at the newest sample, and all energy until then.
  simulated::plant_view truth() const noexcept {
    return std::visit([](const auto& plant) { return plant.view(); }, plant_);
  }
  // The same instant seen from its other side: under what write() has put into effect.
  simulated::plant_view truth_from_now_on() const noexcept {
    return std::visit([this](const auto& plant) { return plant.view_under(acting()); }, plant_);
  }
  const simulated::energy_ledger& ledger() const noexcept {
    return std::visit([](const auto& plant) -> const simulated::energy_ledger& { return plant.ledger(); }, plant_);
  }

 private:
  void go_on() noexcept;
  void take_sample() noexcept;
  simulated::shaft_motion shaft() const noexcept {
    return std::visit([](const auto& plant) { return plant.shaft(); }, plant_);
  }

  device_description description_;
  simulated::scenario scene_;
  std::variant<simulated::plant, simulated::compliant_plant> plant_;
  simulated::shaft_sensors sensors_;
  // At the newest sample, before a command that acts later.
  const actuation& acting() const noexcept {
    return description_.loop.write_latest > 0 ? before_ : line_.back().command;
  }
  struct numbered {
    actuation command;
    unsigned number = 0;  // 0: before the first
  };
  device_report report() const noexcept;

  std::vector<numbered> line_;  // [0]: written last; back(): in effect
  actuation before_;            // in effect until that one acts
  unsigned written_ = 0;        // commands, wrapping around
  bool started_ = false;
  simulated::sample_clock clock_;
  device_sample newest_;     // as a sound device would deliver it
  device_sample delivered_;  // the newest that was delivered
};

}  // namespace dashpot
