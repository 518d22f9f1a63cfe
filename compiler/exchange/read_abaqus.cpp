// Abaqus: "*Viscoelastic, time=PRONY", then lines of shear weight, bulk weight, time (Abaqus Keywords Reference). The
// weights are shares of the instantaneous moduli.
#include <algorithm>

#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

std::string without_blanks(const std::string& text) {
  std::string result;
  for (const char byte : folded(text))
    if (byte != ' ') result += byte;
  return result;
}

// The value of "name=VALUE" among a keyword's parameters; empty where there is none.
std::string parameter(const DeckLine& line, std::string_view name) {
  for (const DeckField& field : line.fields) {
    const std::size_t sign = field.text.find('=');
    if (sign == std::string::npos || without_blanks(field.text.substr(0, sign)) != name) continue;
    const std::size_t begin = field.text.find_first_not_of(" \"", sign + 1);
    const std::size_t end = field.text.find_last_not_of(" \"");
    return begin == std::string::npos ? "" : field.text.substr(begin, end + 1 - begin);
  }
  return "";
}

// A keyword's line that ends with a comma goes on in the next one.
std::vector<DeckLine> with_whole_keywords(std::vector<DeckLine> lines) {
  std::vector<DeckLine> whole;
  bool goes_on = false;
  for (DeckLine& line : lines) {
    if (line.fields[0].text.starts_with("**")) continue;
    if (goes_on && !line.fields[0].text.starts_with('*'))
      whole.back().fields.insert(whole.back().fields.end(), line.fields.begin(), line.fields.end());
    else whole.push_back(std::move(line));
    const std::vector<DeckField>& fields = whole.back().fields;
    goes_on = fields[0].text.starts_with('*') && fields.size() > 1 && fields.back().text.empty();
  }
  return whole;
}

// Weights and a time, or more of them than one term has.
void add_term(const DeckLine& line, PronySeries& series, Diagnostics& diagnostics) {
  constexpr const char* expected = "shear weight, bulk weight and time";
  const auto is_filled = [](const DeckField& field) { return !field.text.empty(); };
  if (line.fields.size() < 3) return diagnostics.report<DiagnosticCode::prony_line_too_short>(line.span, expected);
  if (std::any_of(line.fields.begin() + 3, line.fields.end(), is_filled))
    return diagnostics.report<DiagnosticCode::prony_line_too_long>(line.span, expected);
  const auto weight = number_in(line.fields[0], diagnostics);
  const auto time = number_in(line.fields[2], diagnostics);
  if (weight && time) series.terms.push_back({*weight, *time});
}

}  // namespace

std::vector<MaterialSeries> read_abaqus(const SourceFile& file, Diagnostics& diagnostics) {
  std::vector<MaterialSeries> found;
  std::string material;
  bool inside = false;
  for (const DeckLine& line : with_whole_keywords(deck_lines(file))) {
    const std::string& first = line.fields[0].text;
    if (line.is_blank()) continue;
    if (first.starts_with('*')) {
      const std::string keyword = without_blanks(first);
      if (keyword == "*material") material = parameter(line, "name");
      inside = keyword == "*viscoelastic" && folded(parameter(line, "time")) == "prony";
      if (inside) found.push_back({material, {PronyOf::instantaneous, 1, {}}, line.span});
      continue;
    }
    if (inside) add_term(line, found.back().series, diagnostics);
  }
  return found;
}

}  // namespace dashpot::compiler
