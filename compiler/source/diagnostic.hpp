// What the compiler has to say about the user's input, as data. Message text lives in diagnostics.def only.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "source/source_file.hpp"

namespace dashpot::compiler {

enum class Severity { error, warning, note };
std::string_view name_of(Severity severity);  // as text and JSON have it

enum class DiagnosticCode {
#define DASHPOT_DIAGNOSTIC(code, severity, text) code,
#include "source/diagnostics.def"
#undef DASHPOT_DIAGNOSTIC
};

struct MessageTemplate {
  std::string_view name;  // as written in diagnostics.def, with underscores
  Severity severity;
  std::string_view text;
};

inline constexpr MessageTemplate message_templates[] = {
#define DASHPOT_DIAGNOSTIC(code, severity, text) {#code, Severity::severity, text},
#include "source/diagnostics.def"
#undef DASHPOT_DIAGNOSTIC
};

constexpr const MessageTemplate& message_template(DiagnosticCode code) {
  return message_templates[static_cast<std::size_t>(code)];
}

struct Note {
  std::string text;
  Span span;
};

struct Diagnostic {
  DiagnosticCode code;
  Severity severity;
  std::string text;
  Span span;
  std::vector<Note> notes;
};

class Diagnostics {
 public:
  // The arguments are checked against the message's placeholders when our code is compiled.
  template <DiagnosticCode code, class... Arguments>
  void report(Span span, const Arguments&... arguments) {
    list_.push_back({code, message_template(code).severity, text_of<code>(arguments...), span, {}});
  }

  // Adds a note to the newest diagnostic.
  template <DiagnosticCode code, class... Arguments>
  void note(Span span, const Arguments&... arguments) {
    static_assert(message_template(code).severity == Severity::note);
    list_.back().notes.push_back({text_of<code>(arguments...), span});
  }

  // Files read on the way, such as templates, then live as long as the diagnostics that point into them.
  const SourceFile& keep(SourceFile file);

  void forget() { list_.clear(); }  // what has been told

  // The errors of what was tried, where it failed, and the files that they point into. Its warnings are left out.
  void take_errors(const Diagnostics& of_trial);

  // Advice is what would help, found by compiling otherwise, often many times. It is looked for unless it is unwanted.
  void take_no_advice() { wants_advice_ = false; }
  bool wants_advice() const { return wants_advice_; }

  bool has_errors() const;
  std::size_t error_count() const;
  std::vector<Diagnostic> in_file_order() const;  // placed ones by file and place, the others first

 private:
  template <DiagnosticCode code, class... Arguments>
  static std::string text_of(const Arguments&... arguments) {
    constexpr std::string_view text = message_template(code).text;
    return fmt::format(fmt::format_string<const Arguments&...>(text), arguments...);
  }

  std::vector<Diagnostic> list_;
  std::vector<std::shared_ptr<const SourceFile>> kept_;
  bool wants_advice_ = true;
};

}  // namespace dashpot::compiler
