// The bound over all frequencies against the condition itself in 60 digits, where doubles lose theirs: slow and fast
// modes, estimators whose poles lie next to 1 or to −1.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <dashpot/estimators/kalman.hpp>
#include <map>
#include <string>

#include "certify/storage_function.hpp"
#include "linear/real_traits.hpp"
#include "motors.hpp"
#include "support/random.hpp"
#include "support/repetitions.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::Random;
using dashpot::testing::repetitions;

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

struct Exact {
  Digits real = 0, imaginary = 0;
  friend Exact operator+(const Exact& x, const Exact& y) { return {x.real + y.real, x.imaginary + y.imaginary}; }
  friend Exact operator-(const Exact& x, const Exact& y) { return {x.real - y.real, x.imaginary - y.imaginary}; }
  friend Exact operator*(const Exact& x, const Exact& y) {
    return {x.real * y.real - x.imaginary * y.imaginary, x.real * y.imaginary + x.imaginary * y.real};
  }
  friend Exact operator/(const Exact& x, const Exact& y) {
    const Digits square = y.real * y.real + y.imaginary * y.imaginary;
    return {(x.real * y.real + x.imaginary * y.imaginary) / square,
            (x.imaginary * y.real - x.real * y.imaginary) / square};
  }
  Digits square() const { return real * real + imaginary * imaginary; }
};

Digits half_turn() { return 4 * atan(Digits(1)); }

// E(z) as the runtime's headers state it: Butterworth's sections by the bilinear transform, 1/(1 + k s + s²) with
// s = (1 − w)/(g (1 + w)), of the one-sample difference; the filter in its steady state by its recursion.
Exact estimate(const SampledLoop& loop, const Exact& w) {
  const Exact one{1, 0}, difference = (one - w) * Exact{1 / Digits(loop.sample_period), 0};
  const velocity_description& v = loop.velocity;
  if (v.estimator == estimator_kind::backward_difference) {
    Exact sum, power = one;
    for (unsigned i = 0; i < v.window; ++i, power = power * w) sum = sum + power;
    return difference * sum * Exact{1 / Digits(v.window), 0};
  }
  if (v.estimator == estimator_kind::kalman) {
    const kalman<double> filter(v.acceleration, loop.joint_encoder_step, loop.sample_period);
    const Digits leak = filter.leak(), gain = filter.beta() / loop.sample_period;  // as rounded in the recursion
    const Digits sum = 1 + leak - gain * Digits(loop.sample_period);
    return Exact{gain, 0} * (one - w) / (one - Exact{sum, 0} * w + Exact{leak, 0} * w * w);
  }
  const Digits g = tan(half_turn() * Digits(v.cutoff) * Digits(loop.sample_period));
  Exact response = difference;
  for (unsigned i = 0; i < v.order / 2; ++i) {
    const Digits k = 2 * sin(half_turn() * Digits(v.order - 1 - 2 * i) / Digits(2 * v.order));
    const Exact up = one + w, down = one - w;
    const Exact denominator = up * up * Exact{g * g, 0} + Exact{k * g, 0} * up * down + down * down;
    response = response * up * up * Exact{g * g, 0} / denominator;
  }
  return response;
}

Exact scaled(const Digits& by, const Exact& x) { return {by * x.real, by * x.imaginary}; }

