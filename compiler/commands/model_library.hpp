// A network's emitted code, compiled by the system's compiler and loaded into this process.
#pragma once

#include <dashpot/model_table.hpp>

#include <memory>
#include <optional>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// A model of the servo loop (dashpot/model.hpp) whose class is known only at run time.
class LoadedModel {
 public:
  using scalar = double;

  explicit LoadedModel(const model_table& table);

  model_facts facts() const noexcept { return table_->facts; }
  void reset(double position) noexcept { table_->reset(object_, position); }
  command<double> output(double position, double velocity) noexcept {
    return table_->output(object_, position, velocity);
  }
  void update() noexcept { table_->update(object_); }
  double stored_energy() const noexcept { return table_->stored_energy(object_); }
  double kept_share() const noexcept { return table_->kept_share(object_); }

 private:
  const model_table* table_;
  std::unique_ptr<unsigned char[]> storage_;
  void* object_;
};

// Writes the class to a folder of its own below the system's temporary one, compiles it with $CXX or c++ against the
// runtime's headers, loads it, and removes the folder. The library stays loaded. Refuses: no compiler, a compiler that
// fails (its own words are passed on), a folder that cannot be made, templates that do not fit.
std::optional<LoadedModel> load_model(const Compilation& compilation, EmissionOptions options,
                                      Diagnostics& diagnostics);

}  // namespace dashpot::compiler
