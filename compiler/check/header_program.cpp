#include <cmath>
#include <regex>

#include "check.hpp"

namespace dashpot_check {
namespace {

const std::regex remark(R"(//[^\n]*)"), space(R"(\s+)"), place(R"(\[j\])"), name(R"([A-Za-z_]\w*(\[\d+\])?)");
const std::regex number(R"((-?(?:0|[1-9]\d*)(?:(\.\d*(?:e[-+]?\d+)?|e[-+]?\d+)(f?))?)(, |$)?)");
const std::regex target(R"((const (?:scalar|vector) )?(\w+(?:\[\d+\])?) = |return \{damping, )");
const std::regex declaration(
    R"((?:alignas\(\d+\) )?(static constexpr )?(?:scalar|unsigned) (\w+)(\[(\d+)\])? = \{?([^;{}]*)\}?; )");
const std::regex function(R"((?:dashpot::command<scalar> (output|step)\(scalar position, scalar velocity\)|)"
                          R"(void (update)\(\)) noexcept \{ )");
const std::regex loop(
    R"(for \(int i = 0; i < (\d+); i \+= (\d+)\) for \(int j = i; j < i \+ \2; j \+= vector::width\) )"
    R"(\{ ([^{}]*)\} )");
// What else a header holds.
const std::regex frame(
    R"(#pragma once (#include <dashpot/\w+\.hpp> )+namespace dashpot::generated \{ class \w+ \{ public: |private: |)"
    R"(using scalar = (double|float); |struct certified_for \{ |struct parameters \{\}; |int \w+_turn_ = 0; |\}; |\} |)"
    R"(bool |static constexpr (bool|dashpot::motion|const char\*) \w+ = [^;{}]*; |)"
    R"(void reset\(scalar position = 0\) noexcept \{ (static_cast<void>\(position\); |last_position_ = )"
    R"(dashpot::all_finite\(position, position, position\) \? position : 0; )(\w+_ = 0; |clear\(\w+_\); )*\} |)"
    R"(unsigned set\(const parameters&\) noexcept \{ return 0; \} |)"
    R"(scalar kept_share\(\) const noexcept \{ [^{}]*\} |)"
    R"(template <int size> static void clear\(volatile scalar \(&states\)\[size\]\) noexcept \{ )"
    R"(for \(int i = 0; i < size; \+\+i\) states\[i\] = 0; \} )");

// How it reads while samples arrive, the motor is within its limit and nothing is flushed to zero.
const std::pair<const char*, const char*> readings[] = {
    {R"(DASHPOT_UNROLL |\bsampled_ = (true|false); |if \(!sampled_\) return; |using vector = [^;]*; )", ""},
    {R"(dashpot::command<scalar> step\(scalar position, scalar velocity\) noexcept \{ )"
     R"(const dashpot::command<scalar> now = output\(position, velocity\); update\(\); return now; \} )",
     ""},
    {R"(for \(int j = 0, first = (\w+_)turn_; j < (\d+); j \+= vector::width\) vector::put\(\1, first \+ j, )"
     R"(vector::flush_below\(threshold, vector::at\(\1, first \+ j\)\)\); \1turn_ \+= \2; )"
     R"(\1turn_ = \1turn_ < \d+ \? \1turn_ : 0; )",
     ""},
    {R"(if \(!dashpot::all_finite\([^;{}]*\)\) (return \{damping, 0\}; |\{ return \{damping, 0\}; \} ))", ""},
    {R"(dashpot::partial_sums<[^;]*> lane; )", "const vector lane = 0; "},
    {R"(lane\.add\(j - i, )", "const vector lane = (lane + "},
    {R"(lane\.total\(\))", "lane"},
    {R"(vector::put\((\w+), j, )", "$1[j] = ("},
    {R"(vector::at\((\w+), j\))", "$1[j]"},
    {R"(dashpot::relaxed\(threshold, (\w+), (\w+), )", "($1 * $2 + "},
    {R"((dashpot|vector)::flush_below\(threshold, |dashpot::clamp_to\(motor_limit, |vector::in_register\()", "("},
    {R"(\(wanted - force\) \* wanted > 0 \? force / wanted : all_kept)", "all_kept"},
    {R"(rest_shift_ > 0 \? \(position > 0 \? \(rest_shift_ - position > 0 \? position : rest_shift_\) : no_shift\) : )"
     R"(\(position > 0 \? no_shift : \(rest_shift_ - position > 0 \? rest_shift_ : position\)\))",
     "rest_shift_ + no_shift"}};

class Header {
 public:
  Program read(std::string text) {
    if (std::regex_search(text, std::regex(R"(\\\s|\?\?/|\r|/\*)"))) throw Unknown("a remark is not of one line");
    text = std::regex_replace(std::regex_replace(text, remark, ""), space, " ");
    for (const auto& [known, reading] : readings) text = std::regex_replace(text, std::regex(known), reading);
    for (std::smatch found; std::regex_search(text, found, loop);) {
      std::string all;
      for (int j = 0, step = std::stoi(found[2]); j % step != 0 || j < std::stoi(found[1]); ++j)
        all += std::regex_replace(found[3].str(), place, "[" + std::to_string(j) + "]");
      text = found.prefix().str() + all + found.suffix().str();
    }
    // Numbers and states first. What stored_energy() says is not checked.
    const std::size_t own = text.find("private: "), energy = text.find("scalar stored_energy() const noexcept { ");
    const std::size_t code = text.find_first_not_of(' '), end = text.find("return stored; } ", energy);
    is_float_ = text.find("using scalar = float; ") != text.npos;
    text_ = text.substr(own) + text.substr(code, energy - code) + text.substr(end + 17, own - end - 17);
    result_.force = {{"", 1}};  // where nothing is returned
    while (!text_.empty()) take_part();
    for (const auto& [called, form] : late_.next)
      if (result_.force != late_.force || (called.rfind("sampled_", 0) != 0 && result_.next.at(called) != form))
        throw Unknown("step() is not output() and update()");
    if (functions_ != "output update " && functions_ != "output update step ") throw Unknown("a function is not there");
    return result_;
  }

