// Finds the tokens of a JSON text again, in step with a parser that does not say where they are.
#pragma once

#include <cstddef>

#include "source/source_file.hpp"

namespace dashpot::compiler {

// The token that starts at `offset`: a string with its quotes, a run of word characters, or one code point. A string
// that is not closed ends with its line. Empty at the end of the text.
Span token_at(const SourceFile& file, std::size_t offset);

// The first place from `offset` on that is no blank.
std::size_t skip_blanks(const SourceFile& file, std::size_t offset);

class TokenCursor {
 public:
  explicit TokenCursor(const SourceFile& file);

  // The next token after blanks, commas and colons.
  Span next();
  std::size_t offset() const { return offset_; }  // behind the last token

 private:
  const SourceFile* file_;
  std::size_t offset_;
};

}  // namespace dashpot::compiler
