#include "certify/box_numbers.hpp"

#include <algorithm>

namespace dashpot::compiler {

Affine plus(Affine first, const Affine& second, const Rational& weight) {
  first.base += weight * second.base;
  first.factors.resize(std::max(first.factors.size(), second.factors.size()));
  for (std::size_t i = 0; i < second.factors.size(); ++i) first.factors[i] += weight * second.factors[i];
  return first;
}

Affine BoxNumbers::number(int index) const {
  const TunableNumber& n = tables_.numbers[static_cast<std::size_t>(index)];
  Affine value{Rational(n.base), std::vector<Rational>(tables_.tunables.size())};
  for (const TunableTerm& term : n.terms) value.factors[term.tunable] += Rational(term.share);
  return value;
}

Rational BoxNumbers::extreme(const Affine& f, bool largest) const {
  Rational value = f.base;
  for (std::size_t i = 0; i < f.factors.size(); ++i) {
    const tunable_range<double>& range = tables_.tunables[i].range;
    value += f.factors[i] * Rational((f.factors[i] > 0) == largest ? range.max : range.min);
  }
  return value;
}

}  // namespace dashpot::compiler
