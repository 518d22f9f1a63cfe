#include "slip_trial.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <dashpot/brake_coil.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <deque>
#include <functional>
#include <numbers>

#include "certify/convex_search.hpp"
#include "law/evaluate.hpp"
#include "network/match.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using std::numbers::pi;
using Samples = Eigen::Map<const Eigen::ArrayXd>;

// Samples of a motion, at the law's rate. A sine that would need more is played faster: the error of a slip law grows
// with the velocity, so that slower motions would show less of it.
constexpr double most_samples = 1500;
constexpr double most_periods = 3;
constexpr double around_yield[] = {0.5, 2, 8};  // amplitudes, in displacements at yield

class AnyEvaluation {
 public:
  explicit AnyEvaluation(const UpdateLaw& law) {
    if (law.scalar == ScalarType::float64) wide_.emplace(law);
    else narrow_.emplace(law);
  }

  void reset(double position) {
    if (wide_) wide_->reset(position);
    else narrow_->reset(float(position));
  }

  command<double> step(double position, double velocity) {
    if (wide_) return wide_->step(position, velocity);
    const command<float> now = narrow_->step(float(position), float(velocity));
    return {double(now.damping), double(now.force)};
  }

 private:
  std::optional<Evaluation<double>> wide_;
  std::optional<Evaluation<float>> narrow_;
};

double largest_size(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / double(values.size()));
}

// `shape` of a sine.
template <class Shape>
std::vector<double> to_and_fro(double at, double amplitude, double frequency, double period, int instants,
                               Shape shape) {
  const double samples = std::min(most_samples, most_periods / (frequency * period));
  std::vector<double> positions;
  for (int i = 1; i <= int(samples) * instants; ++i)
    positions.push_back(at + amplitude * shape(std::sin(2 * pi * frequency * i * period / instants)));
  return positions;
}

// Total stiffness of all elements at a frequency: no slip carries more than this times the tool's displacement.
double stuck_amplitude(const Network& network, double angular_frequency) {
  double stiffness = 0, yield = 0;
  for (const Element& element : network.elements) {
    match(
        element.law, [&](const Spring& spring) { stiffness += spring.stiffness; },
        [&](const Damper& damper) { stiffness += damper.damping * angular_frequency; },
        [&](const Slip& slip) {
          if (slip.yield_force > 0) yield = yield == 0 ? slip.yield_force : std::min(yield, slip.yield_force);
        });
  }
  return stiffness > 0 && yield > 0 ? yield / stiffness / 2 : 1e-6;
}

// The commands' way to the tool.
class Drives {
 public:
  Drives(const PortDevice& device, double instant)
      : device_(device),
        instant_(instant),
        lacking_(device.amplifier_lag() > 0 ? std::exp(-instant / device.amplifier_lag()) : 0),
        most_(std::sqrt(device.max_damping().value_or(0) / device.damping_scale())),
        late_(device.description().loop.delay_samples, command<double>{0, 0}),
        until_write_(int(std::lround(mean_write_delay(device) / instant))),
        coil_(device.description().brake) {}

  // The brake is on, and the motor at rest, before a motion begins.
  void begin(const command<double>& first) {
    coil_.reset(std::sqrt(first.damping / device_.damping_scale()));
    std::fill(late_.begin(), late_.end(), command<double>{first.damping, 0});
    told_ = next_ = {first.damping, 0};
    wanted_ = std::sqrt(first.damping / device_.damping_scale());
  }

  void take(const command<double>& now) {
    late_.push_back(now);
    next_ = late_.front();
    late_.pop_front();
    waits_ = until_write_;
  }

  void advance() {
    if (waits_-- == 0) {
      told_ = next_;
      wanted_ = std::sqrt(std::max(told_.damping, 0.0) / device_.damping_scale());
    }
    force_ = told_.force + (force_ - told_.force) * lacking_;
    if (coil_.root_damping() == wanted_) return;  // it stays there
    coil_.advance(std::clamp(coil_.demand_to_reach(wanted_, instant_), 0.0, std::max(most_, wanted_)), instant_);
  }

  double force() const { return force_; }
  double damping() const { return coil_.damping() * device_.damping_scale(); }

 private:
  static double mean_write_delay(const PortDevice& device) {
    return (device.description().loop.write_earliest + device.description().loop.write_latest) / 2;
  }

