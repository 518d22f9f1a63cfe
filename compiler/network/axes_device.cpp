#include "network/axes_device.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "network/port_units.hpp"
#include "network/read_pair.hpp"
#include "source/counted.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using axes::Kinematics;
using axes::Pair;

const std::vector<std::string> arm_kinds = {"serial", "parallelogram", "five_bar", "cartesian"};

motion motion_of(Kinematics kind) { return kind == Kinematics::cartesian ? motion::translation : motion::rotation; }

class AxesDeviceBuilder {
 public:
  AxesDeviceBuilder(const AxesDeviceDecl& decl, Diagnostics& diagnostics)
      : decl_(decl), diagnostics_(diagnostics), errors_before_(diagnostics.error_count()) {}

  AxesDevice build() {
    if (decl_.name) device_.name = decl_.name->text;
    device_.source = decl_.source ? decl_.source->text : std::string();
    device_.digest = decl_.digest;
    if (decl_.kinematics) read_kinematics(*decl_.kinematics);
    check_motion();
    read_joints();
    read_brakes();
    if (decl_.mechanics) read_mechanics(*decl_.mechanics);
    read_assumed();
    return std::move(device_);
  }

 private:
  const char* motion_name() const { return name_of(motion_of(device_.arm.kind)); }
  bool rotates() const { return motion_of(device_.arm.kind) == motion::rotation; }

  void read_kinematics(const JsonValue& object) {
    ObjectReader reader(object, "kinematics", diagnostics_);
    reader.refuse_other_keys({"kind", "links", "base", "workspace"});
    reader.require("kind");
    const std::optional<Text> kind = reader.text("kind");
    if (!kind || !read_kind(*kind)) return;
    read_links(reader);
    if (reader.require("workspace") != nullptr) read_workspace(reader);
  }

  bool read_kind(const Text& kind) {
    const auto found = std::find(arm_kinds.begin(), arm_kinds.end(), kind.text);
    if (found != arm_kinds.end()) {
      device_.arm.kind = static_cast<Kinematics>(found - arm_kinds.begin());
      return true;
    }
    diagnostics_.report<DiagnosticCode::unknown_word>(kind.span, "'kinematics.kind'", excerpt(kind.text),
                                                      fmt::format("{}", fmt::join(arm_kinds, ", ")));
    if (const auto nearest = nearest_name(kind.text, arm_kinds))
      diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
    return false;
  }

  void read_links(const ObjectReader& reader) {
    axes::Arm& arm = device_.arm;
    if (arm.kind == Kinematics::cartesian) {
      for (const char* key : {"links", "base"})
        if (const JsonMember* member = reader.find(key))
          diagnostics_.report<DiagnosticCode::links_of_cartesian>(member->key_span, key);
      return;
    }
    if (const JsonMember* links = reader.require("links"))
      if (const auto lengths = read_pair("links", links->value, dimensions::length, diagnostics_)) {
        arm.proximal = (*lengths)[0], arm.distal = (*lengths)[1];
        for (std::size_t i = 0; i < 2; ++i)
          if (!((*lengths)[i] > 0))
            diagnostics_.report<DiagnosticCode::not_above_zero>(links->value.items[i].span, "'links'",
                                                                fmt::format("{} m", (*lengths)[i]));
      }
    const JsonMember* base = arm.kind == Kinematics::five_bar ? reader.require("base") : reader.find("base");
    if (base == nullptr) return;
    if (arm.kind != Kinematics::five_bar)
      return diagnostics_.report<DiagnosticCode::base_of_five_bar>(base->key_span, name_of(arm.kind));
    const auto width = read_single("base", base->value, dimensions::length, diagnostics_);
    if (width && *width < 0)
      diagnostics_.report<DiagnosticCode::negative_value>(base->value.span, "'base'", fmt::format("{} m", *width));
    arm.base = width.value_or(0);
  }

  void read_workspace(const ObjectReader& kinematics) {
    const JsonValue* object = kinematics.object("workspace");
    if (object == nullptr) return;
    ObjectReader reader(*object, "workspace", diagnostics_);
    reader.refuse_other_keys({"x", "y"});
    const JsonMember* const sides[] = {reader.require("x"), reader.require("y")};
    for (std::size_t i = 0; i < 2; ++i)
      if (sides[i] != nullptr)
        if (const auto side = read_span(sides[i]->key, sides[i]->value, dimensions::length, diagnostics_))
          device_.workspace[i] = axes::Interval((*side)[0], (*side)[1]), ++sides_read_;
    if (sides_read_ == 2 && !has_errors()) check_arm(object->span);
  }

  void check_arm(Span span) {
    const std::optional<axes::Singularity> found = axes::singularity(device_.arm, device_.workspace);
    if (!found) return;
    const double x = 1e3 * found->tip[0], y = 1e3 * found->tip[1];
    if (found->kind == axes::Singularity::Kind::in_line) diagnostics_.report<DiagnosticCode::arm_singular>(span, x, y);
    else diagnostics_.report<DiagnosticCode::arm_out_of_reach>(span, x, y);
    diagnostics_.note<DiagnosticCode::arm_out_of_reach_remedy>({});
  }

