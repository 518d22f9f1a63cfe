// When a simulated device takes its samples: one period after another, each later by the drawn jitter, and all later by
// what `late` faults have added until then. The first marks the start of time and is never late.
#pragma once

#include <cstdint>
#include <vector>

#include <dashpot/device_description.hpp>
#include <dashpot/simulated/sample_fault.hpp>

namespace dashpot::simulated {

class sample_clock {
 public:
  struct step {
    double duration;  // since the sample before [s]
    double end;       // time of the sample [s]
  };

  // Goes on to the next sample. Loop, seed and faults are those of all samples.
  step advance(const loop_description& loop, std::uint64_t seed, const std::vector<sample_fault>& faults) noexcept;
  // For how long, in the step after the newest sample, the command before still acts [s].
  double until_write(const loop_description& loop, std::uint64_t seed, double duration) const noexcept;

  std::uint64_t index() const noexcept { return index_; }  // of the newest sample

 private:
  std::uint64_t index_ = 0;
  double postponed_ = 0;  // by late samples until now [s]
};

}  // namespace dashpot::simulated
