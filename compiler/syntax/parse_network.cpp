#include "syntax/parse_network.hpp"

#include <string>
#include <utility>

#include "source/digest.hpp"
#include "syntax/annotations.hpp"
#include "syntax/file_format.hpp"
#include "syntax/object_of.hpp"
#include "syntax/object_reader.hpp"
#include "syntax/parse_fit.hpp"
#include "syntax/parse_static.hpp"
#include "syntax/parse_structure.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const std::vector<std::string> network_keys = {"dashpot", "axes",       "name",    "title",    "source",
                                               "motion",  "parameters", "network", "elements", "static",
                                               "contact", "valid",      "ports",   "fit"};
const std::vector<std::string> keys_of_port = {"name", "network", "elements", "static", "contact"};

ParameterDecl parse_parameter(const JsonMember& member, Diagnostics& diagnostics) {
  ParameterDecl parameter{{member.key, member.key_span}, {}, false, {}, {}, member.value.span};
  if (member.value.kind != Kind::object) {
    parameter.value = read_value(member.key, member.value, diagnostics);
    return parameter;
  }
  ObjectReader reader(member.value, "a parameter", diagnostics);
  reader.refuse_other_keys({"value", "tunable", "min", "max"});
  reader.require("value");
  parameter.value = reader.value("value");
  parameter.tunable = reader.flag("tunable");
  parameter.min = reader.value("min");
  parameter.max = reader.value("max");
  return parameter;
}

std::vector<ParameterDecl> parse_parameters(const ObjectReader& network, Diagnostics& diagnostics) {
  std::vector<ParameterDecl> parameters;
  if (const JsonValue* object = network.object("parameters"))
    for (const JsonMember& member : object->members) parameters.push_back(parse_parameter(member, diagnostics));
  return parameters;
}

std::optional<ContactDecl> parse_contact(const ObjectReader& network, Diagnostics& diagnostics) {
  const JsonValue* object = network.object("contact");
  if (object == nullptr) return std::nullopt;
  ObjectReader reader(*object, "contact", diagnostics);
  reader.refuse_other_keys({"at"});
  reader.require("at");
  const std::optional<ValueDecl> at = reader.value("at");
  return at ? std::optional(ContactDecl{*at, object->span}) : std::nullopt;
}

std::optional<ValidDecl> parse_valid(const ObjectReader& network, Diagnostics& diagnostics) {
  const JsonValue* object = network.object("valid");
  if (object == nullptr) return std::nullopt;
  ObjectReader reader(*object, "valid", diagnostics);
  reader.refuse_other_keys({"rate", "displacement", "frequency"});
  return ValidDecl{reader.range("rate"), reader.range("displacement"), reader.range("frequency"), object->span};
}

void parse_structure(const ObjectReader& reader, NetworkDecl& decl, Diagnostics& diagnostics) {
  const JsonMember* tree = reader.find("network");
  const JsonMember* netlist = reader.find("elements");
  if (tree != nullptr && netlist != nullptr) {
    const bool tree_first = tree->key_span.begin < netlist->key_span.begin;
    diagnostics.report<DiagnosticCode::tree_and_netlist>(tree_first ? netlist->key_span : tree->key_span);
    diagnostics.note<DiagnosticCode::first_given_here>(tree_first ? tree->key_span : netlist->key_span);
  }
  const bool misspelt = reader.is_misspelt("network") || reader.is_misspelt("elements");
  if (tree == nullptr && netlist == nullptr && !misspelt)
    diagnostics.report<DiagnosticCode::no_structure>(reader.opening());
  if (tree != nullptr) {
    decl.structure_span = tree->key_span;
    if (auto root = parse_tree(tree->value, diagnostics)) decl.structure = std::move(*root);
  } else if (const JsonValue* list = reader.list("elements")) {
    decl.structure_span = netlist->key_span;
    decl.structure = parse_netlist(*list, diagnostics);
  }
}