  void check_motion() {
    if (decl_.motion && decl_.motion->text != motion_name())
      diagnostics_.report<DiagnosticCode::motion_of_kinematics>(decl_.motion->span, excerpt(decl_.motion->text),
                                                                name_of(device_.arm.kind), motion_name());
  }

  // A joint or a brake is read as a device of one axis that has only it.
  std::optional<device_description> described(DeviceDecl decl) {
    decl.motion = Text{motion_name(), decl.opening};
    const std::optional<Device> device = build_device(decl, diagnostics_);
    return device ? std::optional(device->description) : std::nullopt;
  }

  void read_joints() {
    for (const DeviceDecl& joint : decl_.joints) {
      const std::optional<device_description> description = described(joint);
      if (!description) return;  // what is wrong with parts that both share is reported once
      device_.joints.push_back(*description);
    }
    if (sides_read_ == 2 && !has_errors()) warn_of_ranges();
  }

  // By points of the workspace, its corners among them, so that what is told of is certain.
  void warn_of_ranges() {
    constexpr int parts = 16;
    const axes::Box& box = device_.workspace;
    for (std::size_t j = 0; j < device_.joints.size(); ++j)
      for (int point = 0; point < (parts + 1) * (parts + 1); ++point) {
        const auto along = [](const axes::Interval& side, int part) {
          return side.low + (side.high - side.low) * part / parts;
        };
        const Pair<double> tip{along(box[0], point % (parts + 1)), along(box[1], point / (parts + 1))};
        if (warns_of_range(j, tip)) break;
      }
  }

  bool warns_of_range(std::size_t joint, const Pair<double>& tip) {
    const encoder_description& encoder = device_.joints[joint].encoder;
    const auto joints = axes::joints_at(device_.arm, tip);
    if (encoder.range_low == encoder.range_high || !joints) return false;
    constexpr double turn = 2 * std::numbers::pi;
    double at = (*joints)[joint];
    const double middle = 0.5 * (encoder.range_low + encoder.range_high);
    if (rotates()) at += turn * std::round((middle - at) / turn);
    const double rounding = 1e-9 * (encoder.range_high - encoder.range_low);
    if (at >= encoder.range_low - rounding && at <= encoder.range_high + rounding) return false;
    const std::string unit = port_units(motion_of(device_.arm.kind)).position;
    diagnostics_.report<DiagnosticCode::workspace_beyond_encoder>(range_span(joint), 1e3 * tip[0], 1e3 * tip[1],
                                                                  joint + 1, at, unit, encoder.range_low,
                                                                  encoder.range_high, unit);
    diagnostics_.note<DiagnosticCode::workspace_beyond_encoder_remedy>({});
    return true;
  }

  Span range_span(std::size_t joint) const {
    for (const SectionDecl& section : decl_.joints[joint].sections)
      for (const EntryDecl& entry : section.entries)
        if (section.name.text == "encoder" && entry.key.text == "range") return entry.span;
    return decl_.opening;
  }

  void read_brakes() {
    if (decl_.brakes.size() < 2 || decl_.brakes.size() > 4)
      diagnostics_.report<DiagnosticCode::brakes_count>(decl_.brakes.empty() ? decl_.opening : decl_.brakes_span,
                                                        counted(decl_.brakes.size(), "brake"));
    for (const BrakeDecl& decl : decl_.brakes) {
      const auto along = decl.along ? read_direction("along", *decl.along, diagnostics_) : std::nullopt;
      if (has_errors() && device_.joints.empty()) return;  // errors of the loop, which have been reported
      const auto description = described(decl.device);
      if (along && description) device_.brakes.push_back({*along, description->brake});
    }
    if (device_.brakes.size() == decl_.brakes.size() && device_.brakes.size() >= 2) check_directions();
  }

  void check_directions() {
    const Pair<double>& first = device_.brakes.front().along;
    const auto is_parallel = [&](const AlongBrake& brake) {
      const double cross = first[0] * brake.along[1] - first[1] * brake.along[0];
      const auto length = [](const Pair<double>& a) { return std::hypot(a[0], a[1]); };
      return std::abs(cross) <= 1e-6 * length(first) * length(brake.along);
    };
    if (!std::all_of(device_.brakes.begin(), device_.brakes.end(), is_parallel)) return;
    const Pair<double>& second = device_.brakes[1].along;
    diagnostics_.report<DiagnosticCode::brakes_parallel>(decl_.brakes_span, first[0], first[1], second[0], second[1],
                                                         -first[1], first[0]);
  }

