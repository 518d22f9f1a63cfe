#include "syntax/parse_axes.hpp"

#include <algorithm>
#include <utility>

#include "source/digest.hpp"
#include "syntax/annotations.hpp"
#include "syntax/file_format.hpp"
#include "syntax/object_of.hpp"
#include "syntax/object_reader.hpp"
#include "syntax/parse_device.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const std::vector<std::string> keys_of_network_of_axes = {"dashpot", "axes",       "name",  "title",
                                                          "source",  "parameters", "ports", "field"};
const std::vector<std::string> keys_of_axes_port = {"name", "map", "network", "elements", "contact", "static"};
const std::vector<std::string> keys_of_device_of_axes = {
    "dashpot_device", "axes",     "name",   "source", "motion",    "kinematics", "loop",
    "encoders",       "velocity", "motors", "brakes", "mechanics", "assumed"};

std::optional<PortDecl> parse_port(const JsonValue& value, const ObjectReader& file, Diagnostics& diagnostics) {
  if (value.kind != Kind::object) {
    report_wrong_type("ports", value, "a list of objects", diagnostics);
    return std::nullopt;
  }
  ObjectReader reader(value, "a port", diagnostics);
  reader.refuse_other_keys(keys_of_axes_port);
  const JsonMember* name = reader.require("name");
  const JsonMember* map = reader.require("map");
  if (name == nullptr || map == nullptr) return std::nullopt;
  const std::optional<Text> text = read_text("name", name->value, diagnostics);
  if (map->value.kind != Kind::object) report_wrong_type("map", map->value, "an object", diagnostics);
  if (!text || map->value.kind != Kind::object) return std::nullopt;
  if (const JsonMember* curve = reader.find("static"))
    diagnostics.report<DiagnosticCode::static_on_two_axes>(curve->key_span, text->text);
  ObjectOf network(value.span);
  network.take(name);
  network.take(file.find("parameters"));
  for (const char* key : {"network", "elements", "contact"}) network.take(reader.find(key));
  PortDecl port{*text, map->value, parse_network_object(network.value(), diagnostics)};
  port.network.shares_parameters = true;
  return port;
}

std::vector<PortDecl> parse_ports(const ObjectReader& reader, Diagnostics& diagnostics) {
  std::vector<PortDecl> ports;
  if (reader.require("ports") == nullptr) return ports;
  const JsonValue* list = reader.list("ports");
  if (list == nullptr) return ports;
  if (list->items.empty()) diagnostics.report<DiagnosticCode::no_ports>(list->span);
  for (const JsonValue& item : list->items)
    if (std::optional<PortDecl> port = parse_port(item, reader, diagnostics)) ports.push_back(std::move(*port));
  return ports;
}

// Takes a field's 'viscous' or its 'grid', and 'stiffness', which is refused later with the reason.
void parse_field(const ObjectReader& file, AxesNetworkDecl& decl, Diagnostics& diagnostics) {
  const JsonValue* object = file.object("field");
  if (object == nullptr) return;
  ObjectReader reader(*object, "'field'", diagnostics);
  reader.refuse_other_keys({"viscous", "grid", "stiffness"});
  const JsonMember *viscous = reader.find("viscous"), *grid = reader.find("grid"),
                   *stiffness = reader.find("stiffness");
  if (viscous != nullptr && grid != nullptr)
    diagnostics.report<DiagnosticCode::two_kinds_at_once>(grid->key_span, "field", viscous->key, grid->key);
  if (viscous == nullptr && grid == nullptr && stiffness == nullptr && object->members.empty())
    diagnostics.report<DiagnosticCode::field_without_kind>(reader.opening());
  if (grid != nullptr)
    if (const JsonValue* knots = reader.object("grid")) decl.field_grid = *knots;
  if (stiffness != nullptr) decl.stiffness = stiffness->value;
  if (viscous != nullptr) decl.viscous = viscous->value;
}

// The values under `key` for both joints: a list of two objects, or one object for both. Empty if there is nothing, or
// something else, which is reported.
std::vector<const JsonValue*> of_each_joint(const ObjectReader& reader, const char* key, Diagnostics& diagnostics) {
  const JsonMember* member = reader.find(key);
  if (member == nullptr) return {};
  const JsonValue& value = member->value;
  if (value.kind == Kind::object) return {&value, &value};
  const bool is_list_of_objects = std::all_of(value.items.begin(), value.items.end(),
                                              [](const JsonValue& item) { return item.kind == Kind::object; });
  if (value.kind == Kind::array && value.items.size() == most_axes && is_list_of_objects)
    return {&value.items[0], &value.items[1]};
  diagnostics.report<DiagnosticCode::not_a_list_of>(value.span, key, "two objects",
                                                    "one for each joint, or one object");
  return {};
}

std::vector<DeviceDecl> parse_joints(const ObjectReader& reader, Span span, Diagnostics& diagnostics) {
  const std::pair<const char*, const char*> sections[] = {
      {"encoders", "encoder"}, {"velocity", "velocity"}, {"motors", "motor"}};
  const std::size_t errors_before = diagnostics.error_count();
  std::vector<ObjectOf> joints(most_axes, ObjectOf(span));
  for (ObjectOf& joint : joints)
    for (const char* key : {"name", "loop"}) joint.take(reader.find(key));
  for (const auto& [key, section] : sections) {
    const std::vector<const JsonValue*> values = of_each_joint(reader, key, diagnostics);
    for (std::size_t i = 0; i < values.size(); ++i) joints[i].take(section, reader.find(key)->key_span, *values[i]);
  }
  std::vector<DeviceDecl> decls;
  const auto at_once = [&](const ObjectOf& joint) { decls.push_back(parse_device_object(joint.value(), diagnostics)); };
  at_once(joints[0]);
  // What is wrong with parts that both share is reported once.
  if (diagnostics.error_count() == errors_before) at_once(joints[1]);
  return decls;
}

