// ANSYS: "TB,PRONY,material,…,terms,SHEAR", then "TBDATA,first,c1,…,c6" with pairs of relative modulus and time (ANSYS
// Command Reference; words count by their first four letters). The weights are shares of the instantaneous moduli.
#include <cmath>
#include <map>
#include <utility>

#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

bool is_word(const DeckField& field, std::string_view word) { return folded(field.text).substr(0, 4) == word; }

// Constants 1, 2, … in pairs.
PronySeries series_of(const std::map<int, DeckField>& constants, const Span& place, Diagnostics& diagnostics) {
  PronySeries series{PronyOf::instantaneous, 1, {}};
  int next = 1;
  for (const auto& [index, field] : constants) {
    const auto value = number_in(field, diagnostics);
    if (!value) continue;
    if (index != next++) {
      diagnostics.report<DiagnosticCode::prony_constant_missing>(field.span, next - 1);
      return series;
    }
    if (index % 2 == 1) series.terms.push_back({*value, 0});
    else series.terms.back().time = *value;
  }
  if (constants.size() % 2 == 1)
    diagnostics.report<DiagnosticCode::prony_constant_missing>(place, static_cast<int>(constants.size()) + 1);
  return series;
}

// What stands behind an exclamation mark is a remark.
DeckLine without_remark(DeckLine line) {
  for (std::size_t i = 0; i < line.fields.size(); ++i) {
    DeckField& field = line.fields[i];
    const std::size_t mark = field.text.find('!');
    if (mark == std::string::npos) continue;
    field.text.resize(field.text.find_last_not_of(" \t", mark == 0 ? 0 : mark - 1) + 1);
    field.span.end = field.span.begin + field.text.size();
    line.fields.resize(i + 1);
  }
  return line;
}

// The constants of a table, of each temperature or other field that it is given for.
class AnsysTable {
 public:
  AnsysTable(std::string material, const Span& place) : material_(std::move(material)), place_(place) {}

  void begin_field(const DeckLine& line) {
    if (!fields_.back().constants.empty()) fields_.emplace_back();
    for (const DeckField& field : line.fields)
      fields_.back().name += (&field == &line.fields[0] ? " " : ",") + field.text;
  }

  void add(const DeckLine& line, Diagnostics& diagnostics) {
    std::map<int, DeckField>& constants = fields_.back().constants;
    const bool is_told = line.fields.size() > 1 && !line.fields[1].text.empty();
    const auto first = is_told ? number_in(line.fields[1], diagnostics) : std::optional(1.0);
    if (!first) return;
    if (*first != std::floor(*first) || std::abs(*first) > 1e6)
      return diagnostics.report<DiagnosticCode::prony_constant_missing>(line.fields[1].span,
                                                                        static_cast<int>(constants.size()) + 1);
    for (std::size_t i = 2; i < line.fields.size(); ++i)
      if (!line.fields[i].text.empty()) constants[static_cast<int>(*first) + static_cast<int>(i) - 2] = line.fields[i];
  }

  void append_to(std::vector<MaterialSeries>& found, Diagnostics& diagnostics) const {
    for (const Field& field : fields_)
      found.push_back({fields_.size() == 1 ? material_ : material_ + field.name,
                       series_of(field.constants, place_, diagnostics), place_});
  }

 private:
  struct Field {
    std::string name;  // " TBTEMP,20"
    std::map<int, DeckField> constants;
  };

  std::string material_;
  Span place_;
  std::vector<Field> fields_{1};
};

}  // namespace

std::vector<MaterialSeries> read_ansys(const SourceFile& file, Diagnostics& diagnostics) {
  std::vector<AnsysTable> tables;
  bool is_within = false;
  for (const DeckLine& whole : deck_lines(file)) {
    const DeckLine line = without_remark(whole);
    if (is_word(line.fields[0], "tb") && line.fields.size() > 1) {
      const bool is_shear = line.fields.size() < 6 || line.fields[5].text.empty() || is_word(line.fields[5], "shea");
      is_within = is_word(line.fields[1], "pron") && is_shear;
      if (is_within) tables.emplace_back(line.fields.size() > 2 ? line.fields[2].text : "", line.span);
    } else if (is_within && (is_word(line.fields[0], "tbte") || is_word(line.fields[0], "tbfi"))) {
      tables.back().begin_field(line);
    } else if (is_within && is_word(line.fields[0], "tbda")) {
      tables.back().add(line, diagnostics);
    }
  }
  std::vector<MaterialSeries> found;
  for (const AnsysTable& table : tables) table.append_to(found, diagnostics);
  return found;
}

}  // namespace dashpot::compiler
