#include <cmath>
#include <optional>
#include <regex>
#include <sstream>

#include "check.hpp"

namespace dashpot_check {
namespace {

// The number that a C++ compiler makes of a literal.
Rational number_of(const std::string& word) {
  const double value =
      word.back() == 'f' ? double(std::strtof(word.c_str(), nullptr)) : std::strtod(word.c_str(), nullptr);
  if (!std::isfinite(value)) throw Unknown("'" + word + "' is no finite number");
  return Rational(value);
}

// Takes every place where the pattern matches out of the text.
template <class Each>
void take_out(std::string& text, const char* pattern, Each each) {
  const std::regex regex(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) each(*at);
  text = std::regex_replace(text, regex, "");
}

// What is left of a header when its numbers, its states and what stands within its functions have been read.
const char* const skeleton =
    R"( ?#pragma once (#include <dashpot/\w+\.hpp> )+namespace dashpot::generated \{ class \w+ \{ public: )"
    R"(using scalar = (double|float); struct certified_for \{ \}; struct parameters \{\}; )"
    R"(void reset\(scalar position = 0\) noexcept \{\} )"
    R"(dashpot::command<scalar> output\(scalar position, scalar velocity\) noexcept \{\} void update\(\) noexcept \{\} )"
    R"(dashpot::command<scalar> step\(scalar position, scalar velocity\) noexcept \{\} )"
    R"(unsigned set\(const parameters&\) noexcept \{\} scalar stored_energy\(\) const noexcept \{\} private: )"
    R"((template <int size> static void clear\(volatile scalar \(&states\)\[size\]\) noexcept \{\} )?\}; \} ?)";

class Header {
 public:
  explicit Header(std::string text) {
    if (std::regex_search(text, std::regex(R"(\\\s|\?\?/|\r|/\*)"))) throw Unknown("a remark is not of one line");
    text = std::regex_replace(std::regex_replace(text, std::regex("//[^\n]*"), ""), std::regex(R"(\s+)"), " ");
    for (const char* function : {"reset", "output", "update", "step", "set", "stored_energy", "clear"})
      take_body(text, function);
    take_out(text, R"((?:alignas\(\d+\) )?static constexpr (scalar|unsigned) (\w+)(\[\d+\])? = ([^;]*); )",
             [&](const std::smatch& found) {
               std::string list = found[4];
               std::vector<Rational>& values = result_.constants[found[2]];
               if (!values.empty()) throw Unknown("'" + found[2].str() + "' is there twice");
               take_out(list, R"(-?\d[\d.]*(e[-+]?\d+)?f?)",
                        [&](const std::smatch& number) { values.push_back(number_of(number.str())); });
               if (!std::regex_match(list, std::regex("[{}, ]*")))
                 throw Unknown("'" + found[2].str() + "' is no number");
               if (found[3].matched) values.resize(std::stoul(found[3].str().substr(1)));
             });
    take_out(text, R"(static constexpr (bool|dashpot::motion|const char\*) \w+ = [^;{}]*; )",
             [](const std::smatch&) {});
    take_out(text, R"((?:alignas\(\d+\) )?scalar (\w+_)(\[\d+\])? = (0|\{\}); )", [&](const std::smatch& found) {
      const std::size_t size = found[2].matched ? std::stoul(found[2].str().substr(1)) : 1;
      sizes_[found[1]] = size;
      for (std::size_t i = 0; i < size; ++i) result_.states.push_back(cell(found[1], i));
    });
    take_out(text, R"((int (\w+_turn_) = 0|bool sampled_ = false); )", [](const std::smatch&) {});
    if (!std::regex_match(text, std::regex(skeleton))) throw Unknown("there is more in the class than is known");
    if (bodies_["set"] != std::vector<std::string>{"return", "0", ";", ""}) throw Unknown("set() is not empty");
  }

  Program carried_out() {
    run({"output", "update"});
    const Program late = result_;
    run({"step"});
    for (const auto& [state, form] : result_.next)
      if (result_.force != late.force || (state.rfind("sampled_", 0) != 0 && late.next.at(state) != form))
        throw Unknown("step() is not output() and update()");
    return late;
  }

 private:
  static std::string cell(const std::string& name, std::size_t i) { return name + "[" + std::to_string(i) + "]"; }

  void take_body(std::string& text, const std::string& function) {
    const std::regex head(" " + function + R"(\([^{}]*\)( const)? noexcept \{)");
    std::smatch found;
    if (!std::regex_search(text, found, head)) return;
    const std::size_t start = std::size_t(found.position() + found.length());
    std::size_t end = start;
    for (int depth = 1; end < text.size() && depth > 0; ++end) depth += (text[end] == '{') - (text[end] == '}');
    const std::string body = text.substr(start, end - start - 1);
    const std::regex word(R"([A-Za-z_]\w*(?:::\w+)*|\d[\d.]*(?:e[-+]?\d+)?f?|\+=|\S)");
    bodies_[function] = {std::sregex_token_iterator(body.begin(), body.end(), word), {}};
    bodies_[function].push_back("");
    text.erase(start, end - start - 1);
  }

  [[noreturn]] void refuse() const {
    std::string near;
    for (std::size_t i = at_ > 5 ? at_ - 5 : 0; i < std::min(at_ + 5, words_->size()); ++i) near += " " + (*words_)[i];
    throw Unknown("this is not understood:" + near);
  }
  const std::string& peek() const { return words_->at(at_); }
  bool take(const std::string& word) { return peek() == word ? (++at_, true) : false; }
  void expect(const std::string& words) {
    std::istringstream in(words);
    for (std::string word; in >> word;)
      if (!take(word)) refuse();
  }
  std::string name() { return std::isalpha(peek()[0]) ? words_->at(at_++) : (refuse(), ""); }

