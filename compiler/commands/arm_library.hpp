// model_library.hpp for networks of two axes.
#pragma once

#include <dashpot/arm_model_table.hpp>

#include <optional>

#include "commands/model_library.hpp"
#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// A model of two axes (dashpot/arm_model.hpp) whose class is known only at run time.
class LoadedArmModel : public LoadedObject<arm_model_table> {
 public:
  static constexpr int axes = static_cast<int>(arm_axes);
  static constexpr int brakes = static_cast<int>(most_arm_brakes);  // those of its device are the first

  using LoadedObject::LoadedObject;

  void reset(const double (&position)[arm_axes]) noexcept { table().reset(object(), position); }
  any_arm_commands output(const double (&position)[arm_axes], const double (&velocity)[arm_axes]) noexcept {
    return table().output(object(), position, velocity);
  }
};

// As load_model().
std::optional<LoadedArmModel> load_arm_model(const AxesCompilation& compilation, const EmissionOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace dashpot::compiler