// Refuses keys that are none of these, and `of_axes`, which only a network of two axes has.
void refuse_other_keys(ObjectReader& reader, std::vector<std::string> keys, const char* of_axes,
                       Diagnostics& diagnostics) {
  if (const JsonMember* member = reader.find(of_axes)) {
    diagnostics.report<DiagnosticCode::ports_without_axes>(member->key_span, of_axes);
    keys.push_back(of_axes);
  }
  reader.refuse_other_keys(keys);
}

// With the parameters, the motion and the ranges of the whole file.
std::optional<NetworkDecl> parse_port(const JsonValue& value, const NetworkDecl& file, Diagnostics& diagnostics) {
  if (value.kind != Kind::object) {
    report_wrong_type("ports", value, "a list of objects", diagnostics);
    return std::nullopt;
  }
  ObjectReader reader(value, "a port", diagnostics);
  refuse_other_keys(reader, keys_of_port, "map", diagnostics);
  if (reader.require("name") == nullptr) {
    diagnostics.note<DiagnosticCode::port_needs_a_name>({});
    return std::nullopt;
  }
  ObjectOf network(value.span);
  for (const std::string& key : keys_of_port) network.take(reader.find(key));
  NetworkDecl port = parse_network_object(network.value(), diagnostics);
  port.motion = file.motion;
  port.parameters = file.parameters;
  port.valid = file.valid;
  port.shares_parameters = true;
  return port;
}

void parse_ports(const ObjectReader& reader, NetworkDecl& decl, Diagnostics& diagnostics) {
  for (const char* key : {"network", "elements", "static", "contact"})
    if (const JsonMember* member = reader.find(key))
      diagnostics.report<DiagnosticCode::beside_ports>(member->key_span, key);
  const JsonValue* list = reader.list("ports");
  if (list == nullptr) return;
  decl.structure_span = list->span;
  if (list->items.empty()) diagnostics.report<DiagnosticCode::no_ports>(list->span);
  for (const JsonValue& item : list->items)
    if (std::optional<NetworkDecl> port = parse_port(item, decl, diagnostics)) decl.ports.push_back(std::move(*port));
}

NetworkDecl parse_network_keys(ObjectReader reader, Diagnostics& diagnostics) {
  NetworkDecl decl;
  refuse_other_keys(reader, network_keys, "field", diagnostics);
  reader.require("name");
  decl.name = reader.text("name");
  decl.title = reader.text("title");
  decl.source = reader.text("source");
  decl.motion = reader.text("motion");
  decl.parameters = parse_parameters(reader, diagnostics);
  decl.valid = parse_valid(reader, diagnostics);
  check_fit_record(reader, diagnostics);
  if (reader.find("ports") != nullptr) {
    parse_ports(reader, decl, diagnostics);
    return decl;
  }
  parse_structure(reader, decl, diagnostics);
  if (const JsonValue* object = reader.object("static")) decl.static_curve = parse_static(*object, diagnostics);
  decl.contact = parse_contact(reader, diagnostics);
  return decl;
}

}  // namespace

std::optional<NetworkDecl> parse_network(const SourceFile& file, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::optional<JsonValue> root = parse_json(file, diagnostics);
  if (!root || !is_format_1(FileKind::network, *root, diagnostics)) return std::nullopt;
  if (!is_of_one_axis(FileKind::network, *root, diagnostics)) return std::nullopt;
  std::vector<CommentDecl> comments = take_annotations(*root, diagnostics);
  NetworkDecl decl = parse_network_keys(ObjectReader(*root, "the network file", diagnostics), diagnostics);
  decl.comments = std::move(comments);
  decl.digest = digest_of(file.text());
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

NetworkDecl parse_network_object(const JsonValue& object, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  NetworkDecl decl = parse_network_keys(ObjectReader(object, "the port", diagnostics), diagnostics);
  decl.complete = diagnostics.error_count() == errors_before;
  return decl;
}

}  // namespace dashpot::compiler
