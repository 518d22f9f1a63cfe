// model_library.hpp for networks of two axes.
#pragma once

#include <dashpot/arm_model_table.hpp>

#include <memory>
#include <optional>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// A model of two axes (dashpot/arm_model.hpp) whose class is known only at run time.
class LoadedArmModel {
 public:
  using scalar = double;
  static constexpr int axes = static_cast<int>(arm_axes);
  static constexpr int brakes = static_cast<int>(most_arm_brakes);  // those of its device are the first

  explicit LoadedArmModel(const arm_model_table& table);

  arm_model_facts facts() const noexcept { return table_->facts; }
  void reset(const double (&position)[arm_axes]) noexcept { table_->reset(object_, position); }
  any_arm_commands output(const double (&position)[arm_axes], const double (&velocity)[arm_axes]) noexcept {
    return table_->output(object_, position, velocity);
  }
  void update() noexcept { table_->update(object_); }
  double stored_energy() const noexcept { return table_->stored_energy(object_); }
  double kept_share() const noexcept { return table_->kept_share(object_); }

 private:
  const arm_model_table* table_;
  std::unique_ptr<unsigned char[]> storage_;
  void* object_;
};

// As load_model().
std::optional<LoadedArmModel> load_arm_model(const AxesCompilation& compilation, const EmissionOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace dashpot::compiler
