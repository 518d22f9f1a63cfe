#include "emit/response_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/motor_limits.hpp"
#include "law/cost.hpp"

namespace dashpot::compiler {
namespace {

// How far rounding may take the force from the closed form, relative to the peak: the modes' bound, one roundoff for
// each of the products and sums of a sample, and in double as many for the closed form's own.
double test_tolerance(const UpdateLaw& law) {
  const double roundoff = law.scalar == ScalarType::float64 ? 0x1p-53 : 0x1p-24;
  const Cost cost = cost_of(law, law.output);
  return law.relative_error_bound + roundoff * double(2 * (8 + cost.additions + cost.multiplications));
}

// Where the test lets the law rest: half a unit deep, or, where the law keeps to its motor's limits, no deeper than the
// motor holds in its first sample. A power of two is exact in every scalar.
double rest_depth(const Compilation& c) {
  constexpr double deepest = 0.5;
  const double stiffness = to_double(c.form.linear.static_stiffness);
  if (!c.law.sheds() || !(stiffness > 0)) return deepest;
  double force = std::numeric_limits<double>::infinity();
  for (const double limit : {c.certificate.loop.max_force, largest_change(c.certificate.loop)})
    if (limit > 0) force = std::min(force, limit);
  return std::min(deepest, std::exp2(std::floor(std::log2(force / stiffness)) - 1));
}

}  // namespace

CodeModel response_test_model(const Compilation& c, const std::string& log1p) {
  CodeModel model;
  Fields& fields = model.fields;
  fields["name"] = c.network.name;
  fields["scheme"] = name_of(c.law.scheme);
  fields["rate"] = fmt::format("{:#}", c.rate);
  fields["static_stiffness"] = fmt::format("{:#}", to_double(c.form.linear.static_stiffness));
  fields["feedthrough_damping"] = fmt::format("{:#}", to_double(c.form.linear.feedthrough_damping));
  fields["start"] = fmt::format("{:#}", c.network.contact ? c.network.contact->at : 0.0);
  fields["rest_depth"] = fmt::format("{:#}", rest_depth(c));
  fields["tolerance"] = fmt::format("{:#}", test_tolerance(c.law));
  for (const Mode& mode : c.form.linear.modes)
    model.lists["modes"].push_back({{"stiffness", fmt::format("{:#}", to_double(mode.stiffness))},
                                    {"relaxation_rate", fmt::format("{:#}", to_double(mode.relaxation_rate))}});
  model.lists["modes"];
  // Forces of slips have no closed form along a ramp.
  model.lists["closed_forms"];
  if (!c.form.has_slips() && !c.law.sheds())
    model.lists["closed_forms"].push_back(
        {{"decays", c.law.scheme == Scheme::exact ? "rate * period" : log1p + "(rate * period)"}});
  return model;
}

}  // namespace dashpot::compiler
