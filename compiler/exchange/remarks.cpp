// What an export says in the comments of the program that it writes for: a line "KEY: WORDS" each.
#include <set>
#include <sstream>

#include "exchange/deck.hpp"
#include "exchange/prony_format.hpp"

namespace dashpot::compiler {
namespace {

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

// Of a line that is a comment in one of the formats, what stands in it.
std::optional<std::string_view> comment(std::string_view line) {
  line = without_blanks(line);
  for (const std::string_view mark : {"#", "**", "!", "$", "<!--"})
    if (line.starts_with(mark)) {
      line.remove_prefix(mark.size());
      if (line.ends_with("-->")) line.remove_suffix(3);
      return without_blanks(line);
    }
  return std::nullopt;
}

// Where materials of one file were exported from several networks, no remark is of all of them.
std::optional<std::string> only_one(const std::set<std::string>& words) {
  return words.size() == 1 ? std::optional(*words.begin()) : std::nullopt;
}

}  // namespace

PronyRemarks remarks_of(const SourceFile& file) {
  PronyRemarks remarks;
  std::set<std::string> stiffnesses, moduli;
  std::istringstream lines(file.text().substr(begin_of_text(file)));
  for (std::string line; std::getline(lines, line);) {
    const std::optional<std::string_view> text = comment(line);
    const std::size_t colon = text ? text->find(':') : std::string_view::npos;
    if (colon == std::string_view::npos) continue;
    const std::string key = folded(without_blanks(text->substr(0, colon)));
    const std::string words(without_blanks(text->substr(colon + 1)));
    if (key == "of" && !remarks.of) remarks.of = prony_of(folded(words));
    if (key == "stiffness") stiffnesses.insert(words);
    if (key == "modulus") moduli.insert(words);
  }
  remarks.stiffness = only_one(stiffnesses);
  remarks.modulus = only_one(moduli);
  return remarks;
}

}  // namespace dashpot::compiler
