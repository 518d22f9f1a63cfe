#include "syntax/parse_device.hpp"

#include <utility>

#include "source/digest.hpp"
#include "syntax/annotations.hpp"
#include "syntax/file_format.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const std::vector<std::string> section_names = {"loop", "encoder", "velocity", "motor", "brake", "mechanics"};

const std::vector<std::string> device_keys = {"dashpot_device", "axes",      "name",    "source",   "motion",
                                              "arm_radius",     "loop",      "encoder", "velocity", "motor",
                                              "brake",          "mechanics", "assumed"};

std::optional<EntryDecl> parse_entry(const JsonMember& member, Diagnostics& diagnostics) {
  EntryDecl entry{{member.key, member.key_span}, {}, member.value.kind == Kind::array, member.value.span};
  if (!entry.is_list) {
    const std::optional<ValueDecl> value = read_value(member.key, member.value, diagnostics);
    if (!value) return std::nullopt;
    entry.values.push_back(*value);
  }
  for (const JsonValue& item : member.value.items)
    if (const std::optional<ValueDecl> value = read_value(member.key, item, diagnostics))
      entry.values.push_back(*value);
  return entry;
}

// An object within a section is a section of its own, "mechanics.mode".
bool is_subsection(const std::string& section, const JsonMember& member) {
  return section == "mechanics" && member.key == "mode" && member.value.kind == Kind::object;
}

SectionDecl parse_section(const std::string& name, const Span& name_span, const JsonValue& object,
                          Diagnostics& diagnostics) {
  const ObjectReader reader(object, name, diagnostics);
  SectionDecl section{{name, name_span}, {}, reader.opening()};
  for (const JsonMember& member : object.members) {
    if (is_subsection(name, member)) continue;
    if (std::optional<EntryDecl> entry = parse_entry(member, diagnostics)) section.entries.push_back(std::move(*entry));
  }
  return section;
}

std::vector<SectionDecl> parse_sections(const ObjectReader& device, Diagnostics& diagnostics) {
  std::vector<SectionDecl> sections;
  for (const std::string& name : section_names)
    if (const JsonValue* object = device.object(name)) {
      sections.push_back(parse_section(name, device.find(name)->key_span, *object, diagnostics));
      for (const JsonMember& member : object->members)
        if (is_subsection(name, member))
          sections.push_back(parse_section(name + "." + member.key, member.key_span, member.value, diagnostics));
    }
  return sections;
}

std::vector<Text> parse_assumed(const ObjectReader& device, Diagnostics& diagnostics) {
  std::vector<Text> assumed;
  if (const JsonValue* list = device.list("assumed"))
    for (const JsonValue& item : list->items)
      if (std::optional<Text> name = read_text("assumed", item, diagnostics)) assumed.push_back(std::move(*name));
  return assumed;
}

DeviceDecl parse_device_keys(ObjectReader reader, Diagnostics& diagnostics) {
  DeviceDecl decl;
  reader.refuse_other_keys(device_keys);
  reader.require("name");
  decl.name = reader.text("name");
  decl.source = reader.text("source");
  decl.motion = reader.text("motion");
  decl.arm_radius = reader.value("arm_radius");
  decl.sections = parse_sections(reader, diagnostics);
  decl.assumed = parse_assumed(reader, diagnostics);
  decl.opening = reader.opening();
  return decl;
}

}  // namespace

std::optional<DeviceDecl> parse_device(const SourceFile& file, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::optional<JsonValue> root = parse_json(file, diagnostics);
  if (!root || !is_format_1(FileKind::device, *root, diagnostics)) return std::nullopt;
  if (!is_of_one_axis(FileKind::device, *root, diagnostics)) return std::nullopt;
  take_annotations(*root, diagnostics);
  DeviceDecl decl = parse_device_keys(ObjectReader(*root, "the device file", diagnostics), diagnostics);
  decl.digest = digest_of(file.text());
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

DeviceDecl parse_device_object(const JsonValue& object, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  DeviceDecl decl = parse_device_keys(ObjectReader(object, "the device file", diagnostics), diagnostics);
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

}  // namespace dashpot::compiler
