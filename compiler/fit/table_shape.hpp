// How the table in a recording is written: what is between its numbers, and where it begins.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "source/diagnostic.hpp"

namespace dashpot::compiler::fitting {

struct Dialect {
  char delimiter = ',';  // a blank stands for any run of blanks
  bool decimal_comma = false;

  friend bool operator==(const Dialect&, const Dialect&) = default;
};

struct HeadLine {
  std::string text;
  std::size_t number;  // from 1
};

struct TableShape {
  Dialect dialect;
  std::size_t width = 0;              // columns
  std::vector<std::string> names;     // of the columns, with their units where those stand beside; empty without header
  std::vector<std::string> units;     // of a row of units below the names; empty without one
  std::vector<std::string> metadata;  // lines before the table
  std::size_t first_line = 1;         // of the numbers
};

// The fields of a line, free of blanks and quotes around them. A delimiter at the end ends the last field.
std::vector<std::string_view> fields_of(std::string_view line, const Dialect& dialect);

// Of a header's line, without the sign of a comment in front.
std::vector<std::string> names_in(std::string_view line, const Dialect& dialect);

// Whether a table that begins so is text: what a spreadsheet calls Unicode text is UTF-16, with a zero beside every
// letter.
bool is_text(std::string_view beginning);

// What a table writes for a unit, as units are spelt elsewhere: "(mm)" and "[mm]" below a name are "mm", "sec" is "s".
std::string_view unit_text(std::string_view field);

// Whether a field of the line below the names is a unit, or says that there is none.
bool is_unit(std::string_view field);

// A finite decimal number, and nothing else.
std::optional<double> number_of(std::string_view field, const Dialect& dialect);

// In: the beginning of a recording. Out: the one reading that makes a rectangle of numbers of it: a byte order mark,
// metadata, a header and a row of units may stand before it. Refuses: no such reading, and lines such as "0,1,1,5" that
// are two numbers with commas or four without.
std::optional<TableShape> table_shape(const std::string& path, const std::vector<HeadLine>& head, bool has_header,
                                      Diagnostics& diagnostics);

// Lines at the beginning of a table from which its format is found.
inline constexpr std::size_t head_lines = 200;

// How the fields of most lines are separated; nothing where no line is a row of numbers.
std::optional<Dialect> dialect_of(const std::vector<HeadLine>& head);

// The place of a line that is shown in a message; `field` where it points to one.
Span place_of(const std::string& path, std::string_view line, std::size_t number, std::string_view field,
              Diagnostics& diagnostics);

}  // namespace dashpot::compiler::fitting
