#include "emit/emit_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dashpot/estimators/estimator_names.hpp>

#include "emit/banner.hpp"
#include "emit/c99_estimator.hpp"
#include "emit/c99_parts.hpp"
#include "emit/template_text.hpp"
#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

// Device files may call a device what no type can be called; neither can a struct what its members are called.
std::string type_name(const std::string& device) {
  const std::string name = legal_name(device);
  return name == "name" || name == "digest" || name == "description" ? name + "_1" : name;
}

CodeModel device_model(const Device& device, DeviceLanguage language) {
  CodeModel model;
  Fields& fields = model.fields;
  fields["name"] = type_name(device.name);
  fields["title"] = comment_text(device.name);
  fields["device"] = string_text(device.name);
  fields["digest"] = device.digest;
  fields["version"] = DASHPOT_VERSION;
  for (const DeviceFact& fact : all_facts(device.description, language))
    model.lists["facts"].push_back(
        {{"field", fact.field}, {"value", fact.value}, {"remark", fact.remark.empty() ? "" : "  // " + fact.remark}});
  if (language == DeviceLanguage::cpp) return model;
  fields["estimator"] = name_of(device.description.velocity.estimator);
  model.lists["description"] = as_list(c99_device_header());
  const bool needs_command = needs_command_header(device.description.velocity.estimator);
  model.lists["command"] = as_list(needs_command ? c99_command_header() : std::vector<std::string>());
  model.lists["estimate"] = as_list(c99_estimator(device.description, "dashpot_estimator_" + fields["name"]));
  return model;
}

}  // namespace

std::optional<std::string> emit_device(const Device& device, DeviceLanguage language, Diagnostics& diagnostics) {
  const char* shape = language == DeviceLanguage::cpp ? "device.hpp.in" : "device.h.in";
  const SourceFile* file = find_template(shape, std::nullopt, diagnostics);
  return file ? fill(*file, device_model(device, language), diagnostics) : std::nullopt;
}

}  // namespace dashpot::compiler
