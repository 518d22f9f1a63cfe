#include "emit/template_text.hpp"

#include <set>
#include <string_view>

#include "emit/embedded_templates.hpp"

namespace dashpot::compiler {
namespace {

// An empty field leaves its line empty, not a line of blanks.
std::string without_trailing_blanks(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '\n') result.erase(result.find_last_not_of(' ') + 1);
    result += c;
  }
  return result;
}

class Filling {
 public:
  Filling(const SourceFile& text, const CodeModel& model, Diagnostics& diagnostics)
      : text_(text), model_(model), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    std::string result;
    const std::string_view all = text_.text();
    std::size_t place = 0;
    while (place < all.size()) {
      const std::size_t end = std::min(all.find('\n', place), all.size() - 1) + 1;
      if (const auto list = list_tag(all.substr(place, end - place), "{{#")) place = repeat(*list, place, end, result);
      else {
        substitute(place, end, nullptr, result);
        place = end;
      }
    }
    report_unused();
    return failed_ ? std::nullopt : std::optional(without_trailing_blanks(result));
  }

 private:
  // The list's name where the line holds nothing but that tag.
  static std::optional<std::string> list_tag(std::string_view line, std::string_view opening) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == line.npos || line.substr(begin, opening.size()) != opening) return std::nullopt;
    const std::size_t close = line.find("}}", begin);
    if (close == line.npos || line.find_first_not_of(" \t\r\n", close + 2) != line.npos) return std::nullopt;
    return std::string(line.substr(begin + opening.size(), close - begin - opening.size()));
  }

  // Appends the block once for each entry; returns where the text goes on.
  std::size_t repeat(const std::string& name, std::size_t tag, std::size_t block, std::string& result) {
    const std::string_view all = text_.text();
    std::size_t end = block;
    while (end < all.size()) {
      const std::size_t next = std::min(all.find('\n', end), all.size() - 1) + 1;
      if (list_tag(all.substr(end, next - end), "{{/") == name) {
        append_entries(name, tag, block, end, result);
        return next;
      }
      end = next;
    }
    unknown(name, tag, block);
    return all.size();
  }

  void append_entries(const std::string& name, std::size_t tag, std::size_t block, std::size_t end,
                      std::string& result) {
    const auto list = model_.lists.find(name);
    if (list == model_.lists.end()) return unknown(name, tag, block);
    used_.insert(name);
    for (const Fields& entry : list->second) substitute(block, end, &entry, result);
  }

  void substitute(std::size_t begin, std::size_t end, const Fields* entry, std::string& result) {
    const std::string_view all = text_.text();
    while (begin < end) {
      const std::size_t open = std::min(all.find("{{", begin), end);
      result += all.substr(begin, open - begin);
      if (open == end) return;
      const std::size_t close = all.find("}}", open);
      if (close == all.npos || close >= end)
        return unknown(std::string(all.substr(open + 2, end - open - 2)), open, end);
      append_field(std::string(all.substr(open + 2, close - open - 2)), open, close + 2, entry, result);
      begin = close + 2;
    }
  }

  void append_field(const std::string& name, std::size_t open, std::size_t close, const Fields* entry,
                    std::string& result) {
    if (entry != nullptr) {
      if (const auto field = entry->find(name); field != entry->end()) {
        result += field->second;
        return;
      }
    }
    const auto field = model_.fields.find(name);
    if (field == model_.fields.end()) return unknown(name, open, close);
    used_.insert(name);
    result += field->second;
  }

  void unknown(const std::string& name, std::size_t begin, std::size_t end) {
    failed_ = true;
    diagnostics_.report<DiagnosticCode::template_unknown_placeholder>({&text_, begin, end}, name);
  }

  void report_unused() {
    const auto report = [this](const std::string& name) {
      if (used_.count(name) != 0) return;
      failed_ = true;
      diagnostics_.report<DiagnosticCode::template_unused_placeholder>({&text_, 0, 0}, name);
    };
    for (const auto& [name, value] : model_.fields) report(name);
    for (const auto& [name, entries] : model_.lists) report(name);
  }

  const SourceFile& text_;
  const CodeModel& model_;
  Diagnostics& diagnostics_;
  std::set<std::string> used_;
  bool failed_ = false;
};

}  // namespace

const SourceFile* find_template(const std::string& name, const std::optional<std::string>& directory,
                                Diagnostics& diagnostics) {
  if (directory) {
    std::optional<SourceFile> file = read_source(*directory + "/" + name, diagnostics);
    return file ? &diagnostics.keep(std::move(*file)) : nullptr;
  }
  for (const EmbeddedTemplate& embedded : embedded_templates())
    if (embedded.name == name) return &diagnostics.keep(SourceFile("templates/" + name, std::string(embedded.text)));
  diagnostics.report<DiagnosticCode::cannot_read_file>({}, "templates/" + name, "not built into this compiler");
  return nullptr;
}

std::optional<std::string> fill(const SourceFile& text, const CodeModel& model, Diagnostics& diagnostics) {
  return Filling(text, model, diagnostics).run();
}

std::optional<std::string> filled(const std::string& name, const CodeModel& model,
                                  const std::optional<std::string>& directory, Diagnostics& diagnostics) {
  const SourceFile* shape = find_template(name, directory, diagnostics);
  return shape ? fill(*shape, model, diagnostics) : std::nullopt;
}

bool append_filled(const std::string& name, std::string file, const CodeModel& model, const EmissionOptions& options,
                   std::vector<OutputFile>& files, Diagnostics& diagnostics) {
  std::optional<std::string> text = filled(name, model, options.templates, diagnostics);
  if (text) files.push_back({std::move(file), std::move(*text)});
  return text.has_value();
}

}  // namespace dashpot::compiler
