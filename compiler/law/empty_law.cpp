#include "law/empty_law.hpp"

namespace dashpot::compiler {

UpdateLaw empty_law_like(const UpdateLaw& law) {
  UpdateLaw empty;
  empty.scalar = law.scalar;
  empty.scheme = law.scheme;
  empty.state_input = law.state_input;
  empty.sample_period = law.sample_period;
  empty.flush_threshold = law.flush_threshold;
  return empty;
}

}  // namespace dashpot::compiler
