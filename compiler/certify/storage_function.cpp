#include "certify/storage_function.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/estimator_names.hpp>
#include <limits>
#include <numbers>

#include "certify/common_storage.hpp"
#include "certify/recent.hpp"
#include "linear/real_traits.hpp"

namespace dashpot::compiler {

namespace {

namespace checker = dashpot_check;

constexpr std::size_t most_states_in_digits = 30;      // with more, 50 digits take seconds
constexpr std::size_t most_states_step_by_step = 100;  // with more, a step takes seconds
// With more, the search of one P for all holds takes seconds too, and rounding often ends it early: it is then tried
// only for laws for which nothing else is known.
constexpr std::size_t most_states_in_common = 18, most_states_in_common_at_all = 30;
// The share of the excess of the damping over S(θ) that is kept as a margin, so that rounding P does not spoil the
// proof. The least share is for narrow peaks that the states' scales miss, where the usual one is more than there is.
constexpr double usual_strictness = 0.25, least_strictness = 0.25e-3;
constexpr double most_off_in_doubles = 1e-10;  // relative error of a supremum; if it is larger, 50 digits are used

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// 1/T, and q, p, κ of an amplifier's lag; of none q = p = κ = 0. Of a command that acts late the rate at which samples
// come, p until the next one, what it is more from there on, and over the whole hold s = late/T.
template <class Scalar>
struct OneHold {
  Scalar rate, decay = 0, share = 0, spread = 0;
  Scalar late = 0, tilt = 0, pace = rate;

  bool operator==(const OneHold&) const = default;
};

// κ of a hold that is x lags long.
Real spread_of(const Real& x) {
  const Real q = exp(-x), p = (1 - q) / x;
  return p * ((1 + q) / 2 - p);
}

// A device's longest hold [s].
double length_of_longest(const checker::Device& device) {
  return device.sample_period + device.jitter + (device.write_latest - device.write_earliest);
}

template <class Scalar>
OneHold<Scalar> longest_hold(const checker::Device& device) {
  const Real all(length_of_longest(device)), after(device.write_latest), lag(device.amplifier_lag);
  const Real rate = 1 / all, late = after / all, x = lag > 0 ? Real((all - after) / lag) : Real(0);
  const Scalar pace(after > 0 ? Real(1 / (Real(device.sample_period) + Real(device.jitter))) : rate);
  if (lag == 0) return {Scalar(rate), 0, 0, 0, Scalar(late), 0, pace};
  const Real until = exp(-x), p = (1 - until) / x;
  if (after == 0) return {Scalar(rate), Scalar(until), Scalar(p), Scalar(spread_of(x)), 0, 0, pace};
  const Real y = after / lag, tilt = until * (1 - exp(-y)) / y - p;
  const Real spread = (1 - late) * spread_of(x) + late * until * until * spread_of(y);
  return {Scalar(rate), Scalar(exp(-all / lag)), Scalar(p), Scalar(spread), Scalar(late), Scalar(tilt), pace};
}

// x⁺ = A x + B w + L late, what is multiplied by w, C, and e.
template <class Scalar>
struct Recursion {
  Dense<Scalar> A, B, L, C;
  Scalar stiffness;
};

template <class Scalar>
Scalar nearest(const checker::Rational& value) {
  if constexpr (std::is_same_v<Scalar, double>) return value.convert_to<double>();
  else return Scalar(numerator(value)) / Scalar(denominator(value));
}

template <class Scalar>
Recursion<Scalar> recursion(const checker::LoopForm& loop, const OneHold<Scalar>& hold) {
  const Eigen::Index n = Eigen::Index(loop.states.size());
  Recursion<Scalar> r{Dense<Scalar>::Zero(n, n), Dense<Scalar>::Zero(n, 1), Dense<Scalar>::Zero(n, 1),
                      Dense<Scalar>::Zero(1, n), nearest<Scalar>(loop.stiffness)};
  std::map<std::string, Eigen::Index> place;
  for (Eigen::Index i = 0; i < n; ++i) place[loop.states[std::size_t(i)]] = i;
  for (Eigen::Index i = 0; i < n; ++i)
    for (const auto& [name, value] : loop.next.at(loop.states[std::size_t(i)])) {
      const bool is_divided = loop.states[std::size_t(i)] == "pace0";
      const Scalar factor = is_divided ? Scalar(nearest<Scalar>(value) * hold.pace) : nearest<Scalar>(value);
      if (name == "w") r.B(i, 0) += factor;
      else if (name == "late") r.L(i, 0) += factor;
      else r.A(i, place.at(name)) = factor;
    }
  for (const auto& [name, value] : loop.force) r.C(0, place.at(name)) = nearest<Scalar>(value);
  if (hold.spread != 0) {
    r.A(n - 1, n - 1) += hold.decay;
    r.C(0, n - 1) += hold.share;
  }
  return r;
}

// x(θ) = (zI − A)⁻¹ B, of a tool that rests between a sample and when its command acts. The states stand so that A is
// lower triangular but for a few rows of the estimator.
template <class Scalar>
class Response {
 public:
  explicit Response(const Recursion<Scalar>& r) : r_(r) {
    for (Eigen::Index i = 0, end = 0; i < r.A.rows(); i = end) {
      for (end = i + 1; end < r.A.rows() && reads_beyond(i, end); ++end) continue;
      blocks_.emplace_back(i, end);
    }
  }

