#include "network/unit.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t longest_unit = 100;  // [bytes]: keeps every exponent far from overflow

constexpr UnitSymbol symbols[] = {
    {"N", {dimensions::force}, true},
    {"m", {dimensions::length}, true},
    {"s", {dimensions::time}, true},
    {"rad", {dimensions::angle}, true},
    {"g", {dimensions::mass, -3}, true},
    {"A", {dimensions::current}, true},
    {"Hz", {dimensions::frequency}, true},
    {"J", {dimensions::torque}, true},
    {"W", {{1, 2, -3}}, true},
    {"Pa", {{1, -1, -2}}, true},
    {"V", {{1, 2, -3, -1}}, true},
    {"T", {{1, 0, -2, -1}}, true},
    {"ohm", {{1, 2, -3, -2}}, true},
    {"Ω", {{1, 2, -3, -2}}, true},
    {"min", {dimensions::time, 0, 1}, false},
    {"rpm", {dimensions::angular_velocity, -1, 1, 1}, false},  // 360°/min = 6°/s
    {"deg", {dimensions::angle, 0, 0, 1}, false},
    {"°", {dimensions::angle, 0, 0, 1}, false},
    {"%", {dimensions::number, -2}, false},
};

constexpr UnitPrefix prefixes[] = {
    {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6}, {"m", -3}, {"c", -2},
    {"d", -1},  {"da", 1},  {"h", 2},  {"k", 3},  {"M", 6},  {"G", 9},  {"T", 12},
};

const UnitSymbol* find_symbol(std::string_view text) {
  const auto found =
      std::find_if(std::begin(symbols), std::end(symbols), [&](auto& symbol) { return symbol.text == text; });
  return found == std::end(symbols) ? nullptr : found;
}

std::optional<Unit> find_unit(std::string_view text) {
  if (const UnitSymbol* symbol = find_symbol(text)) return symbol->unit;
  for (const UnitPrefix& prefix : prefixes) {
    if (!text.starts_with(prefix.text)) continue;
    const UnitSymbol* symbol = find_symbol(text.substr(prefix.text.size()));
    if (symbol == nullptr || !symbol->takes_prefix) continue;
    Unit unit = symbol->unit;
    unit.power_of_ten += prefix.power_of_ten;
    return unit;
  }
  return std::nullopt;
}

// x · yⁿ
Unit times(const Unit& x, const Unit& y, int n) {
  return {product(x.dimension, power(y.dimension, n)), x.power_of_ten + n * y.power_of_ten,
          x.power_of_sixty + n * y.power_of_sixty, x.power_of_degree + n * y.power_of_degree};
}

