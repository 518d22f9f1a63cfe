#include "commands/completion.hpp"

#include <fmt/format.h>

namespace dashpot::compiler {
namespace {

using Takes = OptionWords::Takes;

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::vector<std::string> names_of(const OptionWords& option) {
  std::vector<std::string> names;
  for (const std::string& name : {option.short_name, option.long_name})
    if (!name.empty()) names.push_back(name);
  return names;
}

// The text with a backslash before each of the characters.
std::string escaped(const std::string& text, std::string_view characters) {
  std::string result;
  for (char c : text) {
    if (characters.find(c) != characters.npos) result += '\\';
    result += c;
  }
  return result;
}

// Inside '…', where no backslash means anything.
std::string in_shell_quotes(const std::string& text) {
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string bash_values(const OptionWords& option) {
  switch (option.takes) {
    case Takes::choice: return fmt::format("-W '{}'", joined(option.choices));
    case Takes::file: return "-f";
    case Takes::folder: return "-d";
    case Takes::nothing:
    case Takes::other: break;
  }
  return "";
}

std::string in_bash(const std::vector<CommandWords>& commands) {
  std::string names, values, options, positionals;
  for (const CommandWords& command : commands) {
    if (!command.name.empty()) names += " " + command.name;
    std::string all;
    for (const OptionWords& option : command.options) {
      std::vector<std::string> patterns;
      for (const std::string& name : names_of(option)) patterns.push_back(command.name + ":" + name);
      all += " " + joined(names_of(option));
      if (option.takes != Takes::nothing)
        values += fmt::format("    {}) how=({}) ;;\n", joined(patterns, "|"), bash_values(option));
    }
    options += fmt::format("    {}) how=(-W '{}') ;;\n", command.name.empty() ? "''" : command.name, all.substr(1));
    for (const OptionWords& positional : command.positionals)
      positionals += fmt::format("    {}) how=({}) ;;\n", command.name, bash_values(positional));
  }
  return fmt::format(R"(# Completes command lines of dashpot in bash. Written by `dashpot completion bash`.
_dashpot() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=
  local -a how=(none)
  COMPREPLY=()
  ((COMP_CWORD > 1)) && command=${{COMP_WORDS[1]}}
  case $command:$before in
{}  esac
  [[ $how == none && $word == -* ]] && case $command in
{}  esac
  [[ $how == none ]] && case $command in
    '') how=(-W '{}') ;;
{}  esac
  [[ ${{#how[@]}} == 0 || $how == none ]] || mapfile -t COMPREPLY < <(compgen "${{how[@]}}" -- "$word")
}}
complete -o filenames -F _dashpot dashpot
)",
                     values, options, names.substr(1), positionals);
}

std::string zsh_values(const OptionWords& option) {
  switch (option.takes) {
    case Takes::choice: return "(" + joined(option.choices) + ")";
    case Takes::file: return "_files";
    case Takes::folder: return "_files -/";
    case Takes::nothing:
    case Takes::other: break;
  }
  return " ";
}

// An argument of zsh's _arguments.
std::string zsh_argument(const OptionWords& option) {
  const std::string what = "[" + escaped(option.what, "[]:\\") + "]";
  const std::string value =
      option.takes == Takes::nothing
          ? ""
          : fmt::format(":{}:{}", escaped(option.value.empty() ? option.long_name : option.value, ":\\"),
                        zsh_values(option));
  std::string text;
  for (const std::string& name : names_of(option))
    text += " " + in_shell_quotes((option.many ? "*" : "") + name + what + value);
  return text;
}

std::string in_zsh(const std::vector<CommandWords>& commands) {
  std::string names, cases;
  for (const CommandWords& command : commands) {
    if (command.name.empty()) continue;
    names += fmt::format("    {}\n", in_shell_quotes(command.name + ":" + escaped(command.what, ":\\")));
    cases += fmt::format("    {}) _arguments", command.name);
    for (const OptionWords& option : command.options) cases += " \\\n     " + zsh_argument(option);
    for (const OptionWords& positional : command.positionals)
      cases += " \\\n      " + in_shell_quotes(fmt::format("{}:{}:{}", positional.many ? "*" : "", positional.long_name,
                                                           zsh_values(positional)));
    cases += " ;;\n";
  }
  return fmt::format(R"(#compdef dashpot
# Completes command lines of dashpot in zsh. Written by `dashpot completion zsh`.
_dashpot() {{
  local -a commands
  commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{}  esac
}}
if [[ $funcstack[1] == _dashpot ]]; then _dashpot "$@"; else compdef _dashpot dashpot; fi
)",
                     names, cases);
}

std::string fish_values(const OptionWords& option) {
  switch (option.takes) {
    case Takes::choice: return " -x -a " + in_shell_quotes(joined(option.choices));
    case Takes::file: return " -r -F";
    case Takes::folder: return " -x -a '(__fish_complete_directories)'";
    case Takes::other: return " -x";
    case Takes::nothing: break;
  }
  return "";
}

std::string in_fish(const std::vector<CommandWords>& commands) {
  std::string text =
      "# Completes command lines of dashpot in fish. Written by `dashpot completion fish`.\n"
      "complete -c dashpot -n __fish_use_subcommand -f\n";
  for (const CommandWords& command : commands) {
    const bool is_dashpot = command.name.empty();
    const std::string condition = is_dashpot ? "__fish_use_subcommand" : "__fish_seen_subcommand_from " + command.name;
    if (!is_dashpot)
      text += fmt::format("complete -c dashpot -n __fish_use_subcommand -a {} -d {}\n", command.name,
                          in_shell_quotes(escaped(command.what, "\\")));
    for (const OptionWords& option : command.options) {
      text += fmt::format("complete -c dashpot -n {}", in_shell_quotes(condition));
      if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
      if (!option.long_name.empty()) text += " -l " + option.long_name.substr(2);
      text += fmt::format("{} -d {}\n", fish_values(option), in_shell_quotes(escaped(option.what, "\\")));
    }
    for (const OptionWords& positional : command.positionals)
      if (positional.takes == Takes::choice)
        text += fmt::format("complete -c dashpot -n {} -f -a {}\n", in_shell_quotes(condition),
                            in_shell_quotes(joined(positional.choices)));
  }
  return text;
}

}  // namespace

std::string completion(const std::vector<CommandWords>& commands, const std::string& shell) {
  if (shell == "bash") return in_bash(commands);
  return shell == "zsh" ? in_zsh(commands) : in_fish(commands);
}

}  // namespace dashpot::compiler
