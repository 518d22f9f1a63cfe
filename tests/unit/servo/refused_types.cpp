// Never linked: compiled once for every type that a servo loop must refuse, named by REFUSED, and once for those it
// takes.
#include <dashpot/servo/servo_loop.hpp>

#include "second_order_maxwell.hpp"

namespace {

using dashpot::command;
using dashpot::device_sample;
using dashpot::device_status;
using complete_model = dashpot::generated::second_order_maxwell;

struct model_without_certificate {
  using scalar = float;
  static constexpr scalar sample_period = 0.001f;
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  void reset(scalar) noexcept;
  command<scalar> output(scalar, scalar) noexcept;
  void update() noexcept;
  scalar stored_energy() const noexcept;
};

struct model_that_throws : complete_model {
  command<double> output(double position, double velocity);
};

struct model_without_rate : complete_model {
  static constexpr double sample_period = 0;
};

struct complete_device {
  device_status read(device_sample&) noexcept;
  device_status write(const dashpot::actuation&) noexcept;
  const dashpot::device_description& description() const noexcept;
};

struct device_that_throws : complete_device {
  device_status read(device_sample&);
};

struct complete_estimator {
  float update(float position) noexcept;
  void reset(float position) noexcept;
  const char* name() const noexcept;
};

struct estimator_without_name {
  float update(float position) noexcept;
  void reset(float position) noexcept;
};

struct estimator_of_integers : complete_estimator {
  int update(float position) noexcept;
};

}  // namespace

static_assert(dashpot::CHECK<REFUSED>());
