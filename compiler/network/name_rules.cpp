#include "network/name_rules.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>

#include "network/decimal.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

// C++20 keywords and alternative tokens, object-like macros that compilers predefine or common headers define, and what
// C23 and, by default, gcc and clang keep beside them.
constexpr std::string_view keywords[] = {
    "alignas",     "alignof",   "and",        "and_eq",       "asm",       "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",         "catch",     "char",         "char16_t",
    "char32_t",    "char8_t",   "class",      "co_await",     "co_return", "co_yield",     "compl",
    "concept",     "const",     "const_cast", "consteval",    "constexpr", "constinit",    "continue",
    "decltype",    "default",   "delete",     "do",           "double",    "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",       "false",     "float",        "for",
    "friend",      "goto",      "if",         "inline",       "int",       "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",          "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected",    "public",    "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",       "sizeof",    "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",     "this",      "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",       "typename",  "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",     "wchar_t",   "while",        "xor",
    "xor_eq",      "linux",     "unix",       "i386",         "NULL",      "NAN",          "INFINITY",
    "EOF",         "errno",     "HUGE_VAL",   "M_E",          "M_LOG2E",   "M_LOG10E",     "M_LN2",
    "M_LN10",      "M_PI",      "M_PI_2",     "M_PI_4",       "M_1_PI",    "M_2_PI",       "M_2_SQRTPI",
    "M_SQRT2",     "M_SQRT1_2", "typeof",     "typeof_unqual"};

// Members of the emitted class (architecture, section 5), names inside its functions, and the namespaces around it.
constexpr std::string_view members[] = {
    "scalar",     "sample_period", "parameters",    "reset",         "output",    "update",    "step",
    "set",        "stored_energy", "added_damping", "position",      "velocity",  "command",   "damping",
    "force",      "port_motion",   "motion",        "certified_for", "estimator", "device",    "loop_delay",
    "any_device", "device_digest", "now",           "stored",        "dashpot",   "generated", "std"};

bool is_letter(char byte) { return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z'); }
bool is_name_byte(char byte) { return is_letter(byte) || is_digit(byte) || byte == '_'; }

bool has_name_form(std::string_view name) {
  return !name.empty() && is_letter(name.front()) && std::all_of(name.begin(), name.end(), is_name_byte);
}

template <std::size_t size>
bool contains(const std::string_view (&list)[size], std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

constexpr std::string_view begin_of_macros = "DASHPOT_";

bool is_legal(std::string_view name) {
  return has_name_form(name) && name.find("__") == std::string_view::npos && !contains(keywords, name) &&
         !contains(members, name) && !name.starts_with(begin_of_macros);
}

// Replaces other bytes by single underscores, none of them at the ends; puts an 'n' before a leading digit and "_1"
// behind a reserved word; removes the prefix of macros.
std::optional<std::string> legal_proposal(std::string_view name) {
  while (name.starts_with(begin_of_macros)) name.remove_prefix(begin_of_macros.size());
  std::string proposal;
  for (const char byte : name)
    if (is_letter(byte) || is_digit(byte)) proposal += byte;
    else if (!proposal.empty() && proposal.back() != '_') proposal += '_';
  if (proposal.ends_with('_')) proposal.pop_back();
  if (!proposal.empty() && is_digit(proposal.front())) proposal.insert(0, 1, 'n');
  if (!proposal.empty() && !is_legal(proposal)) proposal += "_1";
  return is_legal(proposal) ? std::optional(proposal) : std::nullopt;
}

void report_name(const Text& name, std::string_view owner, Diagnostics& diagnostics) {
  if (!has_name_form(name.text)) diagnostics.report<DiagnosticCode::name_form>(name.span, owner, excerpt(name.text));
  else if (name.text.find("__") != std::string::npos)
    diagnostics.report<DiagnosticCode::name_with_double_underscore>(name.span, owner, excerpt(name.text));
  else if (contains(keywords, name.text))
    diagnostics.report<DiagnosticCode::name_is_keyword>(name.span, owner, name.text);
  else if (name.text.starts_with(begin_of_macros))
    diagnostics.report<DiagnosticCode::name_begins_like_macros>(name.span, owner, name.text, begin_of_macros);
  else diagnostics.report<DiagnosticCode::name_is_member>(name.span, owner, name.text);
}

}  // namespace

bool check_name(const Text& name, std::string_view owner, Diagnostics& diagnostics) {
  if (is_legal(name.text)) return true;
  report_name(name, owner, diagnostics);
  const std::string_view end = owner == "node" ? other_name_of_end(name.text) : "";
  if (!end.empty()) diagnostics.note<DiagnosticCode::end_is_called>({}, end);
  else if (const auto proposal = legal_proposal(excerpt(name.text)))
    diagnostics.note<DiagnosticCode::write_instead>({}, *proposal);
  return false;
}

std::string legal_name(std::string_view name) {
  return is_legal(name) ? std::string(name) : legal_proposal(name).value_or("unnamed");
}

std::string folded(std::string_view name) {
  std::string text(name);
  for (char& byte : text)
    if (byte >= 'A' && byte <= 'Z') byte = static_cast<char>(byte - 'A' + 'a');
  return text;
}

std::string_view other_name_of_end(std::string_view stated) {
  const std::string name = folded(stated);
  for (const std::string_view grounded : {"gnd", "grnd", "0", "earth", "base", "frame", "wall", "fixed", "world"})
    if (name == grounded) return "ground";
  for (const std::string_view moved : {"port", "tip", "hand", "handle", "probe", "stylus", "user"})
    if (name == moved) return "tool";
  return "";
}

void UniqueNames::add(const Text& name, Diagnostics& diagnostics) {
  const auto [known, is_new] = places_.emplace(folded(name.text), name.span);
  if (is_new) return;
  diagnostics.report<DiagnosticCode::name_taken>(name.span, excerpt(name.text));
  diagnostics.note<DiagnosticCode::first_given_here>(known->second);
  diagnostics.note<DiagnosticCode::write_instead>({}, free_name(name.text));
}

std::string UniqueNames::free_name(const std::string& wanted) const {
  std::string name = wanted;
  for (int suffix = 2; places_.count(folded(name)) > 0; ++suffix) name = fmt::format("{}_{}", wanted, suffix);
  return name;
}

}  // namespace dashpot::compiler
