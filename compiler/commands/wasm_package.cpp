#include "commands/wasm_package.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/web_module.hpp"
#include "emit/banner.hpp"
#include "emit/template_text.hpp"
#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

CodeModel script_model(const Compilation& c) {
  Fields all;
  describe_file(c, all);
  CodeModel model;
  for (const char* name : {"digest", "motion", "name", "scalar", "title", "version"}) model.fields[name] = all.at(name);
  model.fields["rate"] = fmt::format("{}", c.rate);
  model.fields["device_name"] = Json(c.device ? c.device->name : "").dump();
  Json parameters = Json::object();
  for (const Tunable& t : c.law.parameters())
    parameters[t.name] = {{"unit", t.unit}, {"value", t.range.value}, {"min", t.range.min}, {"max", t.range.max}};
  model.fields["parameters"] = parameters.dump();
  model.lists["device"];
  if (c.device) model.lists["device"].push_back({});
  return model;
}

// The names of parameters as a type: "K1" | "K2", or never.
CodeModel types_model(const Compilation& c) {
  CodeModel model = script_model(c);
  std::string names;
  for (const Tunable& t : c.law.parameters()) names += (names.empty() ? "\"" : " | \"") + t.name + "\"";
  model.fields = {{"name", c.network.name},
                  {"title", model.fields["title"]},
                  {"motion", model.fields["motion"]},
                  {"scalar", model.fields["scalar"]},
                  {"parameter_names", names.empty() ? "never" : names}};
  return model;
}

// What npm and Node.js read. Its names have no capitals.
std::string package_file(const Compilation& c) {
  const Json file = {{"name", folded(c.network.name)},
                     {"version", "0.0.0"},
                     {"description", c.network.title.empty() ? c.network.name : c.network.title},
                     {"private", true},
                     {"type", "module"},
                     {"main", "./index.js"},
                     {"exports", {{".", {{"types", "./index.d.ts"}, {"default", "./index.js"}}}}},
                     {"types", "./index.d.ts"}};
  return file.dump(2) + "\n";
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_wasm(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics) {
  const std::string& name = compilation.network.name;
  std::vector<OutputFile> files;
  for (const auto& [shape_name, file, model] :
       {std::tuple("wasm_package.js.in", "index.js", script_model(compilation)),
        std::tuple("wasm_package.d.ts.in", "index.d.ts", types_model(compilation))}) {
    if (!append_filled(shape_name, name + "/" + file, model, options, files, diagnostics)) return std::nullopt;
  }
  files.push_back({name + "/package.json", package_file(compilation)});
  std::optional<std::string> module = web_module_for_target(compilation, options, diagnostics);
  if (!module) return std::nullopt;
  files.push_back({name + "/" + name + ".wasm", std::move(*module)});
  return files;
}

}  // namespace dashpot::compiler