// Colgate & Schenkel's condition. The held force, with what it lacks of its command, and the velocity are two vectors
// over the aliases of a frequency, of which the condition asks for the lengths and the product. A command that acts
// later turns the force, and leaves its length as it is.
Digits needed_in_digits(const MotorConstants& motor, const SampledLoop& loop, const Digits& angle) {
  const Exact w{cos(angle), -sin(angle)}, one{1, 0};
  const Digits half = sin(angle / 2);
  const Exact delta{2 * half * half, sin(angle)};
  Exact from_position{motor.step_stiffness, 0}, from_velocity{motor.velocity_gain, 0};
  for (const MotorMode& mode : motor.modes) {
    const Digits decay = motor.loss_is_emitted ? 1 - Digits(mode.loss) : Digits(mode.decay);
    const Exact memory = w / (one - Exact{decay, 0} * w);
    from_position = from_position + Exact{mode.position_drive, 0} * memory;
    from_velocity = from_velocity + Exact{mode.velocity_drive, 0} * memory;
  }
  Exact H = Exact{motor.static_stiffness, 0} + delta * from_position;
  if (motor.follows_estimate()) H = H + estimate(loop, w) * from_velocity;
  for (unsigned i = 0; i < loop.delay_samples; ++i) H = H * w;
  const Digits T = loop.sample_period, late = loop.write_latest;
  const Exact command = w * H / delta, change = scaled(-1, w * H);  // for a unit of displacement over the hold
  Digits left = 0, share = 0, left_of_change = 0;                   // q, p; of the change, which comes later
  if (loop.amplifier_lag > 0) {
    const Digits lag = loop.amplifier_lag;
    left = exp(-T / lag), share = (1 - left) * lag / T, left_of_change = exp((late - T) / lag);
  }
  const Exact lacking = change / (one - Exact{left, 0} * w);  // of a command that acts at once
  const Digits spread = share * ((1 + left) / 2 - share);
  const Digits length = (command + scaled(share, lacking)).square() + spread * lacking.square();
  const Digits share_of_change =
      loop.amplifier_lag > 0 ? late / T + (1 - left_of_change) * Digits(loop.amplifier_lag) / T : late / T;
  const Exact lacked = scaled(left_of_change, w * lacking);
  const Exact mean = command + scaled(share_of_change, change) + scaled(share, lacked);
  return T / 2 * (sqrt(length - mean.imaginary * mean.imaginary) - mean.real);
}

struct Peak {
  Digits angle, needed;
  Digits fastest;  // the largest angle seen at which all of it is needed but a thousandth
};

// The highest of angles spread over the decades next to rest and next to Nyquist, and what lies around it and around
// every other that is next to as high: a long window has many peaks.
Peak peak_in_digits(const MotorConstants& motor, const SampledLoop& loop, int points) {
  std::vector<std::pair<Digits, Digits>> seen;
  const auto look_at = [&](const Digits& angle) {
    seen.emplace_back(angle, needed_in_digits(motor, loop, angle));
    return seen.back().second;
  };
  for (int i = 0; i <= points; ++i) {
    const Digits share = pow(Digits(10), Digits(-14) * i / points);
    look_at(half_turn() * share);
    look_at(half_turn() * (1 - share / 2));
    if (i > 0) look_at(half_turn() * i / points);
  }
  std::sort(seen.begin(), seen.end());
  const auto highest = std::ranges::max_element(seen, {}, [](const auto& one) { return one.second; });
  const Digits most = highest->second, rounding = abs(most) * 1e-12;
  std::vector<Peak> peaks = {{highest->first, most, 0}};
  for (std::size_t i = 1; i + 1 < seen.size(); ++i) {
    const auto& [angle, needed] = seen[i];
    const bool is_peak = needed > seen[i - 1].second + rounding && needed > seen[i + 1].second + rounding;
    if (is_peak && needed < most && needed > 0.99 * most) peaks.push_back({angle, needed, 0});
  }
  for (Peak& peak : peaks) {
    const Digits reach = std::min(peak.angle, Digits(half_turn() - peak.angle));
    for (Digits step = (reach > 0 ? reach : peak.angle) / 4; step > 1e-12 * peak.angle; step *= Digits(0.6))
      for (const Digits& angle : {Digits(peak.angle - step), Digits(peak.angle + step)})
        if (angle > 0 && angle <= half_turn())
          if (const Digits needed = look_at(angle); needed > peak.needed) peak.angle = angle, peak.needed = needed;
  }
  Peak peak = *std::ranges::max_element(peaks, {}, &Peak::needed);
  for (const auto& [angle, needed] : seen)
    if (needed >= 0.999 * peak.needed) peak.fastest = std::max(peak.fastest, angle);
  return peak;
}