  const PortDevice& device_;
  double instant_;  // [s]
  double lacking_;  // of a change of the force after an instant [1]
  double most_;     // of the coil's current, as the root of the damping at the brake
  std::deque<command<double>> late_;
  int until_write_;  // instants of a sample until its command acts
  int waits_ = 0;    // those that are left of them
  command<double> next_{0, 0}, told_{0, 0};
  double wanted_ = 0;  // of the coil's current, as the root of the damping at the brake
  brake_coil<double> coil_;
  double force_ = 0;
};

// What the loop reads.
class Sensing {
 public:
  explicit Sensing(const PortDevice& device, double at)
      : device_(device),
        estimator_(device.description().velocity, device.sample_period(), device.description().encoder.step) {
    estimator_.reset(counted(at));
  }

  double position(double tool) const { return counted(tool) * device_.position_scale(); }

  double velocity(double tool, double true_velocity, std::uint64_t sample) {
    device_sample now;
    now.position = counted(tool);
    now.velocity = true_velocity / device_.position_scale();
    now.timestamp_ns = std::uint64_t(double(sample) * device_.sample_period() * 1e9);
    now.sequence = std::uint32_t(sample);
    return estimator_.update(now) * device_.position_scale();
  }

 private:
  double counted(double tool) const {
    const double joint = tool / device_.position_scale(), step = device_.description().encoder.step;
    return step > 0 ? std::floor(joint / step) * step : joint;
  }

  const PortDevice& device_;
  any_estimator<double> estimator_;
};

FeltForce felt_on_ideal(const UpdateLaw& law, const std::vector<double>& positions, double at) {
  AnyEvaluation run(law);
  run.reset(at);
  FeltForce felt;
  double last = at;
  for (const double position : positions) {
    const double velocity = (position - last) / law.sample_period;
    const command<double> now = run.step(position, velocity);
    felt.weak.push_back(now.force + now.damping * velocity);
    felt.dissipated += now.damping * velocity * velocity;
    felt.square_velocity += velocity * velocity;
    last = position;
  }
  felt.strong = felt.weak;
  return felt;
}

// Whatever the law: the device's part of a run that all laws share.
SensedMotion sensed(const TrialMotion& motion, double at, const PortDevice& device, int instants, double period) {
  const std::vector<double>& positions = motion.position;
  const double instant = period / instants;
  Sensing sensing(device, at);
  SensedMotion seen;
  seen.rest = sensing.position(at);
  for (std::size_t i = 0; i + std::size_t(instants) <= positions.size(); i += std::size_t(instants)) {
    const double here = i == 0 ? at : positions[i - 1], velocity = (positions[i] - here) / instant;
    seen.samples.push_back({sensing.position(here), sensing.velocity(here, velocity, i / std::size_t(instants))});
    for (std::size_t j = i; j < i + std::size_t(instants); ++j)
      seen.speed.push_back((positions[j] - (j == 0 ? at : positions[j - 1])) / instant);
  }
  return seen;
}

FeltForce felt_on_device(const UpdateLaw& law, const SensedMotion& seen, const PortDevice& device, int instants) {
  AnyEvaluation run(law);
  const double residual = device.residual_damping(), weakest = 1 - device.tolerance(),
               strongest = 1 + device.tolerance();
  Drives drives(device, law.sample_period / instants);
  run.reset(seen.rest);
  drives.begin({law.damping, 0});
  FeltForce felt;
  felt.weak.reserve(seen.speed.size());
  felt.strong.reserve(seen.speed.size());
  std::size_t j = 0;
  for (const SensedMotion::Sample& sample : seen.samples) {
    const command<double> now = run.step(sample.position, sample.velocity);
    drives.take(now);
    for (const std::size_t next = j + std::size_t(instants); j < next; ++j) {
      const double speed = seen.speed[j];
      drives.advance();
      const double brake = drives.damping();
      felt.weak.push_back(drives.force() + (brake * weakest + residual) * speed);
      felt.strong.push_back(drives.force() + (brake * strongest + residual) * speed);
      felt.dissipated += now.damping * speed * speed;
      felt.square_velocity += speed * speed;
    }
  }
  return felt;
}

// Where in a quarter of a sine the force first departs from what it is for a motion so small that all slips hold.
double displacement_at_yield(const Network& network, const UpdateLaw& coarse, double frequency) {
  const double period = coarse.sample_period, surface = network.surface_behind_map();
  const int samples = int(std::max(16.0, 0.25 / (frequency * period)));
  const auto run = [&](double amplitude) {
    std::vector<double> positions;
    for (int i = 1; i <= samples; ++i) positions.push_back(surface + amplitude * std::sin(pi / 2 * i / samples));
    return felt_on_ideal(coarse, positions, surface).weak;
  };
  const double stuck = stuck_amplitude(network, 2 * pi * frequency);
  const std::vector<double> linear = run(stuck);
  const double scale = largest_size(linear);
  for (double factor = 2; factor < 1e9; factor *= 2) {
    const std::vector<double> forces = run(stuck * factor);
    for (int i = 0; i < samples; ++i)
      if (std::abs(forces[std::size_t(i)] / factor - linear[std::size_t(i)]) > 1e-3 * scale)
        return stuck * factor * std::sin(pi / 2 * (i + 1) / samples);
  }
  return stuck;
}

