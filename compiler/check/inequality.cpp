#include <algorithm>
#include <cmath>

#include "check.hpp"

namespace dashpot_check {

namespace {

// value · 2^digits, rounded down
Integer floor_of(const Rational& value, unsigned digits) {
  Integer quotient, remainder;
  divide_qr(Integer(numerator(value) << digits), Integer(denominator(value)), quotient, remainder);
  return remainder < 0 ? Integer(quotient - 1) : quotient;
}
Rational below(const Rational& value, unsigned digits) {
  return Rational(floor_of(value, digits), Integer(1) << digits);
}
Rational above(const Rational& value, unsigned digits) { return -below(-value, digits); }

// Not above and not below e^{−x}: the partial sums of the alternating series at 2⁻ʲx ≤ 1, squared j times.
std::pair<Rational, Rational> enclosed_exponential(Rational x) {
  unsigned halvings = 0;
  Rational low = 1, high = 1, term = 1;
  for (; x > 1; x /= 2) ++halvings;
  for (int i = 1; i <= 40; ++i) {
    term *= x / i;
    (i % 2 == 1 ? low : high) = i % 2 == 1 ? Rational(high - term) : Rational(low + term);
  }
  for (unsigned i = 0; i < halvings; ++i) low = below(low * low, 250), high = above(high * high, 250);
  return {below(low, 250), above(high, 250)};
}

// The inequality's matrix for one hold, over the states, w and ρ. What is scaled to integers are sums and products of
// doubles, but for the diagonal of w and ρ, which is rounded down.
Matrix matrix_of(const LoopForm& loop, const Matrix& P, unsigned P_digits, const Rational& damping, const Hold& hold) {
  const std::size_t n = loop.states.size(), lags = hold.spread != 0;
  std::map<std::string, std::size_t> place = {{"w", n}};
  std::vector<Form> rows;
  for (const std::string& state : loop.states) place[state] = rows.size(), rows.push_back(loop.next.at(state));
  rows.push_back(Rational(1, 2) * loop.force);  // what is multiplied by w
  if (lags) rows[n - 1]["lacking"] += hold.decay, rows[n]["lacking"] += hold.share / 2;
  unsigned digits = 1;
  for (const Form& row : rows)
    for (const auto& [name, value] : row) digits = std::max(digits, unsigned(msb(Integer(denominator(value)))));
  const unsigned all = 2 * digits + P_digits;
  std::vector<std::vector<std::pair<std::size_t, Integer>>> A(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const auto& [name, value] : rows[i]) A[i].emplace_back(place.at(name), floor_of(value, digits));
  Matrix PA(n, std::vector<Integer>(n + 1)), M(n + 1 + lags, std::vector<Integer>(n + 1 + lags));
  for (std::size_t k = 0; k < n; ++k)
    for (const auto& [j, value] : A[k])
      for (std::size_t i = 0; i < n; ++i) PA[i][j] += P[i][k] * value;
  for (std::size_t k = 0; k < n; ++k)
    for (const auto& [i, value] : A[k])
      for (std::size_t j = 0; j <= i; ++j) M[i][j] -= value * PA[k][j];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) M[i][j] += P[i][j] << (2 * digits);
  for (const auto& [name, value] : rows[n]) M[n][place.at(name)] += floor_of(value, all);
  const Rational per_square = damping / hold.longest;
  M[n][n] += floor_of(per_square - loop.stiffness / 2, all);
  if (lags) M[n + 1][n - 1] = Integer(1) << (all - 1), M[n + 1][n + 1] = floor_of(per_square / hold.spread, all);
  return M;
}

// Of the matrix, what is on and below the diagonal is read, scaled by powers of two to a diagonal between 1 and 4.
bool is_nonnegative(const Matrix& matrix) {
  using Wide = boost::multiprecision::int256_t;
  constexpr int digits = 60;  // of L, behind the point
  const std::size_t n = matrix.size();
  const long double margin = 4 * std::ldexp((long double)(n * n), -digits);
  std::vector<int> size(n, 0);
  std::vector<Wide> spare(n);  // of the diagonal of R, beyond what stands beside it
  std::vector<std::vector<Wide>> L(n);
  std::vector<std::vector<long double>> near(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (matrix[i][i] < 0) return false;
    if (matrix[i][i] > 0) size[i] = int(msb(matrix[i][i]) / 2);
    for (std::size_t j = 0; j <= i; ++j) {
      const int shift = 2 * digits - size[i] - size[j], cut = shift < 0;  // cut off is less than one
      const Integer value = cut ? Integer(matrix[i][j] / (Integer(1) << -shift)) : Integer(matrix[i][j] << shift);
      long double sum = std::ldexp(value.convert_to<long double>(), -2 * digits) - (i == j ? margin : 0);
      for (std::size_t k = 0; k < j; ++k) sum -= near[i][k] * near[j][k];
      near[i].push_back(matrix[j][j] == 0 ? 0 : i == j ? std::sqrt(sum) : sum / near[j][j]);
      if (!(std::fabs(near[i][j]) < 4)) return false;  // nor where it is no number
      L[i].push_back(Wide(std::llrint(std::ldexp(near[i][j], digits))));
      Wide rest(value);
      for (std::size_t k = 0; k <= j; ++k) rest -= L[i][k] * L[j][k];
      if (i != j) spare[j] -= abs(rest) + cut;
      spare[i] += i == j ? rest : Wide(-abs(rest) - cut);
    }
  }
  return std::none_of(spare.begin(), spare.end(), [](const Wide& value) { return value < 0; });
}

}  // namespace

