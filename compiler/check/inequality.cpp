#include <cmath>

#include "check.hpp"

namespace dashpot_check {
namespace {

namespace mp = boost::multiprecision;

Rational rounded(const Rational& value, unsigned digits, bool up) {
  Integer quotient, remainder;
  mp::divide_qr(Integer(numerator(value) << digits), Integer(denominator(value)), quotient, remainder);
  return Rational(quotient + (up && remainder > 0 ? 1 : 0) - (!up && remainder < 0 ? 1 : 0), Integer(1) << digits);
}

// Not above and not below e^{−x}: the partial sums of the alternating series at 2⁻ʲx ≤ 1, squared j times.
std::pair<Rational, Rational> enclosed_exponential(const Rational& x) {
  unsigned halvings = 0;
  Rational y = x, low = 1, high = 1, term = 1;
  for (; y > 1; y /= 2) ++halvings;
  for (int i = 1; i <= 40; ++i) {
    term *= y / i;
    (i % 2 == 1 ? low : high) = i % 2 == 1 ? Rational(high - term) : Rational(low + term);
  }
  for (unsigned i = 0; i <= halvings; ++i) {
    low = rounded(i == 0 ? low : Rational(low * low), 250, false);
    high = rounded(i == 0 ? high : Rational(high * high), 250, true);
  }
  return {low, high};
}

std::vector<LagHold> lag_corners(const Rational& lag, const Rational& shortest, const Rational& longest) {
  if (lag == 0) return {{}};
  const Rational x = longest / lag;
  const auto [low, high] = enclosed_exponential(x);
  const Rational most = rounded(enclosed_exponential(shortest / lag).second, 90, true), least = rounded(low, 90, false);
  const Rational share = rounded((1 - high) / x, 90, false), shares = rounded((1 - low) / x, 90, true);
  const Rational spread = (1 - low) / x * ((1 + high) / 2 - (1 - high) / x);
  return {{least, share, spread}, {least, shares, spread}, {most, share, spread}, {most, shares, spread}};
}

unsigned binary_digits(const Rational& value) {
  const Integer below = denominator(value);
  if ((below & (below - 1)) != 0) throw Unknown("a coefficient is not a binary fraction");
  return unsigned(mp::msb(below));
}

Integer scaled(const Rational& value, unsigned digits) { return (numerator(value) << digits) / denominator(value); }

// The inequality's matrix for one hold, over the states, w and ρ.
Matrix matrix_of(const LoopForm& loop, const Matrix& P, unsigned P_digits, const Rational& per_square,
                 const LagHold& lag) {
  const std::size_t n = loop.states.size(), w = n;
  const bool lags = lag.spread != 0;
  std::map<std::string, std::size_t> place = {{"w", w}};
  for (std::size_t i = 0; i < n; ++i) place[loop.states[i]] = i;
  std::vector<Form> next;
  for (const std::string& state : loop.states) next.push_back(loop.next.at(state));
  Form supply = loop.force;  // what is multiplied by w
  if (lags) next.back()["lacking"] += lag.decay, supply["lacking"] += lag.share;
  supply["w"] = per_square - loop.stiffness / 2;
  unsigned digits = 0, supply_digits = 2;
  for (const Form& row : next)
    for (const auto& [name, value] : row) digits = std::max(digits, binary_digits(value));
  for (const auto& [name, value] : supply) supply_digits = std::max(supply_digits, binary_digits(value) + 1);
  const unsigned stored_digits = 2 * digits + P_digits, all = std::max(stored_digits, supply_digits);
  std::vector<std::vector<std::pair<std::size_t, Integer>>> A(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const auto& [name, value] : next[i]) A[i].emplace_back(place.at(name), scaled(value, digits));
  Matrix PA(n, std::vector<Integer>(n + 1)), M(n + 1 + lags, std::vector<Integer>(n + 1 + lags));
  for (std::size_t k = 0; k < n; ++k)
    for (const auto& [j, value] : A[k])
      for (std::size_t i = 0; i < n; ++i) PA[i][j] += P[i][k] * value;
  for (std::size_t k = 0; k < n; ++k)
    for (const auto& [i, value] : A[k])
      for (std::size_t j = 0; j <= i; ++j) M[i][j] -= value * PA[k][j];
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      M[i][j] = (M[i][j] + (i < n ? Integer(P[i][j] << (2 * digits)) : Integer(0))) << (all - stored_digits);
  for (const auto& [name, value] : supply)
    M[w][place.at(name)] += scaled(name == "w" ? value : Rational(value / 2), all);
  if (lags) M[n + 1][n - 1] = Integer(1) << (all - 1), M[n + 1][n + 1] = scaled(per_square / lag.spread, all);
  return M;
}

}  // namespace

bool is_nonnegative(const Matrix& matrix) {
  constexpr unsigned digits = 60;  // of L, behind the point
  using Wide = mp::int256_t;
  const std::size_t n = matrix.size();
  const long double margin = 4 * std::ldexp((long double)(n * n), -int(digits));
  std::vector<int> size(n, 0);
  std::vector<std::vector<Wide>> rest(n), L(n);
  std::vector<std::vector<long double>> near(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (matrix[i][i] < 0) return false;
    if (matrix[i][i] > 0) size[i] = int(mp::msb(matrix[i][i]) / 2);
    for (std::size_t j = 0; j <= i; ++j) {  // scaled by powers of two to a diagonal between 1 and 4
      const int shift = int(2 * digits) - size[i] - size[j];
      const Integer value =
          shift >= 0 ? Integer(matrix[i][j] << shift) : Integer(matrix[i][j] / (Integer(1) << -shift));
      if (abs(value) > Integer(1) << (2 * digits + 3)) return false;
      rest[i].push_back(Wide(value));
      long double sum = std::ldexp(value.convert_to<long double>(), -int(2 * digits)) - (i == j ? margin : 0);
      for (std::size_t k = 0; k < j; ++k) sum -= near[i][k] * near[j][k];
      const bool empty = matrix[j][j] == 0;
      if (i == j && !empty && !(sum > 0)) return false;
      near[i].push_back(empty ? 0 : i == j ? std::sqrt(sum) : sum / near[j][j]);
      if (!(std::fabs(near[i][j]) < 4)) return false;
      L[i].push_back(Wide(std::llrint(std::ldexp(near[i][j], int(digits)))));
    }
  }
  std::vector<Wide> off_diagonal(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const bool cut = int(2 * digits) - size[i] - size[j] < 0;  // by less than one
      for (std::size_t k = 0; k <= j; ++k) rest[i][j] -= L[i][k] * L[j][k];
      if (i == j) continue;
      off_diagonal[i] += abs(rest[i][j]) + (cut ? 1 : 0);
      off_diagonal[j] += abs(rest[i][j]) + (cut ? 1 : 0);
    }
  for (std::size_t i = 0; i < n; ++i)
    if (rest[i][i] < off_diagonal[i]) return false;
  return true;
}

std::vector<HoldPart> hold_parts(const Device& device) {
  const Rational period = device.sample_period, late = device.jitter, lag = device.amplifier_lag;
  if (period <= 0 || late < 0 || lag < 0) throw Unknown("a time is negative");
  if (lag == 0 || late == 0) return {{period + late, lag_corners(lag, period, period)}};
  const Rational shortest = late < period ? Rational(period - late) : Rational(0),
                 step = (period + late - shortest) / 6;
  std::vector<HoldPart> parts;
  for (int i = 0; i < 6; ++i)
    parts.push_back({shortest + step * (i + 1), lag_corners(lag, shortest + step * i, shortest + step * (i + 1))});
  return parts;
}

bool proves(const LoopForm& loop, const Device& device, const Storage& storage, const Rational& damping) {
  const std::size_t n = loop.states.size();
  unsigned digits = 0;
  if (storage.size() != n) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (storage[i].size() != i + 1) return false;
    for (const double value : storage[i]) digits = std::max(digits, binary_digits(value));
  }
  Matrix P(n, std::vector<Integer>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) P[i][j] = P[j][i] = scaled(storage[i][j], digits);
  if (!is_nonnegative(P)) return false;
  for (const HoldPart& part : hold_parts(device))
    for (const LagHold& corner : part.corners)
      if (!is_nonnegative(matrix_of(loop, P, digits, rounded(damping / part.longest, 200, false), corner)))
        return false;
  return true;
}

Rational hold_stiffness(const LoopForm& loop) {
  constexpr unsigned digits = 300;  // so that sums of many fractions stay short
  Rational sum = loop.stiffness / 2, left = of(loop.force, "q0");
  if (loop.follows_estimate || loop.next.count("lacking") + loop.next.count("q1") > 0 || loop.stiffness < 0)
    throw Unknown("the hold certificate is for a motor that is driven by position alone, in time and without lag");
  for (const std::string& state : loop.states) {
    if (state == "q0") continue;
    const Form& next = loop.next.at(state);
    const Rational a = of(next, state), rest = of(next, "q0"), answer = of(next, "w");
    const Rational c = a == 0 ? rest : Rational(answer + rest / a);
    const bool is_mode = next.size() <= std::size_t(a != 0) + (rest != 0) + (answer != 0) && a >= 0 && a < 1 && c >= 0;
    if (!is_mode || of(loop.force, state) != 1 || (a == 0 && answer != 0))
      throw Unknown("'" + state + "' is not a mode that relaxes");
    sum += rounded(c / (1 + a), digits, true) + Rational(1, Integer(1) << digits);
    if (a != 0) left -= rounded(rest / a, digits, false);
  }
  return sum + abs(left);
}

}  // namespace dashpot_check
