#include "network/parameter_table.hpp"

#include "network/quantity.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {
ParameterTable::ParameterTable(const std::vector<ParameterDecl>& decls, Diagnostics& diagnostics)
    : diagnostics_(diagnostics) {
  for (const ParameterDecl& decl : decls) {
    index_of_name_.emplace(decl.name.text, entries_.size());
    names_.push_back(decl.name.text);
    entries_.push_back(read_entry(decl));
  }
}

ParameterTable::Entry ParameterTable::read_entry(const ParameterDecl& decl) {
  Entry entry{{decl.name.text, 0, decl.tunable, 0, 0, decl.span}, decl, {}, {}, true, false};
  const std::optional<double> value = decl.value ? read_part(*decl.value, entry) : std::nullopt;
  entry.readable = value.has_value();
  entry.parameter.value = value.value_or(0);
  read_range(entry);
  return entry;
}

// Value, minimum and maximum share one dimension: the first one that is stated.
std::optional<double> ParameterTable::read_part(const ValueDecl& decl, Entry& entry) {
  if (!is_quantity(decl)) {
    report_no_quantity(decl, diagnostics_);
    return std::nullopt;
  }
  const std::optional<Quantity> quantity = read_quantity(decl, diagnostics_);
  if (!quantity) return std::nullopt;
  if (quantity->dimension && entry.dimension && quantity->dimension != entry.dimension) {
    diagnostics_.report<DiagnosticCode::range_of_other_unit>(decl.span, excerpt(decl.text),
                                                             describe(*quantity->dimension), entry.parameter.name,
                                                             describe(*entry.dimension));
    return std::nullopt;
  }
  if (quantity->dimension) entry.dimension = quantity->dimension;
  return quantity->value;
}

void ParameterTable::read_range(Entry& entry) {
  const ParameterDecl& decl = entry.decl;
  std::optional<double> min, max;
  if (decl.min) min = read_part(*decl.min, entry);
  if (decl.max) max = read_part(*decl.max, entry);
  if (decl.tunable && (!decl.min || !decl.max))
    return diagnostics_.report<DiagnosticCode::tunable_without_range>(decl.name.span, entry.parameter.name);
  if (!decl.tunable && (decl.min || decl.max))
    diagnostics_.report<DiagnosticCode::range_without_tunable>((decl.min ? decl.min : decl.max)->span,
                                                               entry.parameter.name);
  if (!min || !max) return;
  entry.parameter.min = *min;
  entry.parameter.max = *max;
  if (*min > *max)
    return diagnostics_.report<DiagnosticCode::range_reversed>(decl.max->span, excerpt(decl.max->text),
                                                               excerpt(decl.min->text));
  if (!entry.readable || (*min <= entry.parameter.value && entry.parameter.value <= *max)) return;
  diagnostics_.report<DiagnosticCode::tunable_out_of_range>(decl.value->span, entry.parameter.name,
                                                            excerpt(decl.value->text), excerpt(decl.min->text),
                                                            excerpt(decl.max->text));
}

std::optional<ReadValue> ParameterTable::read(const ValueDecl& decl, const Expectation& expected) {
  if (is_quantity(decl)) {
    const std::optional<double> value = read_quantity_as(decl, expected, diagnostics_);
    return value ? std::optional(ReadValue{*value, std::nullopt}) : std::nullopt;
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
  if (entry.dimension == expected.dimension) return ReadValue{entry.parameter.value, index};
  diagnostics_.report<DiagnosticCode::parameter_of_wrong_unit>(decl.span, decl.text, describe(*entry.dimension),
                                                               expected.taker, describe(expected.dimension));
  if (entry.first_use) diagnostics_.note<DiagnosticCode::first_used_here>(*entry.first_use);
  else diagnostics_.note<DiagnosticCode::given_here>(entry.decl.value->span);
  return std::nullopt;
}

void ParameterTable::report_unknown(const ValueDecl& decl) const {
  if (is_not_finite_word(decl.text)) return report_no_quantity(decl, diagnostics_);
  diagnostics_.report<DiagnosticCode::unknown_parameter>(decl.span, excerpt(decl.text));
  if (const auto nearest = nearest_name(decl.text, names_))
    diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
}

void ParameterTable::report_unused() const {
  for (const Entry& entry : entries_)
    if (!entry.used) diagnostics_.report<DiagnosticCode::unused_parameter>(entry.decl.name.span, entry.parameter.name);
}

Span ParameterTable::place_of_least(std::size_t index) const {
  const ParameterDecl& decl = entries_[index].decl;
  return decl.tunable && decl.min ? decl.min->span : decl.value->span;
}

std::vector<Parameter> ParameterTable::parameters() const {
  std::vector<Parameter> parameters;
  for (const Entry& entry : entries_) parameters.push_back(entry.parameter);
  return parameters;
}

}  // namespace dashpot::compiler