  std::vector<std::complex<Scalar>> at(double angle) const {
    using Matrix = Dense<std::complex<Scalar>>;
    using std::sin;
    const Scalar sine = sin(Scalar(angle) / 2);
    const std::complex<Scalar> less_one(-2 * sine * sine, sin(Scalar(angle)));  // z − 1
    std::vector<std::complex<Scalar>> x(std::size_t(r_.A.rows()));
    for (const auto& [from, end] : blocks_) {
      const Eigen::Index size = end - from;
      Matrix left = Matrix::Zero(size, size), right(size, 1);
      for (Eigen::Index i = from; i < end; ++i) {
        right(i - from, 0) = r_.B(i, 0);
        for (Eigen::Index j = 0; j < from; ++j)
          if (r_.A(i, j) != 0) right(i - from, 0) += r_.A(i, j) * x[std::size_t(j)];
        for (Eigen::Index j = from; j < end; ++j)
          left(i - from, j - from) = i == j ? less_one + Scalar(1 - r_.A(i, i)) : std::complex<Scalar>(-r_.A(i, j));
      }
      const Matrix solution = size == 1 ? Matrix(right / left(0, 0)) : Matrix(left.partialPivLu().solve(right));
      for (Eigen::Index i = from; i < end; ++i) x[std::size_t(i)] = solution(i - from, 0);
    }
    return x;
  }

 private:
  bool reads_beyond(Eigen::Index from, Eigen::Index end) const {
    return (r_.A.block(from, end, end - from, r_.A.cols() - end).array() != 0).any();
  }
  const Recursion<Scalar>& r_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> blocks_;
};

// The damping that the loop needs at one frequency, S(θ).
template <class Scalar>
class Need {
 public:
  Need(const Recursion<Scalar>& r, const OneHold<Scalar>& hold, const checker::Device& device)
      : r_(r), hold_(hold), length_(length_of_longest(device)) {
    const LateWrite<Real> late = late_write(length_, device.write_latest, device.amplifier_lag);
    late_ = {Scalar(late.kept),   Scalar(late.share), Scalar(late.later_share),
             Scalar(late.spread), Scalar(late.mixed), Scalar(late.apart)};
  }

  Scalar at(double angle, const std::vector<std::complex<Scalar>>& x) const {
    using std::sqrt;
    Scalar answer = r_.stiffness / 2;
    for (std::size_t i = 0; i < x.size(); ++i) answer -= r_.C(0, Eigen::Index(i)) * x[i].real();
    Scalar square = hold_.spread == 0 ? Scalar(0) : hold_.spread * std::norm(x.back());
    if (hold_.late > 0) {
      const std::complex<Scalar> change = last_change(angle, x);  // h
      std::complex<Scalar> lacking(0);                            // e
      if (hold_.spread != 0) {
        lacking = turned_back(angle) * x.back() * late_.kept;
        answer += hold_.share * x.back().real() - late_.later_share * lacking.real();
      }
      answer -= late_.share * change.real();
      square = late_.apart * std::norm(change) + late_.spread * std::norm(late_.mixed * change + lacking);
    }
    if (square == 0) return Scalar(length_) * answer;
    return Scalar(length_) * (answer + sqrt(answer * answer + square)) / 2;
  }

 private:
  static std::complex<Scalar> turned_back(double angle) {  // w = z⁻¹
    using std::cos, std::sin;
    return {cos(Scalar(angle)), -sin(Scalar(angle))};
  }

  // Of the command, from the sample before to this one: − k0 w − (1 − w) C x, without what C has of e.
  std::complex<Scalar> last_change(double angle, const std::vector<std::complex<Scalar>>& x) const {
    using std::sin;
    const Scalar sine = sin(Scalar(angle) / 2);
    const std::complex<Scalar> difference(2 * sine * sine, sin(Scalar(angle)));  // 1 − w
    std::complex<Scalar> force(0);
    for (std::size_t i = 0; i < x.size(); ++i) force += x[i] * r_.C(0, Eigen::Index(i));
    if (hold_.spread != 0) force -= x.back() * hold_.share;
    return -(turned_back(angle) * r_.stiffness) - difference * force;
  }

