#include "commands/changed_network.hpp"

#include <algorithm>
#include <cctype>

#include "network/decimal.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

// Text in place of a span of the file, and the words of the command line that ask for it.
struct Change {
  std::size_t begin, end;
  std::string text, words;
};

// A plain number is one in SI; all else is read as a value in quotes is.
std::string value_text(const std::string& value) {
  return !value.empty() && value[0] != '+' && decimal_length(value) == value.size() ? value : json_string(value);
}

// By its first line, which has columns and nothing that JSON starts with.
bool is_a_table(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t first = line.find_first_not_of(" \xEF\xBB\xBF\"#");
  const bool is_word = first != line.npos && std::isalnum(static_cast<unsigned char>(line[first])) != 0;
  return is_word && line.find_first_of(",;\t") != line.npos && line.find_first_of("{}:") == line.npos;
}

// A parameter, or an element; `port` is the name of its port and a dot, or empty.
struct Named {
  std::string port, name;
  Span value;
};

class NetworkChanger {
 public:
  NetworkChanger(const JsonValue& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {
    if (const JsonMember* parameters = find_member(root, "parameters"))
      for (const JsonMember& parameter : parameters->value.members)
        named_.push_back({"", parameter.key, value_of(parameter.value)});
    if (const JsonMember* ports = find_member(root, "ports"))
      for (const JsonValue& port : ports->value.items) find_elements(port, name_of(port) + ".");
    else find_elements(root, "");
  }

  void rename(const std::string& name) {
    const std::string words = "--name " + json_string(name);
    if (const JsonMember* member = find_member(root_, "name")) replace(member->value.span, json_string(name), words);
    else
      changes_.push_back({root_.span.begin + 1, root_.span.begin + 1, " \"name\": " + json_string(name) + ",", words});
  }

  void set(const std::string& words) {
    const std::size_t equals = words.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == words.size())
      return diagnostics_.report<DiagnosticCode::set_malformed>({}, excerpt(words));
    const std::string name = words.substr(0, equals);
    std::vector<const Named*> found;
    for (const Named& each : named_)
      if (each.name == name || each.port + each.name == name) found.push_back(&each);
    if (found.empty()) return report_missing(name);
    // A parameter hides elements of its name; it is of no port.
    if (found.size() > 1 && found[0]->port != found[1]->port && !found[0]->port.empty())
      return diagnostics_.report<DiagnosticCode::set_ambiguous>({}, excerpt(name), listed(found));
    replace(found.front()->value, value_text(words.substr(equals + 1)), "--set " + words);
  }

  SourceFile changed(const SourceFile& file) {
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) { return a.begin < b.begin; });
    std::string text;
    std::vector<ChangedPart> parts;
    std::size_t copied = 0;
    for (const Change& change : changes_) {
      text.append(file.text(), copied, change.begin - copied);
      parts.push_back({text.size(), text.size() + change.text.size(), change.words});
      text += change.text;
      copied = change.end;
    }
    text.append(file.text(), copied);
    SourceFile changed(file.path(), std::move(text));
    changed.mark_changed(std::move(parts));
    return changed;
  }

 private:
  // A parameter is its value, or an object that states it beside a range.
  static Span value_of(const JsonValue& parameter) {
    const JsonMember* stated = parameter.kind == Kind::object ? find_member(parameter, "value") : nullptr;
    return stated ? stated->value.span : parameter.span;
  }

  static std::string name_of(const JsonValue& value) {
    const JsonMember* name = find_member(value, "name");
    return name && name->value.kind == Kind::string ? name->value.text : "";
  }

  // Whatever has a name and is a spring, a damper or a slip; names of parameters go before those of elements.
  void find_elements(const JsonValue& value, const std::string& port) {
    const std::string name = name_of(value);
    for (const char* kind : {"spring", "damper", "slip"})
      if (const JsonMember* law = find_member(value, kind); law && !name.empty())
        named_.push_back({port, name, law->value.span});
    for (const JsonMember& member : value.members) find_elements(member.value, port);
    for (const JsonValue& item : value.items) find_elements(item, port);
  }

  // Of two changes of one value the last holds.
  void replace(Span span, std::string text, std::string words) {
    std::erase_if(changes_, [&](const Change& change) { return change.begin == span.begin; });
    changes_.push_back({span.begin, span.end, std::move(text), std::move(words)});
  }

  void report_missing(const std::string& name) {
    diagnostics_.report<DiagnosticCode::set_unknown_name>({}, excerpt(name));
    std::vector<std::string> names;
    std::vector<const Named*> all;
    for (const Named& each : named_) {
      names.push_back(each.port + each.name);
      all.push_back(&each);
    }
    if (const auto nearest = nearest_name(name, names))
      return diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
    if (!all.empty()) diagnostics_.note<DiagnosticCode::known_keys>({}, listed(all));
    diagnostics_.note<DiagnosticCode::set_needs_a_name>({});
  }

  static std::string listed(const std::vector<const Named*>& some) {
    std::string text;
    for (const Named* each : some) text += (text.empty() ? "" : ", ") + each->port + each->name;
    return text;
  }

  const JsonValue& root_;
  Diagnostics& diagnostics_;
  std::vector<Named> named_;
  std::vector<Change> changes_;
};

}  // namespace

const SourceFile* open_network(const std::string& path, const Options& options, SourceFiles& files,
                               Diagnostics& diagnostics) {
  const SourceFile* file = files.open(path, diagnostics);
  if (file != nullptr && is_a_table(file->text())) {
    diagnostics.report<DiagnosticCode::table_instead_of_network>({}, path);
    diagnostics.note<DiagnosticCode::what_reads_tables>({});
    return nullptr;
  }
  if (file == nullptr || (!options.name && options.set.empty())) return file;
  const std::optional<JsonValue> root = json_in(*file);
  if (!root || root->kind != Kind::object) return file;
  NetworkChanger changer(*root, diagnostics);
  if (options.name) changer.rename(*options.name);
  for (const std::string& words : options.set) changer.set(words);
  return &files.keep(changer.changed(*file));
}

}  // namespace dashpot::compiler
