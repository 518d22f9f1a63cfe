#include "syntax/parse_structure.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const std::vector<std::string> leaf_kinds = {"spring", "damper", "slip", "springpot", "prony"};
const std::vector<std::string> branch_kinds = {"spring", "damper", "slip", "springpot", "prony", "series", "parallel"};

bool is_leaf_kind(std::string_view key) {
  return std::find(leaf_kinds.begin(), leaf_kinds.end(), key) != leaf_kinds.end();
}
bool is_group_kind(std::string_view key) { return key == "series" || key == "parallel"; }

ElementKind element_kind(std::string_view key) {
  return key == "damper" ? ElementKind::damper : key == "slip" ? ElementKind::slip : ElementKind::spring;
}

// What may stand beside the key `kind`.
std::vector<std::string> keys_beside(std::string_view kind, std::vector<std::string> keys) {
  keys.insert(keys.end(), {"name", "nodes"});
  if (kind == "springpot") keys.insert(keys.end(), {"exponent", "time", "band", "error"});
  if (kind == "prony") keys.insert(keys.end(), {"of", "terms"});
  return keys;
}

void report_unknown_kind(const JsonValue& value, Diagnostics& diagnostics) {
  const JsonMember* named = nullptr;  // the key that was probably meant to be the kind
  for (const JsonMember& member : value.members)
    if (named == nullptr && member.key != "name" && member.key != "nodes") named = &member;
  if (named == nullptr)
    return diagnostics.report<DiagnosticCode::element_without_kind>(
        Span{value.span.file, value.span.begin, value.span.begin + 1});
  if (named->key == "contact") {
    diagnostics.report<DiagnosticCode::contact_among_elements>(named->key_span);
    return diagnostics.note<DiagnosticCode::contact_goes_to_top>({});
  }
  diagnostics.report<DiagnosticCode::unknown_kind>(named->key_span, excerpt(named->key));
  if (named->key == "mass" || named->key == "inertia" || named->key == "inerter")
    diagnostics.note<DiagnosticCode::networks_have_no_mass>({});
  else if (const auto nearest = nearest_name(named->key, branch_kinds))
    diagnostics.note<DiagnosticCode::nearest_name>({}, *nearest);
}

// The one member that says what the branch is; null, reported, where there is none or more than one.
const JsonMember* kind_of(const JsonValue& value, Diagnostics& diagnostics) {
  const JsonMember* kind = nullptr;
  for (const JsonMember& member : value.members) {
    if (!is_leaf_kind(member.key) && !is_group_kind(member.key)) continue;
    if (kind != nullptr && kind->key != member.key) {
      diagnostics.report<DiagnosticCode::two_kinds>(member.key_span, member.key, kind->key);
      diagnostics.note<DiagnosticCode::first_given_here>(kind->key_span);
      return nullptr;
    }
    if (kind == nullptr) kind = &member;
  }
  if (kind == nullptr) report_unknown_kind(value, diagnostics);
  return kind;
}

SpringpotDecl parse_springpot(const ObjectReader& reader) {
  reader.require("exponent");
  return {reader.value("exponent"), reader.value("time"), reader.range("band"), reader.value("error")};
}

PronyTermDecl parse_prony_term(const JsonValue& value, Diagnostics& diagnostics) {
  if (value.kind != Kind::object) {
    report_wrong_type("terms", value, "an object such as { \"weight\": 0.4, \"time\": \"0.1 s\" }", diagnostics);
    return {{}, {}, value.span};
  }
  ObjectReader reader(value, "a Prony term", diagnostics);
  reader.refuse_other_keys({"weight", "time"});
  reader.require("weight");
  reader.require("time");
  return {reader.value("weight"), reader.value("time"), value.span};
}

PronyDecl parse_prony(const ObjectReader& reader, Diagnostics& diagnostics) {
  reader.require("of");
  PronyDecl prony{reader.text("of"), {}, reader.opening()};
  const JsonMember* terms = reader.require("terms");
  const JsonValue* list = terms == nullptr ? nullptr : reader.list("terms");
  if (list == nullptr) return prony;
  prony.terms_span = list->span;
  if (list->items.empty()) diagnostics.report<DiagnosticCode::empty_group>(list->span, "terms");
  for (const JsonValue& item : list->items) prony.terms.push_back(parse_prony_term(item, diagnostics));
  return prony;
}

