#include "certify/adaptive_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <sstream>

#include "certify/estimator_factors.hpp"
#include "certify/hold_bound.hpp"
#include "certify/window_tables.hpp"

namespace dashpot::compiler {
namespace {

constexpr double unit = 0x1p-23;         // the tables hold whole numbers of this
constexpr std::size_t most_states = 32;  // of a storage function without a table: more take seconds to check
constexpr double strictness = 1e-9;      // margin of its matrices, so that rounding does not spoil the proof

bool adapts(const SampledLoop& loop) { return loop.has_device && loop.velocity.estimator == estimator_kind::foaw; }

unsigned longest(const SampledLoop& loop) { return std::clamp(loop.velocity.window, 1u, longest_window); }

std::string_view table(bool best_fit, bool is_positive) {
  const std::string name =
      fmt::format("{}_fit_{}.txt", best_fit ? "best" : "end", is_positive ? "positive" : "negative");
  for (const WindowTable& file : window_tables())
    if (file.name == name) return file.text;
  return {};
}

// The largest weight that a difference may have at an age.
double largest_weight(const SampledLoop& loop, unsigned age) {
  double largest = 0;
  for (unsigned n = age + 1; n <= longest(loop); ++n) {
    const double count = n, j = age;
    const double best_fit = 6 * (j + 1) * (count - j) / (count * (count + 1) * (count + 2));
    largest = std::max(largest, loop.velocity.best_fit ? best_fit : 1 / count);
  }
  return largest;
}

// Of γ: P_jj = Σ_{i ≥ j} max_n w_{n,i}/(2γ), so that V falls by v̂²/(2γ) at least and rises by γ w²/2.
std::optional<WindowStorage> diagonal_storage(const SampledLoop& loop) {
  const std::size_t states = loop.delay_samples + longest(loop);
  if (states > most_states) return std::nullopt;
  const double gain = *adaptive_window_gain(loop);
  WindowStorage result{gain + strictness * double(states + 1), dashpot_check::Storage(states)};
  double sum = 0;
  for (std::size_t i = states; i-- > 0;) {
    if (i >= loop.delay_samples) sum += largest_weight(loop, unsigned(i) - loop.delay_samples);
    result.storage[i].assign(i + 1, 0.0);
    result.storage[i][i] = sum / (2 * gain) + strictness * double(states - i);
  }
  return result;
}

// b and p as above. Each older estimate stores a little less, so that every matrix bears rounding.
std::optional<WindowStorage> interval_storage(const SampledLoop& loop) {
  const double shortest = loop.sample_period - loop.jitter, longest_hold = loop.longest_hold();
  const std::size_t registers = loop.delay_samples + 1;
  if (!(shortest > 0)) return std::nullopt;
  const double mean = std::sqrt(shortest * longest_hold), slack = strictness * double(registers + 1);
  WindowStorage result{loop.sample_period / mean * (loop.sample_period / longest_hold) * (1 + 4 * slack),
                       dashpot_check::Storage(2 * registers)};
  for (std::size_t i = 0; i < result.storage.size(); ++i) {
    result.storage[i].assign(i + 1, 0.0);
    if (i >= registers)
      result.storage[i][i] = loop.sample_period * mean / 2 * (1 + strictness * double(2 * registers - i));
  }
  return result;
}

// Not below the largest |g + Σ e/(z − a)| at any frequency: each e/(z − a) lies in a disk around e a/(1 − a²) of the
// radius |e|/(1 − a²), and disks add. Empty where a mode does not relax.
std::optional<Rational> largest_response(const MotorConstants& motor) {
  Rational centre = motor.velocity_gain, radius = 0;
  for (const MotorMode& mode : motor.modes) {
    const Rational a = exact_decay(motor, mode), e = mode.velocity_drive;
    if (e == 0) continue;
    if (abs(a) >= 1) return std::nullopt;
    centre += e * a / (1 - a * a);
    radius += abs(e) / (1 - a * a);
  }
  return Rational(abs(centre) + radius);
}

}  // namespace

std::optional<WindowStorage> window_storage(const SampledLoop& loop, double gain) {
  if (loop.amplifier_lag > 0 || loop.write_latest > 0) return std::nullopt;
  if (divides_by_varying_interval(loop)) return interval_storage(loop);
  if (!adapts(loop)) return std::nullopt;
  const std::string_view text = table(loop.velocity.best_fit, gain > 0);
  const std::string head = fmt::format("\ndelay {}, longest {}:", loop.delay_samples, longest(loop));
  const std::size_t found = text.find(head);
  if (found == text.npos) return diagonal_storage(loop);
  std::istringstream numbers(std::string(text.substr(found + head.size(), 4000)));
  const auto next = [&] {
    long value = 0;
    numbers >> value;
    return double(value) * unit;
  };
  WindowStorage result{next(), dashpot_check::Storage(loop.delay_samples + longest(loop))};
  for (std::size_t i = 0; i < result.storage.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) result.storage[i].push_back(next());
  return result;
}

std::optional<double> adaptive_window_gain(const SampledLoop& loop) {
  if (!adapts(loop)) return std::nullopt;
  double square = 0;
  for (unsigned age = 0; age < longest(loop); ++age) square += largest_weight(loop, age);
  return std::sqrt(square) * (1 + 1e-12);
}

std::optional<double> damping_for_estimate(const MotorConstants& motor, const SampledLoop& loop) {
  const bool divides = divides_by_varying_interval(loop);
  const std::optional<double> gain = divides ? estimate_gain(loop) : adaptive_window_gain(loop);
  if (!gain) return std::nullopt;
  const std::optional<WindowStorage> known =
      motor.estimate_drives_modes() && !divides ? std::nullopt : window_storage(loop, motor.velocity_gain);
  const std::optional<Rational> response = largest_response(motor);
  if (!response || (divides && !known && loop.write_latest == 0)) return std::nullopt;
  return ceiling(Rational(known ? known->factor : *gain) * *response);
}

std::optional<StorageProof> adaptive_storage_proof(const MotorConstants& motor, const SampledLoop& loop) {
  const std::optional<WindowStorage> known = window_storage(loop, motor.velocity_gain);
  if (!known || motor.estimate_drives_modes()) return std::nullopt;
  const std::optional<StorageProof> beside = storage_proof(position_driven(motor), loop);
  if (!beside) return std::nullopt;
  const Rational gain = abs(Rational(motor.velocity_gain)), T = loop.sample_period;
  StorageProof proof = *beside;
  proof.damping = ceiling(Rational(beside->damping) + Rational(known->factor) * gain * (T + Rational(loop.jitter)) / T);
  // Both proofs have the states q0 … q_delay. After these come the states of the estimate alone, then the modes.
  const std::size_t shared = loop.delay_samples + 1, more = known->storage.size() - shared;
  const auto place = [&](std::size_t i) { return i < shared ? i : i + more; };
  proof.storage = known->storage;
  for (std::size_t i = proof.storage.size(); i < beside->storage.size() + more; ++i)
    proof.storage.emplace_back(i + 1, 0.0);
  for (std::size_t i = 0; i < known->storage.size(); ++i)
    for (double& value : proof.storage[i]) value *= std::abs(motor.velocity_gain) / loop.sample_period;
  for (std::size_t i = 0; i < beside->storage.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) proof.storage[place(i)][place(j)] += beside->storage[i][j];
  if (!dashpot_check::proves(checked_program(motor), checked_device(loop), proof.storage, proof.damping))
    return std::nullopt;
  return proof;
}

}  // namespace dashpot::compiler
