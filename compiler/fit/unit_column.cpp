#include "fit/unit_column.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "network/springpot.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Column = Eigen::VectorXd;

double& at(Column& column, std::size_t row) { return column[static_cast<Eigen::Index>(row)]; }

// e^{−x} and φ(x) = (1 − e^{−x})/x, kept from row to row while the step stays the same.
class Decay {
 public:
  explicit Decay(double time) : time_(time) {}

  void advance(double step) {
    if (step == step_) return;
    step_ = step;
    x = step / time_;
    factor = std::exp(-x);
    share = x > 0 ? -std::expm1(-x) / x : 1;
  }

  double x = 0, factor = 1, share = 1;

 private:
  double time_;
  double step_ = std::numeric_limits<double>::quiet_NaN();
};

// q ← e^{−x} q + φ(x) Δu, with x = h/τ
Column maxwell_history(const Signal& signal, double time) {
  Column column(signal.rows());
  Decay decay(time);
  double q = 0;
  for (std::size_t i = 0; i < signal.steps.size(); ++i) {
    decay.advance(signal.steps[i]);
    q = decay.factor * q + decay.share * signal.change[i];
    at(column, i) = q;
  }
  return column;
}

// ∂q/∂ln τ: g ← e^{−x} g + x e^{−x} q + (φ − e^{−x}) Δu
Column maxwell_history_slope(const Signal& signal, double time) {
  Column column(signal.rows());
  Decay decay(time);
  double q = 0, g = 0;
  for (std::size_t i = 0; i < signal.steps.size(); ++i) {
    decay.advance(signal.steps[i]);
    const double drift = decay.share - decay.factor;
    g = decay.factor * g + decay.x * decay.factor * q + drift * signal.change[i];
    q = decay.factor * q + decay.share * signal.change[i];
    at(column, i) = g;
  }
  return column;
}

// z ← clamp(z + Δu, ±d)
Column stop_history(const Signal& signal, double threshold) {
  Column column(signal.rows());
  double z = 0;
  for (std::size_t i = 0; i < signal.change.size(); ++i) {
    z = std::clamp(z + signal.change[i], -threshold, threshold);
    at(column, i) = z;
  }
  return column;
}

// d ∂z/∂d: ±d where the slip yields, and what it was where it sticks.
Column stop_history_slope(const Signal& signal, double threshold) {
  Column column(signal.rows());
  double z = 0, slope = 0;
  for (std::size_t i = 0; i < signal.change.size(); ++i) {
    const double tried = z + signal.change[i];
    z = std::clamp(tried, -threshold, threshold);
    if (tried > threshold) slope = threshold;
    if (tried < -threshold) slope = -threshold;
    at(column, i) = slope;
  }
  return column;
}

// A spring whose slip lies beside a damper. Below the threshold z' = v; above it, with s the side, y = s z − d obeys
//     y' = s v − y/τ.
// Within a row v is constant, so that every phase ends at a time in closed form; there are at most three of them.
class SlidingSpring {
 public:
  SlidingSpring(double threshold, double time) : threshold_(threshold), time_(time) {}

  double advance(double change, double step) {
    double left = step;
    const double velocity = step > 0 ? change / step : 0;
    for (int phase = 0; phase < 4 && left > 0; ++phase) left -= advance_phase(velocity, left);
    return elongation_;
  }

 private:
  bool slides(double velocity) const {
    const double beyond = std::abs(elongation_) - threshold_;
    const bool goes_on = threshold_ == 0 ? velocity != 0 : elongation_ * velocity > 0;
    return beyond > 0 || (beyond == 0 && goes_on);
  }

  // Returns how much of the time is used up.
  double advance_phase(double velocity, double left) {
    return slides(velocity) ? advance_sliding(velocity, left) : advance_stuck(velocity, left);
  }

  double advance_stuck(double velocity, double left) {
    const double room = velocity > 0 ? threshold_ - elongation_ : threshold_ + elongation_;
    const double needed = velocity == 0 ? left : room / std::abs(velocity);
    if (needed >= left) {
      elongation_ += velocity * left;
      return left;
    }
    elongation_ = velocity > 0 ? threshold_ : -threshold_;
    return needed;
  }