std::optional<BrakeDecl> parse_brake(const JsonValue& value, const ObjectReader& file, Diagnostics& diagnostics) {
  if (value.kind != Kind::object) {
    report_wrong_type("brakes", value, "a list of objects", diagnostics);
    return std::nullopt;
  }
  const ObjectReader reader(value, "a brake", diagnostics);
  BrakeDecl brake;
  brake.span = value.span;
  if (const JsonMember* along = reader.require("along")) brake.along = along->value;
  ObjectOf keys(value.span), device(value.span);
  for (const JsonMember& member : value.members)
    if (member.key != "along") keys.take(&member);
  for (const char* key : {"name", "loop"}) device.take(file.find(key));
  device.take("brake", {value.span.file, value.span.begin, value.span.begin + 1}, keys.value());
  brake.device = parse_device_object(device.value(), diagnostics);
  return brake;
}

std::vector<BrakeDecl> parse_brakes(const ObjectReader& reader, Diagnostics& diagnostics) {
  std::vector<BrakeDecl> brakes;
  if (const JsonValue* list = reader.list("brakes"))
    for (const JsonValue& item : list->items)
      if (std::optional<BrakeDecl> brake = parse_brake(item, reader, diagnostics)) brakes.push_back(std::move(*brake));
  return brakes;
}

void add_dotted_keys(const std::string& before, const JsonValue& value, std::vector<std::string>& keys) {
  for (const JsonValue& item : value.items)
    if (item.kind == Kind::object) add_dotted_keys(before, item, keys);
  for (const JsonMember& member : value.members) {
    keys.push_back(before + member.key);
    if (member.value.kind == Kind::object) add_dotted_keys(before + member.key + ".", member.value, keys);
    if (before.empty() && member.value.kind == Kind::array) add_dotted_keys(member.key + ".", member.value, keys);
  }
}

AxesNetworkDecl parse_keys(ObjectReader reader, Diagnostics& diagnostics) {
  AxesNetworkDecl decl;
  reader.refuse_other_keys(keys_of_network_of_axes);
  reader.require("name");
  decl.name = reader.text("name");
  decl.title = reader.text("title");
  decl.source = reader.text("source");
  decl.ports = parse_ports(reader, diagnostics);
  parse_field(reader, decl, diagnostics);
  return decl;
}

AxesDeviceDecl parse_device_keys(ObjectReader reader, const JsonValue& root, Diagnostics& diagnostics) {
  AxesDeviceDecl decl;
  reader.refuse_other_keys(keys_of_device_of_axes);
  for (const char* key : {"name", "kinematics", "loop"}) reader.require(key);
  decl.name = reader.text("name");
  decl.source = reader.text("source");
  decl.motion = reader.text("motion");
  decl.opening = reader.opening();
  if (const JsonValue* kinematics = reader.object("kinematics")) decl.kinematics = *kinematics;
  if (const JsonValue* mechanics = reader.object("mechanics")) decl.mechanics = *mechanics;
  if (const JsonValue* list = reader.list("assumed"))
    for (const JsonValue& item : list->items)
      if (std::optional<Text> name = read_text("assumed", item, diagnostics)) decl.assumed.push_back(std::move(*name));
  add_dotted_keys("", root, decl.given);
  if (const JsonMember* brakes = reader.find("brakes")) decl.brakes_span = brakes->value.span;
  decl.joints = parse_joints(reader, root.span, diagnostics);
  decl.brakes = parse_brakes(reader, diagnostics);
  return decl;
}

}  // namespace

std::size_t axes_of(const SourceFile& file) {
  const std::optional<JsonValue> root = json_in(file);
  const JsonMember* axes = root && root->kind == Kind::object ? find_member(*root, "axes") : nullptr;
  const bool is_several = axes != nullptr && axes->value.kind == Kind::number && number_in(axes->value) == most_axes;
  return is_several ? most_axes : 1;
}

std::optional<AxesNetworkDecl> parse_axes_network(const SourceFile& file, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::optional<JsonValue> root = parse_json(file, diagnostics);
  if (!root || !is_format_1(FileKind::network, *root, diagnostics)) return std::nullopt;
  std::vector<CommentDecl> comments = take_annotations(*root, diagnostics);
  AxesNetworkDecl decl = parse_keys(ObjectReader(*root, "the network file", diagnostics), diagnostics);
  decl.comments = std::move(comments);
  decl.digest = digest_of(file.text());
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

std::optional<AxesDeviceDecl> parse_axes_device(const SourceFile& file, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::optional<JsonValue> root = parse_json(file, diagnostics);
  if (!root || !is_format_1(FileKind::device, *root, diagnostics)) return std::nullopt;
  take_annotations(*root, diagnostics);
  AxesDeviceDecl decl = parse_device_keys(ObjectReader(*root, "the device file", diagnostics), *root, diagnostics);
  decl.digest = digest_of(file.text());
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

}  // namespace dashpot::compiler
