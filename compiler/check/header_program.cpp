#include <cmath>
#include <regex>

#include "check.hpp"

namespace dashpot_check {
namespace {

// What a header is made of, once remarks are gone and between words is one space.
const std::regex function(R"((?:dashpot::command<scalar> (output|step)\(scalar position, scalar velocity\)|)"
                          R"(void (update)\(\)) noexcept \{ )");
const std::regex declaration(
    R"((?:alignas\(\d+\) )?(static constexpr )?(?:scalar|unsigned) (\w+)(?:\[(\d+)\])? = \{?)");
const std::regex assignment(R"((const (?:scalar|vector) )?(\w+(?:\[\d+\])?) = |return \{damping, )");
const std::regex loop(R"(for \(int i = 0; i < (\d+); i \+= (\d+)\) (?:DASHPOT_UNROLL )?)"
                      R"(for \(int j = i; j < i \+ \2; j \+= vector::width\) \{ ([^{}]*)\} )");
const std::regex name(R"([A-Za-z_]\w*(\[\d+\])?)");
const std::regex number(R"((-?(?:0|[1-9]\d*)(?:(\.\d*(?:e[-+]?\d+)?|e[-+]?\d+)(f?))?))");
// What computes nothing, nothing of a sample, or nothing while samples arrive and no state is small.
const std::regex frame(
    R"( ?#pragma once (?:#include <dashpot/\w+\.hpp> )+namespace dashpot::generated \{ class \w+ \{ public: |private: |)"
    R"(using scalar = (?:double|float); |struct certified_for \{ |struct parameters \{\}; |int \w+_turn_ = 0; |\}; |\} |)"
    R"(static constexpr (?:bool|dashpot::motion|const char\*) \w+ = [^;{}]*; |using vector = [^;]*; |DASHPOT_UNROLL |)"
    R"((?:bool )?sampled_ = (?:true|false); |if \(!sampled_\) return; |)"
    R"(if \(!dashpot::all_finite\([^;{}]*\)\) (?:return \{damping, 0\}; |\{ (?:sampled_ = false; )?return \{damping, 0\}; \} )|)"
    R"(void reset\(scalar position = 0\) noexcept \{ (?:static_cast<void>\(position\); |last_position_ = )"
    R"(dashpot::all_finite\(position, position, position\) \? position : 0; )(?:\w+_ = (?:0|false); |clear\(\w+_\); )*\} |)"
    R"(unsigned set\(const parameters&\) noexcept \{ return 0; \} |scalar kept_share\(\) const noexcept \{ [^{}]*\} |)"
    R"(template <int size> static void clear\(volatile scalar \(&states\)\[size\]\) noexcept \{ )"
    R"(for \(int i = 0; i < size; \+\+i\) states\[i\] = 0; \} |)"
    R"(dashpot::command<scalar> step\(scalar position, scalar velocity\) noexcept \{ )"
    R"(const dashpot::command<scalar> now = output\(position, velocity\); update\(\); return now; \} |)"
    R"(for \(int j = 0, first = (\w+_)turn_; j < (\d+); j \+= vector::width\) vector::put\(\1, first \+ j, )"
    R"(\(vector::at\(\1, first \+ j\)\)\); \1turn_ \+= \2; \1turn_ = \1turn_ < \d+ \? \1turn_ : 0; )");

// How expressions read while the motor is within its limit and nothing is flushed to zero.
const std::pair<const char*, const char*> readings[] = {
    {R"(//[^\n]*)", ""},
    {R"(\s+)", " "},
    {R"( - )", " + -1 * "},
    {R"(dashpot::partial_sums<[^;]*> lane; )", "const vector lane = 0; "},
    {R"(lane\.add\(j \+ -1 \* i, )", "const vector lane = (lane + "},
    {R"(lane\.total\(\))", "lane"},
    {R"(vector::put\((\w+), j, )", "$1[j] = ("},
    {R"(vector::at\((\w+), j\))", "$1[j]"},
    {R"(dashpot::relaxed\(threshold, (\w+), (\w+), )", "($1 * $2 + "},
    {R"((dashpot|vector)::flush_below\(threshold, |dashpot::clamp_to\(motor_limit, |vector::in_register\()", "("},
    {R"(\(wanted \+ -1 \* force\) \* wanted > 0 \? force / wanted : all_kept)", "all_kept"},
    {R"(rest_shift_ > 0 \? \(position > 0 \? \(rest_shift_ \+ -1 \* position > 0 \? position : rest_shift_\) : no_shift\))"
     R"( : \(position > 0 \? no_shift : \(rest_shift_ \+ -1 \* position > 0 \? rest_shift_ : position\)\))",
     "rest_shift_ + no_shift"}};

class Header {
 public:
  Program read(std::string text) {
    if (std::regex_search(text, std::regex(R"(\\\s|\?\?/|\r|/\*)"))) throw Unknown("a remark is not of one line");
    for (const auto& [known, reading] : readings) text = std::regex_replace(text, std::regex(known), reading);
    is_float_ = text.find("using scalar = float; ") != text.npos;
    const std::size_t own = text.find("private: ");  // numbers and states, which are needed first
    text_ = text.substr(own) + text.substr(0, own);
    while (!text_.empty()) read_part();
    const auto is_for_update = [](const auto& of) { return of.first.rfind("sampled_", 0) == 0; };
    std::erase_if(late_.next, is_for_update), std::erase_if(now_.next, is_for_update);
    const bool is_same = late_.next == now_.next && late_.force == now_.force;
    if (functions_ != "output update " && !(functions_ == "output update step " && is_same))
      throw Unknown("step() is not output() and update()");
    return now_;
  }