 private:
  [[noreturn]] void refuse() const { throw Unknown("this is not known: " + text_.substr(0, 60)); }
  bool take(const std::string& word) { return text_.rfind(word, 0) == 0 ? (text_.erase(0, word.size()), true) : false; }
  bool take(const std::regex& pattern) {
    std::smatch match;
    if (!std::regex_search(text_, match, pattern, std::regex_constants::match_continuous)) return false;
    found_.assign(match.begin(), match.end());
    text_.erase(0, found_[0].size());
    return true;
  }
  void take_part() {
    if (take(function)) {
      functions_ += found_[1] + found_[2] + " ";
      locals_ = {{"position", {{"position", 1}}}, {"velocity", {{"velocity", 1}}}};
      if (found_[1] != "step") return;
      late_ = result_, result_.force = {{"", 1}};
      for (auto& [called, form] : result_.next) form = {{called, 1}};
    } else if (take(declaration)) {  // of a constant, or of a state, which begins at zero
      const std::vector<std::string> found = found_;
      const std::string rest = std::exchange(text_, found[5]);
      const bool is_list = !found[3].empty(), is_state = found[1].empty();
      for (std::size_t i = 0, end = is_list ? std::stoul(found[4]) : 1; i < end; ++i) {
        const std::string cell = is_list ? found[2] + "[" + std::to_string(i) + "]" : found[2];
        const Rational value = is_list && text_.empty() ? Rational(0) : literal();
        if (is_state) result_.states.push_back(cell), result_.next[cell] = {{cell, 1}};
        if (!result_.constants.emplace(cell, value).second || (is_state && value != 0)) refuse();
      }
      if (!std::exchange(text_, rest).empty()) refuse();
    } else if (take(target)) {
      const std::vector<std::string> to = found_;
      const Form value = sum();
      if (!take(to[2].empty() ? "}; " : "; ") || (!to[1].empty() && result_.constants.count(to[2]) != 0)) refuse();
      (to[2].empty() ? result_.force : to[1].empty() ? result_.next.at(to[2]) : locals_[to[2]]) = value;
    } else if (!take(frame)) {
      refuse();
    }
  }

  Rational literal() {  // as a C++ compiler reads it
    if (!take(number) || (!found_[2].empty() && is_float_ == found_[3].empty())) refuse();
    const double value =
        is_float_ ? double(std::strtof(found_[1].c_str(), nullptr)) : std::strtod(found_[1].c_str(), nullptr);
    return std::isfinite(value) ? Rational(value) : (refuse(), Rational());
  }
  Form sum() {
    Form value = product();
    for (bool more = true; more;) {
      if (take(" + ")) value = value + product();
      else if ((more = take(" - "))) value = value + Rational(-1) * product();
    }
    return value;
  }
  Form product() {
    Form value = factor();
    while (take(" * ")) {
      const Form other = factor();
      if (value.size() > value.count("") && other.size() > other.count("")) refuse();
      value = value.size() > value.count("") ? of(other, "") * value : of(value, "") * other;
    }
    return value;
  }
  Form factor() {
    if (take("(")) {
      const Form value = sum();
      return take(")") ? value : (refuse(), value);
    }
    if (!take(name)) return literal() * Form{{"", 1}};
    if (locals_.count(found_[0])) return locals_.at(found_[0]);
    if (result_.next.count(found_[0])) return result_.next.at(found_[0]);
    return result_.constants.at(found_[0]) * Form{{"", 1}};
  }

  std::string text_, functions_;    // what has not been read; what was
  std::vector<std::string> found_;  // by a pattern, with its parts
  bool is_float_ = false;
  std::map<std::string, Form> locals_;
  Program result_, late_;  // late_: of output() and update()
};

}  // namespace

Program program_of(const std::string& header) { return Header().read(header); }

}  // namespace dashpot_check
