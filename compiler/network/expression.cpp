#include "network/expression.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <initializer_list>
#include <variant>

#include "network/read_value.hpp"
#include "network/unit.hpp"
#include "source/excerpt.hpp"
#include "source/utf8.hpp"

namespace dashpot::compiler {
namespace {

constexpr int deepest_expression = 100;  // brackets, signs and powers within each other

bool is_letter(char byte) { return (byte | 0x20) >= 'a' && (byte | 0x20) <= 'z'; }
bool is_name_byte(char byte) { return is_letter(byte) || is_digit(byte) || byte == '_'; }
bool is_function(std::string_view name) { return name == "sqrt" || name == "exp" || name == "ln"; }

std::size_t name_length(std::string_view text) {
  if (text.empty() || !is_letter(text.front())) return 0;
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_name_byte) - text.begin());
}

std::size_t blanks(std::string_view text) { return std::min(text.find_first_not_of(' '), text.size()); }

bool is_unit(std::string_view text) { return std::holds_alternative<Unit>(parse_unit(text)); }

bool has_known_name(std::string_view text, const NameScope& scope) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = name_length(text.substr(at));
    const std::string_view name = text.substr(at, length);
    if (length > 0 && (scope.knows(name) || is_function(name) || name == "pi")) return true;
    at += std::max<std::size_t>(1, length > 0 ? length : decimal_length(text.substr(at)));
  }
  return false;
}

// A number with a unit behind it, a name, or a unit that lacks its number: nothing is to be calculated.
bool is_plain(std::string_view text, const NameScope& scope) {
  text.remove_prefix(blanks(text));
  const std::size_t name = name_length(text);
  if (name > 0)
    return name + blanks(text.substr(name)) == text.size() || (!has_known_name(text, scope) && is_unit(text));
  const std::size_t number = decimal_length(text);
  if (number == 0) return false;
  const std::string_view unit = text.substr(number + blanks(text.substr(number)));
  return unit.empty() || is_unit(unit);
}

// Whether there is an operator that cannot be part of a unit: "+" or "-" between operands, one directly behind a number
// or in front of one, any if the text starts with a name. Nor can a bracket that starts with a number.
bool has_operator(std::string_view text) {
  std::size_t at = blanks(text);
  if (name_length(text.substr(at)) > 0) return text.find_first_of("+-*/^") != std::string_view::npos;
  bool after_operand = false, after_number = false;
  for (char before = ' '; at < text.size(); at += blanks(text.substr(at))) {
    const std::string_view rest = text.substr(at);
    const bool signs = rest.front() == '+' || rest.front() == '-';
    if (after_operand && before != '^' && signs) return true;
    if (after_number && (rest.front() == '*' || rest.front() == '^')) return true;
    const std::size_t number = is_digit(rest.front()) || rest.front() == '.' ? decimal_length(rest) : 0;
    if (number > 0 && (before == '*' || before == '/' || before == '(')) return true;
    after_number = number > 0 && before != '^';
    after_operand = number > 0 || name_length(rest) > 0 || rest.front() == ')';
    before = rest.front();
    at += std::max<std::size_t>({1, number, name_length(rest)});
  }
  return false;
}

bool has_only_expression_bytes(std::string_view text) {
  const auto belongs = [](char byte) {
    return is_name_byte(byte) || static_cast<unsigned char>(byte) >= 0x80 ||
           std::string_view(" .+-*/^()%").find(byte) != std::string_view::npos;
  };
  return std::all_of(text.begin(), text.end(), belongs);
}

class ExpressionReader {
 public:
  ExpressionReader(const ValueDecl& decl, const NameScope& scope, Diagnostics& diagnostics)
      : decl_(decl), text_(decl.text), scope_(scope), diagnostics_(diagnostics) {}

  std::optional<ExactQuantity> read() {
    const Term whole = sum();
    if (!failed_ && rest().size() > 0) fail_at_rest("an operator");
    return failed_ ? std::nullopt : std::optional(whole.quantity);
  }

