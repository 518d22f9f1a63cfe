#include <dashpot/simulated/sample_fault.hpp>

#include <algorithm>
#include <limits>

namespace dashpot::simulated {

bool has_early_sample(const std::vector<sample_fault>& faults) noexcept {
  return std::any_of(faults.begin(), faults.end(), [](const sample_fault& fault) {
    return fault.kind == sample_fault_kind::late && !(fault.size >= 0);
  });
}

const sample_fault* fault_at(const std::vector<sample_fault>& faults, std::uint64_t index) noexcept {
  for (const sample_fault& fault : faults)
    if (index >= fault.first && index - fault.first < fault.count) return &fault;
  return nullptr;
}

void spoil(const sample_fault& fault, const shaft_sensors& sensors, double& position, std::int64_t& counts) noexcept {
  if (fault.kind == sample_fault_kind::not_a_number) {
    position = std::numeric_limits<double>::quiet_NaN();
  } else {
    position += sensors.quantised(fault.size);
    counts += sensors.counts(fault.size);
  }
}

}  // namespace dashpot::simulated
