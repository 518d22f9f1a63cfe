#include "network/parameter_table.hpp"

#include <algorithm>
#include <utility>

#include "network/quantity.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {

ParameterTable::ParameterTable(const std::vector<ParameterDecl>& decls, std::vector<Text> element_names,
                               Diagnostics& diagnostics)
    : element_names_(std::move(element_names)), diagnostics_(diagnostics) {
  for (const ParameterDecl& decl : decls) {
    index_of_name_.emplace(decl.name.text, names_.size());
    names_.push_back(decl.name.text);
  }
  for (const ParameterDecl& decl : decls) entries_.push_back(read_entry(decl));
}

ParameterTable::Entry ParameterTable::read_entry(const ParameterDecl& decl) {
  Entry entry;
  entry.parameter = {decl.name.text, 0, decl.tunable, 0, 0, decl.span};
  entry.decl = decl;
  const std::optional<Quantity> value = decl.value ? read_part(*decl.value, entry) : std::nullopt;
  entry.readable = value.has_value();
  if (value) {
    entry.parameter.value = value->value;
    entry.exact = value->exact;
    if (is_calculated(*decl.value)) entry.parameter.calculation = decl.value->text;
  }
  read_range(entry);
  return entry;
}

// Value, minimum and maximum share one dimension: the first one that is stated.
std::optional<Quantity> ParameterTable::read_part(const ValueDecl& decl, Entry& entry) {
  const bool is_name = index_of_name_.contains(decl.text);  // another parameter's value, as it is
  if (!is_name && !is_stated(decl, scope())) {
    report_no_quantity(decl, diagnostics_);
    return std::nullopt;
  }
  const std::optional<Quantity> quantity =
      is_name ? read_expression(decl, scope(), diagnostics_) : read_stated(decl, scope(), diagnostics_);
  if (!quantity) return std::nullopt;
  if (quantity->dimension && entry.dimension && quantity->dimension != entry.dimension) {
    diagnostics_.report<DiagnosticCode::range_of_other_unit>(decl.span, excerpt(decl.text),
                                                             describe(*quantity->dimension), entry.parameter.name,
                                                             describe(*entry.dimension));
    return std::nullopt;
  }
  if (quantity->dimension) entry.dimension = quantity->dimension;
  return quantity;
}

void ParameterTable::read_range(Entry& entry) {
  const ParameterDecl& decl = entry.decl;
  std::optional<Quantity> min, max;
  if (decl.min) min = read_part(*decl.min, entry);
  if (decl.max) max = read_part(*decl.max, entry);
  if (decl.tunable && (!decl.min || !decl.max))
    return diagnostics_.report<DiagnosticCode::tunable_without_range>(decl.name.span, entry.parameter.name);
  if (!decl.tunable && (decl.min || decl.max))
    diagnostics_.report<DiagnosticCode::range_without_tunable>((decl.min ? decl.min : decl.max)->span,
                                                               entry.parameter.name);
  if (!min || !max) return;
  entry.parameter.min = min->value;
  entry.parameter.max = max->value;
  if (min->value > max->value)
    return diagnostics_.report<DiagnosticCode::range_reversed>(decl.max->span, excerpt(decl.max->text),
                                                               excerpt(decl.min->text));
  if (!entry.readable || (min->value <= entry.parameter.value && entry.parameter.value <= max->value)) return;
  diagnostics_.report<DiagnosticCode::tunable_out_of_range>(decl.value->span, entry.parameter.name,
                                                            excerpt(decl.value->text), excerpt(decl.min->text),
                                                            excerpt(decl.max->text));
}

std::optional<ReadValue> ParameterTable::read(const ValueDecl& decl, const Expectation& expected) {
  if (is_stated(decl, scope())) {
    const std::optional<double> value = read_quantity_as(decl, expected, diagnostics_, scope());
    return value ? std::optional(ReadValue{*value, {*value, *value}, {}, {}}) : std::nullopt;
  }
  const auto index = index_of_name_.find(decl.text);
  if (index != index_of_name_.end()) return use(entries_[index->second], decl, expected);
  report_unknown(decl);
  return std::nullopt;
}

