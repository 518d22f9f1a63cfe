// A static curve while it is fitted (theory, section 11).
#pragma once

#include <vector>

#include "network/network.hpp"

namespace dashpot::compiler::fitting {

// The shape of a curve f(u), and with it the map w(u) behind which a network lies,
//
//     w = sgn(u) √(2 ∫f du),   w′ = f/w,
//
// where f is the force over the stiffness of the network that the curve is made from [m]. A factor of the curve could
// as well be in the network's weights, so it is fixed: at u = reach, w is the reach.
//
// Its parameters have no bounds of physics: the power itself, the logarithm of the rate times the reach, and of a table
// that is straight over equal stretches the logarithms of each slope over the last.
class CurveShape {
 public:
  using Kind = StaticCurve::Kind;

  // In: the reach of the recordings, above 0 [m].
  static CurveShape power(double exponent, double reach);
  static CurveShape exponential(double rate_times_reach, double reach);
  static CurveShape table(std::vector<double> log_slopes, double reach);
  // With the same parameters and another reach [m].
  CurveShape over(double reach) const { return {kind(), parameters_, reach}; }
  // As many stretches of a table, through the curve at their ends.
  CurveShape sampled(std::size_t stretches) const;
  // A curve as it stands in a file, over its network's stiffness.
  static CurveShape of(const StaticCurve& curve, double stiffness);

  struct Place {
    double value, tangent;  // w [m], w′
  };
  Place at(double displacement) const;
  double force_at(double displacement) const;  // over the stiffness, of a displacement that is not negative [m]

  Kind kind() const { return curve_.kind; }
  double reach() const { return curve_.point.displacement; }
  const std::vector<double>& parameters() const { return parameters_; }
  void set_parameter(std::size_t index, double value);

  friend bool operator==(const CurveShape& a, const CurveShape& b) {
    return a.kind() == b.kind() && a.reach() == b.reach() && a.curve_.point.force == b.curve_.point.force &&
           a.parameters_ == b.parameters_;
  }

 private:
  CurveShape(Kind kind, std::vector<double> parameters, double reach);
  void normalise();
  void find_work();
  double work_to(double distance) const;  // ∫f du over the stiffness [m²]
  std::size_t row_of(double distance) const;

  StaticCurve curve_;
  std::vector<double> parameters_;
  double factor_ = 0;         // c of c u^p or of c (e^{a u} − 1)
  std::vector<double> work_;  // of a table, up to each of its points
};

// Within which a fit looks for a parameter of such a curve.
struct ShapeRange {
  double least, most;
};
ShapeRange range_of(CurveShape::Kind kind);

// Candidates for the start of a search, which takes the best: from nearly straight to as steep as tissue is.
std::vector<CurveShape> some_powers(double reach);
std::vector<CurveShape> some_exponentials(double reach);

const char* word_of(CurveShape::Kind kind);  // "power", "exponential", "table"

}  // namespace dashpot::compiler::fitting
