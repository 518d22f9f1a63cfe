// LS-DYNA: *MAT_GENERAL_VISCOELASTIC, two cards and then lines of G_i, β_i (absolute moduli, β = 1/τ, a term with β = 0
// relaxes never), and *MAT_VISCOELASTIC, mid, ro, bulk, G0, GI, β: GI + (G0 − GI) e^{−βt} (LS-DYNA Keyword Manual,
// volume II). Fields stand in columns of ten characters, or behind commas.
#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t column = 10;  // [characters]

class LsDynaReader {
 public:
  LsDynaReader(const SourceFile& file, Diagnostics& diagnostics)
      : lines_(deck_lines(file, column)), diagnostics_(diagnostics) {}

  std::vector<MaterialSeries> read() {
    for (at_ = 0; at_ < lines_.size(); ++at_) {
      const std::string words = keyword_of(lines_[at_]);
      std::string_view keyword = words;
      const bool has_title = keyword.ends_with("_title");
      if (has_title) keyword.remove_suffix(std::string_view("_title").size());
      // Materials whose names go on, as *MAT_VISCOELASTIC_THERMAL, have other cards.
      if (keyword == "*mat_general_viscoelastic" || keyword == "*mat_076") read_general(has_title);
      else if (keyword == "*mat_viscoelastic" || keyword == "*mat_006") read_simple(has_title);
    }
    return std::move(found_);
  }

 private:
  static std::string keyword_of(const DeckLine& line) {
    std::string word;
    for (const DeckField& field : line.fields) word += field.text;
    return word.starts_with('*') ? folded(word) : "";
  }

  // The next line that is no comment; null at the next keyword and at the end.
  const DeckLine* next() {
    while (at_ + 1 < lines_.size()) {
      const DeckLine& line = lines_[at_ + 1];
      if (line.fields[0].text.starts_with('*')) return nullptr;
      ++at_;
      if (!line.fields[0].text.starts_with('$')) return &line;
    }
    return nullptr;
  }

  void read_general(bool has_title) {
    const Span place = lines_[at_].span;
    if (has_title) next();
    const DeckLine* first = next();
    if (first == nullptr || next() == nullptr)
      return diagnostics_.report<DiagnosticCode::prony_cards_missing>(place, "two cards before the terms");
    found_.push_back({first->fields[0].text, {PronyOf::absolute, 0, {}}, place});
    while (const DeckLine* line = next()) {
      if (line->is_blank()) continue;
      if (line->fields.size() < 2) {
        diagnostics_.report<DiagnosticCode::prony_line_too_short>(line->span, "G and beta");
        continue;
      }
      add(line->fields[0], line->fields[1]);
    }
  }

  void add(const DeckField& modulus_field, const DeckField& rate_field) {
    const auto modulus = number_in(modulus_field, diagnostics_);
    const auto rate = number_in(rate_field, diagnostics_);
    if (!modulus || !rate) return;
    PronySeries& series = found_.back().series;
    if (*rate == 0) series.stiffness += *modulus;
    else series.terms.push_back({*modulus, 1 / *rate});
  }

  void read_simple(bool has_title) {
    const Span place = lines_[at_].span;
    if (has_title) next();
    const DeckLine* card = next();
    if (card == nullptr || card->fields.size() < 6)
      return diagnostics_.report<DiagnosticCode::prony_cards_missing>(place,
                                                                      "a card of mid, ro, bulk, G0, GI and beta");
    const auto at_once = number_in(card->fields[3], diagnostics_);
    const auto at_last = number_in(card->fields[4], diagnostics_);
    const auto rate = number_in(card->fields[5], diagnostics_);
    if (!at_once || !at_last || !rate) return;
    PronySeries series{PronyOf::absolute, *at_once, {}};  // with β = 0 nothing relaxes
    if (*rate != 0) series = {PronyOf::absolute, *at_last, {{*at_once - *at_last, 1 / *rate}}};
    found_.push_back({card->fields[0].text, series, place});
  }

  std::vector<DeckLine> lines_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  std::vector<MaterialSeries> found_;
};

}  // namespace

std::vector<MaterialSeries> read_ls_dyna(const SourceFile& file, Diagnostics& diagnostics) {
  return LsDynaReader(file, diagnostics).read();
}

}  // namespace dashpot::compiler