  void run(std::vector<std::string> functions) {
    result_.next.clear();
    for (const std::string& state : result_.states) result_.next[state] = {{state, 1}};
    for (const std::string& function : functions) call(function);
  }
  void call(const std::string& function) {
    const auto* const words = std::exchange(words_, &bodies_.at(function));
    const std::size_t at = std::exchange(at_, 0);
    locals_ = {{"position", {{"position", 1}}}, {"velocity", {{"velocity", 1}}}};
    while (peek() != "") statement();
    words_ = words;
    at_ = at;
  }

  void statement() {
    if (take("{")) {
      while (!take("}")) statement();
    } else if (take("if")) {  // taken when the input is not finite, or there is none: not by a sample that arrives
      expect("( !");
      if (take("sampled_")) return expect(") return ;");
      for (expect("dashpot::all_finite ("); !take(")"); ++at_) continue;
      expect(") ");
      expect(take("{") ? "sampled_ = false ; return { damping , 0 } ; }" : "return { damping , 0 } ;");
    } else if (take("DASHPOT_UNROLL")) {
      statement();
    } else if (take("for")) {
      loop();
    } else if (take("using")) {
      expect("vector = dashpot::vector < scalar , dashpot::vector_width < scalar ,"), ++at_;
      expect("> ,"), ++at_, expect("> ;");
    } else if (take("dashpot::partial_sums")) {
      expect("< vector ,"), ++at_, expect("> lane ;");
      locals_["lane"] = {};
    } else if (take("return")) {
      result_.force = argument("{ damping ,");
      expect("} ;");
    } else if (take("const")) {
      if (take("dashpot::command")) {
        expect("< scalar > now = output ( position , velocity ) ; update ( ) ; return now ;");
        return call("output"), call("update");
      }
      if (!take("scalar")) expect("vector");
      const std::string local = name();
      locals_[local] = argument("=");
      expect(";");
    } else if (take("vector::put")) {
      const std::string place = indexed();
      result_.next.at(place) = argument(",");
      expect(") ;");
    } else if (take("lane")) {
      argument(". add (");
      locals_.at("lane") = locals_.at("lane") + argument(",");
      expect(") ;");
    } else {
      assignment();
    }
  }

  void assignment() {
    const std::string called = name();
    if (called == "sampled_") return expect(words_->at(at_ + 1) == "true" ? "= true ;" : "= false ;");
    if (const std::size_t turn = called.find("turn_"); turn != called.npos) {  // whose guard it is next
      const std::string end = std::to_string(sizes_.at(called.substr(0, turn)));
      return take("+=") ? (++at_, expect(";")) : expect("= " + called + " < " + end + " ? " + called + " : 0 ;");
    }
    result_.next.at(cell(called, 0)) = argument("=");
    expect(";");
  }

  void loop() {
    expect("( int");
    const std::string index = name();
    Form at = argument("=");
    if (take(",")) expect("first ="), name(), locals_["first"] = {};  // guards that take turns change nothing, anywhere
    const Rational end = constant(argument("; " + index + " <"));
    const Rational step = (expect("; " + index + " +="), take("vector::width")) ? 1 : number_of(words_->at(at_++));
    expect(")");
    const std::size_t body = at_;
    if (step <= 0 || constant(at) >= end) refuse();
    for (; constant(at) < end; at = at + Form{{"", step}}) {
      locals_[index] = at;
      at_ = body;
      statement();
    }
  }

  // ---- expressions
  Rational constant(const Form& form) const {
    if (form.size() > form.count("")) refuse();
    return of(form, "");
  }
  Form argument(const std::string& before) {
    expect(before);
    Form value = product();
    while (peek() == "+" || peek() == "-") {
      const Rational sign = words_->at(at_++) == "+" ? 1 : -1;
      value = value + sign * product();
    }
    return value;
  }
  Form product() {
    Form value = factor();
    while (take("*")) value = times(value, factor());
    return value;
  }
  Form times(const Form& x, const Form& y) const { return x.size() == x.count("") ? of(x, "") * y : constant(y) * x; }
  std::string indexed() {
    expect("(");
    const std::string called = name();
    return cell(called, std::size_t(constant(argument(","))));
  }
  Form factor() {
    Form value;
    if (peek() == "(") value = argument("(");
    else if (take("dashpot::relaxed"))
      value = argument("( threshold ,"), value = times(value, argument(",")), value = value + argument(",");
    else if (take("dashpot::flush_below") || take("vector::flush_below")) value = argument("( threshold ,");
    else if (take("vector::at")) value = stored(indexed());
    else if (take("lane")) expect(". total ("), value = locals_.at("lane");
    else if (std::isdigit(peek()[0])) return number_of(words_->at(at_++)) * Form{{"", 1}};
    else if (const std::string called = name(); locals_.count(called)) return locals_.at(called);
    else return stored(cell(called, 0));
    return expect(")"), value;
  }
  Form stored(const std::string& place) const {
    if (result_.next.count(place)) return result_.next.at(place);
    const std::size_t bracket = place.find('[');
    return result_.constants.at(place.substr(0, bracket)).at(std::stoul(place.substr(bracket + 1))) * Form{{"", 1}};
  }

  Program result_;
  std::map<std::string, std::size_t> sizes_;
  std::map<std::string, std::vector<std::string>> bodies_;
  const std::vector<std::string>* words_ = nullptr;
  std::size_t at_ = 0;
  std::map<std::string, Form> locals_;
};

}  // namespace

Program program_of(const std::string& header) {
  try {
    return Header(header).carried_out();
  } catch (const std::out_of_range&) {
    throw Unknown("a name or a place is used that is not there");
  }
}

}  // namespace dashpot_check
