#include "network/section_reader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "network/expression.hpp"
#include "network/quantity.hpp"
#include "network/read_value.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {

std::optional<double> stated_in(const EntryDecl& entry, const Dimension& dimension) {
  if (entry.is_list || entry.values.empty()) return std::nullopt;
  const std::optional<Quantity> quantity = quantity_in(entry.values.front());
  return quantity && quantity->dimension == dimension ? std::optional(quantity->value) : std::nullopt;
}

SectionReader::SectionReader(const DeviceDecl& decl, std::string name, motion joint_motion, Diagnostics& diagnostics)
    : name_(std::move(name)), motion_(joint_motion), diagnostics_(diagnostics) {
  for (const SectionDecl& section : decl.sections)
    if (section.name.text == name_) section_ = &section;
}

void SectionReader::require(std::string_view key) const {
  const bool misspelt = std::find(misspelt_.begin(), misspelt_.end(), key) != misspelt_.end();
  if (is_present() && !has(key) && !misspelt)
    diagnostics_.report<DiagnosticCode::missing_key>(section_->opening, name_, key);
}

void SectionReader::refuse_other_keys(const std::vector<std::string>& keys, const std::vector<KeyRemedy>& remedies) {
  if (!is_present()) return;
  for (const EntryDecl& entry : section_->entries) {
    if (std::find(keys.begin(), keys.end(), entry.key.text) != keys.end()) continue;
    const auto remedy = std::find_if(remedies.begin(), remedies.end(),
                                     [&](const KeyRemedy& known) { return known.key == entry.key.text; });
    if (remedy != remedies.end()) {
      diagnostics_.report<DiagnosticCode::unknown_key>(entry.key.span, name_, entry.key.text);
      remedy->note(entry);
      continue;
    }
    if (const auto nearest = report_unknown_key(entry.key, name_, keys, diagnostics_)) misspelt_.push_back(*nearest);
  }
}

bool SectionReader::read(std::string_view key, const Dimension& due, Bound bound, double& target) const {
  const ValueDecl* decl = find_single(key);
  const auto value = decl != nullptr ? value_of(*decl, key, due, bound) : std::nullopt;
  if (value) target = *value;
  return value.has_value();
}

void SectionReader::read_pair(std::string_view key, const Dimension& due, Bound bound, double& low, double& high,
                              bool may_be_one) const {
  const EntryDecl* entry = find(key);
  if (entry == nullptr) return;
  if (entry->values.size() != 2) return diagnostics_.report<DiagnosticCode::not_a_pair>(entry->span, dotted(key));
  const auto first = value_of(entry->values[0], key, due, bound);
  const auto second = value_of(entry->values[1], key, due, bound);
  if (!first || !second) return;
  if (*first > *second || (*first == *second && !may_be_one))
    return diagnostics_.report<DiagnosticCode::empty_range>(entry->span, dotted(key), excerpt(entry->values[0].text),
                                                            excerpt(entry->values[1].text));
  low = *first;
  high = *second;
}

void SectionReader::read_count(std::string_view key, unsigned least, unsigned& target) const {
  const ValueDecl* decl = find_single(key);
  if (decl == nullptr) return;
  const auto value = read_quantity_as(*decl, {dotted(key), dimensions::number, motion_}, diagnostics_);
  if (!value) return;
  if (*value >= least && *value <= std::numeric_limits<unsigned>::max() && std::floor(*value) == *value)
    target = static_cast<unsigned>(*value);
  else diagnostics_.report<DiagnosticCode::not_a_count>(decl->span, dotted(key), excerpt(decl->text), least);
}

bool SectionReader::is_within(std::string_view key, double value, double low, double high,
                              std::string_view unit) const {
  if (value >= low && value <= high) return true;
  const ValueDecl* decl = find_single(key);
  if (decl == nullptr) return true;
  diagnostics_.report<DiagnosticCode::device_limit>(decl->span, name_ + "." + std::string(key), excerpt(decl->text),
                                                    fmt::format("{} to {} {}", low, high, unit));
  return false;
}

bool SectionReader::read_within(std::string_view key, const Dimension& due, Bound bound, double low, double high,
                                std::string_view unit, double& target) const {
  return read(key, due, bound, target) && is_within(key, target, low, high, unit);
}

std::optional<std::size_t> SectionReader::read_word(std::string_view key, const std::vector<std::string>& words) const {
  const ValueDecl* decl = find_single(key);
  if (decl == nullptr) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), decl->text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  diagnostics_.report<DiagnosticCode::unknown_word>(decl->span, dotted(key), excerpt(decl->text),
                                                    fmt::format("{}", fmt::join(words, ", ")));
  if (const auto nearest = nearest_name(decl->text, words))
    diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
  return std::nullopt;
}

Span SectionReader::place_of(std::string_view key) const {
  const EntryDecl* entry = find(key);
  return entry != nullptr ? entry->span : section_ != nullptr ? section_->name.span : Span{};
}

std::optional<double> SectionReader::stated(std::string_view key, const Dimension& dimension) const {
  const EntryDecl* entry = find(key);
  return entry == nullptr ? std::nullopt : stated_in(*entry, dimension);
}

std::string SectionReader::text_of(std::string_view key) const {
  const EntryDecl* entry = find(key);
  return entry != nullptr && !entry->values.empty() ? excerpt(entry->values.front().text) : std::string();
}

const EntryDecl* SectionReader::find(std::string_view key) const {
  if (!is_present()) return nullptr;
  const auto entry = std::find_if(section_->entries.begin(), section_->entries.end(),
                                  [&](const EntryDecl& e) { return e.key.text == key; });
  return entry == section_->entries.end() ? nullptr : &*entry;
}

const ValueDecl* SectionReader::find_single(std::string_view key) const {
  const EntryDecl* entry = find(key);
  if (entry == nullptr) return nullptr;
  if (!entry->is_list) return &entry->values.front();
  diagnostics_.report<DiagnosticCode::wrong_type>(entry->span, key, "a list", "one value");
  return nullptr;
}

std::optional<double> SectionReader::value_of(const ValueDecl& decl, std::string_view key, const Dimension& due,
                                              Bound bound) const {
  const auto value = read_quantity_as(decl, {dotted(key), due, motion_}, diagnostics_);
  if (!value || bound == Bound::any || *value > 0 || (bound == Bound::zero_or_more && *value == 0)) return value;
  const std::string text =
      due == dimensions::number ? fmt::format("{}", *value) : fmt::format("{} {}", *value, unit_of(due));
  if (bound == Bound::zero_or_more) diagnostics_.report<DiagnosticCode::negative_value>(decl.span, dotted(key), text);
  else diagnostics_.report<DiagnosticCode::not_above_zero>(decl.span, dotted(key), text);
  return std::nullopt;
}

std::string SectionReader::dotted(std::string_view key) const { return fmt::format("'{}.{}'", name_, key); }

}  // namespace dashpot::compiler