// From where the network lies unloaded, how far the tool goes to displace it so far; of a static curve no further than
// that is known.
double way_of_tool(const Network& network, double displacement) {
  if (!network.map) return displacement;
  const auto is_before = [&](double way) { return network.map->value_at(way) < displacement; };
  return is_before(network.map->reach) ? network.map->reach : boundary(is_before, 0, network.map->reach, 1e-9);
}

}  // namespace

SlipTrial::SlipTrial(const Network& network, const UpdateLaw& coarse, const UpdateLaw& fine, const PortDevice& device)
    : device_(device), at_(network.surface()) {
  const int instants = instants_a_sample(device);
  const std::string unit = port_units(network.port_motion).position;
  const double period = coarse.sample_period, slowest = 1.25 / (most_samples * period), highest = 0.25 / period;
  const double low = std::clamp(device.band_low() / (2 * pi), slowest, highest),
               high = std::clamp(device.band_high() / (2 * pi), slowest, highest);
  const std::vector<double> frequencies = low < high ? std::vector{low, high} : std::vector{low};
  for (const double frequency : frequencies) {
    const double yield = displacement_at_yield(network, coarse, frequency);
    for (const double share : around_yield) {
      const double way = way_of_tool(network, share * yield);
      motions_.push_back({fmt::format("a sine of {:.3g} Hz and ±{:.3g} {}", frequency, way, unit),
                          to_and_fro(at_, way, frequency, period, instants, std::identity())});
    }
  }
  const double middle = std::sqrt(low * high);
  const double way = way_of_tool(network, around_yield[2] * displacement_at_yield(network, coarse, middle));
  const auto at_one_speed = [](double sine) { return std::asin(sine); };
  motions_.push_back(
      {fmt::format("a drag to and fro at {:.3g} {}/s over ±{:.3g} {}", 4 * way * middle, unit, way, unit),
       to_and_fro(at_, way * 2 / pi, middle, period, instants, at_one_speed)});
  for (const TrialMotion& motion : motions_) {
    if (!device.is_ideal()) sensed_.push_back(sensed(motion, at_, device, instants, period));
    std::vector<double> force = felt_on_ideal(fine, motion.position, at_).weak;
    const double largest = largest_size(force), rms = root_mean_square(force);
    forces_.push_back({std::move(force), largest, rms});
  }
}

FeltForce SlipTrial::felt(const UpdateLaw& law, std::size_t motion) const {
  return device_.is_ideal() ? felt_on_ideal(law, motions_[motion].position, at_)
                            : felt_on_device(law, sensed_[motion], device_, instants_a_sample(device_));
}

TrialError trial_error(const SlipTrial& trial, const std::vector<FeltForce>& felt) {
  TrialError worst;
  for (std::size_t m = 0; m < felt.size(); ++m) {
    const std::vector<double>& truth = trial.network_force(m);
    const double peak = trial.largest_network_force(m), rms = trial.rms_network_force(m);
    TrialError of_motion;
    for (const std::vector<double>* end : {&felt[m].weak, &felt[m].strong}) {
      const auto size = static_cast<Eigen::Index>(std::min(end->size(), truth.size()));
      if (size == 0) continue;
      const auto error = Samples(end->data(), size) - Samples(truth.data(), size);
      if (peak > 0) of_motion.peak = std::max(of_motion.peak, error.abs().maxCoeff() / peak);
      if (rms > 0) of_motion.rms = std::max(of_motion.rms, std::sqrt(error.square().mean()) / rms);
    }
    worst.peak = std::max(worst.peak, of_motion.peak);
    worst.rms = std::max(worst.rms, of_motion.rms);
    worst.by_motion.push_back(of_motion.worst());
  }
  return worst;
}

