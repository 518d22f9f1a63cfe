// Prony series: which of them a network of springs and dampers can be, and the nearest one that is.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::compiler {

struct PronyTerm {
  double weight;  // share of the named stiffness; of an absolute series a stiffness
  double time;    // [s]
};

// What `stiffness` is: the instantaneous value of the relaxation function, the long-term one, or the long-term one with
// weights that are stiffnesses.
enum class PronyOf { instantaneous, long_term, absolute };

std::string_view name_of(PronyOf of);                    // "instantaneous", "long-term", "absolute"
std::optional<PronyOf> prony_of(std::string_view name);  // empty: none of these

struct PronySeries {
  PronyOf of = PronyOf::long_term;
  double stiffness = 0;
  std::vector<PronyTerm> terms;

  double sum_of_weights() const;
  double stiffness_of(const PronyTerm& term) const {
    return of == PronyOf::absolute ? term.weight : term.weight * stiffness;
  }
  double long_term_stiffness() const;  // below zero where an instantaneous series has weights of more than 1 in all
};

// True where the series is a spring and Maxwell elements in parallel, none of them negative. A sum of weights that is
// above 1 by rounding alone, 1e-12, counts as 1.
bool is_passive(const PronySeries& series);

struct PassiveFit {
  PronySeries series;  // absolute, of the same times
  double error;        // largest difference of the relaxation functions, as a share of the given one at once
};

// The passive series of the same times whose relaxation function is nearest, by least squares over the logarithm of
// time from a hundredth of the shortest time to a hundred of the longest.
PassiveFit nearest_passive(const PronySeries& series);

// The leaf as it stands in a network file: `{ "prony": …, "of": "absolute", "terms": … }`, in SI, six digits.
std::string absolute_leaf(const PronySeries& series, const std::string& stiffness_unit);

}  // namespace dashpot::compiler