 private:
  struct Term {
    ExactQuantity quantity;
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  Term sum() {
    Term left = product();
    while (!failed_) {
      const bool adds = accept('+');
      if (!adds && !accept('-')) break;
      const Term right = product();
      if (failed_) break;
      if (!(left.quantity.dimension == right.quantity.dimension)) return fail_sum(left, right);
      if (adds) left.quantity.value += right.quantity.value;
      else left.quantity.value -= right.quantity.value;
      left.end = right.end;
    }
    return left;
  }

  Term product() {
    Term left = signed_power();
    while (!failed_) {
      const bool multiplies = accept('*');
      if (!multiplies && !accept('/')) break;
      const Term right = signed_power();
      if (failed_) break;
      if (!multiplies && right.quantity.value == 0) {
        diagnostics_.report<DiagnosticCode::division_by_zero>(place(right), text_of(right));
        return failed();
      }
      if (multiplies) left.quantity.value *= right.quantity.value;
      else left.quantity.value /= right.quantity.value;
      left.quantity.dimension =
          compiler::product(left.quantity.dimension, compiler::power(right.quantity.dimension, multiplies ? 1 : -1));
      left.end = right.end;
    }
    return left;
  }

  Term signed_power() {
    if (++depth_ > deepest_expression) return fail_too_deep();
    const std::size_t begin = skip();
    Term term;
    if (accept('-')) {
      term = signed_power();
      term.quantity.value = -term.quantity.value;
    } else if (accept('+')) {
      term = signed_power();
    } else {
      term = raised();
    }
    term.begin = begin;
    --depth_;
    return term;
  }

  Term raised() {
    Term base = factor();
    if (failed_ || !accept('^')) return base;
    const Term exponent = signed_power();
    if (failed_) return exponent;
    if (!(exponent.quantity.dimension == dimensions::number)) return fail_not_plain(exponent, "an exponent");
    base = raise(base, exponent.quantity.value, text_of(exponent));
    base.end = exponent.end;
    return base;
  }

  Term raise(Term base, const ExactReal& power, const std::string& power_text) {
    const std::optional<Dimension> dimension = power_of(base.quantity.dimension, power);
    if (!dimension) {
      diagnostics_.report<DiagnosticCode::power_without_unit>(place(base), text_of(base),
                                                              describe(base.quantity.dimension), power_text);
      return failed();
    }
    const bool defined = base.quantity.value > 0 || (base.quantity.value == 0 ? power > 0 : power == floor(power));
    if (!defined) {
      diagnostics_.report<DiagnosticCode::undefined_power>(place(base), text_of(base), power_text);
      return failed();
    }
    base.quantity = {pow(base.quantity.value, power), *dimension};
    return base;
  }

  // Nothing where an exponent of a base unit would not be whole.
  static std::optional<Dimension> power_of(const Dimension& base, const ExactReal& exponent) {
    if (base == dimensions::number) return base;
    if (!isfinite(exponent)) return std::nullopt;
    Dimension result;
    for (int Dimension::*unit :
         {&Dimension::kilogram, &Dimension::metre, &Dimension::second, &Dimension::ampere, &Dimension::radian}) {
      const ExactReal power = base.*unit * exponent;
      const ExactReal whole = round(power);
      if (abs(power - whole) > 1e-30 || abs(whole) > 100) return std::nullopt;
      result.*unit = whole.convert_to<int>();
    }
    return result;
  }

  Term factor() {
    const std::size_t begin = skip();
    if (accept('(')) return bracket(begin);
    if (decimal_length(rest()) > 0) return literal(begin);
    if (name_length(rest()) > 0) return named(begin);
    return fail_at_rest("a number, a parameter or a bracket");
  }

  Term bracket(std::size_t begin) {
    Term inner = sum();
    if (failed_) return inner;
    if (!accept(')')) return fail_at_rest("an operator or ')'");
    return {inner.quantity, begin, at_};
  }