  const Recursion<Scalar>& r_;
  const OneHold<Scalar>& hold_;
  double length_;  // [s]
  LateWrite<Scalar> late_;
};

// The least share that any state loses in a sample; none if 1 less that share rounds to 1 in Scalar.
template <class Scalar>
double least_leak(const Recursion<Scalar>& r) {
  double least = 1;
  for (Eigen::Index i = 0; i < r.A.rows(); ++i)
    if (const double leak = double(1 - r.A(i, i)); leak > 0) least = std::min(least, leak);
  return least;
}

// Angles down to where the slowest state, which is largest near rest, grows no more.
std::vector<double> angles_of_interest(double binding, double least_leak) {
  std::vector<double> angles = {std::numbers::pi};
  for (int i = 0; i < 420; ++i) angles.push_back(std::numbers::pi * std::pow(10.0, -13.5 * i / 420));
  for (double angle = 1e-14; angle > least_leak / 100; angle /= 2) angles.push_back(angle);
  for (int i = 0; i <= 80; ++i) angles.push_back(std::numbers::pi * i / 80);
  for (int i = 0; i < 120; ++i) angles.push_back(std::numbers::pi * (1 - std::pow(10.0, -8.0 * i / 120) / 2));
  for (int i = -100; i <= 100; ++i) {
    const double near = binding + (i < 0 ? -1 : 1) * binding * std::pow(10.0, -8.0 * (100 - std::abs(i)) / 100) / 2;
    if (near > 0 && near <= std::numbers::pi) angles.push_back(near);
  }
  return angles;
}

// What the states are divided by, as powers of two: their excursions over the angles of interest, whatever the damping.
template <class Scalar>
class StateScales {
 public:
  StateScales(const Recursion<Scalar>& r, const OneHold<Scalar>& hold, const checker::Device& device, double binding)
      : hold_(length_of_longest(device)) {
    const Response<Scalar> response(r);
    const Need<Scalar> need(r, hold, device);
    for (const double angle : angles_of_interest(binding, least_leak(r))) {
      const std::vector<std::complex<Scalar>> x = response.at(angle);
      places_.push_back({double(need.at(angle, x)), {}});
      for (const std::complex<Scalar>& state : x) places_.back().squares.push_back(double(std::norm(state)));
      if (hold.late > 0)
        places_.back().squares.front() = double(hold.late);  // what the tool moves until a command acts
    }
  }

  std::vector<double> at(double damping) const {
    std::vector<double> squares(places_.front().squares.size(), 0.0);
    for (const Place& place : places_) {
      const double left = std::max(damping - place.needed, damping * 1e-12);
      for (std::size_t i = 0; i < squares.size(); ++i)
        squares[i] = std::max(squares[i], place.squares[i] * hold_ / left);
    }
    for (double& square : squares) square = square > 0 ? std::exp2(std::round(std::log2(square) / 2)) : 1;
    return squares;
  }