Form operator+(Form sum, const Form& other) {
  for (const auto& [name, value] : other)
    if ((sum[name] += value) == 0) sum.erase(name);
  return sum;
}
Form operator*(const Rational& factor, Form form) {
  for (auto& [name, value] : form) value *= factor;
  return factor == 0 ? Form{} : form;
}
Rational of(const Form& form, const std::string& name) { return form.count(name) ? form.at(name) : Rational(0); }

std::vector<Hold> holds(const Device& device) {
  const Rational period = device.sample_period, late = device.jitter, lag = device.amplifier_lag;
  if (period <= 0 || late < 0 || lag < 0) throw Unknown("a time is negative");
  if (lag == 0) return {{period + late, 0, 0, 0}};
  std::vector<Hold> holds;
  const int parts = late == 0 ? 1 : 6;
  const Rational shortest = late < period ? Rational(period - late) : Rational(0);
  const Rational step = (period + late - shortest) / parts;
  for (int i = 0; i < parts; ++i) {
    const Rational longest = shortest + step * (i + 1), x = longest / lag;
    const auto [low, high] = enclosed_exponential(x);
    const Rational spread = (1 - low) / x * ((1 + high) / 2 - (1 - high) / x);
    for (const Rational& decay : {below(low, 90), above(enclosed_exponential(x - step / lag).second, 90)})
      for (const Rational& share : {below((1 - high) / x, 90), above((1 - low) / x, 90)})
        holds.push_back({longest, decay, share, spread});
  }
  return holds;
}

bool proves(const LoopForm& loop, const Device& device, const Storage& storage, const Rational& damping) {
  const std::size_t n = loop.states.size();
  unsigned digits = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (const Rational value : storage.at(i)) digits = std::max(digits, unsigned(msb(Integer(denominator(value)))));
  Matrix P(n, std::vector<Integer>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) P[i][j] = P[j][i] = floor_of(storage[i].at(j), digits);
  const std::vector<Hold> all = holds(device);
  return is_nonnegative(P) && std::all_of(all.begin(), all.end(), [&](const Hold& hold) {
           return is_nonnegative(matrix_of(loop, P, digits, damping, hold));
         });
}

bool proves(const Program& program, Device device, const Storage& storage, const Rational& damping) {
  const unsigned choices = device.estimator == "foaw" ? std::max(device.window, 1u) : 1;
  for (device.chosen = 1; device.chosen <= choices; ++device.chosen)
    if (!proves(loop_form(program, device), device, storage, damping)) return false;
  return true;
}

}  // namespace dashpot_check