  // A number with its unit, the longest text behind it that is one.
  Term literal(std::size_t begin) {
    const std::size_t number = decimal_length(rest());
    const std::string_view digits = text_.substr(begin, number);
    at_ += number;
    const std::size_t unit_begin = skip();
    const std::size_t length = unit_length(unit_begin);
    Unit unit;
    if (length > 0) unit = std::get<Unit>(parse_unit(text_.substr(unit_begin, length)));
    else at_ = begin + number;
    at_ += length;
    const ExactReal value = exact_decimal(digits, unit);
    return {{value, unit.dimension}, begin, at_};
  }

  // Of the longest text that is a unit: symbols joined by blanks, dots and '/'. A '*' joins factors instead.
  std::size_t unit_length(std::size_t begin) const {
    std::size_t longest = 0;
    for (std::size_t end = begin + 1; end <= text_.size() && !joins_factors(end - 1); ++end) {
      if (text_[end - 1] == ' ' || (end < text_.size() && is_name_byte(text_[end]))) continue;
      const std::string_view unit = text_.substr(begin, end - begin);
      if (is_unit(unit)) longest = unit.size();
    }
    return longest;
  }

  bool joins_factors(std::size_t at) const {
    const bool is_exponent_sign = text_[at] == '-' && text_[at - 1] == '^';
    return !is_exponent_sign && std::string_view("*+-").find(text_[at]) != std::string_view::npos;
  }

  Term named(std::size_t begin) {
    const std::string name(rest().substr(0, name_length(rest())));
    at_ += name.size();
    if (name == "pi") return {{boost::math::constants::pi<ExactReal>(), dimensions::number}, begin, at_};
    if (rest().starts_with('(')) return function(name, begin);
    if (!scope_.read) {
      report_no_quantity(decl_, diagnostics_);
      return failed();
    }
    const std::optional<ExactQuantity> value = scope_.read({name, part_of(decl_, begin, begin + name.size())});
    if (!value) return failed();
    return {*value, begin, begin + name.size()};
  }

  Term function(const std::string& name, std::size_t begin) {
    if (!is_function(name)) {
      diagnostics_.report<DiagnosticCode::unknown_function>(part_of(decl_, begin, begin + name.size()), excerpt(name));
      return failed();
    }
    accept('(');
    if (++depth_ > deepest_expression) return fail_too_deep();
    Term argument = sum();
    if (!failed_ && !accept(')')) return fail_at_rest("an operator or ')'");
    --depth_;
    if (!failed_) argument = apply(name, argument);
    argument.begin = begin;
    argument.end = at_;
    return argument;
  }

  Term apply(const std::string& name, Term argument) {
    if (name == "sqrt") return raise(argument, ExactReal(0.5), "1/2");
    if (!(argument.quantity.dimension == dimensions::number)) return fail_not_plain(argument, name);
    if (name == "ln" && !(argument.quantity.value > 0)) {
      diagnostics_.report<DiagnosticCode::logarithm_of_zero>(place(argument), text_of(argument));
      return failed();
    }
    const ExactReal& x = argument.quantity.value;
    argument.quantity.value = name == "ln" ? ExactReal(log(x)) : ExactReal(exp(x));
    return argument;
  }

  Term fail_sum(const Term& left, const Term& right) {
    diagnostics_.report<DiagnosticCode::sum_of_dimensions>(part_of(decl_, left.begin, right.end), text_of(left),
                                                           describe(left.quantity.dimension), text_of(right),
                                                           describe(right.quantity.dimension));
    return failed();
  }

  Term fail_not_plain(const Term& term, std::string_view taker) {
    diagnostics_.report<DiagnosticCode::not_a_plain_number>(place(term), text_of(term),
                                                            describe(term.quantity.dimension), taker);
    return failed();
  }

  Term fail_too_deep() {
    if (!failed_) diagnostics_.report<DiagnosticCode::expression_too_deep>(decl_.span, deepest_expression);
    return failed();
  }

  Term fail_at_rest(std::string_view expected) {
    const std::size_t begin = skip();
    if (begin >= text_.size()) {
      diagnostics_.report<DiagnosticCode::expression_ends>(decl_.span, excerpt(decl_.text), expected);
      return failed();
    }
    const std::size_t length =
        std::max<std::size_t>({first_code_points(rest(), 1).size(), name_length(rest()), decimal_length(rest())});
    diagnostics_.report<DiagnosticCode::expression_syntax>(part_of(decl_, begin, begin + length),
                                                           excerpt(rest().substr(0, length)), expected);
    note_other_spelling(begin, expected.starts_with("an operator"));
    return failed();
  }

