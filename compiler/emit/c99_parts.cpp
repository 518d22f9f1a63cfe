#include "emit/c99_parts.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "emit/cpp_program.hpp"
#include "emit/embedded_templates.hpp"

namespace dashpot::compiler {
namespace {

std::string_view embedded(const std::string& name) {
  for (const EmbeddedTemplate& file : embedded_templates())
    if (file.name == name) return file.text;
  throw std::logic_error("not built into this compiler: " + name);
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// Conditions are names joined by &&, each with ! before it or not.
bool holds(std::string_view condition, const std::map<std::string, bool>& has) {
  bool result = true;
  while (!condition.empty()) {
    const std::size_t end = std::min(condition.find(" && "), condition.size());
    std::string name(condition.substr(0, end));
    condition.remove_prefix(std::min(end + 4, condition.size()));
    const bool is_not = name.starts_with('!');
    if (is_not) name.erase(0, 1);
    const auto found = has.find(name);
    if (found == has.end()) throw std::logic_error("nothing is known of " + name);
    result = result && found->second != is_not;
  }
  return result;
}

// The lines that are left when every #if has been decided.
class Choice {
 public:
  explicit Choice(const std::map<std::string, bool>& has) : has_(has) {}

  // True where the line is to be written.
  bool keeps(std::string_view line) {
    if (line.starts_with("#if ")) return open(line.substr(4));
    if (line.starts_with("#elif ")) return go_on(holds(line.substr(6), has_));
    if (line == "#else") return go_on(true);
    if (line == "#endif") return close();
    for (const Level& level : levels_)
      if (!level.is_taken) return false;
    return true;
  }

 private:
  struct Level {
    bool is_taken;
    bool was_taken;
  };

  bool open(std::string_view condition) {
    const bool is_taken = holds(condition, has_);
    levels_.push_back({is_taken, is_taken});
    return false;
  }
  bool go_on(bool condition) {
    Level& level = levels_.back();
    level.is_taken = !level.was_taken && condition;
    level.was_taken = level.was_taken || condition;
    return false;
  }
  bool close() {
    levels_.pop_back();
    return false;
  }

  const std::map<std::string, bool>& has_;
  std::vector<Level> levels_;
};

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Wording {
 public:
  explicit Wording(const C99Words& words) : words_(words), text_(words.text) {
    const bool is_float = words.scalar == ScalarType::float32;
    const auto literal = [&](double value) { return cpp_literal(value, words.scalar); };
    text_["scalar"] = is_float ? "float" : "double";
    text_["law_type"] = words.name;
    text_["ONE"] = literal(1);
    text_["ROUNDOFF"] = literal(is_float ? 0x1p-20 : 0x1p-48);
    text_["LARGEST"] = literal(is_float ? 0x1.fffffep127 : 0x1.fffffffffffffp1023);
    std::string halves;
    for (const double half :
         is_float ? std::vector{0x1p32, 0x1p32, 0x1p16, 0x1p8, 0x1p4, 0x1p2, 0x1p1}
                  : std::vector{0x1p256, 0x1p256, 0x1p128, 0x1p64, 0x1p32, 0x1p16, 0x1p8, 0x1p4, 0x1p2, 0x1p1})
      halves += (halves.empty() ? "" : ", ") + literal(half);
    text_["HALVES"] = halves;
    text_["ROOT_ON_X86"] = fmt::format(R"("sqrts{0} %0, %0" : "+x"(x))", is_float ? 's' : 'd');
    text_["ROOT_ON_ARM"] = is_float ? R"("vsqrt.f32 %0, %0" : "+t"(x))" : R"("vsqrt.f64 %P0, %P0" : "+w"(x))";
    text_["ROOT_BIT"] = is_float ? "4" : "8";
    text_["LAST_PLACE"] = literal(is_float ? 0x1p-23 : 0x1p-52);
    text_["HALF_OF_DIGITS"] = literal(is_float ? 0x1p12 + 1 : 0x1p27 + 1);
    for (const char* shared : {"dashpot_flush_below", "dashpot_clamp_to"})
      text_[fmt::format("{}F", shared)] = fmt::format("{}{}", shared, is_float ? "f" : "");
  }

  std::string of(std::string_view line) const {
    std::string result;
    const std::size_t comment = line.find("//");
    for (std::size_t i = 0; i < line.size();) {
      if (!is_of_word(line[i])) {
        result += line[i++];
        continue;
      }
      std::size_t end = i;
      while (end < line.size() && is_of_word(line[end])) ++end;
      const std::string word(line.substr(i, end - i));
      i = end;
      if (i > comment) result += word;
      else if (word == "NUMBER") result += number(line, i);
      else result += replaced(word);
    }
    return result;
  }

 private:
  // NUMBER(…) as a literal; `place` is after the word, and moves past the closing parenthesis.
  std::string number(std::string_view line, std::size_t& place) const {
    const std::size_t close = line.find(')', place);
    const std::string digits(line.substr(place + 1, close - place - 1));
    place = close + 1;
    return cpp_literal(std::strtod(digits.c_str(), nullptr), words_.scalar);
  }

  std::string replaced(const std::string& word) const {
    if (const auto whole = text_.find(word); whole != text_.end()) return whole->second;
    return word.starts_with("law_") ? words_.name + word.substr(3) : word;
  }

  const C99Words& words_;
  std::map<std::string, std::string> text_;
};

}  // namespace

std::vector<std::string> c99_part(const std::string& part, const C99Words& words) {
  const Wording wording(words);
  Choice choice(words.has);
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(embedded(part)))
    if (choice.keeps(line)) lines.push_back(wording.of(line));
  return lines;
}

std::vector<std::string> c99_command_header() { return lines_of(embedded("command.h")); }

std::vector<std::string> c99_device_header() { return lines_of(embedded("device_description.h")); }

}  // namespace dashpot::compiler