LeafDecl parse_leaf(const JsonValue& value, const JsonMember& kind, Diagnostics& diagnostics) {
  const ObjectReader reader(value, "an element", diagnostics);
  LeafDecl leaf{element_kind(kind.key), kind.key_span, reader.value(kind.key), reader.text("name"), value.span};
  if (kind.key == "springpot") leaf.springpot = parse_springpot(reader);
  if (kind.key == "prony") leaf.prony = parse_prony(reader, diagnostics);
  return leaf;
}

bool is_object(const JsonValue& value, Diagnostics& diagnostics) {
  if (value.kind == Kind::object) return true;
  report_wrong_type("element", value, "an object such as { \"spring\": \"5 N/m\" }", diagnostics);
  if (value.kind == Kind::array) diagnostics.note<DiagnosticCode::join_the_elements>({});
  return false;
}

std::optional<TreeDecl> parse_group(const JsonValue& value, const JsonMember& kind, Diagnostics& diagnostics) {
  const ObjectReader reader(value, "an element", diagnostics);
  if (const JsonMember* name = reader.find("name"))
    diagnostics.report<DiagnosticCode::named_group>(name->key_span, kind.key);
  const JsonValue* list = reader.list(kind.key);
  if (list == nullptr) return std::nullopt;
  if (list->items.empty()) diagnostics.report<DiagnosticCode::empty_group>(list->span, kind.key);
  TreeDecl group{kind.key == "series" ? TreeDecl::Kind::series : TreeDecl::Kind::parallel, {}, {}, value.span};
  for (const JsonValue& item : list->items)
    if (std::optional<TreeDecl> child = parse_tree(item, diagnostics)) group.children.push_back(std::move(*child));
  return group;
}

std::optional<std::array<Text, 2>> parse_nodes(const JsonValue& value, std::string_view kind,
                                               Diagnostics& diagnostics) {
  ObjectReader reader(value, "an element of a netlist", diagnostics);
  reader.refuse_other_keys(keys_beside(kind, leaf_kinds));
  const JsonMember* nodes = reader.require("nodes");
  if (nodes == nullptr) return std::nullopt;
  if (nodes->value.kind != Kind::array || nodes->value.items.size() != 2) {
    diagnostics.report<DiagnosticCode::not_two_nodes>(nodes->value.span);
    return std::nullopt;
  }
  const std::optional<Text> from = read_text("nodes", nodes->value.items[0], diagnostics);
  const std::optional<Text> to = read_text("nodes", nodes->value.items[1], diagnostics);
  if (!from || !to) return std::nullopt;
  return std::array{*from, *to};
}

std::optional<EdgeDecl> parse_edge(const JsonValue& value, Diagnostics& diagnostics) {
  if (!is_object(value, diagnostics)) return std::nullopt;
  const JsonMember* kind = kind_of(value, diagnostics);
  if (kind == nullptr) return std::nullopt;
  if (is_group_kind(kind->key)) {
    diagnostics.report<DiagnosticCode::group_in_netlist>(kind->key_span, kind->key);
    return std::nullopt;
  }
  const std::optional<std::array<Text, 2>> nodes = parse_nodes(value, kind->key, diagnostics);
  LeafDecl leaf = parse_leaf(value, *kind, diagnostics);
  if (!nodes) return std::nullopt;
  return EdgeDecl{std::move(leaf), (*nodes)[0], (*nodes)[1]};
}

}  // namespace

std::optional<TreeDecl> parse_tree(const JsonValue& value, Diagnostics& diagnostics) {
  if (!is_object(value, diagnostics)) return std::nullopt;
  const JsonMember* kind = kind_of(value, diagnostics);
  if (kind == nullptr) return std::nullopt;
  ObjectReader reader(value, "an element of a tree", diagnostics);
  reader.refuse_other_keys(keys_beside(kind->key, branch_kinds));
  if (const JsonMember* nodes = reader.find("nodes")) {
    diagnostics.report<DiagnosticCode::nodes_in_tree>(nodes->key_span);
    diagnostics.note<DiagnosticCode::nodes_need_netlist>({});
  }
  if (is_group_kind(kind->key)) return parse_group(value, *kind, diagnostics);
  return TreeDecl{TreeDecl::Kind::leaf, parse_leaf(value, *kind, diagnostics), {}, value.span};
}

std::vector<EdgeDecl> parse_netlist(const JsonValue& list, Diagnostics& diagnostics) {
  std::vector<EdgeDecl> edges;
  if (list.items.empty()) diagnostics.report<DiagnosticCode::empty_group>(list.span, "elements");
  for (const JsonValue& item : list.items)
    if (std::optional<EdgeDecl> edge = parse_edge(item, diagnostics)) edges.push_back(std::move(*edge));
  return edges;
}

}  // namespace dashpot::compiler