  // Notes how to write an operator that is spelt as elsewhere: "G × a", "G ** 2".
  void note_other_spelling(std::size_t begin, bool after_operand) {
    const auto is_any_of = [this](std::initializer_list<std::string_view> signs) {
      return std::any_of(signs.begin(), signs.end(),
                         [this](std::string_view sign) { return rest().starts_with(sign); });
    };
    if (is_any_of({"·", "⋅", "×", "∙"})) diagnostics_.note<DiagnosticCode::write_product>({});
    else if (is_any_of({"−", "–"})) diagnostics_.note<DiagnosticCode::write_instead>({}, "-");
    else if (is_any_of({"÷"})) diagnostics_.note<DiagnosticCode::write_instead>({}, "/");
    else if (rest().starts_with('*') && begin > 0 && text_[begin - 1] == '*')
      diagnostics_.note<DiagnosticCode::write_instead>({}, "^");
    else if (after_operand && (name_length(rest()) > 0 || rest().starts_with('(')))
      diagnostics_.note<DiagnosticCode::write_product>({});
  }

  Term failed() {
    failed_ = true;
    return {};
  }

  std::size_t skip() { return at_ += blanks(text_.substr(at_)); }
  std::string_view rest() const { return text_.substr(std::min(at_ + blanks(text_.substr(at_)), text_.size())); }

  bool accept(char byte) {
    if (!rest().starts_with(byte)) return false;
    skip();
    ++at_;
    return true;
  }

  Span place(const Term& term) const { return part_of(decl_, term.begin, term.end); }
  std::string text_of(const Term& term) const { return excerpt(text_.substr(term.begin, term.end - term.begin)); }

  const ValueDecl& decl_;
  std::string_view text_;
  const NameScope& scope_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

bool is_expression(const ValueDecl& decl, const NameScope& scope) {
  if (decl.form == ValueDecl::Form::number || is_plain(decl.text, scope) || !has_only_expression_bytes(decl.text))
    return false;
  const bool opens = std::string_view(decl.text).substr(blanks(decl.text)).starts_with('(');
  // A parameter with the name of a unit does not turn a misspelt quantity such as "5 N/m s" into an expression.
  const NameScope no_units{[&](std::string_view name) { return scope.knows(name) && !is_unit(name); }, scope.read};
  return opens || has_operator(decl.text) || has_known_name(decl.text, no_units);
}

std::optional<Quantity> read_expression(const ValueDecl& decl, const NameScope& scope, Diagnostics& diagnostics) {
  const std::optional<ExactQuantity> exact = ExpressionReader(decl, scope, diagnostics).read();
  if (!exact) return std::nullopt;
  const double rounded = exact->value.convert_to<double>();
  if (std::isfinite(rounded) && (rounded != 0 || exact->value == 0))
    return Quantity{rounded, exact->dimension, exact->value};
  if (rounded == 0) diagnostics.report<DiagnosticCode::number_too_small>(decl.span, excerpt(decl.text));
  else diagnostics.report<DiagnosticCode::number_too_large>(decl.span, excerpt(decl.text));
  return std::nullopt;
}

bool is_stated(const ValueDecl& decl, const NameScope& scope) {
  return is_expression(decl, scope) || is_quantity(decl);
}

std::optional<Quantity> read_stated(const ValueDecl& decl, const NameScope& scope, Diagnostics& diagnostics) {
  return is_expression(decl, scope) ? read_expression(decl, scope, diagnostics) : read_quantity(decl, diagnostics);
}

std::optional<Quantity> quantity_in(const ValueDecl& decl) {
  const NameScope no_names;
  Diagnostics of_reader;
  return is_stated(decl, no_names) ? read_stated(decl, no_names, of_reader) : std::nullopt;
}

}  // namespace dashpot::compiler
