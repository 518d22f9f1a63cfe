// A network's emitted code, compiled by the system's compiler and loaded into this process.
#pragma once

#include <dashpot/model_table.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// An object of a class that a loaded library alone knows, with what is alike in the tables of one axis and of two.
template <class Table>
class LoadedObject {
 public:
  using scalar = double;

  explicit LoadedObject(const Table& table)
      : table_(&table), storage_(new unsigned char[table.size + table.alignment]), object_(storage_.get()) {
    std::size_t space = table.size + table.alignment;
    std::align(table.alignment, table.size, object_, space);
    table_->construct(object_);
  }

  auto facts() const noexcept { return table_->facts; }
  void update() noexcept { table_->update(object_); }
  double stored_energy() const noexcept { return table_->stored_energy(object_); }
  double kept_share() const noexcept { return table_->kept_share(object_); }

 protected:
  const Table& table() const noexcept { return *table_; }
  void* object() noexcept { return object_; }

 private:
  const Table* table_;
  std::unique_ptr<unsigned char[]> storage_;
  void* object_;
};

// A model of the servo loop (dashpot/model.hpp) whose class is known only at run time.
class LoadedModel : public LoadedObject<model_table> {
 public:
  using LoadedObject::LoadedObject;

  void reset(double position) noexcept { table().reset(object(), position); }
  command<double> output(double position, double velocity) noexcept {
    return table().output(object(), position, velocity);
  }
};

// The function of that name in a library that is made of the files, of which `source` is compiled; null, with a
// diagnostic, where none is made or has it. The library stays loaded.
void* function_of_library(const std::vector<OutputFile>& files, const std::string& source, const char* name,
                          Diagnostics& diagnostics);
void refuse_table_of_another_version(Diagnostics& diagnostics);

// The table that the library's function `name` answers.
template <class Table>
const Table* table_of_library(const std::vector<OutputFile>& files, const std::string& source, const char* name,
                              unsigned version, Diagnostics& diagnostics) {
  void* function = function_of_library(files, source, name, diagnostics);
  if (function == nullptr) return nullptr;
  const Table* table = reinterpret_cast<const Table* (*)()>(function)();
  if (table != nullptr && table->version == version) return table;
  refuse_table_of_another_version(diagnostics);
  return nullptr;
}

// Writes the class to a folder of its own below the system's temporary one, compiles it with $CXX or c++ against the
// runtime's headers, loads it, and removes the folder. The library stays loaded. Refuses: no compiler, a compiler that
// fails (its own words are passed on), a folder that cannot be made, templates that do not fit.
std::optional<LoadedModel> load_model(const Compilation& compilation, EmissionOptions options,
                                      Diagnostics& diagnostics);

}  // namespace dashpot::compiler
