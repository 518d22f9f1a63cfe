#include <fmt/format.h>

#include <iterator>
#include <set>

#include "emit/banner.hpp"
#include "emit/cpp_batch.hpp"
#include "emit/cpp_program.hpp"
#include "emit/device_facts.hpp"
#include "emit/emission.hpp"
#include "emit/response_test.hpp"
#include "emit/step_shape.hpp"
#include "emit/template_text.hpp"
#include "emit/tunable_fields.hpp"
#include "lower/apart_from.hpp"

namespace dashpot::compiler {
namespace {

CodeModel header_model(const Compilation& c, Timing timing) {
  const UpdateLaw& law = c.law;
  const CppProgram program = cpp_program(law, c.network, c.registers, timing);
  CodeModel model;
  Fields& fields = model.fields;
  describe_file(c, fields);
  describe_device(c, fields);
  add_program(program, model);
  add_tunables(law, model);
  model.lists["set"] = as_list(program.set);
  model.lists["banner"] = as_list(banner(c, law, timing));
  return model;
}

void describe_outputs(const UpdateLaw& law, CodeModel& model) {
  const bool brake = law.brake_changes();
  Fields& fields = model.fields;
  fields["outputs"] = brake ? "scalar* dampings, scalar* forces" : "scalar* forces";
  fields["outputs_passed"] = brake ? "dampings, forces" : "forces";
  fields["no_outputs"] = brake ? "nullptr, nullptr" : "nullptr";
  fields["dampings_comment"] = brake ? " and dampings" : "";
  model.lists["damping"];
  if (!brake)
    model.lists["damping"].push_back(
        {{"line", fmt::format("static constexpr scalar damping = {};  // b, the brake's part, of every point",
                              cpp_literal(law.damping, law.scalar))}});
}

// What the template and the lines of a batch declare, beside its classes.
constexpr const char* names_in_batches[] = {
    "advances",       "begin",     "block",    "clamped",     "dampings",   "forces",
    "gives_commands", "i",         "lane",     "number",      "point",      "points",
    "points_from",    "positions", "put",      "reset_point", "run",        "sampled",
    "size",           "state",     "state_of", "states",      "storage",    "storage_size",
    "tunables",       "value",     "values",   "vector",      "velocities", "wanted"};

CodeModel batch_model(const Compilation& c) {
  std::set<std::string> taken(std::begin(names_in_batches), std::end(names_in_batches));
  for (const char* of_class : {"_batch", "_batch_storage", "_points"}) taken.insert(c.network.name + of_class);
  const UpdateLaw law = apart_from(taken, c.law);
  const CppBatch batch = cpp_batch(law);
  CodeModel model;
  describe_file(c, model.fields);
  describe_outputs(law, model);
  model.fields["checked"] = law.variables[law.checked()].name;
  model.fields["begins"] = batch.set.empty() ? "" : "begin(); ";
  model.fields["states"] = std::to_string(batch.states);
  model.fields["reads"] = std::to_string(batch.loaded + 2);
  model.fields["writes"] = std::to_string(batch.stored + (law.brake_changes() ? 2 : 1));
  model.fields["energy_contract"] = "Energy in the springs of the point [J].";
  for (const std::string& header : batch.headers) model.lists["headers"].push_back({{"header", header}});
  model.lists["banner"] = as_list(banner(c, law, Timing::any));
  add_tunables(law, model);
  model.lists.erase("no_tunable");
  model.lists["set"] = as_list(batch.set);
  model.lists["constants"] = as_list(batch.constants);
  model.lists["reset"] = as_list(batch.reset);
  model.lists["loads"] = as_list(batch.loads);
  model.lists["output"] = as_list(batch.output);
  model.lists["commands"] = as_list(batch.commands);
  model.lists["update"] = as_list(batch.update);
  model.lists["stores"] = as_list(batch.stores);
  model.lists["energy_loads"] = as_list(batch.energy_loads);
  model.lists["energy"] = as_list(batch.energy);
  return model;
}

CodeModel live_model(const Compilation& c) {
  CodeModel model;
  model.fields["name"] = c.network.name;
  for (const char* list : {"settable", "tunables", "device", "facts"}) model.lists[list];
  if (c.device) {
    model.lists["device"].push_back({});
    for (const DeviceFact& fact : facts_of_led_device(c.device->description))
      model.lists["facts"].push_back({{"fact", fact.field + " = " + fact.value}});
  }
  for (const Tunable& t : c.law.parameters()) model.lists["tunables"].push_back({{"tunable", t.name}});
  if (!model.lists["tunables"].empty()) model.lists["settable"].push_back({});
  return model;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_cpp(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics) {
  const std::string& name = compilation.network.name;
  std::vector<OutputFile> files;
  if (options.constant_time && !can_be_timed(compilation, diagnostics)) return std::nullopt;
  const Timing timing = options.constant_time ? Timing::constant : Timing::any;
  const auto is_appended = [&](const char* shape, const char* ending, const CodeModel& model) {
    return append_filled(shape, name + ending, model, options, files, diagnostics);
  };
  bool ok = is_appended("network.hpp.in", ".hpp", header_model(compilation, timing));
  if (options.batch) ok &= is_appended("batch.hpp.in", "_batch.hpp", batch_model(compilation));
  if (options.with_test)
    ok &= is_appended("network_test.cpp.in", "_test.cpp", response_test_model(compilation, "std::log1p"));
  if (options.with_library) ok &= is_appended("model_library.cpp.in", "_library.cpp", {{{"name", name}}, {}});
  if (options.with_live) ok &= is_appended("live.cpp.in", "_live.cpp", live_model(compilation));
  if (!ok) return std::nullopt;
  return files;
}

}  // namespace dashpot::compiler
