// The emitted laws as a board without a standard library compiles them: C++17, freestanding, no exceptions, no
// warnings.
#include "slip_laws_emitted.hpp"

namespace {

struct Step {
  double position;
  double* force;

  template <class Law>
  void operator()(unsigned long) {
    static Law law;
    using scalar = typename Law::scalar;
    *force += static_cast<double>(law.step(static_cast<scalar>(position), scalar(0)).force);
  }
};

}  // namespace

extern "C" double step_all(double position) noexcept {
  double force = 0;
  dashpot::generated::for_each_slip_law(Step{position, &force});
  return force;
}
