// Faults of the sampling that a simulated device makes on request. The mechanics underneath go on undisturbed, and the
// samples before a fault are the same, bit for bit, as without it.
#pragma once

#include <cstdint>
#include <vector>

#include <dashpot/device.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>

namespace dashpot::simulated {

enum class sample_fault_kind : unsigned char {
  lost,          // read() returns no_data
  repeated,      // read() returns stale and the newest sample that was delivered before
  corrupted,     // read() returns corrupted
  disconnected,  // read() returns disconnected
  device_error,  // read() returns fault
  late,          // the sample, and with it all later ones, comes `size` [s] later than it should
  not_a_number,  // the position is NaN
  jump,          // position and counts are off by `size` at the joint [rad] or [m], rounded to whole encoder steps
};

struct sample_fault {
  sample_fault_kind kind = sample_fault_kind::lost;
  std::uint64_t first = 0;  // index of the first sample that it strikes: reads before it
  std::uint64_t count = 1;  // samples in a row; `late` strikes each of them
  double size = 0;
};

// Whether a late sample would come before its time.
bool has_early_sample(const std::vector<sample_fault>& faults) noexcept;

// The first that strikes the sample of this index; null where none does.
const sample_fault* fault_at(const std::vector<sample_fault>& faults, std::uint64_t index) noexcept;

// Makes a position wrong as `not_a_number` and `jump` say.
void spoil(const sample_fault& fault, const shaft_sensors& sensors, double& position, std::int64_t& counts) noexcept;

// What a reader gets of the newest sample under a fault, or without one. `delivered`: the newest that it got;
// `spoil_position` does to a sample what spoil() does to a position.
template <class Sample, class Spoil>
device_status deliver(const sample_fault* fault, const Sample& newest, Sample& delivered, Sample& sample,
                      const Spoil& spoil_position) noexcept {
  Sample answer = newest;
  if (fault) {
    switch (fault->kind) {
      case sample_fault_kind::lost: return device_status::no_data;
      case sample_fault_kind::corrupted: return device_status::corrupted;
      case sample_fault_kind::disconnected: return device_status::disconnected;
      case sample_fault_kind::device_error: return device_status::fault;
      case sample_fault_kind::repeated: sample = delivered; return device_status::stale;
      case sample_fault_kind::late: break;
      case sample_fault_kind::not_a_number:
      case sample_fault_kind::jump: spoil_position(answer); break;
    }
  }
  sample = delivered = answer;
  return device_status::ok;
}

}  // namespace dashpot::simulated
