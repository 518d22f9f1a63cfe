#include <algorithm>
#include <tuple>

#include "check.hpp"

namespace dashpot_check {
namespace {

// value · 2^digits, rounded down
Integer whole(const Rational& value, unsigned digits) {
  const Integer scaled = numerator(value) << digits, quotient = scaled / denominator(value);
  return quotient * denominator(value) > scaled ? Integer(quotient - 1) : quotient;
}
constexpr unsigned rate_digits = 90;  // of what is no sum or product of doubles: decays, shares and rates
Rational below(const Rational& value) { return Rational(whole(value, rate_digits), Integer(1) << rate_digits); }
Rational above(const Rational& value) { return -below(-value); }

// Not above and not below e^{−x}: (1 − x/n)ⁿ and (1 + x/n)⁻ⁿ, of which the two differ by x²/n of themselves.
std::pair<Rational, Rational> enclosed_exponential(const Rational& x) {
  constexpr unsigned squarings = 110, digits = 220;
  const Rational part = x / (Integer(1) << squarings);
  Integer low = part < 1 ? whole(1 - part, digits) : Integer(0), high = whole(1 / (1 + part), digits) + 1;
  for (unsigned i = 0; i < squarings; ++i) low = low * low >> digits, high = (high * high >> digits) + 1;
  return {below(Rational(low, Integer(1) << digits)), above(Rational(high, Integer(1) << digits))};
}

// The inequality's matrix for one hold, over the states, w and ρ, on and below the diagonal: whole, because scaled by
// 2^digits for each of three factors, but for b/T and b/(κT), which are rounded down.
Matrix matrix_of(const LoopForm& loop, const Matrix& P, unsigned digits, const Rational& damping, const Hold& hold) {
  const std::size_t n = P.size(), lags = hold.spread != 0;
  std::map<std::string, std::size_t> place = {{"w", n}};
  for (const std::string& state : loop.states) place.emplace(state, place.size() - 1);
  std::vector<std::tuple<std::size_t, std::size_t, Integer>> A;  // with B as its last column
  for (const auto& [state, next] : loop.next)
    for (const auto& [name, value] : next) {
      const bool paces = name == "pace";
      A.emplace_back(place.at(state), paces ? n : place.at(name), whole(paces ? value * hold.rate : value, digits));
    }
  if (lags) A.emplace_back(n - 1, n - 1, whole(hold.decay, digits));
  Matrix PA(n, std::vector<Integer>(n + 1)), M(n + 1 + lags, std::vector<Integer>(n + 1 + lags));
  for (const auto& [k, j, value] : A)
    for (std::size_t i = 0; i < n; ++i) PA[i][j] += P[i][k] * value;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) M[i][j] = P[i][j] << (2 * digits);
  for (const auto& [k, i, value] : A)
    for (std::size_t j = 0; j <= i; ++j) M[i][j] -= value * PA[k][j];
  for (const auto& [name, value] : loop.force) M[n][place.at(name)] += whole(value / 2, 3 * digits);
  const Rational per_square = damping / hold.longest;
  M[n][n] += whole(per_square - loop.stiffness / 2, 3 * digits);
  if (!lags) return M;
  M[n][n - 1] += whole(hold.share / 2, 3 * digits);
  M[n + 1][n - 1] = whole(Rational(1, 2), 3 * digits);
  M[n + 1][n + 1] = whole(per_square / hold.spread, 3 * digits);
  return M;
}

// Whether M, which is read on and below the diagonal, is L D Lᵀ + R with D > 0 and R diagonally dominant, by
// elimination. Powers of two scale its diagonal to some 120 binary digits. Entries are then rounded to whole numbers,
// by less than one each time: until row k is eliminated, all roundings in it come to less than n (k + 1), which R keeps
// of its diagonal.
bool is_nonnegative(Matrix M) {
  const std::size_t n = M.size();
  std::vector<int> digits(n, 60);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n && M[i][i] <= 0; ++j)  // then all beside it has to be zero, as it is
      if (M[std::max(i, j)][std::min(i, j)] != 0) return false;
    if (M[i][i] == 0) M[i][i] = 1;
    digits[i] -= int(msb(M[i][i]) / 2);
    for (std::size_t j = 0; j <= i; ++j) {
      const int more = digits[i] + digits[j];
      M[i][j] = more < 0 ? Integer(M[i][j] / (Integer(1) << -more)) : Integer(M[i][j] << more);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    M[k][k] -= n * (k + 1);
    if (M[k][k] <= 0) return false;
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j <= i; ++j) M[i][j] -= M[i][k] * M[j][k] / M[k][k];
  }
  return true;
}

}  // namespace

std::vector<Hold> holds(const Device& device) {
  const Rational period = device.sample_period, late = device.jitter, lag = device.amplifier_lag;
  if (period <= 0 || late < 0 || lag < 0) throw Unknown("a time is negative");
  const Rational shortest = std::max(Rational(period - late), Rational(0));
  const bool divides = device.estimator == "interval_difference" && shortest > 0;
  const auto rates = [&](const Rational& low, const Rational& high) {
    return divides ? std::vector{below(1 / high), above(1 / low)} : std::vector{Rational(1 / high)};
  };
  std::vector<Hold> holds;
  if (lag == 0) {
    for (const Rational& rate : rates(shortest, period + late)) holds.push_back({1 / rate, 0, 0, 0, rate});
    return holds;
  }
  const int parts = late == 0 ? 1 : 6;
  const Rational step = (period + late - shortest) / parts;
  for (int i = 0; i < parts; ++i) {
    const Rational longest = shortest + step * (i + 1), x = longest / lag;
    const auto [low, high] = enclosed_exponential(x);
    const Rational spread = (1 - low) / x * ((1 + high) / 2 - (1 - high) / x);
    for (const Rational& decay : {low, enclosed_exponential(x - step / lag).second})
      for (const Rational& share : {below((1 - high) / x), above((1 - low) / x)})
        for (const Rational& rate : rates(longest - step, longest))
          holds.push_back({1 / rate, decay, share, spread, rate});
  }
  return holds;
}

bool proves(const Program& program, Device device, const Storage& storage, const Rational& damping) {
  const unsigned choices = device.estimator == "foaw" ? std::max(device.window, 1u) : 1;
  const std::vector<Hold> all = holds(device);
  for (device.chosen = 1; device.chosen <= choices; ++device.chosen) {
    const LoopForm loop = loop_form(program, device);
    const std::size_t n = loop.states.size();
    unsigned digits = 200;  // those of P are cut off, which makes another P of it
    for (const auto& [state, next] : loop.next)
      for (const auto& [name, value] : next)
        digits = std::max(digits, msb(denominator(value)) + (name == "pace" ? rate_digits : 0));
    for (const auto& [name, value] : loop.force) digits = std::max(digits, msb(denominator(value)));
    Matrix P(n, std::vector<Integer>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) P[i][j] = P[j][i] = whole(storage.at(i).at(j), digits);
    const auto holds_for = [&](const Hold& hold) { return is_nonnegative(matrix_of(loop, P, digits, damping, hold)); };
    if (loop.stiffness < 0 || !is_nonnegative(P) || !std::all_of(all.begin(), all.end(), holds_for)) return false;
  }
  return true;
}

}  // namespace dashpot_check
