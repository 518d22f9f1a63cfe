#include "emit/fmi_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <variant>

#include "emit/banner.hpp"
#include "emit/c99_source.hpp"
#include "emit/cpp_program.hpp"
#include "emit/fmi_functions.hpp"
#include "emit/template_text.hpp"
#include "emit/tunable_fields.hpp"
#include "law/evaluate.hpp"
#include "network/port_units.hpp"
#include "network/unit.hpp"
#include "source/digest.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t first_parameter = 5;  // value references: time, position, velocity, damping and force come before

const std::set<std::string> own_variables = {"time", "position", "velocity", "damping", "force"};

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

bool has_names_of_its_own(const Compilation& c, Diagnostics& diagnostics) {
  bool good = true;
  for (const Parameter& p : c.network.parameters)
    if (p.tunable && own_variables.count(p.name) != 0) {
      diagnostics.report<DiagnosticCode::parameter_name_kept_by>(p.span, p.name, "another variable of the unit");
      good = false;
    }
  return good;
}

// Whether the command of a sample is a linear map of states and inputs: then from rest at 0 it is its own derivative.
bool is_linear(const Compilation& c) {
  if (c.beyond_linear() || c.law.sheds()) return false;
  for (const Variable& variable : c.law.variables)
    if (variable.role == Role::state && variable.rest_value != 0) return false;
  Evaluation<double> run(c.law);
  run.reset(0);
  return run.step(0, 0).force == 0;
}

// A unit of the standard: the powers of the base units that are in it.
Fields unit_fields(const std::string& unit) {
  const std::variant<Unit, UnitFault> parsed = parse_unit(unit);
  const Unit* known = std::get_if<Unit>(&parsed);
  const Dimension dimension = known != nullptr ? known->dimension : Dimension{};
  std::string powers;
  for (const auto& [name, power] : {std::pair("kg", dimension.kilogram),
                                    {"m", dimension.metre},
                                    {"s", dimension.second},
                                    {"A", dimension.ampere},
                                    {"rad", dimension.radian}})
    if (power != 0) powers += fmt::format(" {}=\"{}\"", name, power);
  return {{"unit", unit}, {"powers", powers}};
}

std::vector<Fields> all_units(const std::vector<std::string>& names) {
  std::vector<Fields> all;
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) all.push_back(unit_fields(name));
  return all;
}

std::string period_text(const Compilation& c) { return cpp_literal(1 / c.rate, ScalarType::float64); }

CodeModel core_model(const Compilation& c, const std::string& token) {
  CodeModel model;
  const std::vector<Fields> tunables = tunable_fields(c.law, ScalarType::float64);
  std::string values;
  for (const Fields& tunable : tunables) values += (values.empty() ? "" : ", ") + tunable.at("value");
  model.fields = {{"law", c99_name(c)},
                  {"scalar", std::string(name_of(c.law.scalar))},
                  {"period", period_text(c)},
                  {"token", token},
                  {"count", std::to_string(tunables.size())},
                  {"values", values.empty() ? "0.0" : values}};
  for (const char* list : {"any_tunable", "is_linear", "is_not_linear"}) model.lists[list];
  if (!tunables.empty()) model.lists["any_tunable"].push_back({});
  model.lists[is_linear(c) ? "is_linear" : "is_not_linear"].push_back({});
  return model;
}

CodeModel source_model(const Compilation& c, FmiVersion version, std::string law, std::string core) {
  CodeModel model;
  Fields file;
  describe_file(c, file);
  model.fields["title"] = file["title"];
  model.lists["source"] = as_one_entry(std::move(law));
  model.lists["core"] = as_one_entry(std::move(core));
  FmiFunctions functions = unused_functions(version);
  model.lists["without"] = std::move(functions.without);
  model.lists["refused"] = std::move(functions.refused);
  if (version == FmiVersion::three) model.lists["no_instance"] = std::move(functions.no_instance);
  return model;
}

CodeModel description_model(const Compilation& c, const std::string& token) {
  CodeModel model;
  Fields file;
  describe_file(c, file);
  describe_device(c, file);
  const PortUnits units = port_units(c.network.port_motion);
  model.fields = {{"name", c.network.name},
                  {"title", xml_text(file["title"])},
                  {"token", token},
                  {"version", file["version"]},
                  {"period", period_text(c)},
                  {"has_derivatives", is_linear(c) ? "true" : "false"},
                  {"position_unit", units.position},
                  {"velocity_unit", units.velocity},
                  {"damping_unit", units.damping},
                  {"force_unit", units.force},
                  {"estimator", file["estimator"]}};
  std::vector<std::string> names = {"s", units.position, units.velocity, units.damping, units.force};
  model.lists["tunables"];
  for (Fields tunable : tunable_fields(c.law, ScalarType::float64)) {
    names.push_back(tunable["unit"]);
    tunable["reference"] = std::to_string(first_parameter + model.lists["tunables"].size());
    model.lists["tunables"].push_back(std::move(tunable));
  }
  model.lists["units"] = all_units(names);
  return model;
}

std::string documentation(const Compilation& c) {
  Fields file;
  describe_file(c, file);
  std::string text;
  for (const std::string& line : banner(c, c.law, Timing::any)) text += xml_text(line) + "\n";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<meta "
      "charset=\"utf-8\">\n<title>{0}</title>\n<h1>{0}</h1>\n<pre>\n{1}</pre>\n"
      "</html>\n",
      xml_text(file["title"]), text);
}

}  // namespace

std::optional<FmiUnit> fmi_unit(const Compilation& c, FmiVersion version, const EmissionOptions& options,
                                Diagnostics& diagnostics) {
  if (!has_names_of_its_own(c, diagnostics)) return std::nullopt;
  std::optional<std::string> law = c99_source(c, options, diagnostics);
  if (!law) return std::nullopt;
  const std::string prefix = fmt::format("fmi{}", int(version));
  const std::string token = fmt::format("{{{}-{}-{}}}", prefix, c.network.name, digest_of(*law));
  std::optional<std::string> core = filled("fmi_core.c.in", core_model(c, token), options.templates, diagnostics);
  if (!core) return std::nullopt;
  std::optional<std::string> source = filled(
      prefix + ".c.in", source_model(c, version, std::move(*law), std::move(*core)), options.templates, diagnostics);
  std::optional<std::string> description =
      filled(prefix + ".xml.in", description_model(c, token), options.templates, diagnostics);
  if (!source || !description) return std::nullopt;
  return FmiUnit{std::move(*description), std::move(*source), documentation(c)};
}

}  // namespace dashpot::compiler
