#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "check.hpp"
namespace dashpot_check {
namespace {
Form operator+(Form sum, const Form& other) {
  for (const auto& [name, value] : other)
    if ((sum[name] += value) == 0) sum.erase(name);
  return sum;
}
Form operator*(const Rational& factor, Form form) {
  for (auto& [name, value] : form) value *= factor;
  return factor == 0 ? Form{} : form;
}
Form operator-(const Form& left, const Form& right) { return left + Rational(-1) * right; }
Form substituted(const Form& form, const Forms& values) {
  Form result;
  for (const auto& [name, value] : form) result = std::move(result) + value * values.at(name);
  return result;
}
Rational of(const Form& form, const std::string& name) { return form.count(name) ? form.at(name) : Rational(0); }
// How a header is normalised: comments go, blanks become one space, and clamps and flushes become the expressions that
// are left while the motor is within its limit and nothing is flushed to zero.
const std::pair<const char*, const char*> readings[] = {
    {R"#("[^"\\\n]*"|//[^\n]*|\bDASHPOT_UNROLL\b| noexcept|alignas\(\d+\)|dashpot::(?!generated))#", ""},
    {R"(\s+)", " "},
    {R"(partial_sums<[^;]*> lane; )", "sampled_lane = 0; "},
    {R"(lane\.add\(j - i, )", "sampled_lane = (sampled_lane + "},
    {R"(lane\.total\(\))", "sampled_lane"},
    {R"(vector::put\((\w+), j, )", "$1[j] = ("},
    {R"(vector::at\((\w+), j\))", "$1[j]"},
    {R"(relaxed\(threshold, (\w+), (\w+), )", "($1 * $2 + "},
    {R"((vector::)?flush_below\(threshold, |clamp_to\(motor_limit, |vector::in_register\()", "("},
    {R"(\(wanted - force\) \* wanted > 0 \? force / wanted : all_kept)", "all_kept"},
    {R"(rest_shift_ > 0 \? \(position > 0 \? \(rest_shift_ - position > 0 \? position : rest_shift_\) : no_shift\) : )"
     R"(\(position > 0 \? no_shift : \(rest_shift_ - position > 0 \? rest_shift_ : position\)\))",
     "rest_shift_ + no_shift"}};
// The forms of a header's statements, once it has been normalised by `readings`.
struct Header : Program {
  explicit Header(std::string text) {
    if (std::regex_search(text, std::regex(R"(\\\s|\?\?/|\r|/\*)"))) throw Unknown("a remark is not of one line");
    for (const auto& [known, reading] : readings) text = std::regex_replace(text, std::regex(known), reading);
    is_float_ = text.find("using scalar = float; ") != text.npos;
    const std::size_t own = text.find("private: ");  // numbers and states, which are needed first
    text = text.substr(own) + text.substr(0, own);
    left_ = text.c_str();
    next = {{"", {{"", 1}}}, {"sampled_", {}}, {"sampled_lane", {}}};  // what is returned; sums over loops
    constants = {{"position", 0}, {"velocity", 0}, {"true", 1}, {"sampled_", 0}, {"sampled_lane", 0}};  // taken names
    while (!take("command<scalar> output(scalar position, scalar velocity) { ")) read_part();
    Forms at_rest = next;
    while (!take("void update() { ")) read_part();
    while (!take("command<scalar> step(scalar position, scalar velocity) { ")) read_part();
    Forms apart = next;
    if (!take("const command<scalar> now = output(position, velocity); update(); return now; } ")) next = at_rest;
    while (*left_) read_part();
    for (Forms* of : {&next, &apart, &at_rest})
      std::erase_if(*of, [](const auto& state) { return state.first.starts_with("sampled_"); });
    if (apart != next || next.size() != at_rest.size()) throw Unknown("step() is not output() and update()");
    force = next.extract("").mapped();
  }
  void read_part() {
    static const std::regex declaration(
        R"((?:scalar|(static constexpr )(?:scalar|unsigned(?= loop_delay = \d+;))) (\w+)(?:\[(\d+)\])? = \{?)");
    static const std::regex assignment(R"((const (?:scalar|vector) )?(\w+(?:\[\d+\])?) = |return \{damping, )");
    static const std::regex rolled(R"(for \(int i = 0; i < (\d+); i \+= (\d+)\) )"
                                   R"(for \(int j = i; j < i \+ \2; j \+= vector::width\) \{ ([^{}]*)\} )");
    // Text that computes nothing, nothing in a sample, or nothing as long as samples are finite and no state is small.
    static const std::regex frame(
        R"( ?#pragma once (?:#include <dashpot/\w+\.hpp> )+namespace dashpot::generated \{ class \w+ \{ public: |)"
        R"(private: |using scalar = (?:double|float); |static constexpr motion port_motion = motion::\w+; |struct )"
        R"(certified_for \{ static constexpr bool any_device = \w+; (?:static constexpr const char\* (?:device|)"
        R"(device_digest|estimator) = ; )*|static constexpr bool is_certified = \w+; \}; |struct parameters \{\}; |)"
        R"(int \w+_turn_ = 0; |bool sampled_ = false; |\}; |\} |using vector = vector<scalar, vector_width<scalar, )"
        R"(\d+>, \d+>; |if \(!all_finite\([\w, ]*\)\) (?:return \{damping, 0\}; |\{ (?:sampled_ = false; )?return )"
        R"(\{damping, 0\}; \} )|void reset\(scalar position = 0\) \{ (?:static_cast<void>\(position\); |)"
        R"(last_position_ = all_finite\(position, position, position\) \? position : 0; )(?:\w+_ = (?:0|false); |)"
        R"(clear\(\w+_\); )*\} |unsigned set\(const parameters&\) \{ return 0; \} |scalar \w+\(\) const \{ (?:[^{}]|)"
        R"(\{[^{}]*\})*\} |template <unsigned size> static void clear\(volatile scalar \(&states\)\[size\]\) \{ for )"
        R"(\(unsigned i = 0; i < size; \+\+i\) states\[i\] = 0; \} |for \(int j = 0, first = (\w+_)turn_; j < (\d+); j \+= )"
        R"(vector::width\) vector::put\(\1, first \+ j, \(vector::at\(\1, first \+ j\)\)\); \1turn_ \+= \2; \1turn_ = )"
        R"(\1turn_ < \d+ \? \1turn_ : 0; )");
    if (take(frame) || (next["sampled_"] == Form{{"", 1}} && take("if (!sampled_) return; "))) return;
    if (take(rolled)) {
      std::string all;
      for (int j = 0, step = std::stoi(found_[2]); j % step != 0 || j < std::stoi(found_[1]); ++j)
        all += std::regex_replace(found_[3].str(), std::regex(R"(\[j\])"), "[" + std::to_string(j) + "]");
      const char* const after = std::exchange(left_, all.c_str());
      const Forms outside = others_;  // names that the loop declares end with it
      while (*left_) read_part();
      others_ = outside, left_ = after;
    } else if (take(declaration)) {  // of a constant, or of a state, which begins at zero
      const bool is_state = !found_[1].matched;
      const std::string called = found_[2], size = found_[3];
      for (int i = 0; i < (size.empty() ? 1 : std::stoi(size)); ++i, take(", ")) {
        const std::string cell = size.empty() ? called : called + "[" + std::to_string(i) + "]";
        const Rational value = *left_ == '}' ? Rational(0) : literal();
        if (!constants.emplace(cell, value).second || (is_state && value != 0)) refuse();
        if (is_state) states.push_back(cell);
        (is_state ? next : others_)[cell] = {{is_state ? cell : "", is_state ? 1 : value}};
      }
      expect(size.empty() ? "; " : "}; ");
    } else if (take(assignment) && !(found_[1].matched && constants.contains(found_[2]))) {
      Form& to = found_[1].matched ? others_[found_[2]] : next.at(found_[2]);
      const char* const end = found_[2].matched ? "; " : "}; } ";
      to = sum(), expect(end);
    } else refuse();
  }
  Form sum() {
    Form all, term = factor();
    for (;;)
      if (take(" + ")) all = all + std::exchange(term, factor());
      else if (take(" - ")) all = all + std::exchange(term, Rational(-1) * factor());
      else if (take(" * ")) term = product(term, factor());
      else return all + term;
  }
  Form product(const Form& left, const Form& right) const {
    if (left.size() == left.count("")) return of(left, "") * right;
    return right.size() == right.count("") ? of(right, "") * left : (refuse(), Form());
  }
  Form factor() {
    static const std::regex word(R"([A-Za-z_]\w*(\[\d+\])?)");
    if (take(word)) return (next.contains(found_[0]) ? next : others_).at(found_[0]);
    if (!take("(")) return {{"", literal()}};
    const Form value = sum();
    return expect(")"), value;
  }
  Rational literal() {  // as a C++ compiler reads it
    static const std::regex number(R"(-?(?:0|[1-9]\d*)(?:(\.\d*(?:e[-+]?\d+)?|e[-+]?\d+)(f?))?)");
    const char* const at = left_;
    if (!take(number) || (found_[1].matched && is_float_ != (found_[2].length() > 0))) refuse();
    const double value = is_float_ ? double(std::strtof(at, nullptr)) : std::strtod(at, nullptr);
    return std::isfinite(value) ? Rational(value) : (refuse(), Rational());
  }
  bool take(const std::string& it) { return std::string_view(left_).starts_with(it) && (left_ += it.size(), true); }
  bool take(const std::regex& pattern) {
    const bool is_next = std::regex_search(left_, found_, pattern, std::regex_constants::match_continuous);
    return is_next && (left_ += found_.length(), true);
  }
  void expect(const std::string& text) { take(text) || (refuse(), false); }
  [[noreturn]] void refuse() const { throw Unknown("this is not known: " + std::string(left_).substr(0, 60)); }
  const char* left_;   // what has not been read
  std::cmatch found_;  // by a pattern, with its parts
  bool is_float_;
  Forms others_ = {
      {"position", {{"position", 1}}}, {"velocity", {{"velocity", 1}}}, {"true", {{"", 1}}}, {"false", {}}};
};
std::string displacement(unsigned age) { return "q" + std::to_string(age); }
Form add(LoopForm& loop, const std::string& state, const Form& next) {
  return loop.states.push_back(state), loop.next[state] = next, Form{{state, 1}};
}
// The velocity estimate in terms of the states after the sample; adds its own. Its coefficients are checked too.
Form estimate(const Device& device, LoopForm& loop) {
  const std::string& kind = device.estimator;
  const bool adapts = kind == "foaw", slope = adapts ? device.best_fit : kind == "least_squares";
  std::size_t at = adapts ? device.chosen - 1 : 0;
  const auto coefficient = [&](long double derived, long double off = 1e-13L) {
    const double given = device.estimator_coefficients.at(at++);
    if (std::fabs(given - derived) <= off * std::fabs(derived)) return Rational(given);
    throw Unknown("a coefficient of the estimator is not what its description gives");
  };
  const long double T = device.sample_period, turn = std::acos(-1.0L), share = device.cutoff * device.sample_period;
  const Form arriving = loop.next.at(displacement(device.delay_samples));
  if (kind == "butterworth") {  // sections of two trapezoidal integrators
    const long double warped = std::sin(turn * share) / std::sin(turn * (0.5L - share));
    Form value = coefficient(1 / T) * arriving;
    const Rational g = coefficient(warped);
    for (unsigned i = 0, order = device.order < 4 ? 2 : 4; i < order / 2; ++i) {
      const long double k = 2 * std::sin(turn * (order - 1 - 2 * i) / (2 * order));
      const std::string band = "band" + std::to_string(i), low = "low" + std::to_string(i);
      const Rational solve = coefficient(1 / (1 + warped * (warped + k))), damped = coefficient(warped + k);
      const Form high = solve * (value + Form{{band, -damped}, {low, -1}}), middle = Form{{band, 1}} + g * high;
      value = Form{{low, 1}} + g * middle;
      add(loop, band, middle + g * high), add(loop, low, value + g * middle);
    }
    return add(loop, "estimate", value);
  }
  if (kind == "kalman") {  // e ← Δ + r² e − T v̂, v̂ ← v̂ + (β/T) e
    const long double L = device.acceleration * T * T * std::sqrt(12.0L) / device.joint_encoder_step;
    const long double r = 4 / (4 + L + std::sqrt(8 * L + L * L)), gain = 2 * (1 - r) * (1 - r) / T;
    const Rational period = coefficient(T), leak = coefficient(r * r), beta = coefficient(gain, 1e-14L / (1 - r));
    const Form innovation = arriving + Form{{"innovation", leak}, {"estimate", -period}};
    return add(loop, "innovation", innovation), add(loop, "estimate", Form{{"estimate", 1}} + beta * innovation);
  }
  if (kind == "interval_difference") {
    if (device.jitter >= device.sample_period) throw Unknown("the estimate may divide by no time at all");
    Form oldest = loop.next.at(displacement(0));
    for (unsigned age = 0; age <= device.delay_samples; ++age) oldest = add(loop, "pace" + std::to_string(age), oldest);
    return oldest;
  }
  if (!adapts && !slope && kind != "difference of two samples" && kind != "backward_difference")
    throw Unknown("nothing is known of the estimator " + kind);
  if (adapts && device.amplifier_lag) throw Unknown("the window adapts, and the force that lacks is of two windows");
  const unsigned longest = kind == "difference of two samples" ? 1 : std::max(device.window, 1u);
  const unsigned n = adapts ? device.chosen : longest;
  const Rational rate = coefficient((slope ? 6.0L / (n * (n + 1.0L) * (n + 2.0L)) : 1.0L / n) / T);
  Form sum;
  for (unsigned j = 0, age = device.delay_samples; j < longest; ++j, ++age) {
    if (j > 0) add(loop, displacement(age), {{displacement(age - 1), 1}});
    if (j < n) sum[displacement(age)] = rate * (slope ? (j + 1) * (n - j) : 1);
  }
  return sum;
}
Integer whole(const Rational& value, unsigned digits) {  // value · 2^digits, rounded down
  const Integer scaled = numerator(value) << digits, left = scaled % denominator(value);
  return (scaled - left) / denominator(value) - (left < 0 ? 1 : 0);
}
Rational below(const Rational& value, unsigned digits = 90) { return {whole(value, digits), Integer(1) << digits}; }
Rational above(const Rational& value, unsigned digits = 90) { return -below(-value, digits); }
// A lower and an upper bound of e^{−x}, x = time/lag: (1 − x/n)ⁿ and (1 + x/n)⁻ⁿ, which differ by a share of x²/n.
std::pair<Rational, Rational> enclosed_decay(const Rational& time, const Rational& lag) {
  if (lag == 0) return {0, 0};
  const Rational part = time / lag / (Integer(1) << 110);
  Integer low = whole(std::max(Rational(1 - part), Rational(0)), 220), high = -whole(-1 / (1 + part), 220);
  for (int squarings = 0; squarings < 110; ++squarings) low = low * low >> 220, high = (high * high >> 220) + 1;
  return {below({low, Integer(1) << 220}), above({high, Integer(1) << 220})};
}
// The inequality's matrix for one hold, over the states, w, late and ρ, on and below the diagonal. Each of its three
// factors is scaled by 2^digits, so that entries are whole numbers; only the damping's heat is rounded, downwards.
Matrix matrix_of(LoopForm loop, const Matrix& P, unsigned digits, const Rational& damping, const Hold& hold) {
  const std::size_t n = P.size(), lags = hold.spread != 0 && !loop.next.at("lacking").empty();  // else it is none
  const std::size_t known = n + 1 + (hold.after != 0);
  if (lags) loop.next["lacking"]["lacking"] += hold.decay, loop.next[""]["lacking"] += hold.share;
  std::map<std::string, std::size_t> place = {{"w", n}, {"late", n + 1}, {"", n}};
  for (const std::string& state : loop.states) place.emplace(state, place.size() - 3);
  Matrix M(known + lags, std::vector<Integer>(known + lags)), A(n + 1, std::vector<Integer>(known));  // and B; C
  for (const auto& [state, next] : loop.next)
    for (const auto& [name, value] : next)
      A[place.at(state)][place.at(name)] += whole(state == "pace0" ? Rational(value * hold.rate) : value, digits);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Integer> PA(known);  // a row of it
    for (std::size_t l = 0; l < n; ++l)
      for (std::size_t j = 0; j < known; ++j)
        if (A[l][j] != 0) PA[j] += P[k][l] * A[l][j];
    for (std::size_t i = 0; i < known; ++i)
      for (std::size_t j = 0; j <= i && A[k][i] != 0; ++j) M[i][j] -= A[k][i] * PA[j];
    for (std::size_t j = 0; j <= k; ++j) M[k][j] += P[k][j] << (2 * digits);
    M[n][k] += A[n][k] << (2 * digits - 1);
  }
  const auto heat = [&](const Rational& time) { return whole(damping / time, 3 * digits); };
  M[n][n] += heat(hold.before) + whole(-loop.stiffness / 2, 3 * digits);
  if (known > n + 1) M[n + 1][n] -= heat(hold.before), M[n + 1][n + 1] += heat(hold.before) + heat(hold.after);
  if (known > n + 1) M[n + 1][n - 1] += whole(hold.tilt / 2, 3 * digits);
  if (lags) M[known][n - 1] = Integer(1) << (3 * digits - 1), M[known][known] = heat(hold.spread);
  return M;
}
// Whether M, which is read on and below the diagonal, is L D Lᵀ + R with D > 0 and R diagonally dominant, by
// elimination, once its last binary digits are dropped. Entries are rounded, by less than one each time: until row k is
// eliminated, all roundings in it come to less than n (k + 1), which R keeps of its diagonal.
bool is_nonnegative(Matrix M, unsigned dropped) {
  const std::size_t n = M.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n && M[i][i] <= 0; ++j)  // then the rest of its row and column has to be zero
      if (M[std::max(i, j)][std::min(i, j)] != 0) return false;
    if (M[i][i] == 0) M[i][i] = Integer(1) << (dropped + 2 * n);
    for (std::size_t j = 0; j <= i; ++j) M[i][j] >>= dropped;
  }
  for (std::size_t k = 0; k < n; ++k) {
    M[k][k] -= n * (k + 1);
    if (M[k][k] <= 0) return false;
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j <= i; ++j) M[i][j] -= M[i][k] * M[j][k] / M[k][k];
  }
  return true;
}
// β of a motor that position alone drives, without lag: V⁺ − V ≤ m w + β w² with V = ½ k0 u² + Σ F²/(2 c) and
// β = k0/2 + Σ c/(1 + a) + |the answer within a sample that no mode explains|.
Rational hold_stiffness(const LoopForm& loop, const Device& device) {
  const std::string drive = displacement(device.delay_samples);
  Rational sum = loop.stiffness / 2, left = of(loop.force, drive);
  if (device.amplifier_lag != 0 || loop.stiffness < 0 || holds(device).empty())  // holds() throws if times contradict
    throw Unknown("the amplifier lags, or the spring pushes");
  for (std::size_t i = device.delay_samples + 1 + (device.write_latest > 0); i < loop.states.size(); ++i) {
    const Form& next = loop.next.at(loop.states[i]);
    const Rational a = of(next, loop.states[i]), d = of(next, drive);
    if (next.size() != (a == 0 ? 1u : 2u) || a < 0 || a >= 1 || d <= 0 || of(loop.force, loop.states[i]) != 1)
      throw Unknown("'" + loop.states[i] + "' is not a mode that relaxes and that position alone drives");
    sum += a == 0 ? d : Rational(d / (a + a * a)), left -= a == 0 ? Rational(0) : Rational(d / a);
  }
  return sum + abs(left);
}
}  // namespace
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Device, sample_period, jitter, write_earliest, write_latest, amplifier_lag, cutoff,
                                   acceleration, joint_encoder_step, delay_samples, window, order, best_fit, estimator,
                                   estimator_coefficients)