 private:
  struct Place {
    double needed;                // S(θ)
    std::vector<double> squares;  // |x_i(θ)|²
  };
  double hold_;
  std::vector<Place> places_;
};

// P = −X, X the stabilising solution of AᵀXA − X − (AᵀXB + S)(R + BᵀXB)⁻¹(·)ᵀ − Q = 0 (Chu, Fan & Lin 2005), Q the
// strictness: the same share for the square of each state, and `strictness` for all of them.
template <class Scalar>
std::optional<Dense<Scalar>> riccati(const Dense<Scalar>& A, const Dense<Scalar>& B, const Dense<Scalar>& S,
                                     const Dense<Scalar>& R, double strictness) {
  using Matrix = Dense<Scalar>;
  const Eigen::Index n = A.rows();
  const Matrix inverse = R.inverse(), one = Matrix::Identity(n, n);
  Matrix step = A - B * inverse * S.transpose(), G = B * inverse * B.transpose();
  Matrix H = -one * (Scalar(strictness) / Scalar(double(n))) - S * inverse * S.transpose();
  for (int i = 0; i < 120; ++i) {  // enough for states that lose 2⁻¹⁰⁰ a sample
    const Eigen::PartialPivLU<Matrix> W(Matrix(one + G * H));
    const Matrix onward = W.solve(step), change = step.transpose() * (H * onward);
    G += step * W.solve(G) * step.transpose();
    H += change;
    H = (H + H.transpose()).eval() / Scalar(2);
    G = (G + G.transpose()).eval() / Scalar(2);
    step = step * onward;
    const double moved = double(change.cwiseAbs().maxCoeff()), all = double(H.cwiseAbs().maxCoeff());
    if (!std::isfinite(moved) || !std::isfinite(all)) return std::nullopt;
    if (moved <= 1e-18 * all) return Matrix(-H);
  }
  return std::nullopt;
}

template <class Scalar>
std::optional<checker::Storage> found_storage(const checker::LoopForm& loop, const OneHold<Scalar>& lag, double hold,
                                              double damping, const std::vector<double>& scale,
                                              double strictness = usual_strictness) {
  const Recursion<Scalar> r = recursion<Scalar>(loop, lag);
  const Eigen::Index n = r.A.rows(), late = lag.late == 0 ? 0 : 1, inputs = 1 + late + (lag.spread == 0 ? 0 : 1);
  Dense<Scalar> by(n, 1);
  for (Eigen::Index i = 0; i < n; ++i) by(i, 0) = Scalar(scale[std::size_t(i)]);
  using std::sqrt;
  const Scalar unit = sqrt(Scalar(hold) / Scalar(damping));
  Dense<Scalar> A = r.A, B = Dense<Scalar>::Zero(n, inputs), S = B, R = Dense<Scalar>::Identity(inputs, inputs);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) *= by(j, 0) / by(i, 0);
    B(i, 0) = r.B(i, 0) * unit / by(i, 0);
    S(i, 0) = r.C(0, i) * by(i, 0) * unit / Scalar(2);
  }
  if (late == 1) {  // of b (a² /(1 − s) + c²/s)/T, with c, and a = w − c, over √s of the unit
    const Scalar own = unit * sqrt(lag.late), early = Scalar(1) - lag.late;
    for (Eigen::Index i = 0; i < n; ++i) B(i, 1) = r.L(i, 0) * own / by(i, 0);
    if (lag.spread != 0) S(n - 1, 1) = by(n - 1, 0) * own * lag.tilt / Scalar(2);
    R(0, 0) = R(1, 1) = Scalar(1) / early;
    R(0, 1) = R(1, 0) = -sqrt(lag.late) / early;
  }
  R(0, 0) -= r.stiffness * unit * unit / Scalar(2);
  if (lag.spread != 0) S(n - 1, inputs - 1) = by(n - 1, 0) * unit * sqrt(lag.spread) / Scalar(2);
  const std::optional<Dense<Scalar>> P = riccati<Scalar>(A, B, S, R, strictness);
  if (!P) return std::nullopt;
  checker::Storage storage(loop.states.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<double>& row = storage[std::size_t(i)];
    for (Eigen::Index j = 0; j <= i; ++j) row.push_back(double((*P)(i, j) / (by(i, 0) * by(j, 0))));
    if constexpr (!std::is_same_v<Scalar, double>)
      for (Eigen::Index j = 0; j <= i; ++j)
        row.push_back(double((*P)(i, j) / (by(i, 0) * by(j, 0)) - Scalar(row[std::size_t(j)])));
  }
  return storage;
}

// The coefficients of the runtime's estimator, to the last bit.
std::vector<double> runtime_coefficients(const velocity_description& v, double T, double step) {
  const double n = std::clamp(v.window, 1u, longest_window);
  switch (v.estimator) {
    case estimator_kind::backward_difference: return {1 / (n * T)};
    case estimator_kind::least_squares: return {6 / (T * n * (n + 1) * (n + 2))};
    case estimator_kind::kalman: {
      const kalman<double> filter(v.acceleration, step, T);
      const double index = filter.manoeuvre_index(), root = 4 / (4 + index + square_root(8 * index + index * index));
      return {T, root * root, filter.beta() / T};
    }
    case estimator_kind::butterworth: {
      const unsigned order = v.order < 4 ? 2 : 4;
      const double g = tangent_of_half_turns(v.cutoff * T);
      std::vector<double> all = {1 / T, g};
      for (unsigned i = 0; i < order / 2; ++i) {
        const double k = 2 * sine_of_half_turns((order - 1 - 2.0 * i) / (2.0 * order));
        all.insert(all.end(), {1 / (1 + g * (g + k)), g + k});
      }
      return all;
    }
    case estimator_kind::foaw: {  // for every window that it may choose
      std::vector<double> all;
      for (double m = 1; m <= n; ++m) all.push_back(v.best_fit ? 6 / (m * (m + 1) * (m + 2) * T) : 1 / (m * T));
      return all;
    }
    default: return {};
  }
}