ErrorBetween::ErrorBetween(const SlipTrial& trial, const std::vector<FeltForce>& first,
                           const std::vector<FeltForce>& second) {
  for (std::size_t m = 0; m < first.size(); ++m)
    for (const std::vector<double> FeltForce::*end : {&FeltForce::weak, &FeltForce::strong}) {
      const std::vector<double>&low = first[m].*end, &high = second[m].*end, &truth = trial.network_force(m);
      const auto size = static_cast<Eigen::Index>(std::min({low.size(), high.size(), truth.size()}));
      if (size == 0) continue;
      const Samples network(truth.data(), size);
      std::vector<double> errors[2] = {std::vector<double>(std::size_t(size)), std::vector<double>(std::size_t(size))};
      Eigen::Map<Eigen::ArrayXd> at_first(errors[0].data(), size), at_second(errors[1].data(), size);
      at_first = Samples(low.data(), size) - network;
      at_second = Samples(high.data(), size) - network;
      Run run;
      run.first_square = at_first.square().mean();
      run.product = (at_first * at_second).mean();
      run.second_square = at_second.square().mean();
      run.peaks = peaks_of(errors[0], errors[1]);
      run.network_peak = trial.largest_network_force(m);
      run.network_rms = trial.rms_network_force(m);
      runs_.push_back(std::move(run));
    }
}

// First between the largest at either end alone, so that most samples are gone soon.
std::vector<ErrorBetween::Ends> ErrorBetween::peaks_of(const std::vector<double>& first,
                                                       const std::vector<double>& second) {
  const Samples at_first(first.data(), Eigen::Index(first.size())),
      at_second(second.data(), Eigen::Index(second.size()));
  Eigen::Index one = 0, other = 0;
  at_first.abs().maxCoeff(&one);
  at_second.abs().maxCoeff(&other);
  std::vector<Ends> largest = {{at_first(one), at_second(one)}, {at_first(other), at_second(other)}};
  const Meeting meeting = meetings_of(largest).front();
  const Eigen::ArrayXd sizes = ((1 - meeting.share) * at_first + meeting.share * at_second).abs();
  std::vector<Ends> errors = std::move(largest);
  for (Eigen::Index i = 0; i < sizes.size(); ++i)
    if (!(sizes(i) < meeting.size)) errors.push_back({at_first(i), at_second(i)});
  for (const int parts : {4, 16}) keep_largest(errors, parts);
  return errors;
}

// Where the lines of the largest at neighbouring shares meet, each with the sign that it has at its own share.
std::vector<ErrorBetween::Meeting> ErrorBetween::meetings_of(const std::vector<Ends>& largest) {
  const double parts = double(largest.size() - 1);
  const auto line = [&](std::size_t k) {
    const double sign = largest[k].at(double(k) / parts) < 0 ? -1 : 1;
    return Ends{sign * largest[k].first, sign * largest[k].second};
  };
  std::vector<Meeting> meetings;
  for (std::size_t k = 0; k + 1 < largest.size(); ++k) {
    const Ends one = line(k), other = line(k + 1);
    const double at_first = one.first - other.first, at_second = one.second - other.second;
    const bool cross = (at_first > 0) != (at_second > 0) && at_first != at_second;
    const double share = cross ? at_first / (at_first - at_second) : double(k) / parts;
    meetings.push_back({share, std::max(one.at(share), other.at(share))});
  }
  return meetings;
}

// Keeps what is the largest at some share: that of `parts` + 1 shares, and what is not below two neighbours of these
// where their lines meet. All errors' sizes are convex, so what is below there is below the larger of both everywhere
// between.
void ErrorBetween::keep_largest(std::vector<Ends>& errors, int parts) {
  std::vector<Ends> largest;
  for (int k = 0; k <= parts; ++k) {
    const auto size = [share = double(k) / parts](const Ends& error) { return std::abs(error.at(share)); };
    largest.push_back(*std::ranges::max_element(errors, {}, size));
  }
  const std::vector<Meeting> meetings = meetings_of(largest);
  std::erase_if(errors, [&](const Ends& error) {
    return std::ranges::all_of(
        meetings, [&](const Meeting& meeting) { return std::abs(error.at(meeting.share)) < meeting.size; });
  });
  errors.insert(errors.end(), largest.begin(), largest.end());
}

double ErrorBetween::at(double share) const {
  double worst = 0;
  for (const Run& run : runs_) {
    double peak = 0;
    for (const Ends& error : run.peaks) peak = std::max(peak, std::abs(error.at(share)));
    const double square = (1 - share) * (1 - share) * run.first_square + 2 * share * (1 - share) * run.product +
                          share * share * run.second_square;
    if (run.network_peak > 0) worst = std::max(worst, peak / run.network_peak);
    if (run.network_rms > 0) worst = std::max(worst, std::sqrt(std::max(square, 0.0)) / run.network_rms);
  }
  return worst;
}

}  // namespace dashpot::compiler
