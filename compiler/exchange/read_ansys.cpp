// ANSYS: "TB,PRONY,material,…,terms,SHEAR", then "TBDATA,first,c1,…,c6" with pairs of relative modulus and time (ANSYS
// Command Reference; words count by their first four letters). The weights are shares of the instantaneous moduli.
#include <cmath>
#include <map>

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

}  // namespace

std::vector<MaterialSeries> read_ansys(const SourceFile& file, Diagnostics& diagnostics) {
  std::vector<MaterialSeries> found;
  std::map<int, DeckField> constants;
  bool inside = false;
  const auto finish = [&] {
    if (inside) found.back().series = series_of(constants, found.back().span, diagnostics);
    constants.clear();
    inside = false;
  };
  for (const DeckLine& line : deck_lines(file)) {
    if (is_word(line.fields[0], "tb") && line.fields.size() > 1) {
      finish();
      const bool is_shear = line.fields.size() < 6 || line.fields[5].text.empty() || is_word(line.fields[5], "shea");
      if (!is_word(line.fields[1], "pron") || !is_shear) continue;
      found.push_back({line.fields.size() > 2 ? line.fields[2].text : "", {}, line.span});
      inside = true;
    } else if (inside && is_word(line.fields[0], "tbda")) {
      const auto first = line.fields.size() > 1 && !line.fields[1].text.empty() ? number_in(line.fields[1], diagnostics)
                                                                                : std::optional(1.0);
      if (!first || *first != std::floor(*first) || std::abs(*first) > 1e6) continue;
      for (std::size_t i = 2; i < line.fields.size(); ++i)
        if (!line.fields[i].text.empty())
          constants[static_cast<int>(*first) + static_cast<int>(i) - 2] = line.fields[i];
    }
  }
  finish();
  return found;
}

}  // namespace dashpot::compiler
