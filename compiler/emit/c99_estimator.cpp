#include "emit/c99_estimator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <dashpot/elementary.hpp>
#include <dashpot/estimators/estimator_fault.hpp>
#include <dashpot/estimators/estimator_names.hpp>
#include <dashpot/estimators/half_turns.hpp>
#include <dashpot/estimators/kalman.hpp>

#include "emit/c99_parts.hpp"
#include "emit/cpp_program.hpp"

namespace dashpot::compiler {
namespace {

// The constants of the template, as the estimators' constructors compute them.
class EstimatorWords {
 public:
  explicit EstimatorWords(C99Words& words) : words_(words) {}

  void number(const char* word, double value) { words_.text[word] = cpp_literal(value, ScalarType::float64); }

  // A ring for the positions of `window` samples; a power of two, as the runtime's.
  void ring(unsigned window) {
    words_.has["ring"] = true;
    const unsigned size = std::bit_ceil(window + 1);
    words_.text["WINDOW"] = fmt::format("{}u", window);
    words_.text["SIZE"] = fmt::format("{}u", size);
    words_.text["LAST"] = fmt::format("{}u", size - 1);
  }

  void low_pass(unsigned wanted_order, double cutoff, double period) {
    const unsigned order = wanted_order < 4 ? 2 : 4;
    const double g = tangent_of_half_turns(cutoff * period);
    std::string damped, solve;
    for (unsigned i = 0; i < order / 2; ++i) {
      const double k = 2 * sine_of_half_turns((order - 1 - 2.0 * i) / (2.0 * order));
      const char* comma = i == 0 ? "" : ", ";
      damped += comma + cpp_literal(g + k, ScalarType::float64);
      solve += comma + cpp_literal(1 / (1 + g * (g + k)), ScalarType::float64);
    }
    words_.text["SECTIONS"] = std::to_string(order / 2);
    words_.text["DAMPED"] = damped;
    words_.text["SOLVE"] = solve;
    number("HALF_STEP", g);
    number("RATE", 1 / period);
  }

 private:
  C99Words& words_;
};

void add_constants(const device_description& device, C99Words& words) {
  const velocity_description& velocity = device.velocity;
  const double period = device.loop.sample_period;
  const double step = device.encoder.step;
  const unsigned window = std::clamp(velocity.window, 1u, longest_window);
  const double n = window;
  EstimatorWords add(words);
  add.number("PERIOD", period);
  add.number("SMALLEST", 1e-30);  // far below any motion, far above subnormals
  switch (velocity.estimator) {
    case estimator_kind::backward_difference: add.ring(window); return add.number("RATE", 1 / (n * period));
    case estimator_kind::least_squares:
      add.ring(window);
      words.has["slope"] = true;
      return add.number("RATE", 6 / (period * n * (n + 1) * (n + 2)));
    case estimator_kind::foaw:
      add.ring(window);
      words.has["slope"] = words.has["best_fit"] = velocity.best_fit;
      words.has["end_fit"] = !velocity.best_fit;
      return add.number("BAND", step * (1 + 1.0 / 1024));
    case estimator_kind::butterworth: return add.low_pass(velocity.order, velocity.cutoff, period);
    case estimator_kind::kalman: {
      const kalman<double> filter(velocity.acceleration, step, period);
      add.number("POSITION_LEAK", filter.leak());
      return add.number("VELOCITY_GAIN", filter.beta() / period);
    }
    case estimator_kind::super_twisting:
      words.has["ROOTS"] = true;
      add.number("RATE", 1 / period);
      add.number("SWITCHING", 1.1 * velocity.acceleration);
      return add.number("ROOT_GAIN", 1.5 * square_root(velocity.acceleration));
    case estimator_kind::tracking_differentiator:
      words.has["ROOTS"] = true;
      add.number("ACCELERATION", velocity.acceleration);
      return add.number("HORIZON", velocity.filter_factor * period);
    case estimator_kind::inverse_time: return add.number("STEP", step);
    default: return;
  }
}

}  // namespace

bool needs_command_header(estimator_kind estimator) {
  return estimator == estimator_kind::butterworth || estimator == estimator_kind::kalman ||
         estimator == estimator_kind::tracking_differentiator;
}

std::vector<std::string> c99_estimator(const device_description& device, const std::string& name) {
  C99Words words;
  words.name = name;
  for (const estimator_kind kind : all_estimators) words.has[name_of(kind)] = kind == device.velocity.estimator;
  for (const char* part : {"ring", "slope", "best_fit", "end_fit", "ROOTS", "DECAYS", "RANGES"})
    words.has[part] = false;
  add_constants(device, words);
  std::vector<std::string> lines = c99_part("numbers.h", words);
  const std::vector<std::string> own = c99_part("estimator.h", words);
  lines.insert(lines.end(), own.begin(), own.end());
  return lines;
}

}  // namespace dashpot::compiler
