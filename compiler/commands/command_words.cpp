#include "commands/command_words.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "commands/targets.hpp"

namespace dashpot::compiler {
namespace {

// What may be typed as it stands: "exact", "ls-dyna", not "FILE" nor "needle:KEY=LENGTH".
bool is_literal(std::string_view word) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789-";
  return !word.empty() && word.find_first_not_of(letters) == word.npos;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);)
    words.push_back(word.substr(std::min(word.find_first_not_of(' '), word.size())));
  return words;
}

// The literals of "a|b|C", or of a list in brackets, "C (a,b, or more)".
std::vector<std::string> choices_in(const std::string& value) {
  const std::size_t open = value.find('('), close = value.find(')');
  std::vector<std::string> words = open == value.npos || close == value.npos
                                       ? split(value, '|')
                                       : split(value.substr(open + 1, close - open - 1), ',');
  const bool is_list = words.size() > 1;
  words.erase(std::remove_if(words.begin(), words.end(), [](const std::string& word) { return !is_literal(word); }),
              words.end());
  return is_list ? words : std::vector<std::string>();
}

OptionWords::Takes taken_by(const OptionWords& option) {
  constexpr std::string_view files[] = {"NETWORK", "FILE", "DEVICE", "CERTIFICATE", "HEADER", "RECORDING", "--device"};
  if (!option.choices.empty()) return OptionWords::Takes::choice;
  if (option.value.starts_with("FILE") || option.value.starts_with("RECORDING") ||
      std::find(std::begin(files), std::end(files), option.long_name) != std::end(files))
    return OptionWords::Takes::file;
  return option.value == "DIR" ? OptionWords::Takes::folder : OptionWords::Takes::other;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  const bool is_positional = option.get_positional();
  if (is_positional) {
    words.long_name = option.get_name(true, false);
  } else {
    if (!option.get_snames().empty()) words.short_name = "-" + option.get_snames().front();
    if (!option.get_lnames().empty()) words.long_name = "--" + option.get_lnames().front();
  }
  words.what = option.get_description();
  words.required = option.get_required();
  words.value = !option.get_option_text().empty() ? option.get_option_text()
                : is_positional                   ? ""
                                                  : option.get_type_name();
  if (words.value.empty() && !is_positional) return words;  // a flag
  words.many = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  words.choices = choices_in(words.value);
  if (words.long_name == "--target")
    for (const Target& target : targets()) words.choices.emplace_back(target.name);
  words.takes = taken_by(words);
  return words;
}

CommandWords words_of(const CLI::App& command) {
  CommandWords words;
  words.what = command.get_description();
  words.footer = command.get_footer();
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      (option->get_positional() ? words.positionals : words.options).push_back(words_of(*option));
  return words;
}

}  // namespace

std::vector<CommandWords> command_words(const CLI::App& app) {
  std::vector<CommandWords> all = {words_of(app)};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    all.push_back(words_of(*command));
    all.back().name = command->get_name();
  }
  return all;
}

}  // namespace dashpot::compiler