constexpr std::string_view superscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::variant<Unit, UnitFault> parse() {
    if (text_.size() > longest_unit) fail(UnitFault::Kind::malformed, 0, text_.size());
    const Unit unit = quotient();
    if (!fault_ && at_ < text_.size()) fail_here();
    const std::size_t percent = text_.find('%');
    if (percent != std::string_view::npos && text_ != "%")
      fail(UnitFault::Kind::percent_in_product, percent, percent + 1);
    if (fault_) return *fault_;
    return unit;
  }

 private:
  Unit quotient() {
    if (accept("1")) {  // as in "1/s"
      skip_blanks();
      if (!text_.substr(at_).starts_with('/')) fail_here();
    }
    Unit unit = at_ > 0 ? Unit{} : factor();
    bool divided = false;
    while (!fault_ && starts_factor()) {
      const std::size_t begin = at_;
      const bool divides = accept_separator();
      if (divided && !divides) fail(UnitFault::Kind::product_after_slash, begin, text_.size());
      unit = times(unit, divides ? divisor() : factor(), divides ? -1 : 1);
      divided = divided || divides;
    }
    return unit;
  }

  Unit divisor() {
    if (!accept("(")) return factor();
    Unit unit = factor();
    skip_blanks();
    while (!fault_ && !accept(")")) {
      if (accept_separator()) fail_here();
      unit = times(unit, factor(), 1);
      skip_blanks();
    }
    return unit;
  }

  Unit factor() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_symbol_byte()) ++at_;
    if (at_ == begin) return fail_here();
    const std::optional<Unit> unit = find_unit(text_.substr(begin, at_ - begin));
    if (!unit) return fail(UnitFault::Kind::unknown_symbol, begin, at_);
    return times({}, *unit, exponent());
  }

  // A letter, or a byte of a character beyond ASCII that means nothing else.
  bool is_symbol_byte() const {
    const auto byte = static_cast<unsigned char>(text_[at_]);
    if ((byte | 0x20) >= 'a' && (byte | 0x20) <= 'z') return true;
    return byte == '%' || (byte >= 0x80 && !at_dot() && !superscript_digit() && !text_.substr(at_).starts_with("⁻"));
  }

  int exponent() {
    if (accept("^")) return digits(accept("-") ? -1 : 1);
    const int sign = accept("⁻") ? -1 : 1;
    const std::optional<int> digit = superscript_digit();
    if (!digit) return sign > 0 ? 1 : (fail_here(), 1);
    accept(superscripts[*digit]);
    return sign * *digit;
  }

  int digits(int sign) {
    if (at_ == text_.size() || text_[at_] < '0' || text_[at_] > '9') return fail_here(), 1;
    return sign * (text_[at_++] - '0');
  }

  std::optional<int> superscript_digit() const {
    for (int digit = 0; digit < 10; ++digit)
      if (text_.substr(at_).starts_with(superscripts[digit])) return digit;
    return std::nullopt;
  }

  bool at_dot() const { return text_.substr(at_).starts_with("·") || text_.substr(at_).starts_with("⋅"); }

  bool starts_factor() {
    const std::size_t before = at_;
    skip_blanks();
    if (at_ == text_.size()) return false;
    return at_ > before || at_dot() || text_[at_] == '*' || text_[at_] == '/';
  }

  // True for a '/'.
  bool accept_separator() {
    skip_blanks();
    const bool divides = accept("/");
    if (!divides && !accept("*") && !accept("·")) accept("⋅");
    skip_blanks();
    return divides;
  }

  bool accept(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  Unit fail_here() { return fail(UnitFault::Kind::malformed, at_, text_.size()); }

  Unit fail(UnitFault::Kind kind, std::size_t begin, std::size_t end) {
    if (!fault_) fault_ = UnitFault{kind, begin, end};
    return {};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::optional<UnitFault> fault_;
};

std::optional<std::string> split(std::string_view symbol);

// A factor with a prefix, as the "cm" of "gcm".
std::optional<std::string> split_behind_prefix(std::string_view symbol) {
  for (const UnitPrefix& prefix : prefixes) {
    if (!symbol.starts_with(prefix.text)) continue;
    const std::string_view rest = symbol.substr(prefix.text.size());
    for (std::size_t length = std::min<std::size_t>(3, rest.size()); length > 0; --length) {
      const UnitSymbol* known = find_symbol(rest.substr(0, length));
      if (known == nullptr || !known->takes_prefix) continue;
      if (const auto others = split(rest.substr(length)))
        return std::string(prefix.text) + std::string(rest.substr(0, length)) + (others->empty() ? "" : " ") + *others;
    }
  }
  return std::nullopt;
}

// Longest symbols first, so that "rad" is not read as "r a d".
std::optional<std::string> split(std::string_view symbol) {
  if (symbol.empty()) return std::string();
  // "mm" is no product of a metre and a metre.
  if (symbol.size() > 1 && symbol[0] == symbol[1])
    if (const auto prefixed = split_behind_prefix(symbol)) return prefixed;
  for (std::size_t length = std::min<std::size_t>(3, symbol.size()); length > 0; --length) {
    const std::string_view first = symbol.substr(0, length);
    if (find_symbol(first) == nullptr || first == "rpm") continue;  // nobody multiplies a speed by anything
    if (const auto rest = split(symbol.substr(length)))
      return std::string(symbol.substr(0, length)) + (rest->empty() ? "" : " ") + *rest;
  }
  return split_behind_prefix(symbol);
}

// A prefix in front is the likelier reading: "mNm" is rather "mN m" than "m N m".
std::optional<std::string> split_prefixed(std::string_view symbol) {
  for (const UnitPrefix& prefix : prefixes) {
    if (!symbol.starts_with(prefix.text) || symbol == prefix.text) continue;
    if (const auto rest = split(symbol.substr(prefix.text.size()))) return std::string(prefix.text) + *rest;
  }
  return split(symbol);
}

}  // namespace

std::span<const UnitSymbol> unit_symbols() { return symbols; }
std::span<const UnitPrefix> unit_prefixes() { return prefixes; }

std::variant<Unit, UnitFault> parse_unit(std::string_view text) { return UnitParser(text).parse(); }

std::string unit_in_other_case(std::string_view symbol) {
  const std::string small = folded(symbol);
  std::string found;
  const auto consider = [&](const std::string& known) {
    if (folded(known) != small) return true;
    if (!found.empty()) return false;
    found = known;
    return true;
  };
  for (const UnitSymbol& known : symbols) {
    if (!consider(std::string(known.text))) return {};
    for (const UnitPrefix& prefix : prefixes)
      if (known.takes_prefix && !consider(std::string(prefix.text) + std::string(known.text))) return {};
  }
  const bool makes_nano_of_newton = symbol.starts_with('N') && found.starts_with('n');
  return makes_nano_of_newton ? std::string() : found;
}

std::string spaced_unit(std::string_view symbol) {
  constexpr std::size_t longest_symbol = 12;  // splitting is exponential, and nobody runs more units together
  if (symbol.size() > longest_symbol) return {};
  return split_prefixed(symbol).value_or("");
}

}  // namespace dashpot::compiler
