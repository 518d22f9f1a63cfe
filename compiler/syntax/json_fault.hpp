// Why a text is not JSON, in our own words.
#pragma once

#include <optional>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// Where the parser stood after the last token that it accepted.
struct JsonContext {
  enum class Next { value, first_item, first_key, colon, more_items, more_members, end_of_file };

  Next next = Next::value;
  std::size_t offset = 0;            // behind the last accepted token
  std::optional<Span> open_bracket;  // of the innermost list or object still open
};

// Reports the fault that follows `context`, at its place.
void report_json_fault(const SourceFile& file, const JsonContext& context, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
