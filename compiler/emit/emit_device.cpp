#include "emit/emit_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dashpot/estimators/estimator_names.hpp>

#include "emit/banner.hpp"
#include "emit/c99_estimator.hpp"
#include "emit/c99_parts.hpp"
#include "emit/cpp_program.hpp"
#include "emit/template_text.hpp"
#include "network/arm_description.hpp"
#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

// Device files may call a device what no type can be called; neither can a struct what its members are called.
std::string type_name(const std::string& device) {
  const std::string name = legal_name(device);
  return name == "name" || name == "digest" || name == "description" ? name + "_1" : name;
}

Fields identity_fields(const std::string& name, const std::string& digest) {
  return {{"name", type_name(name)},
          {"title", comment_text(name)},
          {"device", string_text(name)},
          {"digest", digest},
          {"version", DASHPOT_VERSION}};
}

Fields fact_row(const DeviceFact& fact, const std::string& prefix = "") {
  return {{"field", prefix + fact.field},
          {"value", fact.value},
          {"remark", fact.remark.empty() ? "" : "  // " + fact.remark}};
}

DeviceFact number_fact(const std::string& field, double value, const char* remark) {
  return {field, cpp_literal(value, ScalarType::float64), remark};
}

std::vector<DeviceFact> geometry_facts(const AxesDevice& device, const arm_geometry& arm) {
  std::vector<DeviceFact> facts{{"geometry.kind", fmt::format("dashpot::arm_kind::{}", name_of(device.arm.kind)), ""},
                                number_fact("geometry.proximal", arm.proximal, "[m]"),
                                number_fact("geometry.distal", arm.distal, "[m]"),
                                number_fact("geometry.base", arm.base, "[m]")};
  for (unsigned i = 0; i < 2; ++i) {
    facts.push_back(number_fact(fmt::format("geometry.workspace_low[{}]", i), arm.workspace_low[i], "[m]"));
    facts.push_back(number_fact(fmt::format("geometry.workspace_high[{}]", i), arm.workspace_high[i], "[m]"));
  }
  return facts;
}

// Of both joints and all brakes: what joint_of() and brake_of() take of them.
CodeModel arm_device_model(const AxesDevice& device) {
  const arm_description arm = arm_description_of(device);
  CodeModel model;
  model.fields = identity_fields(device.name, device.digest);
  std::vector<Fields>& rows = model.lists["facts"];
  const auto add = [&rows](const device_description& one, const std::string& prefix, bool of_brake) {
    for (const DeviceFact& fact : all_facts(one, DeviceLanguage::cpp))
      if (fact.field.starts_with("brake.") == of_brake) rows.push_back(fact_row(fact, prefix));
  };
  for (const DeviceFact& fact : geometry_facts(device, arm.geometry)) rows.push_back(fact_row(fact));
  for (unsigned j = 0; j < arm_axes; ++j) add(joint_of(arm, j), fmt::format("joints[{}].", j), false);
  rows.push_back(fact_row({"brake_count", fmt::format("{}u", arm.brake_count), ""}));
  for (unsigned i = 0; i < arm.brake_count; ++i) {
    const std::string prefix = fmt::format("brakes[{}].", i);
    for (unsigned j = 0; j < arm_axes; ++j)
      rows.push_back(fact_row(number_fact(fmt::format("along[{}]", j), arm.brakes[i].along[j], ""), prefix));
    add(brake_of(arm, i), prefix, true);
  }
  const char* const inertia = arm.motion() == motion::rotation ? "[kg·m²]" : "[kg]";
  for (unsigned j = 0; j < arm_axes; ++j) {
    for (unsigned k = 0; k < arm_axes; ++k)
      rows.push_back(fact_row(number_fact(fmt::format("inertia[{}][{}]", j, k), arm.inertia[j][k], inertia)));
    rows.push_back(fact_row(number_fact(fmt::format("link_masses[{}]", j), arm.link_masses[j], "[kg]")));
  }
  return model;
}

CodeModel device_model(const Device& device, DeviceLanguage language) {
  CodeModel model;
  model.fields = identity_fields(device.name, device.digest);
  Fields& fields = model.fields;
  for (const DeviceFact& fact : all_facts(device.description, language)) model.lists["facts"].push_back(fact_row(fact));
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
  return filled(shape, device_model(device, language), std::nullopt, diagnostics);
}

std::optional<std::string> emit_arm_device(const AxesDevice& device, Diagnostics& diagnostics) {
  return filled("arm_device.hpp.in", arm_device_model(device), std::nullopt, diagnostics);
}

}  // namespace dashpot::compiler
