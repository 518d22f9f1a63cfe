#include "source/diagnostic.hpp"

#include <algorithm>
#include <map>

namespace dashpot::compiler {
namespace {

// Of a part that several others share, as the loop of two joints, each of them says what is wrong with it.
bool says_the_same(const Diagnostic& x, const Diagnostic& y) {
  const auto is_same_note = [](const Note& a, const Note& b) { return a.text == b.text; };
  return x.code == y.code && x.text == y.text && x.span.file == y.span.file && x.span.begin == y.span.begin &&
         std::equal(x.notes.begin(), x.notes.end(), y.notes.begin(), y.notes.end(), is_same_note);
}

}  // namespace

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::error: return "error";
    case Severity::warning: return "warning";
    case Severity::note: return "note";
  }
  return {};
}

const SourceFile& Diagnostics::keep(SourceFile file) {
  kept_.push_back(std::make_shared<const SourceFile>(std::move(file)));
  return *kept_.back();
}

void Diagnostics::take_errors(const Diagnostics& of_trial) {
  for (const Diagnostic& diagnostic : of_trial.list_)
    if (diagnostic.severity == Severity::error) list_.push_back(diagnostic);
  kept_.insert(kept_.end(), of_trial.kept_.begin(), of_trial.kept_.end());
}

std::size_t Diagnostics::error_count() const {
  return static_cast<std::size_t>(
      std::count_if(list_.begin(), list_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; }));
}

bool Diagnostics::has_errors() const { return error_count() > 0; }

std::vector<Diagnostic> Diagnostics::in_file_order() const {
  std::map<const SourceFile*, std::size_t> file_order{{nullptr, 0}};  // files in the order in which they were met
  for (const Diagnostic& diagnostic : list_) file_order.emplace(diagnostic.span.file, file_order.size());
  std::vector<Diagnostic> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Diagnostic& x, const Diagnostic& y) {
    return std::pair(file_order[x.span.file], x.span.begin) < std::pair(file_order[y.span.file], y.span.begin);
  });
  sorted.erase(std::unique(sorted.begin(), sorted.end(), says_the_same), sorted.end());
  return sorted;
}

}  // namespace dashpot::compiler