MotorConstants extreme_motor(Random& random, double period) {
  MotorConstants motor = spring_motor(random.chance(0.4) ? 0 : random.log_uniform(1e-2, 1e4));
  if (random.chance(0.8)) motor.velocity_gain = (random.chance(0.5) ? -1 : 1) * random.log_uniform(1e-3, 100);
  const std::size_t modes = random.between(0, 4);
  for (std::size_t i = 0; i < modes; ++i)
    add_maxwell(motor, random.log_uniform(1e-2, 1e4), random.log_uniform(1e-6, 10) / period, period,
                random.chance(0.6));
  return motor;
}

SampledLoop extreme_loop(Random& random) {
  SampledLoop loop = plain_loop(random.log_uniform(1e-4, 5e-3));
  loop.has_device = true;
  loop.delay_samples = random.chance(0.5) ? 0 : unsigned(random.between(1, 4));
  if (random.chance(0.25)) loop.amplifier_lag = loop.sample_period * random.log_uniform(0.05, 20);
  loop.joint_encoder_step = random.log_uniform(1e-9, 1e-4);
  const estimator_kind kinds[] = {estimator_kind::backward_difference, estimator_kind::butterworth,
                                  estimator_kind::kalman, estimator_kind::kalman};
  loop.velocity.estimator = kinds[random.index(4)];
  loop.velocity.window = unsigned(random.between(1, 30));
  loop.velocity.order = random.chance(0.5) ? 2 : 4;
  const double below = random.log_uniform(1e-7, 0.49);  // the rate's half
  loop.velocity.cutoff = (random.chance(0.5) ? 0.5 - below : below) / loop.sample_period;
  // Λ from 1e-3 to 1e12
  loop.velocity.acceleration = random.log_uniform(1e-3, 1e12) * loop.joint_encoder_step /
                               (std::sqrt(12.0) * loop.sample_period * loop.sample_period);
  return loop;
}

// The certificate would promise less damping than some frequency needs, or ask for more than any does.
void expect_supremum_of(const MotorConstants& motor, const SampledLoop& loop, int points, double looseness = 1e-6) {
  const std::optional<EstimatorFactors> factors = estimator_factors(loop);
  ASSERT_TRUE(factors);
  const NeededDamping needed(motor, loop, *factors);
  const SampledBound bound = sampled_bound(needed, loop.sample_period);
  const Digits most = peak_in_digits(motor, loop, points).needed;
  EXPECT_GE(Digits(bound.needed), most);
  // Ill-conditioned terms are known to their rounding, times the number of operations on them.
  const double margin = std::max(1e-9, 8 * needed.roundoff()) * needed.scale();
  EXPECT_LE(bound.needed, std::max(most.convert_to<double>(), 0.0) * (1 + looseness) + margin);
}

TEST(Supremum, IsMetByRandomMotorsToTheEndsOfTheirRanges) {
  const std::uint64_t cases = repetitions(24, 3000);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 7000);
    const SampledLoop loop = extreme_loop(random);
    const MotorConstants motor = extreme_motor(random, loop.sample_period);
    expect_supremum_of(motor, loop, 120);
    SampledLoop late = loop;
    late.write_earliest = late.write_latest = loop.sample_period * random.uniform(0.001, 0.999);
    expect_supremum_of(motor, late, 60);
    if (::testing::Test::HasFailure() && seed > 20) return;
  }
}

