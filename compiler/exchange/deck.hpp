// Lines of an input deck, split at commas, every field with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "network/name_rules.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

struct DeckField {
  std::string text;  // without blanks around it
  Span span;
};

struct DeckLine {
  std::vector<DeckField> fields;
  Span span;

  bool is_blank() const { return fields.empty() || (fields.size() == 1 && fields[0].text.empty()); }
};

// The text behind a byte order mark, which spreadsheets put before their tables.
std::size_t begin_of_text(const SourceFile& file);

// Split at commas; where a line has none and `width` is not 0, into columns of that many characters.
std::vector<DeckLine> deck_lines(const SourceFile& file, std::size_t width = 0);

// Of a field that is a decimal number (1.5, 2e-3, 2.d-3); reports anything else.
std::optional<double> number_in(const DeckField& field, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