  double advance_sliding(double velocity, double left) {
    const double side = (elongation_ != 0 ? elongation_ : velocity) > 0 ? 1 : -1;
    const double beyond = std::abs(elongation_) - threshold_, final = side * velocity * time_;
    // y(t) = final + (y − final) e^{−t/τ} reaches 0 only where it falls below it in the end.
    const double until_stuck = final < 0 ? time_ * std::log((beyond - final) / -final) : left;
    if (until_stuck >= left) {
      const double y = final + (beyond - final) * std::exp(-left / time_);
      elongation_ = side * (threshold_ + std::max(0.0, y));
      return left;
    }
    elongation_ = side * threshold_;
    return until_stuck;
  }

  double threshold_, time_;
  double elongation_ = 0;
};

Column sliding_history(const Signal& signal, const Term& term) {
  if (term.time <= 0) return stop_history(signal, term.threshold);
  Column column(signal.rows());
  SlidingSpring spring(term.threshold, term.time);
  for (std::size_t i = 0; i < signal.change.size(); ++i)
    at(column, i) = spring.advance(signal.change[i], signal.steps[i]);
  return column;
}

// Of a spectrum: storage above, loss below.
template <class Response>
Column spectrum(const Signal& signal, Response response) {
  const std::vector<double>& omega = signal.recording->time;
  Column column(signal.rows());
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const auto [storage, loss] = response(omega[i]);
    at(column, i) = storage;
    at(column, omega.size() + i) = loss;
  }
  return column;
}

struct Complex {
  double storage, loss;
};

// jx/(1 + jx), x = ωτ
Complex maxwell_spectrum(double omega, double time) {
  const double x = omega * time;
  return {x * x / (1 + x * x), x / (1 + x * x)};
}

// Its derivative with respect to ln τ: jx/(1 + jx)²
Complex maxwell_spectrum_slope(double omega, double time) {
  const double x = omega * time, square = (1 + x * x) * (1 + x * x);
  return {2 * x * x / square, x * (1 - x * x) / square};
}

template <class Function>
Column over_time(const Signal& signal, Function function) {
  Column column(signal.rows());
  for (std::size_t i = 0; i < signal.recording->time.size(); ++i) at(column, i) = function(signal.recording->time[i]);
  return column;
}

Column maxwell(const Signal& signal, double time) {
  switch (signal.recording->kind) {
    case RecordingKind::motion: {
      Column column = maxwell_history(signal, time);
      if (signal.form == Form::compliance)
        for (std::size_t i = 0; i < signal.drive.size(); ++i) at(column, i) = signal.drive[i] - at(column, i);
      return column;
    }
    case RecordingKind::relaxation: return over_time(signal, [&](double t) { return std::exp(-t / time); });
    case RecordingKind::creep: return over_time(signal, [&](double t) { return -std::expm1(-t / time); });
    case RecordingKind::frequency: return spectrum(signal, [&](double w) { return maxwell_spectrum(w, time); });
  }
  return {};
}

Column maxwell_slope(const Signal& signal, double time) {
  switch (signal.recording->kind) {
    case RecordingKind::motion: {
      const Column column = maxwell_history_slope(signal, time);
      return signal.form == Form::compliance ? Column(-column) : column;
    }
    case RecordingKind::relaxation: return over_time(signal, [&](double t) { return t / time * std::exp(-t / time); });
    case RecordingKind::creep: return over_time(signal, [&](double t) { return -t / time * std::exp(-t / time); });
    case RecordingKind::frequency: return spectrum(signal, [&](double w) { return maxwell_spectrum_slope(w, time); });
  }
  return {};
}

Column spring(const Signal& signal) {
  switch (signal.recording->kind) {
    case RecordingKind::motion: return Eigen::Map<const Column>(signal.drive.data(), signal.rows());
    case RecordingKind::relaxation:
    case RecordingKind::creep: return Column::Ones(signal.rows());
    case RecordingKind::frequency: return spectrum(signal, [](double) { return Complex{1, 0}; });
  }
  return {};
}

// Δu/h; in the compliance form ∫ f dt.
Column damper_history(const Signal& signal) {
  Column column(signal.rows());
  double sum = 0;
  for (std::size_t i = 0; i < signal.steps.size(); ++i) {
    const double step = signal.steps[i];
    sum += step * (signal.drive[i] - signal.change[i] / 2);
    at(column, i) = signal.form == Form::compliance ? sum : step > 0 ? signal.change[i] / step : 0;
  }
  return column;
}