using Square = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// Of the energy that `damping` takes up, the share that a motion gets out beyond it: from rest, w_k = cos(kθ) over as
// many holds as it takes, 2ⁿ of them; within a hold the tool moves evenly, but with an amplifier's lag as the force
// that it lacks, e, makes worst, ρ = −e κT/2b (theory, section 6b). What is left in the static spring at the end counts
// as lost. The energy is a quadratic form in the law's states and the motion's two, which 2ⁿ holds carry as n
// squarings. A command that acts later lacks all of its change until then: like a lag, of which the next sample sees
// nothing.
double extracted_share(const MotorConstants& motor, const SampledLoop& loop, double damping, const Digits& angle) {
  dashpot_check::Device device = checked_device(loop);
  if (loop.write_latest > 0) device.amplifier_lag = loop.sample_period, device.write_earliest = device.write_latest = 0;
  const dashpot_check::LoopForm form = dashpot_check::loop_form(checked_program(motor), device);
  const auto exact = [](const dashpot_check::Rational& value) {
    return Real(numerator(value)) / Real(denominator(value));
  };
  const Eigen::Index n = Eigen::Index(form.states.size()), w = n, u = n + 2;
  std::map<std::string, Eigen::Index> place = {{"w", w}};
  for (Eigen::Index i = 0; i < n; ++i) place[form.states[std::size_t(i)]] = i;
  const Real T = loop.sample_period, b = damping, k0 = exact(form.stiffness);
  Square step = Square::Zero(n + 3, n + 3), work = step, dissipated = step, spring = step;
  for (const auto& [state, next] : form.next)
    for (const auto& [name, value] : next) step(place.at(state), place.at(name)) += exact(value);
  step(w, w) = step(w + 1, w + 1) = Real(cos(angle));
  step(w + 1, w) = Real(sin(angle)), step(w, w + 1) = -step(w + 1, w);
  step(u, u) = step(u, w) = 1;
  for (const auto& [name, value] : form.force)
    work(w, place.at(name)) += exact(value) / 2, work(place.at(name), w) += exact(value) / 2;
  work(w, w) -= k0 / 2, dissipated(w, w) += b / T, spring(u, u) = k0 / 2;
  if (loop.amplifier_lag > 0 || loop.write_latest > 0) {
    const Real x = loop.amplifier_lag > 0 ? Real(T / Real(loop.amplifier_lag)) : Real(0);
    const Real q = x > 0 ? exp(-x) : Real(0), p = x > 0 ? (1 - q) / x : Real(loop.write_latest) / T;
    const Real rho = -p * (x > 0 ? (1 + q) / 2 - p : 1 - p) * T / (2 * b);
    const Eigen::Index e = n - 1;
    step(e, e) += q, work(w, e) += p / 2, work(e, w) += p / 2;
    work(e, e) += rho, dissipated(e, e) -= rho / 2;
  }
  Real most = 0;
  for (int doubling = 0; doubling < 64 && most < 0.04; ++doubling) {
    const Real stored = (step.transpose() * spring * step)(w, w), taken = dissipated(w, w);
    if (taken > 0) most = std::max(most, Real(-(work(w, w) + taken + stored) / taken));
    work += Square(step.transpose() * work * step), dissipated += Square(step.transpose() * dissipated * step);
    step = Square(step * step);
  }
  return most.convert_to<double>();
}

// Why there is no storage function; in the checker's words, where it does not know the loop.
std::string reason_for_none(const MotorConstants& motor, const SampledLoop& loop) {
  if (!estimator_factors(loop)) return "the estimate's recursion, as rounded, does not die away";
  try {
    const std::size_t states = dashpot_check::loop_form(checked_program(motor), checked_device(loop)).states.size();
    return states > most_storage_states ? "it has too many states" : "none is found";
  } catch (const dashpot_check::Unknown& unknown) {
    return unknown.what();
  }
}

// What is proved of random motors on random devices, which are punctual: no P has to serve more than one hold.
struct Proved {
  std::uint64_t all = 0, nearly = 0, needed = 0, extracted = 0;
  std::map<std::string, int> unproved;

