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

std::vector<MaxwellBranch> springpot_branches(double exponent, const Band& band) {
  constexpr double step = std::numbers::ln10 / springpot_branches_per_decade;
  const double first = std::log(band.low);
  const auto points = static_cast<std::size_t>(std::ceil((std::log(band.high) - first) / step)) + 1;
  return springpot_ladder(exponent, band.low, band.high, SpringpotGrid{first, step, points}).branches;
}

Column springpot(const Signal& signal, double exponent) {
  Column column = Column::Zero(signal.rows());
  for (const MaxwellBranch& branch : springpot_branches(exponent, signal.band))
    column += branch.stiffness * maxwell(signal, 1 / branch.relaxation_rate);
  return column;
}

Column initial(const Signal& signal, double time) {
  const double start = signal.recording->time.front();
  return over_time(signal, [&](double t) { return std::exp(-(t - start) / time); });
}

// One element of a tissue whose surface is followed. It is copied to try where the surface might go.
class Follower {
 public:
  Follower(const Term& term, double weight)
      : term_(term), weight_(weight), decay_(term.time), sliding_(term.threshold, term.time) {}

  // At the first row nothing but a spring has had time to be pushed.
  void begin(double position) { state_ = term_.kind == TermKind::spring ? position : 0; }

  // Moves on; returns its force then.
  double advance(double change, double step) {
    switch (term_.kind) {
      case TermKind::spring: return weight_ * (state_ += change);
      case TermKind::damper: return step > 0 ? weight_ * change / step : 0;
      case TermKind::maxwell:
        decay_.advance(step);
        return weight_ * (state_ = decay_.factor * state_ + decay_.share * change);
      case TermKind::stop: return weight_ * (state_ = std::clamp(state_ + change, -term_.threshold, term_.threshold));
      case TermKind::sliding: return weight_ * sliding_.advance(change, step);
      default: return 0;
    }
  }

 private:
  Term term_;
  double weight_;
  Decay decay_;
  SlidingSpring sliding_;
  double state_ = 0;
};

class Followers {
 public:
  Followers(const std::vector<Term>& terms, const Column& weights, const Band& band) {
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const double weight = weights[static_cast<Eigen::Index>(j)];
      const Term& term = terms[j];
      if (weight == 0 || is_signed(term)) continue;
      is_straight_ = is_straight_ && term.kind != TermKind::stop && term.kind != TermKind::sliding;
      if (term.kind != TermKind::springpot) list_.emplace_back(term, weight);
      else
        for (const MaxwellBranch& branch : springpot_branches(term.exponent, band))
          list_.emplace_back(Term{TermKind::maxwell, 1 / branch.relaxation_rate, 0, 0, 0}, weight * branch.stiffness);
    }
  }

  void begin(double position) {
    for (Follower& one : list_) one.begin(position);
  }

  double advance(double change, double step) {
    double force = 0;
    for (Follower& one : list_) force += one.advance(change, step);
    return force;
  }

  double tried(double change, double step) const { return Followers(*this).advance(change, step); }

  // The change at which the force is 0, given one at which it pulls. The force rises with the change, in a straight
  // line except for slips.
  double released(double pulling, double step, double most) const {
    const double other = pulling < 0 ? 0 : most;
    const double at_other = tried(other, step), at_pulling = tried(pulling, step);
    if (is_straight_) return at_other > at_pulling ? other - at_other * (other - pulling) / (at_other - at_pulling) : 0;
    double low = pulling, high = at_other < 0 ? most : other;
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = (low + high) / 2;
      (tried(middle, step) < 0 ? low : high) = middle;
    }
    return high;
  }

 private:
  std::vector<Follower> list_;
  bool is_straight_ = true;
};

// The displacement at which a curve's map has that value.
double unmapped(const CurveShape& curve, double value, double most) {
  double low = 0, high = most;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = (low + high) / 2;
    (curve.at(middle).value < value ? low : high) = middle;
  }
  return high;
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

// A sensor's offset does not belong to the tissue's force, so w′ does not apply to it.
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
  signal.drive = form == Form::stiffness ? recording.pushed() : recording.force;
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

std::vector<double> surface_under(const Recording& recording, const std::vector<Term>& terms, const Column& weights,
                                  const Band& band, const std::optional<CurveShape>& curve) {
  const std::vector<double> steps = steps_of(recording.time);
  const double furthest = *std::max_element(recording.position.begin(), recording.position.end());
  const auto mapped = [&](double position) { return curve ? curve->at(position).value : position; };
  const double most = mapped(furthest);
  Followers tissue(terms, weights, band);
  std::vector<double> surface{recording.position.front()};
  double last = mapped(surface.front());
  tissue.begin(last);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double tool = mapped(recording.position[i]), approach = tool - last;
    const bool pulls = tissue.tried(approach, steps[i]) < 0;
    const double change = pulls ? tissue.released(approach, steps[i], most) : approach;
    tissue.advance(change, steps[i]);
    last = pulls ? last + change : tool;
    surface.push_back(!pulls ? recording.position[i] : curve ? unmapped(*curve, last, furthest) : last);
  }
  return surface;
}

}  // namespace dashpot::compiler::fitting
