// What a term of weight one answers to a recording: exact for positions that are linear between rows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/curve_shape.hpp"
#include "fit/recording.hpp"
#include "fit/term.hpp"

namespace dashpot::compiler::fitting {

// The angular frequencies of all recordings together, and a decade on either side [rad/s].
struct Band {
  double low;
  double high;
};

// A recording with what every column of it needs.
struct Signal {
  const Recording* recording;
  std::size_t file;            // its place among all
  std::vector<double> steps;   // [s]
  std::vector<double> change;  // of what drives the network, from row to row: position [m], or force [N]
  std::vector<double> drive;   // position [m], or force [N]; behind a curve w [m]
  std::vector<double> lever;   // w′ at each row, of a motion behind a curve; else empty
  Band band;                   // of a springpot's ladder
  Form form;

  // Storage, then loss, of a spectrum; else one for each row.
  Eigen::Index rows() const {
    const std::size_t count = recording->time.size();
    return static_cast<Eigen::Index>(recording->kind == RecordingKind::frequency ? 2 * count : count);
  }
};

// Behind a curve the network is driven by w, and its force is felt w′ times (theory, section 11): the tangent at the
// row, which is what was measured there. The secant to the row before would be that of half a step earlier.
Signal signal_of(const Recording& recording, std::size_t file, Form form, const Band& band,
                 const std::optional<CurveShape>& curve = {});

// Force [N] (position [m] in the compliance form) of the term with weight one, at each row; left limits.
Eigen::VectorXd unit_column(const Signal& signal, const Term& term);

// Where the surface of a tissue is that a tool may leave, at each row from rest [m]: with the tool, or where that would
// pull, where the force is 0 (theory, section 5, "Contact"). In: a motion, and the tissue's terms with their weights.
// The rule is that of the laws that are emitted, sample by sample.
std::vector<double> surface_under(const Recording& recording, const std::vector<Term>& terms,
                                  const Eigen::VectorXd& weights, const Band& band,
                                  const std::optional<CurveShape>& curve);

// Its derivative with respect to the logarithm of a time or threshold, or to an exponent.
enum class Shape { time, threshold, exponent };
Eigen::VectorXd column_slope(const Signal& signal, const Term& term, Shape shape);

// Density of branches in a springpot's ladder: its ripple is below 2e-3, whatever the exponent.
inline constexpr double springpot_branches_per_decade = 2;

}  // namespace dashpot::compiler::fitting
