// Abaqus: "*Viscoelastic, time=PRONY", then lines of shear weight, bulk weight, time (Abaqus Keywords Reference). The
// weights are shares of the instantaneous moduli.
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

}  // namespace

std::vector<MaterialSeries> read_abaqus(const SourceFile& file, Diagnostics& diagnostics) {
  std::vector<MaterialSeries> found;
  std::string material;
  bool inside = false;
  for (const DeckLine& line : deck_lines(file)) {
    const std::string& first = line.fields[0].text;
    if (line.is_blank() || first.starts_with("**")) continue;
    if (first.starts_with('*')) {
      const std::string keyword = without_blanks(first);
      if (keyword == "*material") material = parameter(line, "name");
      inside = keyword == "*viscoelastic" && folded(parameter(line, "time")) == "prony";
      if (inside) found.push_back({material, {PronyOf::instantaneous, 1, {}}, line.span});
      continue;
    }
    if (!inside) continue;
    if (line.fields.size() < 3) {
      diagnostics.report<DiagnosticCode::prony_line_too_short>(line.span, "shear weight, bulk weight and time");
      continue;
    }
    const auto weight = number_in(line.fields[0], diagnostics);
    const auto time = number_in(line.fields[2], diagnostics);
    if (weight && time) found.back().series.terms.push_back({*weight, *time});
  }
  return found;
}

}  // namespace dashpot::compiler
