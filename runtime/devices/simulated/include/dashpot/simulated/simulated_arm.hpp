// A device of two axes that exists only as numbers: simulated_device for arms (arm_device.hpp), with the same time,
// delay, faults and seed. What it moves is arm_plant.hpp. Nothing allocates after construction.
#pragma once

#include <cstdint>
#include <vector>

#include <dashpot/arm_device.hpp>
#include <dashpot/simulated/arm_plant.hpp>
#include <dashpot/simulated/arm_scenario.hpp>
#include <dashpot/simulated/sample_clock.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>

namespace dashpot {

class simulated_arm {
 public:
  // Throws std::invalid_argument with refusal()'s words where they are not null.
  explicit simulated_arm(const arm_description& arm, simulated::arm_scenario scene = {});

  // Why these two make no simulation, one clause; null where they do.
  static const char* refusal(const arm_description& arm, const simulated::arm_scenario& scene) noexcept;

  device_status read(arm_sample& sample) noexcept;

  // As simulated_device::write(): what is not finite is answered with `fault` and replaced by the safe command.
  device_status write(const arm_actuation& demand) noexcept;

  const arm_description& description() const noexcept { return description_; }

  // What only a simulation can know: the truth at the newest sample, and all energy until then.
  simulated::arm_view truth() const noexcept { return plant_.view(); }
  // The same instant seen from its other side: under what write() has put into effect.
  simulated::arm_view truth_from_now_on() const noexcept { return plant_.view_under(acting()); }
  const simulated::energy_ledger& ledger() const noexcept { return plant_.ledger(); }

 private:
  // At the newest sample, before a command that acts later.
  const arm_actuation& acting() const noexcept {
    return description_.loop().write_latest > 0 ? before_ : line_.back().command;
  }
  struct numbered {
    arm_actuation command;
    unsigned number = 0;  // 0: before the first
  };

  void go_on() noexcept;
  void take_sample() noexcept;
  arm_report report() const noexcept;

  arm_description description_;
  simulated::arm_scenario scene_;
  simulated::arm_plant plant_;
  simulated::shaft_sensors sensors_[arm_axes];
  std::vector<numbered> line_;  // [0]: written last; back(): in effect
  arm_actuation before_;        // in effect until that one acts
  unsigned written_ = 0;        // commands, wrapping around
  bool started_ = false;
  simulated::sample_clock clock_;
  arm_sample newest_;     // as a sound device would deliver it
  arm_sample delivered_;  // the newest that was delivered
};

}  // namespace dashpot