LoopForm loop_form(Program program, const Device& device) {
  if (device.delay_samples > 1000 || device.window > 1000) throw Unknown("more than a thousand samples are remembered");
  auto& next = program.next;
  next[""] = program.force;
  const auto stays_at_zero = [](const auto& of) { return of.second.size() == of.second.count(of.first); };
  for (auto at = next.begin(); (at = std::ranges::find_if(next, stays_at_zero)) != next.end(); next.erase(at))
    for (auto& [other, form] : next) form.erase(at->first);
  LoopForm loop;
  Form position = {{"u", 1}}, drive = {{"w", 1}};  // as the law sees them
  if (device.write_latest > 0) position = position - add(loop, "moved", {{"late", 1}});
  if (device.write_latest > 0) drive = drive + Form{{"moved", 1}, {"late", -1}};
  for (unsigned age = 0; age <= device.delay_samples; ++age)
    position = age > 0 ? position - drive : position, drive = add(loop, displacement(age), drive);
  Form sum, all;  // of all states except a last position, and of their next values
  for (const auto& [state, form] : next)
    if (!state.empty() && form != Form{{"position", 1}}) sum[state] = 1, all = std::move(all) + form;
  Forms values = {{"position", position}};
  if (std::ranges::any_of(next, [](const auto& of) { return of.second.contains("velocity"); }))
    values["velocity"] = estimate(device, loop);
  for (const std::string& state : program.states) {
    if (!next.contains(state)) continue;
    if (next[state] == Form{{"position", 1}}) values[state] = position - drive;
    else if (!all.count(state) && all == Rational(2) * next[state]) values[state] = sum - Form{{state, 1}};
    else values[state] = add(loop, state, next[state]);
  }
  for (auto& [state, form] : loop.next)
    if (next.count(state)) form = substituted(form, values);
  loop.force = substituted(next[""], values);
  if (const auto of_position = loop.force.extract("u")) loop.stiffness = of_position.mapped();
  if (device.amplifier_lag == 0) return loop;
  values = loop.next, values["w"] = {{"w", 1}};
  add(loop, "lacking", loop.force - loop.stiffness * Form{{"w", 1}} - substituted(loop.force, values));
  return loop;
}
std::vector<Hold> holds(const Device& device) {
  const Rational period = device.sample_period, jitter = device.jitter, lag = device.amplifier_lag;
  const Rational soonest = device.write_earliest, latest = device.write_latest, wait = latest - soonest;
  const Rational first = std::max(Rational(period - jitter), Rational(0)),
                 then = latest > 0 ? Rational(lag / latest) : latest;
  const bool divides = device.estimator == "interval_difference" && first > 0, is_late = latest > 0;
  if (period <= 0 || jitter < 0 || lag < 0 || soonest < 0 || wait < 0 || (is_late && latest > first))
    throw Unknown("a time is negative, or a sample may be read before the command before it acts");
  const int parts = jitter == 0 || (lag == 0 && !(divides && is_late)) ? 1 : 6;
  std::vector<Hold> holds;
  for (int i = 0; i < parts; ++i) {
    const Rational step = (period + jitter - first) / parts, shortest = first + step * i, longest = shortest + step;
    const Rational before = longest - soonest, part = lag / before;
    const auto [low, high] = enclosed_decay(before, lag);  // of what lacks until the next sample; below, after it
    const auto [least, most] = enclosed_decay(latest, lag);
    const Rational until = enclosed_decay(shortest - latest, lag).second, on = until * (1 - least) * then;
    const Rational spread = before * (1 - low) * part * ((1 + high) / 2 - (1 - high) * part) +
                            latest * on * until * ((1 + most) / 2 - (1 - most) * then);
    const auto rates = divides ? std::set{below(1 / longest), above(1 / shortest)} : std::set{Rational(1 / longest)};
    for (const auto& decay :
         std::set{enclosed_decay(longest + wait, lag).first, enclosed_decay(shortest - wait, lag).second})
      for (const auto& share : std::set{below((1 - high) * part), above((1 - low) * part)})
        for (const auto& more : is_late ? std::set{below(low * (1 - most) * then), above(on)} : std::set{share})
          for (const auto& rate : rates)
            holds.push_back({is_late ? before : Rational(1 / rate), latest, decay, share, spread, more - share, rate});
  }
  return holds;
}
bool proves(const Program& program, Device device, const Storage& storage, const Rational& damping) {
  const unsigned choices = device.estimator == "foaw" ? std::max(device.window, 1u) : 1, kept = 200;  // digits
  for (device.chosen = 1; device.chosen <= choices; ++device.chosen) {
    LoopForm loop = loop_form(program, device);
    loop.next[""] = loop.force;
    const std::size_t n = loop.states.size();
    unsigned digits = kept;  // of the scale in which all is whole; P is truncated to it, and that P is tested
    for (const auto& [state, form] : loop.next)
      for (const auto& [name, value] : form) digits = std::max(digits, msb(denominator(value)));
    Matrix P(n, std::vector<Integer>(n));
    const auto left = [&](auto i, auto j) { return i + 1 < storage.at(i).size() ? storage[i].at(i + 1 + j) : 0; };
    for (std::size_t i = 0; i < n; ++i)
      for (auto j = 0u; j <= i; ++j) P[i][j] = P[j][i] = whole(storage.at(i).at(j), digits) + whole(left(i, j), digits);
    if (loop.stiffness < 0 || !is_nonnegative(P, digits - kept)) return false;
    for (const Hold& hold : holds(device))
      if (!is_nonnegative(matrix_of(loop, P, digits, damping, hold), 3 * digits - kept)) return false;
  }
  return true;
}
bool has_constant(const std::string& header, const std::string& name) {
  return header.find("\n  static constexpr scalar " + name + " = ") != std::string::npos;
}
std::pair<int, std::string> verdict(const std::string& header, const std::string& certificate) try {
  const nlohmann::json all = nlohmann::json::parse(certificate), &passivity = all.at("passivity");
  bool other = !all.contains("storage") || all.contains("ports") || all.at("constants").contains("cell_begins");
  other = other || passivity.at("any_regime") || passivity.at("any_value") || has_constant(header, "motor_step");
  if (other) throw Unknown("nothing is known of slips, contacts, curves, tunables, several ports, two axes or a slew");
  const nlohmann::json &storage = all.at("storage"), &minimum = passivity.at("minimum_damping");
  const Program program = Header(header);
  Device device = all.at("loop");
  const nlohmann::json taken = device;  // by the library, which cuts and wraps numbers
  for (const auto& [key, value] : taken.items())
    if (all.at("loop").at(key) != value)
      throw Unknown("\"" + key + "\" is not a number of the kind that belongs there");
  const auto number = [&](const char* at) { return Rational(all.at(nlohmann::json::json_pointer(at)).get<double>()); };
  const bool is_punctual = passivity.at("constant_period_only"), is_certified = passivity.at("certified");
  if (is_punctual) device.jitter = 0, device.write_earliest = device.write_latest;
  const Rational late_by = device.write_latest, needed = number("/passivity/needed_damping");
  const Rational longest = Rational(device.sample_period) + device.jitter + (late_by - device.write_earliest);
  const Rational slow = number("/loop/critical_speed"), fast = number("/loop/largest_speed"), square = slow * slow;
  const Rational share = slow == 0 ? Rational(1) : fast == 0 ? Rational(0) : Rational(square / (square + fast * fast));
  const Rational told = share * (1 - number("/loop/brake_tolerance")), given = told * program.constants.at("damping");
  const Rational assured = given + share * number("/loop/residual_damping") + number("/loop/device_damping");
  const Rational spare = assured - needed, said = program.constants.at("sample_period");
  const bool by_hold = passivity.at("proof") == "hold";
  // n samples and a share s of a hold late: b ≥ βT, b (b − βT (1 + 2n + 2s)) ≥ s (1 − s) β²T²
  const Rational prompt =
      by_hold ? Rational(hold_stiffness(loop_form(program, device), device) * longest) : Rational(0);
  const Rational late = late_by / longest, beyond = needed - prompt * (1 + 2 * (device.delay_samples + late));
  const char* refuted = nullptr;
  if (said != device.sample_period && said != float(device.sample_period)) refuted = "the sample periods differ";
  else if (program.constants.at("loop_delay") != device.delay_samples) refuted = "the delays differ";
  else if (by_hold && (needed < prompt || needed * beyond < late * (1 - late) * prompt * prompt))
    refuted = "the hold certificate asks for more damping";
  else if (!by_hold && (storage.is_null() || !proves(program, device, storage.at("matrix"), needed)))
    refuted = "no storage function proves the damping that is stated";
  else if (spare < 0 && is_certified) refuted = "the brake does not surely give the damping that is needed";
  else if (assured * (1 + Rational(1e-12)) < number("/passivity/assured_damping")) refuted = "less is assured";
  else if (!minimum.is_null() && spare + told * minimum.get<double>() < 0) refuted = "more would have to be added";
  if (refuted) return {1, std::string("not proved: ") + refuted + "\n"};
  std::ostringstream words;
  words.precision(17), words << "proved: with a damping of " << double(needed)
                             << " at the tool, no motion takes energy out of the loop, for holds of "
                             << (is_punctual ? "one length, " : "any lengths up to ") << double(longest) << " s\n"
                             << (is_certified ? "proved: brake and device surely give as much\n"
                                              : "not proved: that as much damping is there\n");
  if (spare * 1000000 > needed)  // x is spare and pays for an error e of the force: e u̇ ≤ e²/4x + x u̇²
    words << "proved: " << double(spare) << " more is there; rounding that puts the force off by e [N, N m] brings in "
          << "at most " << double(Rational(1 / (4 * spare))) << " e^2 watts\n";
  words
      << R"(assumed: exact arithmetic in output(), update() and step(), no state that is flushed to zero, and a motor within its
  limits; delay, lag, estimator and damping of the device as the certificate states them
not proved here: that the constants are those of the network, the remarks and the other functions of the header,
  what the encoder's steps and the motor's limits add, and by how much rounding puts the force off
)";
  return {is_certified ? 0 : 4, words.str()};
} catch (const std::out_of_range&) {
  return {3, "not proved here: a name or a place is used that is not there\n"};
} catch (const std::exception& unknown) {
  return {3, std::string("not proved here: ") + unknown.what() + "\n"};
}
}  // namespace dashpot_check