std::optional<ReadValue> ParameterTable::use(Entry& entry, const ValueDecl& decl, const Expectation& expected) {
  entry.used = true;
  if (!entry.readable) return std::nullopt;
  const auto index = static_cast<std::size_t>(&entry - entries_.data());
  if (!entry.dimension) {
    entry.dimension = expected.dimension;
    entry.first_use = decl.span;
  }
  const Parameter& parameter = entry.parameter;
  if (entry.dimension == expected.dimension)
    return parameter.tunable ? ReadValue{parameter.value, {parameter.min, parameter.max}, index, index}
                             : ReadValue{parameter.value, {parameter.value, parameter.value}, index, {}};
  diagnostics_.report<DiagnosticCode::parameter_of_wrong_unit>(decl.span, decl.text, describe(*entry.dimension),
                                                               expected.taker, describe(expected.dimension));
  if (entry.first_use) diagnostics_.note<DiagnosticCode::first_used_here>(*entry.first_use);
  else diagnostics_.note<DiagnosticCode::given_here>(entry.decl.value->span);
  return std::nullopt;
}

std::optional<double> ParameterTable::read_constant(const ValueDecl& decl, const Expectation& expected) {
  const std::optional<ReadValue> read_value = read(decl, expected);
  if (!read_value) return std::nullopt;
  if (read_value->tunable)
    diagnostics_.report<DiagnosticCode::tunable_outside_elements>(decl.span, decl.text, expected.taker);
  return read_value->value;
}

NameScope ParameterTable::scope() {
  return {[this](std::string_view name) { return index_of_name_.contains(std::string(name)); },
          [this](const Text& name) { return read_operand(name); }};
}

// A plain number counts as dimensionless: an expression does not say which unit would be due.
std::optional<ExactQuantity> ParameterTable::read_operand(const Text& name) {
  const auto index = index_of_name_.find(name.text);
  if (index == index_of_name_.end()) {
    report_unknown({ValueDecl::Form::text, name.text, name.span});
    return std::nullopt;
  }
  if (index->second >= entries_.size()) {
    named_early_.insert(name.text);
    diagnostics_.report<DiagnosticCode::parameter_not_yet_defined>(name.span, name.text);
    return std::nullopt;
  }
  Entry& entry = entries_[index->second];
  entry.used = true;
  if (entry.parameter.tunable) {
    diagnostics_.report<DiagnosticCode::tunable_in_expression>(name.span, name.text);
    diagnostics_.note<DiagnosticCode::given_here>(entry.decl.name.span);
    return std::nullopt;
  }
  if (!entry.readable) return std::nullopt;
  if (!entry.dimension) {
    entry.dimension = dimensions::number;
    entry.first_use = name.span;
  }
  return ExactQuantity{entry.exact, *entry.dimension};
}

void ParameterTable::report_unknown(const ValueDecl& decl) const {
  if (is_not_finite_word(decl.text)) return report_no_quantity(decl, diagnostics_);
  diagnostics_.report<DiagnosticCode::unknown_parameter>(decl.span, excerpt(decl.text));
  const auto is_named = [&](const Text& name) { return name.text == decl.text; };
  const auto element = std::find_if(element_names_.begin(), element_names_.end(), is_named);
  if (element != element_names_.end())
    return diagnostics_.note<DiagnosticCode::name_of_element>(element->span, element->text);
  if (const auto nearest = nearest_name(decl.text, names_))
    diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
}

void ParameterTable::report_unused() const {
  for (const Entry& entry : entries_)
    if (!entry.used && !named_early_.contains(entry.parameter.name))
      diagnostics_.report<DiagnosticCode::unused_parameter>(entry.decl.name.span, entry.parameter.name);
}

Span ParameterTable::place_of_least(std::size_t index) const {
  const ParameterDecl& decl = entries_[index].decl;
  return decl.tunable && decl.min ? decl.min->span : decl.value->span;
}

std::vector<Parameter> ParameterTable::parameters() const {
  std::vector<Parameter> parameters;
  for (const Entry& entry : entries_) {
    parameters.push_back(entry.parameter);
    if (entry.dimension && !(*entry.dimension == dimensions::number))
      parameters.back().unit = unit_of(*entry.dimension);
  }
  return parameters;
}

}  // namespace dashpot::compiler