  void take(std::uint64_t seed, bool writes_late = false) {
    SCOPED_TRACE(seed);
    Random random(seed + 17000);
    SampledLoop loop = extreme_loop(random);
    if (writes_late) loop.write_earliest = loop.write_latest = loop.sample_period * random.uniform(0.001, 0.999);
    const MotorConstants motor = extreme_motor(random, loop.sample_period);
    const std::optional<StorageProof> proof = estimator_factors(loop) ? storage_proof(motor, loop) : std::nullopt;
    if (!proof) {
      ++unproved[reason_for_none(motor, loop)];
      return;
    }
    ++all;
    const Peak peak = peak_in_digits(motor, loop, 120);
    EXPECT_GE(Digits(proof->damping), peak.needed);
    nearly += proof->damping <= peak.needed * (1 + 1e-8) ? 1 : 0;
    if (peak.needed <= 0 || (writes_late && loop.amplifier_lag > 0)) return;
    ++needed;
    const double share = extracted_share(motor, loop, 0.95 * proof->damping, peak.fastest);
    EXPECT_LE(share, 1 / 0.95 - 1 + 1e-8);
    extracted += share >= 0.04 ? 1 : 0;
  }
};

// A storage function would prove less damping than some frequency needs, or the statement ask for more than 1e-8 beyond
// it; or with 0.95 of what is proved there would be no motion that gets energy out of the loop: of a sinusoid in its
// steady state (1/0.95 − 1) of what the damping takes up, and of no motion more.
void expect_suprema(std::uint64_t cases, bool writes_late) {
  Proved proved;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) proved.take(seed, writes_late);
  std::printf("%d proved, %d of them within 1e-8 of the supremum; 0.95 of it is too little for a motion in %d of %d\n",
              int(proved.all), int(proved.nearly), int(proved.extracted), int(proved.needed));
  for (const auto& [reason, count] : proved.unproved) std::printf("%d not proved: %s\n", count, reason.c_str());
  EXPECT_GE(proved.all, cases * 99 / 100);
  EXPECT_GE(proved.nearly, proved.all * 99 / 100);
  EXPECT_GE(proved.extracted, proved.needed * 95 / 100);
}

TEST(Supremum, IsWhatStorageFunctionsProveOfRandomMotors) { expect_suprema(repetitions(15, 5000), false); }

// The same of commands that act later than their samples, behind lags too.
TEST(Supremum, IsWhatStorageFunctionsProveOfLateCommands) { expect_suprema(repetitions(9, 1000), true); }

// If this failed, doubles would keep too few digits of a pole next to −1, of an estimate that follows every sample, to
// find the supremum or a P near it; no state would be looked at where a filter near half the rate rings; the checker
// would not know such a filter's coefficients; or the test see the lower of two peaks that a long window has.
TEST(Supremum, IsWhatStorageFunctionsProveNearHalfTheRate) {
  Proved proved;
  const std::uint64_t seeds[] = {52, 99, 196, 261, 376, 76, 215, 255, 142, 187, 267, 1191};
  for (const std::uint64_t seed : seeds) proved.take(seed);
  EXPECT_EQ(proved.all, std::size(seeds));
  EXPECT_EQ(proved.nearly, std::size(seeds));
}

// If this failed, more strictness would be asked for than there is beyond a narrow peak, and with it 4e-8 to 4e-7 more
// damping.
TEST(Supremum, IsWhatStorageFunctionsProveAtNarrowPeaks) {
  Proved proved;
  const std::uint64_t seeds[] = {3395, 4131, 1091, 2185, 2402};
  for (const std::uint64_t seed : seeds) proved.take(seed);
  EXPECT_EQ(proved.nearly, std::size(seeds));
}

