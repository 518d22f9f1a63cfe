#include "chosen.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "source/source_file.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::paper {
namespace {

using nlohmann::ordered_json;

ordered_json read(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return ordered_json::parse(file);
}

std::string device_path(const std::string& name) { return DASHPOT_DEVICES "/" + name + ".json"; }

const ordered_json& choices() {
  static const ordered_json file = read(DASHPOT_PAPER_ROOM "/chosen.json");
  return file;
}

std::string text_of(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return fmt::format("{}", value.get<double>());
  std::string text;
  for (const ordered_json& item : value) text += (text.empty() ? "" : ", ") + text_of(item);
  return text;
}

// "section.key" of the rig's own file, as written there.
std::string device_value(const std::string& key) {
  static const ordered_json file = read(device_path("pantograph_brake_2009"));
  const std::size_t dot = key.find('.');
  return text_of(file.at(key.substr(0, dot)).at(key.substr(dot + 1)));
}

std::string value_text(const ordered_json& choice) {
  if (choice.contains("device")) return device_value(choice.at("device"));
  const std::string unit = choice.at("unit");
  return text_of(choice.at("value")) + (unit == "1" ? "" : " " + unit);
}

const ordered_json& choice(std::string_view name) {
  const auto found = choices().find(std::string(name));
  if (found == choices().end()) throw std::out_of_range("chosen.json has no " + std::string(name));
  return found->at("value");
}

}  // namespace

double chosen(std::string_view name) { return choice(name).get<double>(); }

std::vector<double> chosen_list(std::string_view name) { return choice(name).get<std::vector<double>>(); }

std::vector<Choice> all_choices() {
  std::vector<Choice> all;
  for (const auto& [name, choice] : choices().items()) all.push_back({name, value_text(choice), choice.at("reason")});
  return all;
}

compiler::Device device_of(const std::string& name) {
  compiler::Diagnostics diagnostics;
  const std::optional<compiler::SourceFile> file = compiler::read_source(device_path(name), diagnostics);
  const std::optional<compiler::DeviceDecl> decl = file ? compiler::parse_device(*file, diagnostics) : std::nullopt;
  std::optional<compiler::Device> device = decl ? compiler::build_device(*decl, diagnostics) : std::nullopt;
  if (!device) throw std::runtime_error("cannot read device " + name);
  return std::move(*device);
}

const compiler::Device& rig() {
  static const compiler::Device device = device_of("pantograph_brake_2009");
  return device;
}

velocity_description true_velocity() {
  velocity_description velocity;
  velocity.estimator = estimator_kind::sensor;
  return velocity;
}

simulated::hand grip() { return simulated::mass_spring_damper(0, chosen("grip.damping"), chosen("grip.stiffness")); }

device_description ideal_rig() {
  device_description plant = rig().description;
  plant.loop.jitter = 0;
  plant.loop.delay_samples = 0;
  plant.encoder.step = 0;
  plant.motor.amplifier_lag = 0;
  plant.velocity = true_velocity();
  return plant;
}

device_description ideal_plant(double sample_period) {
  device_description plant;
  plant.loop.sample_period = sample_period;
  plant.velocity = true_velocity();
  plant.brake.kind = brake_kind::eddy_current;
  plant.brake.max_damping = 1e6;  // any
  plant.mechanics.inertia = 1;    // its motion is prescribed: of no effect
  return plant;
}

}  // namespace dashpot::paper
