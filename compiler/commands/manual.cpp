#include "commands/manual.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dashpot::compiler {
namespace {

// As roff prints it: no hyphen where a dash stands, no request where a line begins with a dot.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\') result += "\\e";
    else if (text[i] == '-') result += "\\-";
    else result += text[i];
  }
  return result;
}

// Lists may be broken where a line ends.
std::string with_gaps(const std::string& list) {
  std::string result;
  for (std::size_t i = 0; i < list.size(); ++i)
    result += list[i] == ',' && i + 1 < list.size() && list[i + 1] != ' ' ? std::string(", ") : std::string(1, list[i]);
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

std::string entry(const OptionWords& option) {
  std::string names;
  for (const std::string& name : {option.short_name, option.long_name})
    if (!name.empty()) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) names += " \\fI" + roff(with_gaps(option.value)) + "\\fR";
  return fmt::format(".TP\n{}{}\n{}\n", names, option.many ? " ..." : "", roff(option.what));
}

std::string synopsis(const CommandWords& command) {
  if (command.name.empty()) return "\\fBdashpot\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]";
  std::string text = fmt::format("\\fBdashpot {}\\fR [\\fIOPTIONS\\fR]", roff(command.name));
  for (const OptionWords& positional : command.positionals) {
    const std::string name = roff(positional.long_name) + (positional.many ? "..." : "");
    text += positional.required ? " \\fI" + name + "\\fR" : " [\\fI" + name + "\\fR]";
  }
  return text;
}

std::string section(const char* heading, const std::string& text) {
  return text.empty() ? "" : fmt::format(".SH {}\n{}", heading, text);
}

std::string entries(const std::vector<OptionWords>& options) {
  std::string text;
  for (const OptionWords& option : options) text += entry(option);
  return text;
}

std::string exit_status(const std::string& command) {
  const char* const after_a_run =
      command == "run"
          ? "Or the run was not sound: a fault ended it, or the device did not confirm the safe command, or "
            "the log could not be written.\n"
          : "";
  return fmt::format(
      ".TP\n0\nDone.\n.TP\n1\nAn input is refused, and nothing is written.\n{}.TP\n2\nThe command line is wrong.\n"
      ".TP\n3\nA defect in dashpot.\n",
      after_a_run);
}

}  // namespace

std::string manual_page(const std::vector<CommandWords>& commands, const std::string& name) {
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&](const CommandWords& c) { return c.name == name; });
  if (found == commands.end()) return "";
  const CommandWords& command = *found;
  const std::string title = name.empty() ? "dashpot" : "dashpot-" + name;
  std::string list, others;
  for (const CommandWords& other : commands) {
    if (other.name == name) continue;
    if (!other.name.empty()) list += fmt::format(".TP\n{}\n{}\n", bold(other.name), roff(other.what));
    others += fmt::format("{}.BR {} (1)", others.empty() ? "" : ",\n",
                          roff(other.name.empty() ? "dashpot" : "dashpot-" + other.name));
  }
  std::string capitals = title;
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
  return fmt::format(".TH {} 1 \"\" \"dashpot {}\" \"dashpot\"\n", roff(capitals), DASHPOT_VERSION) +
         section("NAME", fmt::format("{} \\- {}\n", roff(title), roff(command.what))) +
         section("SYNOPSIS", synopsis(command) + "\n") + section("COMMANDS", name.empty() ? list : "") +
         section("ARGUMENTS", entries(command.positionals)) + section("OPTIONS", entries(command.options)) +
         (command.footer.find_first_not_of('\n') == std::string::npos
              ? ""
              : section("NOTES",
                        ".nf\n" + roff(command.footer.substr(command.footer.find_first_not_of('\n'))) + "\n.fi\n")) +
         section("EXIT STATUS", exit_status(name)) + section("SEE ALSO", others + "\n");
}

}  // namespace dashpot::compiler
