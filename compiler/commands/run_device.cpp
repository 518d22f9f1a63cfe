#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "commands/commands.hpp"
#include "commands/eddy_brake.hpp"
#include "emit/emit_device.hpp"
#include "network/read_value.hpp"

namespace dashpot::compiler {
namespace {

inline constexpr Dimension magnetic_field{1, 0, -2, -1};
inline constexpr Dimension resistivity{1, 3, -3, -2};

// Reads quantities from the command line with the same rules and messages as from files.
class Words {
 public:
  explicit Words(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  double positive(const char* option, const std::string& text, const Dimension& dimension) {
    sources_.push_back(std::make_unique<SourceFile>(option, text));
    const Span span{sources_.back().get(), 0, text.size()};
    const std::optional<double> value =
        read_quantity_as({ValueDecl::Form::text, text, span}, {option, dimension, motion::translation}, diagnostics_);
    if (value && !(*value > 0)) diagnostics_.report<DiagnosticCode::not_positive>(span, option, text);
    sound_ = sound_ && value && *value > 0;
    return value.value_or(1);
  }

  bool sound() const { return sound_; }
  std::vector<std::unique_ptr<SourceFile>> take_sources() { return std::move(sources_); }

 private:
  Diagnostics& diagnostics_;
  std::vector<std::unique_ptr<SourceFile>> sources_;
  bool sound_ = true;
};

struct FilledBrake {
  double damping;  // at the joint [N·m·s/rad] or [N·s/m]
  std::optional<double> damping_per_current_squared;
};

const char* damping_unit(bool rotary) { return rotary ? "N m s/rad" : "N s/m"; }
const char* current_unit(bool rotary) { return rotary ? "N m s/(rad A^2)" : "N s/(m A^2)"; }

// Quantities that are valid each may still give a brake whose numbers overflow or vanish.
bool is_within_numbers(const FilledBrake& brake, bool rotary, Diagnostics& diagnostics) {
  const auto is_quantity = [&](const char* what, double value, const char* unit) {
    if (value > 0 && std::isfinite(value)) return true;
    diagnostics.report<DiagnosticCode::blade_beyond_numbers>({}, what, value, unit);
    return false;
  };
  return is_quantity("damping", brake.damping, damping_unit(rotary)) &&
         is_quantity("damping per squared current", brake.damping_per_current_squared.value_or(1),
                     current_unit(rotary));
}

std::optional<FilledBrake> fill_in(const Device& device, const BladeWords& blade, Words& words,
                                   Diagnostics& diagnostics) {
  const device_description& d = device.description;
  const bool rotary = d.motion == motion::rotation;
  const EddyBrake brake{words.positive("--blade", blade.thickness, dimensions::length),
                        words.positive("--pole-length", blade.pole_length, dimensions::length),
                        words.positive("--pole-width", blade.pole_width, dimensions::length),
                        words.positive("--field", blade.field, magnetic_field),
                        words.positive("--resistivity", blade.resistivity, resistivity)};
  const double radius = blade.radius ? words.positive("--radius", *blade.radius, dimensions::length) : d.arm_radius;
  const double current = blade.current ? words.positive("--current", *blade.current, dimensions::current) : 0;
  if (d.brake.kind != brake_kind::eddy_current) diagnostics.report<DiagnosticCode::brake_missing>({}, device.name);
  if (rotary && radius == 0) diagnostics.report<DiagnosticCode::blade_radius_missing>({}, device.name);
  if (!words.sound() || diagnostics.has_errors()) return std::nullopt;
  const double alpha = blade.correction.value_or(return_path_correction(brake.pole_length, brake.pole_width));
  const double damping = linear_damping(brake, alpha) * (rotary ? radius * radius : 1);
  const FilledBrake filled{damping, current > 0 ? std::optional(damping / (current * current)) : std::nullopt};
  return is_within_numbers(filled, rotary, diagnostics) ? std::optional(filled) : std::nullopt;
}

// What a formula says of a brake is not measured.
void assume(nlohmann::ordered_json& json, const char* name) {
  nlohmann::ordered_json& assumed = json["assumed"];
  if (std::find(assumed.begin(), assumed.end(), name) == assumed.end()) assumed.push_back(name);
}

// A constant of the brake before would make another current of the new largest damping.
void leave_out_constant(nlohmann::ordered_json& json) {
  json["brake"].erase("damping_per_current_squared");
  nlohmann::ordered_json& assumed = json["assumed"];
  assumed.erase(std::remove(assumed.begin(), assumed.end(), "brake.damping_per_current_squared"), assumed.end());
}

// What the file said of where its numbers are from was said of another brake.
void add_to_source(nlohmann::ordered_json& json, const BladeWords& blade, bool without_constant) {
  const nlohmann::ordered_json& before = json["brake"]["max_damping"];
  std::string made = fmt::format(
      "brake.max_damping by 'dashpot device' from a blade of {}, poles of {} by {} and a field of {}, in place of {}",
      blade.thickness, blade.pole_length, blade.pole_width, blade.field,
      before.is_string() ? before.get<std::string>() : before.dump());
  if (without_constant) made += "; damping_per_current_squared, which was of that brake, is left out";
  const std::string source = json.value("source", "");
  json["source"] = source.empty() ? made : source + "; " + made;
}

// It is another device than that of the file before, and so takes the name of the file that is written.
void name_after(nlohmann::ordered_json& json, const std::optional<std::string>& output) {
  const std::filesystem::path path = output.value_or("");
  if (path.extension() == ".json") json["name"] = path.stem().string();
}

std::string filled_text(const SourceFile& file, const FilledBrake& brake, const Options& options, bool rotary) {
  const BladeWords& blade = options.blade;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(file.text());
  name_after(json, options.output);
  const bool without_constant =
      !brake.damping_per_current_squared && json["brake"].contains("damping_per_current_squared");
  add_to_source(json, blade, without_constant);
  json["brake"]["max_damping"] = fmt::format("{:.6g} {}", brake.damping, damping_unit(rotary));
  assume(json, "brake.max_damping");
  if (brake.damping_per_current_squared) {
    json["brake"]["damping_per_current_squared"] =
        fmt::format("{:.6g} {}", *brake.damping_per_current_squared, current_unit(rotary));
    assume(json, "brake.damping_per_current_squared");
  }
  if (without_constant) leave_out_constant(json);
  return json.dump(2) + "\n";
}

ExitStatus write_as_code(const DeviceChoice& device, const Options& options, Diagnostics& diagnostics) {
  const std::optional<std::string> text = device.device
                                              ? emit_device(*device.device, *options.device_language, diagnostics)
                                              : emit_arm_device(*device.axes_device, diagnostics);
  return text ? write_output(options, *text, diagnostics) : ExitStatus::input_refused;
}

}  // namespace

ExitStatus run_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const bool is_filled_in = !options.blade.thickness.empty();
  // In C99 and with a blade there are devices of one axis alone.
  const bool takes_two_axes = !is_filled_in && options.device_language != DeviceLanguage::c99;
  const DeviceChoice device =
      takes_two_axes ? open_any_device(options, files, diagnostics) : open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  if (options.device_language) return write_as_code(device, options, diagnostics);
  const SourceFile* file = files.open(*options.device, diagnostics);
  if (!is_filled_in)
    return write_output(options, nlohmann::ordered_json::parse(file->text()).dump(2) + "\n", diagnostics);
  Words words(diagnostics);
  const std::optional<FilledBrake> brake = fill_in(*device.device, options.blade, words, diagnostics);
  files.keep(words.take_sources());
  if (!brake) return ExitStatus::input_refused;
  const std::string text = filled_text(*file, *brake, options, device.device->description.motion == motion::rotation);
  // All other commands have to take it.
  if (!read_device(files.keep(*options.device + " with this blade", text), diagnostics))
    return ExitStatus::input_refused;
  return write_output(options, text, diagnostics);
}

}  // namespace dashpot::compiler