// The largest S(θ) and its angle, of `attained` at `angle` and of what is found near the angles of interest.
template <class Scalar>
std::pair<double, double> largest_need(const Recursion<Scalar>& r, const OneHold<Scalar>& hold,
                                       const checker::Device& device, double attained, double angle) {
  const Response<Scalar> response(r);
  const Need<Scalar> needed(r, hold, device);
  const auto need = [&](double at) { return double(needed.at(at, response.at(at))); };
  std::vector<double> angles = angles_of_interest(angle > 0 ? angle : 1, least_leak(r));
  std::sort(angles.begin(), angles.end());
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (const double found = need(angles[i]); found > most) most = found, best = i;
  double low = angles[best == 0 ? 0 : best - 1], high = angles[std::min(best + 1, angles.size() - 1)];
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    const bool rises = need(low + third) < need(high - third);
    (rises ? low : high) += rises ? third : -third;
  }
  most = std::max(most, need((low + high) / 2));
  return most > attained ? std::pair(most, (low + high) / 2) : std::pair(attained, angle);
}

class StorageSearch {
 public:
  // Without `is_proved` the exact check is left out, and the result is an estimate.
  StorageSearch(const checker::Program& program, const checker::LoopForm& loop, const checker::Device& device,
                const SampledBound& bound, bool is_proved)
      : program_(program),
        loop_(loop),
        device_(device),
        is_proved_(is_proved),
        hold_(length_of_longest(device)),
        lag_(longest_hold<double>(device)),
        lag_in_digits_(longest_hold<Real>(device)) {
    const double jitter = hold_ / device.sample_period;
    const bool is_scaled = lag_.spread == 0 && device.estimator != name_of(estimator_kind::interval_difference);
    const double attained = is_scaled ? bound.attained * jitter : 0;
    const double angle = 2 * std::numbers::pi * bound.frequency * device.sample_period;
    const Recursion<double> r = recursion<double>(loop, lag_);
    std::tie(supremum_, angle_) = largest_need(r, lag_, device, attained, angle);
    // A pole close to −1 has few digits in doubles.
    const Recursion<Real> exact = recursion<Real>(loop, lag_in_digits_);
    const double there = double(Need<Real>(exact, lag_in_digits_, device).at(angle_, Response<Real>(exact).at(angle_)));
    if (!(std::abs(supremum_ - there) <= most_off_in_doubles * supremum_))
      std::tie(supremum_, angle_) = largest_need(exact, lag_in_digits_, device, attained, angle);
    scales_.emplace(r, lag_, device, angle_);
  }

  double supremum() const { return supremum_; }

  std::size_t states() const { return loop_.states.size(); }

  std::optional<StorageProof> at(double damping, bool in_doubles, double strictness = usual_strictness) const {
    if (!(damping > 0)) return std::nullopt;
    std::optional<checker::Storage> storage =
        in_doubles
            ? found_storage<double>(loop_, lag_, hold_, damping, scales_->at(damping), strictness)
            : found_storage<Real>(loop_, lag_in_digits_, hold_, damping, scales_in_digits().at(damping), strictness);
    if (!storage) return std::nullopt;
    checker::Storage rounded = *storage;
    for (std::size_t i = 0; i < rounded.size(); ++i) rounded[i].resize(i + 1);
    if (proves(rounded, damping)) return StorageProof{damping, std::move(rounded), in_doubles};
    if (in_doubles || !proves(*storage, damping)) return std::nullopt;
    return StorageProof{damping, std::move(*storage), false};
  }