// If this failed, P rounded to doubles would ask for more than 1e-8 beyond the supremum, where its roundings stand
// behind it and are read with it; or a row of which some are missing would be read.
TEST(Supremum, IsWhatStorageFunctionsProveOfMoreDigitsThanDoubleHas) {
  Proved proved;
  const std::uint64_t seeds[] = {162, 562, 563, 893, 1139, 1218, 2334};
  for (const std::uint64_t seed : seeds) proved.take(seed);
  EXPECT_EQ(proved.nearly, std::size(seeds));
  Random random(162 + 17000);
  const SampledLoop loop = extreme_loop(random);
  const MotorConstants motor = extreme_motor(random, loop.sample_period);
  const auto is_proved = [&](const dashpot_check::Storage& storage, double damping) {
    return dashpot_check::proves(checked_program(motor), checked_device(loop), storage, damping);
  };
  const std::optional<StorageProof> proof = storage_proof(motor, loop);
  ASSERT_TRUE(proof);
  dashpot_check::Storage storage = proof->storage;
  for (std::size_t i = 0; i < storage.size(); ++i) ASSERT_EQ(storage[i].size(), 2 * (i + 1));
  EXPECT_TRUE(is_proved(storage, proof->damping));
  EXPECT_FALSE(is_proved(storage, proof->damping * 0.999));
  storage.back().pop_back();
  EXPECT_THROW(is_proved(storage, proof->damping), std::out_of_range);
  for (std::size_t i = 0; i < storage.size(); ++i) storage[i].resize(i + 1);
  EXPECT_FALSE(is_proved(storage, proof->damping));
}

// If this failed, a pole of the filter next to −1 would keep no digits, and the bound fall below the supremum.
TEST(Supremum, OfAnEstimateThatFollowsEverySample) {
  for (const double manoeuvre : {1e6, 1e7, 3e7, 1e8, 1e10, 1e12}) {
    SCOPED_TRACE(manoeuvre);
    SampledLoop loop = plain_loop(0.001);
    loop.has_device = true;
    loop.joint_encoder_step = 1e-6;
    loop.velocity.estimator = estimator_kind::kalman;
    loop.velocity.acceleration = manoeuvre * 1e-6 / (std::sqrt(12.0) * 1e-6);
    // Angles next to Nyquist are known to 2⁻⁵³, and a pole 4/Λ away from it so to Λ 2⁻⁵⁵ of that.
    const double looseness = 1e-6 + manoeuvre * 0x1p-50;
    for (const double gain : {1.0, -1.0}) expect_supremum_of(damper_motor(gain), loop, 200, looseness);
  }
}

// If this failed, nothing would be said of an estimate whose recursion, rounded, no longer dies away.
TEST(Supremum, RefusesAnEstimateThatRings) {
  SampledLoop loop = plain_loop(0.001);
  loop.has_device = true;
  loop.joint_encoder_step = 1e-9;
  loop.velocity.estimator = estimator_kind::kalman;
  loop.velocity.acceleration = 1e30;
  EXPECT_FALSE(estimator_factors(loop));
  EXPECT_EQ(passivity_bound(damper_motor(1), loop).proof, Proof::none);
}

// If this failed, a filter that never amplifies would cost damping because its cut-off is near half the rate, or be
// given up. What its brake leaves to the motor is below half the viscosity, so that no delay and no filter costs any
// (theory, section 4).
TEST(Supremum, OfAFilterNearHalfTheRate) {
  for (const double share : {0.4, 0.49, 0.498, 0.499, 0.4999, 0.499999})
    for (const unsigned order : {2u, 4u}) {
      SCOPED_TRACE(share);
      SampledLoop loop = plain_loop(0.001);
      loop.has_device = true;
      loop.velocity.estimator = estimator_kind::butterworth;
      loop.velocity.order = order;
      loop.velocity.cutoff = share * 1000;
      // A Maxwell element of 50 N·s/m, all of which the brake has: velocity driven, −b + k/(s + λ).
      MotorConstants motor = damper_motor(-50);
      add_maxwell(motor, 500, 10, loop.sample_period, false);
      expect_supremum_of(motor, loop, 200);
      const PassivityBound bound = passivity_bound(motor, loop);
      EXPECT_EQ(bound.proof, Proof::sampled);
      EXPECT_LE(bound.needed, 50 * (1 + 1e-9));
      EXPECT_EQ(missing_damping(bound, loop, 50.0001), 0);
    }
}

}  // namespace
}  // namespace dashpot::compiler