 private:
  void read_part() {
    if (take(frame)) return;
    if (take("scalar stored_energy() const noexcept { ")) {  // what it says is not checked
      text_.erase(0, text_.find("return stored; } "));
      expect("return stored; } ");
    } else if (take(function)) {
      functions_ += found_[1] + found_[2] + " ";
      locals_ = {{"position", {{"position", 1}}}, {"velocity", {{"velocity", 1}}}};
      if (found_[1] == "output") at_rest_ = now_;
      if (found_[1] == "step") late_ = std::exchange(now_, at_rest_);
    } else if (take(loop)) {
      std::string all;
      for (int j = 0, step = std::stoi(found_[2]); j % step != 0 || j < std::stoi(found_[1]); ++j)
        all += std::regex_replace(found_[3], std::regex(R"(\[j\])"), "[" + std::to_string(j) + "]");
      text_.insert(0, all);
    } else if (take(declaration)) {  // of a constant, or of a state, which begins at zero
      const bool is_state = found_[1].empty(), is_list = !found_[3].empty();
      const std::string called = found_[2];
      for (std::size_t i = 0, count = is_list ? std::stoul(found_[3]) : 1; i < count; ++i) {
        const std::string cell = is_list ? called + "[" + std::to_string(i) + "]" : called;
        const Rational value = is_list && text_[0] == '}' ? Rational(0) : literal();
        if (is_list) take(", ");
        if (is_state) now_.states.push_back(cell), now_.next[cell] = {{cell, 1}};
        if (!now_.constants.emplace(cell, value).second || (is_state && value != 0)) refuse();
      }
      expect(is_list ? "}; " : "; ");
    } else {
      if (!take(assignment)) refuse();
      const bool is_local = !found_[1].empty(), is_return = found_[2].empty();
      const std::string to = found_[2];
      if (is_local && now_.constants.count(to) != 0) refuse();
      const Form value = sum();
      (is_return ? now_.force : is_local ? locals_[to] : now_.next.at(to)) = value;
      expect(is_return ? "}; " : "; ");
    }
  }
  Form sum() {
    Form value = product();
    while (take(" + ")) value = value + product();
    return value;
  }
  Form product() {
    Form value = factor();
    while (take(" * ")) {
      Form other = factor();
      if (value.size() > value.count("")) std::swap(value, other);
      if (value.size() > value.count("")) refuse();  // neither is a number
      value = of(value, "") * other;
    }
    return value;
  }
  Form factor() {
    if (take("(")) {
      const Form value = sum();
      expect(")");
      return value;
    }
    if (!take(name)) return literal() * Form{{"", 1}};
    if (locals_.count(found_[0])) return locals_.at(found_[0]);
    return now_.next.count(found_[0]) ? now_.next.at(found_[0]) : now_.constants.at(found_[0]) * Form{{"", 1}};
  }
  Rational literal() {  // as a C++ compiler reads it
    if (!take(number) || (!found_[2].empty() && is_float_ == found_[3].empty())) refuse();
    const double value =
        is_float_ ? double(std::strtof(found_[1].c_str(), nullptr)) : std::strtod(found_[1].c_str(), nullptr);
    return std::isfinite(value) ? Rational(value) : (refuse(), Rational());
  }
  bool take(const std::string& word) { return text_.rfind(word, 0) == 0 && (text_.erase(0, word.size()), true); }
  bool take(const std::regex& pattern) {
    std::smatch match;
    if (!std::regex_search(text_, match, pattern, std::regex_constants::match_continuous)) return false;
    found_.assign(match.begin(), match.end());
    text_.erase(0, found_[0].size());
    return true;
  }
  void expect(const std::string& word) { take(word) || (refuse(), false); }
  [[noreturn]] void refuse() const { throw Unknown("this is not known: " + text_.substr(0, 60)); }

  std::string text_, functions_;    // what has not been read; what was
  std::vector<std::string> found_;  // by a pattern, with its parts
  bool is_float_ = false;
  std::map<std::string, Form> locals_;
  Program now_{{}, {}, {}, {{"", 1}}}, at_rest_, late_;  // a force of 1 where none is returned; late_: without step()
};

}  // namespace

Program program_of(const std::string& header) { return Header().read(header); }

}  // namespace dashpot_check