Column damper(const Signal& signal) {
  switch (signal.recording->kind) {
    case RecordingKind::motion: return damper_history(signal);
    case RecordingKind::relaxation: return Column::Zero(signal.rows());  // an impulse before the first row
    case RecordingKind::creep: return over_time(signal, [](double t) { return t; });
    case RecordingKind::frequency: return spectrum(signal, [](double w) { return Complex{0, w}; });
  }
  return {};
}

Column springpot(const Signal& signal, double exponent) {
  constexpr double step = std::numbers::ln10 / springpot_branches_per_decade;
  const double first = std::log(signal.band.low);
  const auto points = static_cast<std::size_t>(std::ceil((std::log(signal.band.high) - first) / step)) + 1;
  Column column = Column::Zero(signal.rows());
  for (const MaxwellBranch& branch :
       springpot_ladder(exponent, signal.band.low, signal.band.high, SpringpotGrid{first, step, points}).branches)
    column += branch.stiffness * maxwell(signal, 1 / branch.relaxation_rate);
  return column;
}

Column initial(const Signal& signal, double time) {
  const double start = signal.recording->time.front();
  return over_time(signal, [&](double t) { return std::exp(-(t - start) / time); });
}

Term shaped(Term term, Shape shape, double change) {
  if (shape == Shape::time) term.time *= std::exp(change);
  if (shape == Shape::threshold) term.threshold *= std::exp(change);
  if (shape == Shape::exponent) term.exponent = std::clamp(term.exponent + change, 1e-4, 1 - 1e-4);
  return term;
}

Column straight_column(const Signal& signal, const Term& term) {
  switch (term.kind) {
    case TermKind::spring: return spring(signal);
    case TermKind::damper: return damper(signal);
    case TermKind::maxwell: return maxwell(signal, term.time);
    case TermKind::stop: return stop_history(signal, term.threshold);
    case TermKind::sliding: return sliding_history(signal, term);
    case TermKind::springpot: return springpot(signal, term.exponent);
    case TermKind::offset:
      return term.file == signal.file ? Column(Column::Ones(signal.rows())) : Column(Column::Zero(signal.rows()));
    case TermKind::initial:
      return term.file == signal.file ? initial(signal, term.time) : Column(Column::Zero(signal.rows()));
  }
  return {};
}

Column difference(const Signal& signal, const Term& term, Shape shape) {
  constexpr double reach = 1e-4;  // the error of a central difference, reach² / 6, is below the noise of any recording
  return (straight_column(signal, shaped(term, shape, reach)) - straight_column(signal, shaped(term, shape, -reach))) /
         (2 * reach);
}

Column straight_slope(const Signal& signal, const Term& term, Shape shape) {
  if (term.kind == TermKind::maxwell) return maxwell_slope(signal, term.time);
  if (term.kind == TermKind::stop) return stop_history_slope(signal, term.threshold);
  return difference(signal, term, shape);
}

void put_behind(Signal& signal, const CurveShape& curve) {
  for (double& drive : signal.drive) {
    const CurveShape::Place place = curve.at(drive);
    drive = place.value;
    signal.lever.push_back(place.tangent);
  }
}

// A sensor's offset is none of the tissue's force.
Column levered(const Signal& signal, const Term& term, Column column) {
  if (signal.lever.empty() || term.kind == TermKind::offset) return column;
  return column.cwiseProduct(Eigen::Map<const Column>(signal.lever.data(), signal.rows()));
}

}  // namespace

Signal signal_of(const Recording& recording, std::size_t file, Form form, const Band& band,
                 const std::optional<CurveShape>& curve) {
  Signal signal{&recording, file, {}, {}, {}, {}, band, form};
  if (recording.kind != RecordingKind::motion) return signal;
  signal.steps = steps_of(recording.time);
  signal.drive = form == Form::stiffness ? recording.position : recording.force;
  if (curve) put_behind(signal, *curve);
  signal.change.assign(signal.drive.size(), 0.0);
  for (std::size_t i = 1; i < signal.drive.size(); ++i) signal.change[i] = signal.drive[i] - signal.drive[i - 1];
  return signal;
}

Column unit_column(const Signal& signal, const Term& term) {
  return levered(signal, term, straight_column(signal, term));
}

Column column_slope(const Signal& signal, const Term& term, Shape shape) {
  return levered(signal, term, straight_slope(signal, term, shape));
}

}  // namespace dashpot::compiler::fitting