  // One for all holds that is next to the best, up to `excess`: from `damping`, where there is one.
  std::optional<StorageProof> best_for_all(double damping, double excess) const {
    const std::vector<double> scale = scales_->at(damping);
    const std::optional<checker::Storage> first = found_storage<double>(loop_, lag_, hold_, damping, scale);
    if (!first) return std::nullopt;
    const std::optional<CommonStorage> best =
        least_common_storage(inequalities(scale, damping), {1, scaled(*first, scale)}, excess);
    if (!best) return std::nullopt;
    checker::Storage storage(states());
    for (std::size_t i = 0; i < states(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        storage[i].push_back(best->P(Eigen::Index(i), Eigen::Index(j)) / (scale[i] * scale[j]));
    const double least = best->damping * damping;
    if (!proves(storage, least)) return std::nullopt;
    return StorageProof{least, storage, true};
  }

  // The P of the longest hold, if it serves all others too, with as little more damping than the supremum as is found
  // quickly. Nothing if that would be `most` or more.
  std::optional<StorageProof> longest_for_all(double most) const {
    constexpr double first_tried = 1e-4, most_tried = 100;  // beyond the supremum, relative to it
    const auto next = [&] { return longest_fails_ > 0 ? 2 * longest_fails_ : first_tried; };
    std::optional<StorageProof> best;
    while (!best && longest_fails_ < most_tried && supremum_ * (1 + longest_fails_) < most)
      if (best = longest_for_all_at(next()); !best) longest_fails_ = next();
    double fails = longest_fails_, serves = next();
    for (int i = 0; i < 3 && best && fails > 0; ++i) {
      const double middle = std::sqrt(fails * serves);
      if (std::optional<StorageProof> less = longest_for_all_at(middle)) best = std::move(less), serves = middle;
      else fails = middle;
    }
    if (!best || proves(best->storage, best->damping)) return best;
    return at(best->damping * (1 + 1e-6), true);
  }

 private:
  const StateScales<Real>& scales_in_digits() const {
    if (!scales_in_digits_)
      scales_in_digits_.emplace(recursion<Real>(loop_, lag_in_digits_), lag_in_digits_, device_, angle_);
    return *scales_in_digits_;
  }

  bool proves(const checker::Storage& storage, double damping) const {
    const auto are_finite = [](const std::vector<double>& row) {
      return std::all_of(row.begin(), row.end(), [](double entry) { return std::isfinite(entry); });
    };
    if (!is_proved_) return true;
    return std::isfinite(damping) && std::all_of(storage.begin(), storage.end(), are_finite) &&
           checker::proves(program_, device_, storage, damping);
  }

  // Checked in doubles only.
  std::optional<StorageProof> longest_for_all_at(double excess) const {
    const double damping = supremum_ * (1 + excess);
    if (!(damping > 0)) return std::nullopt;
    const std::vector<double> scale = scales_->at(damping);
    std::optional<checker::Storage> storage = found_storage<double>(loop_, lag_, hold_, damping, scale);
    if (!storage) return std::nullopt;
    const CommonStorage tried{1, scaled(*storage, scale)};
    for (const auto& [hold, r] : all_holds())
      if (!serves(inequality(hold, r, scale, damping), tried)) return std::nullopt;
    return StorageProof{damping, std::move(*storage), true};
  }

  static Dense<double> scaled(const checker::Storage& storage, const std::vector<double>& scale) {
    const Eigen::Index n = Eigen::Index(scale.size());
    Dense<double> P(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        P(i, j) = P(j, i) = storage[std::size_t(i)][std::size_t(j)] * scale[std::size_t(i)] * scale[std::size_t(j)];
    return P;
  }

  // All holds that differ in doubles.
  const std::vector<std::pair<OneHold<double>, Recursion<double>>>& all_holds() const {
    thread_local Recent<checker::Device, std::vector<checker::Hold>> recent;
    if (holds_.empty())
      for (const checker::Hold& hold : recent.at(device_, [&] { return checker::holds(device_); })) {
        const checker::Rational all = hold.before + hold.after;  // [s]
        const OneHold<double> one{nearest<double>(1 / all),          nearest<double>(hold.decay),
                                  nearest<double>(hold.share),       nearest<double>(hold.spread / all),
                                  nearest<double>(hold.after / all), nearest<double>(hold.tilt),
                                  nearest<double>(hold.rate)};
        const bool is_known =
            std::any_of(holds_.begin(), holds_.end(), [&](const auto& known) { return known.first == one; });
        if (!is_known) holds_.emplace_back(one, recursion<double>(loop_, one));
      }
    return holds_;
  }

  std::vector<HoldInequality> inequalities(const std::vector<double>& scale, double damping) const {
    std::vector<HoldInequality> all;
    for (const auto& [hold, r] : all_holds()) all.push_back(inequality(hold, r, scale, damping));
    return all;
  }

  // The inequality of one hold, in the coordinates of the search: states over `scale`, inputs over a unit, dampings
  // over `damping`.
  HoldInequality inequality(const OneHold<double>& hold, const Recursion<double>& r, const std::vector<double>& scale,
                            double damping) const {
    const double unit = std::sqrt(hold_ / damping);
    const Eigen::Index n = r.A.rows(), late = hold.late == 0 ? 0 : 1, all = n + 1 + late + (hold.spread == 0 ? 0 : 1);
    HoldInequality result{Dense<double>::Zero(n, all), Dense<double>::Zero(all, all), Dense<double>::Zero(all, all)};
    const double own = unit * std::sqrt(hold.late);  // unit of what the tool moves until a command acts
    for (Eigen::Index i = 0; i < n; ++i) {
      const double by = scale[std::size_t(i)];
      for (Eigen::Index j = 0; j < n; ++j) result.next(i, j) = r.A(i, j) * scale[std::size_t(j)] / by;
      result.next(i, n) = r.B(i, 0) * unit / by;
      if (late == 1) result.next(i, n + 1) = r.L(i, 0) * own / by;
      result.constant(i, n) = result.constant(n, i) = r.C(0, i) * by * unit / 2;
    }
    const double share = damping * unit * unit * hold.rate;
    result.constant(n, n) = -r.stiffness * unit * unit / 2;
    result.damping(n, n) = share / (1 - hold.late);
    if (late == 1) {
      result.damping(n, n + 1) = result.damping(n + 1, n) = -std::sqrt(hold.late) * share / (1 - hold.late);
      result.damping(n + 1, n + 1) = share / (1 - hold.late);
    }
    if (hold.spread == 0) return result;
    if (late == 1) result.constant(n - 1, n + 1) = result.constant(n + 1, n - 1) = scale.back() * own * hold.tilt / 2;
    result.constant(n - 1, all - 1) = result.constant(all - 1, n - 1) = scale.back() * unit / 2;
    result.damping(all - 1, all - 1) = share / hold.spread;
    return result;
  }

  const checker::Program& program_;
  const checker::LoopForm& loop_;
  const checker::Device& device_;
  bool is_proved_;
  double hold_;          // the longest [s]
  OneHold<double> lag_;  // over it
  OneHold<Real> lag_in_digits_;
  double supremum_ = 0, angle_ = 0;
  std::optional<StateScales<double>> scales_;
  mutable std::optional<StateScales<Real>> scales_in_digits_;                 // when first asked for
  mutable std::vector<std::pair<OneHold<double>, Recursion<double>>> holds_;  // all that differ, when first asked for
  mutable double longest_fails_ = 0;  // relative excess over the supremum at which longest_for_all() last found nothing
};

// Empty where the estimator's coefficients, as rounded, are not what the checker derives.
std::optional<checker::LoopForm> loop_form_of(const checker::Program& program, const checker::Device& device) {
  try {
    return checker::loop_form(program, device);
  } catch (const checker::Unknown&) {
    return std::nullopt;
  }
}

// The proof with the least of these slacks above the supremum for which there is one, and not above `most`. By
// bisection: if one slack succeeds, all larger ones are taken to.
std::optional<StorageProof> punctual_proof(const StorageSearch& search, double most) {
  std::vector<double> slacks = {4e-9, 9e-9, 4e-8, 4e-7, 4e-6, 4e-5, 4e-4, 4e-3, 4e-2};
  const bool takes_long = search.states() > most_states_in_digits;
  if (search.states() > most_states_step_by_step) slacks.resize(1);
  while (slacks.size() > 1 && search.supremum() * (1 + slacks.back()) > most) slacks.pop_back();
  const auto at = [&](std::size_t step) -> std::optional<StorageProof> {
    const double damping = search.supremum() * (1 + slacks[step]);
    for (const double strictness : {usual_strictness, least_strictness})
      for (const bool in_doubles : {true, false})
        if (!takes_long || (in_doubles && strictness == usual_strictness))
          if (std::optional<StorageProof> proof = search.at(damping, in_doubles, strictness)) return proof;
    return std::nullopt;
  };
  std::size_t fails = 0, serves = slacks.size() - 1;
  std::optional<StorageProof> best = at(fails);
  if (best || serves == fails) return best;
  best = at(serves);
  while (best && serves - fails > 1) {
    const std::size_t middle = (fails + serves) / 2;
    if (std::optional<StorageProof> nearer = at(middle)) best = std::move(nearer), serves = middle;
    else fails = middle;
  }
  return best;
}

// One P for holds of all lengths, behind an amplifier's lag or for measured intervals that vary. The P of the longest
// hold is taken where it serves all others with less damping than the best common one that is found, always if there
// are many states, and, where a proof is wanted soon, with hardly more than the necessary damping.
std::optional<StorageProof> jittered_proof(const StorageSearch& search, bool is_soon) {
  constexpr double most_tried = 100;  // relative to the supremum
  constexpr double hardly_more = 1.01, any = std::numeric_limits<double>::infinity();
  if (is_soon)
    if (std::optional<StorageProof> proof = search.longest_for_all(search.supremum() * hardly_more);
        proof && proof->damping < search.supremum() * hardly_more)
      return proof;
  const bool has_many_states = search.states() > most_states_in_common;
  if (has_many_states)
    if (std::optional<StorageProof> proof = search.longest_for_all(any)) return proof;
  if (search.states() <= most_states_in_common_at_all)
    for (double serves = 2; serves < most_tried; serves *= 2)
      if (std::optional<StorageProof> proof = search.best_for_all(search.supremum() * serves, is_soon ? 1e-3 : 1e-4)) {
        const std::optional<StorageProof> of_longest = search.longest_for_all(proof->damping);
        return of_longest && of_longest->damping < proof->damping ? of_longest : proof;
      }
  return has_many_states ? std::nullopt : search.longest_for_all(any);
}

}  // namespace

checker::Device checked_device(const SampledLoop& loop) {
  const velocity_description& v = loop.velocity;
  checker::Device device{loop.sample_period,
                         loop.jitter,
                         loop.write_earliest,
                         loop.write_latest,
                         loop.amplifier_lag,
                         v.cutoff,
                         v.acceleration,
                         loop.joint_encoder_step,
                         loop.delay_samples,
                         1,
                         v.order,
                         v.best_fit,
                         "difference of two samples",
                         {1 / loop.sample_period}};
  if (!loop.has_device) return device;
  device.window = std::clamp(v.window, 1u, longest_window);
  device.estimator = name_of(v.estimator);
  device.estimator_coefficients = runtime_coefficients(v, loop.sample_period, loop.joint_encoder_step);
  return device;
}

checker::Program checked_program(const MotorConstants& motor) {
  checker::Program program;
  program.force = {{"velocity", motor.velocity_gain},
                   {"last", -Rational(motor.step_stiffness)},
                   {"position", Rational(motor.static_stiffness) + Rational(motor.step_stiffness)}};
  for (std::size_t i = 0; i < motor.modes.size(); ++i) {
    const MotorMode& mode = motor.modes[i];
    const std::string name = "mode" + std::to_string(i);
    program.force[name] = 1;
    program.states.push_back(name);
    program.next[name] = {{name, exact_decay(motor, mode)},
                          {"position", mode.position_drive},
                          {"last", -Rational(mode.position_drive)},
                          {"velocity", mode.velocity_drive}};
  }
  program.states.push_back("last");
  program.next["last"] = {{"position", 1}};
  const auto without_zeros = [](checker::Form& form) {
    std::erase_if(form, [](const auto& term) { return term.second == 0; });
  };
  without_zeros(program.force);
  for (auto& [state, form] : program.next) without_zeros(form);
  return program;
}

namespace {

// The result of `find` for a motor on a device with its estimator, if that can be searched at all.
template <class Find>
std::optional<StorageProof> found_proof(const MotorConstants& motor, const SampledLoop& loop, bool is_proved,
                                        Find find) {
  const std::optional<EstimatorFactors> factors =
      motor.follows_estimate() ? estimator_factors(loop) : EstimatorFactors{};
  const bool may_follow_at_once = needs_one_for_all_holds(motor, loop) && loop.jitter >= loop.sample_period;
  if (!factors || may_follow_at_once || loop.may_overtake()) return std::nullopt;
  const checker::Device device = checked_device(loop);
  const checker::Program program = checked_program(motor);
  const std::optional<checker::LoopForm> form = loop_form_of(program, device);
  if (!form || form->states.size() > most_storage_states) return std::nullopt;
  if (form->force.empty() && form->stiffness == 0) {
    StorageProof idle;
    for (std::size_t i = 0; i < form->states.size(); ++i) idle.storage.emplace_back(i + 1, 0.0);
    return idle;
  }
  const NeededDamping needed(motor, loop, *factors);
  const SampledBound bound = sampled_bound(needed, loop.sample_period, most_terms / 10);
  return find(StorageSearch(program, *form, device, bound, is_proved));
}

}  // namespace

bool needs_one_for_all_holds(const MotorConstants& motor, const SampledLoop& loop) {
  const bool divides = motor.follows_estimate() && divides_by_varying_interval(loop);
  return !loop.is_punctual() && (loop.amplifier_lag > 0 || divides);
}

std::optional<StorageProof> storage_proof(const MotorConstants& motor, const SampledLoop& loop, double most) {
  return found_proof(motor, loop, true, [&](const StorageSearch& search) {
    return needs_one_for_all_holds(motor, loop) ? jittered_proof(search, false) : punctual_proof(search, most);
  });
}

std::optional<StorageProof> proof_for_all_holds(const MotorConstants& motor, const SampledLoop& loop,
                                                std::optional<double> enough) {
  return found_proof(motor, loop, true, [&](const StorageSearch& search) {
    const bool may_be_enough = !enough || search.supremum() <= *enough;
    std::optional<StorageProof> proof = may_be_enough ? jittered_proof(search, true) : std::nullopt;
    return proof && (!enough || proof->damping <= *enough) ? proof : jittered_proof(search, false);
  });
}

std::optional<double> estimate_for_all_holds(const MotorConstants& motor, const SampledLoop& loop) {
  const std::optional<StorageProof> found =
      found_proof(motor, loop, false, [](const StorageSearch& search) { return jittered_proof(search, false); });
  return found ? std::optional(found->damping) : std::nullopt;
}

}  // namespace dashpot::compiler
