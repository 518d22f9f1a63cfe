// A network file as its author wrote it: shape checked, values not yet read.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

struct Text {
  std::string text;
  Span span;  // with the quotes
};

// A number in SI, a quantity with its unit, or the name of a parameter.
struct ValueDecl {
  enum class Form { number, text };

  Form form = Form::number;
  std::string text;  // the literal as written, or the contents of the string
  Span span;
};

struct ParameterDecl {
  Text name;
  std::optional<ValueDecl> value;  // nothing where a reported problem left none
  bool tunable = false;
  std::optional<ValueDecl> min;
  std::optional<ValueDecl> max;
  Span span;  // of the whole value
};

enum class ElementKind { spring, damper, slip };

// `[low, high]`, or a single upper bound, which stands for 0 … high.
struct RangeDecl {
  std::optional<ValueDecl> low;
  ValueDecl high;
  Span span;
};

struct SpringpotDecl {
  std::optional<ValueDecl> exponent;  // nothing where a reported problem left none
  std::optional<ValueDecl> time;
  std::optional<RangeDecl> band;
  std::optional<ValueDecl> error;
};

struct PronyTermDecl {
  std::optional<ValueDecl> weight;
  std::optional<ValueDecl> time;
  Span span;
};

struct PronyDecl {
  std::optional<Text> of;
  std::vector<PronyTermDecl> terms;
  Span terms_span;
};

// One element, or what becomes several: a springpot and a Prony series are ladders of Maxwell elements.
struct LeafDecl {
  ElementKind kind = ElementKind::spring;  // what `value` is: of ladders a stiffness
  Span kind_span;
  std::optional<ValueDecl> value;
  std::optional<Text> name;
  Span span;
  std::optional<SpringpotDecl> springpot = {};
  std::optional<PronyDecl> prony = {};
};

struct TreeDecl {
  enum class Kind { leaf, series, parallel };

  Kind kind = Kind::leaf;
  std::optional<LeafDecl> leaf;  // of a leaf
  std::vector<TreeDecl> children;
  Span span;
};

struct EdgeDecl {
  LeafDecl leaf;
  Text from;
  Text to;
};

struct ContactDecl {
  ValueDecl at;
  Span span;
};

// The wanted force over displacement at rest or at once: one of the three kinds.
struct StaticDecl {
  std::string kind;                // "power", "exponential" or "table"
  std::optional<ValueDecl> shape;  // the exponent, or the rate of the exponential; of a table nothing
  std::optional<ValueDecl> force;  // at `at`
  std::optional<ValueDecl> at;
  std::vector<std::pair<ValueDecl, ValueDecl>> table;  // displacement and force
  std::optional<Text> is;
  Span span;
  Span kind_span;
};

struct ValidDecl {
  std::optional<RangeDecl> rate;
  std::optional<RangeDecl> displacement;
  std::optional<RangeDecl> frequency;
  Span span;
};

// A remark of the author's that changes nothing.
struct CommentDecl {
  std::string about;  // the name of what it stands in, or its place: "network.parallel[2]"
  std::string text;
};

struct NetworkDecl {
  std::optional<Text> name;
  std::optional<Text> title;
  std::optional<Text> source;
  std::optional<Text> motion;
  std::vector<ParameterDecl> parameters;
  std::variant<TreeDecl, std::vector<EdgeDecl>> structure;  // `network` or `elements`
  Span structure_span;
  std::optional<ContactDecl> contact;
  std::optional<StaticDecl> static_curve;
  std::optional<ValidDecl> valid;
  std::vector<NetworkDecl> ports;  // that act side by side, in the place of a structure; each called as its port is
  std::vector<CommentDecl> comments;
  std::string digest;              // of the file's bytes
  bool complete = true;            // false: problems were reported, so only what is here can be checked further
  bool shares_parameters = false;  // with other ports of its file, which may use what is not used here
};

}  // namespace dashpot::compiler