  // One for both joints, or one for each.
  Pair<double> of_joints(const ObjectReader& reader, const char* key, const Dimension& due) {
    const JsonMember* member = reader.find(key);
    if (member == nullptr) return {0, 0};
    if (member->value.kind == JsonValue::Kind::array)
      return read_pair(key, member->value, due, diagnostics_).value_or(Pair<double>{0, 0});
    const double both = read_single(key, member->value, due, diagnostics_).value_or(0);
    return {both, both};
  }

  void refuse_negative(const ObjectReader& reader, const char* key, const Pair<double>& values) {
    for (const double value : values)
      if (value < 0)
        return diagnostics_.report<DiagnosticCode::negative_value>(reader.find(key)->value.span,
                                                                   fmt::format("'{}'", key), fmt::format("{}", value));
  }

  void read_mechanics(const JsonValue& object) {
    ObjectReader reader(object, "mechanics", diagnostics_);
    JointMechanics& mechanics = device_.mechanics;
    reader.refuse_other_keys({"inertia", "link_masses", "damping", "coulomb_friction"});
    if (const JsonMember* inertia = reader.find("inertia")) read_inertia(inertia->value);
    const JsonMember* links = reader.find("link_masses");
    if (links != nullptr && device_.arm.kind == Kinematics::cartesian && !has_errors())
      diagnostics_.report<DiagnosticCode::links_of_cartesian>(links->key_span, "link_masses");
    mechanics.link_masses = of_joints(reader, "link_masses", dimensions::mass);
    mechanics.damping = of_joints(reader, "damping", rotates() ? dimensions::rotational_damping : dimensions::damping);
    mechanics.coulomb_friction =
        of_joints(reader, "coulomb_friction", rotates() ? dimensions::torque : dimensions::force);
    refuse_negative(reader, "link_masses", mechanics.link_masses);
    refuse_negative(reader, "damping", mechanics.damping);
    refuse_negative(reader, "coulomb_friction", mechanics.coulomb_friction);
  }

  void read_inertia(const JsonValue& value) {
    const Dimension due = rotates() ? dimensions::inertia : dimensions::mass;
    if (value.kind != JsonValue::Kind::array || value.items.size() != 2)
      return diagnostics_.report<DiagnosticCode::not_a_list_of>(value.span, "inertia", "two rows",
                                                                describe(due) + " for each of 2 x 2");
    const auto first = read_pair("inertia", value.items[0], due, diagnostics_);
    const auto second = read_pair("inertia", value.items[1], due, diagnostics_);
    if (!first || !second) return;
    const auto [xx, xy] = *first;
    const auto [yx, yy] = *second;
    device_.mechanics.inertia = {xx, xy, yy};
    const bool is_positive = xx >= 0 && yy >= 0 && std::abs(xy) <= (1 + 1e-12) * std::sqrt(xx) * std::sqrt(yy);
    if (xy != yx) refuse_inertia(value, *first, *second, "the same number twice beside the diagonal");
    else if (!is_positive)
      refuse_inertia(value, *first, *second, "a matrix that gives no motion a kinetic energy below zero");
  }

  void refuse_inertia(const JsonValue& value, const Pair<double>& first, const Pair<double>& second,
                      const char* expected) {
    const std::string told = fmt::format("[[{}, {}], [{}, {}]]", first[0], first[1], second[0], second[1]);
    diagnostics_.report<DiagnosticCode::device_limit>(value.span, "mechanics.inertia", told, expected);
  }

  void read_assumed() {
    for (const Text& name : decl_.assumed) {
      device_.assumed.push_back(name.text);
      if (std::find(decl_.given.begin(), decl_.given.end(), name.text) != decl_.given.end()) continue;
      diagnostics_.report<DiagnosticCode::assumed_not_given>(name.span, excerpt(name.text));
      if (const auto nearest = nearest_name(name.text, decl_.given))
        diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
    }
  }

  bool has_errors() const { return diagnostics_.error_count() > errors_before_; }

  const AxesDeviceDecl& decl_;
  Diagnostics& diagnostics_;
  std::size_t errors_before_;
  AxesDevice device_;
  int sides_read_ = 0;
};

}  // namespace

std::string_view axes::name_of(Kinematics kind) { return arm_kinds[static_cast<std::size_t>(kind)]; }

std::optional<AxesDevice> build_axes_device(const AxesDeviceDecl& decl, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  AxesDevice device = AxesDeviceBuilder(decl, diagnostics).build();
  if (!decl.complete || diagnostics.error_count() > errors_before) return std::nullopt;
  return device;
}

AxesDevice ideal_axes_device(double sample_period) {
  AxesDevice device;
  device.name = "ideal";
  device.joints.resize(2);
  for (device_description& joint : device.joints) {
    joint.motion = motion::translation;
    joint.loop.sample_period = sample_period;
  }
  device.brakes = {{{1, 0}, {}}, {{0, 1}, {}}};
  return device;
}

}  // namespace dashpot::compiler
