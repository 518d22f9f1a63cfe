#include "network/passive_prony.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {
namespace {

constexpr double rounding_of_sum = 1e-12;
constexpr int samples_per_decade = 10;
constexpr int most_sweeps = 100'000;

// Columns of the relaxation function: the long-term stiffness, then each term.
std::vector<double> columns_at(double time, const std::vector<PronyTerm>& terms) {
  std::vector<double> columns{1};
  for (const PronyTerm& term : terms) columns.push_back(std::exp(-time / term.time));
  return columns;
}

std::vector<double> stiffnesses_of(const PronySeries& series) {
  std::vector<double> stiffnesses{series.long_term_stiffness()};
  for (const PronyTerm& term : series.terms) stiffnesses.push_back(series.stiffness_of(term));
  return stiffnesses;
}

double dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

std::vector<double> sample_times(const std::vector<PronyTerm>& terms) {
  const auto shorter = [](const PronyTerm& x, const PronyTerm& y) { return x.time < y.time; };
  const auto [least, greatest] = std::minmax_element(terms.begin(), terms.end(), shorter);
  const double decades = std::log10(greatest->time / least->time) + 4;
  const int count = static_cast<int>(std::ceil(decades * samples_per_decade)) + 1;
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(least->time / 100 * std::pow(10, decades * i / (count - 1)));
  return times;
}

// min ½ xᵀGx − gᵀx over x ≥ 0, one unknown after the other: each step is exact, so that the sum of squares only falls.
std::vector<double> solve(const std::vector<std::vector<double>>& gram, const std::vector<double>& right) {
  std::vector<double> x(right.size(), 0);
  const double scale = *std::max_element(right.begin(), right.end());
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double next = std::max(0.0, x[i] + (right[i] - dot(gram[i], x)) / gram[i][i]);
      largest = std::max(largest, std::abs(next - x[i]) * gram[i][i]);
      x[i] = next;
    }
    if (largest <= 1e-10 * scale) break;
  }
  return x;
}

}  // namespace

std::string_view name_of(PronyOf of) {
  switch (of) {
    case PronyOf::instantaneous: return "instantaneous";
    case PronyOf::long_term: return "long-term";
    case PronyOf::absolute: return "absolute";
  }
  return "";
}

std::optional<PronyOf> prony_of(std::string_view name) {
  for (const PronyOf of : {PronyOf::instantaneous, PronyOf::long_term, PronyOf::absolute})
    if (name_of(of) == name) return of;
  return std::nullopt;
}

double PronySeries::sum_of_weights() const {
  double sum = 0;
  for (const PronyTerm& term : terms) sum += term.weight;
  return sum;
}

double PronySeries::long_term_stiffness() const {
  if (of != PronyOf::instantaneous) return stiffness;
  const double rest = 1 - sum_of_weights();
  return std::abs(rest) <= rounding_of_sum ? 0 : stiffness * rest;
}

bool is_passive(const PronySeries& series) {
  const auto is_negative = [](const PronyTerm& term) { return term.weight < 0; };
  return series.long_term_stiffness() >= 0 && std::none_of(series.terms.begin(), series.terms.end(), is_negative);
}

PassiveFit nearest_passive(const PronySeries& series) {
  const std::vector<double> given = stiffnesses_of(series);
  const std::vector<double> times = sample_times(series.terms);
  std::vector<std::vector<double>> gram(given.size(), std::vector<double>(given.size(), 0));
  std::vector<double> right(given.size(), 0);
  for (const double time : times) {
    const std::vector<double> columns = columns_at(time, series.terms);
    for (std::size_t i = 0; i < given.size(); ++i) {
      right[i] += columns[i] * dot(columns, given);
      for (std::size_t j = 0; j < given.size(); ++j) gram[i][j] += columns[i] * columns[j];
    }
  }
  const std::vector<double> found = solve(gram, right);
  PassiveFit fit{{PronyOf::absolute, found[0], series.terms}, 0};
  for (std::size_t i = 0; i < series.terms.size(); ++i) fit.series.terms[i].weight = found[i + 1];
  const double at_once = dot(columns_at(0, series.terms), given);
  for (const double time : times) {
    const std::vector<double> columns = columns_at(time, series.terms);
    fit.error = std::max(fit.error, std::abs(dot(columns, found) - dot(columns, given)) / std::abs(at_once));
  }
  return fit;
}

std::string absolute_leaf(const PronySeries& series, const std::string& stiffness_unit) {
  std::string terms;
  for (const PronyTerm& term : series.terms)
    if (term.weight > 0)
      terms += fmt::format("{}{{ \"weight\": \"{:.6g} {}\", \"time\": \"{:.6g} s\" }}", terms.empty() ? "" : ", ",
                           series.stiffness_of(term), stiffness_unit, term.time);
  return fmt::format("{{ \"prony\": \"{:.6g} {}\", \"of\": \"absolute\", \"terms\": [ {} ] }}",
                     series.long_term_stiffness(), stiffness_unit, terms);
}

}  // namespace dashpot::compiler
