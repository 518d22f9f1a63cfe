// Any text as a network file, compiled with any choices for any device: it is refused in words, or it becomes a law
// whose commands are finite or safe, and headers, certificates and explanations of it are written.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "network/rate_limits.hpp"
#include "source/render.hpp"
#include "verify/certificate_file.hpp"

namespace {

using namespace dashpot::compiler;

// What stands behind the last bracket of the text, where a file has its last line's end: one byte a choice, 0 where
// none is.
class Tail {
 public:
  explicit Tail(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint8_t next() { return place_ < bytes_.size() ? static_cast<std::uint8_t>(bytes_[place_++]) : std::uint8_t(0); }

 private:
  std::string bytes_;
  std::size_t place_ = 0;
};

std::variant<std::string, double> decomposition_for(std::uint8_t choice) {
  static const char* const names[] = {
      "paper", "zero-frequency", "quietest-passive", "velocity-free", "virtual", "largest-observer",
      "gated", "steady",         "ramped",           "no such name"};
  constexpr std::size_t count = std::size(names);
  if (choice % 16 < count) return names[choice % 16];
  return std::ldexp(1.0, choice / 16 * 8 - 60);
}

Choices choices_for(Tail& tail) {
  static constexpr double rates[] = {1000, 5, 333.25, 100000, lowest_rate, highest_rate};
  const std::uint8_t law = tail.next();
  Choices choices;
  choices.scheme = law & 1 ? Scheme::backward_euler : Scheme::exact;
  choices.scalar = law & 2 ? ScalarType::float32 : ScalarType::float64;
  if (law & 4) choices.state_input = law & 8 ? StateInput::nodal : StateInput::velocity;
  else if (law & 8) choices.state_input = StateInput::position;
  choices.decomposition = decomposition_for(tail.next());
  choices.rate = rates[tail.next() % std::size(rates)];
  return choices;
}

// None, one whose coil is slow, one that is late with a recursive estimator, one of which little is proved.
std::optional<Device> device_for(std::uint8_t choice, double rate) {
  if (choice % 4 == 0) return std::nullopt;
  Device device;
  device.name = "a device";
  dashpot::device_description& d = device.description;
  d.loop.sample_period = 1 / rate;
  d.encoder.step = 1e-5;
  d.velocity.window = 3;
  d.brake = {dashpot::brake_kind::eddy_current, choice & 4 ? 1e6 : 2.8, 0, 0.01, 0.05, 0.01, 0, 0, 0};
  if (choice & 8) d.motion = dashpot::motion::rotation, d.arm_radius = 0.05;
  if (choice % 4 == 2) {
    d.loop.delay_samples = 1;
    d.motor.amplifier_lag = 2e-4;
    d.velocity = {dashpot::estimator_kind::butterworth, 1, 4, rate / 9};
  } else if (choice % 4 == 3) {
    d.velocity = {dashpot::estimator_kind::foaw, 8};
    d.brake.critical_speed = 400;
    d.mechanics = {0.1, 1e-4, 1e-3};
  }
  return device;
}

template <class Scalar>
void run(const UpdateLaw& law, Tail& tail) {
  Evaluation<Scalar> model(law);
  model.reset(Scalar(0.001));
  for (int k = 0; k < 20; ++k) {
    if (k % 7 == 6) {
      std::vector<Scalar> values(law.parameters().size());
      for (Scalar& value : values)
        value = tail.next() == 0xFF ? Scalar(NAN) : Scalar(std::ldexp(1.0, tail.next() - 128));
      model.set(values);
    }
    const Scalar position = k == 10 ? Scalar(NAN) : Scalar(0.001 * (k % 5));
    const auto [damping, force] = model.step(position, Scalar(1));
    if (!(damping >= 0) || !std::isfinite(damping) || !std::isfinite(force)) std::abort();
  }
}

void write_all(const Compilation& c, const Choices& choices, const std::string& text, std::uint8_t extras) {
  Diagnostics diagnostics;
  EmissionOptions options;
  options.with_test = extras & 1;
  options.with_library = extras & 2;
  options.with_live = extras & 4;
  const auto files = emit_cpp(c, options, diagnostics);
  if (!files && !diagnostics.has_errors()) std::abort();
  to_text(c.network);
  to_text(c.certificate, c.network.port_motion);
  if (files) certificate_text(c, choices, text, std::nullopt, files->front().text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string all(data, data + size);
  const std::size_t end = std::min(all.rfind('}'), size - (size > 0)) + (size > 0);
  Tail tail(all.substr(end));
  const SourceFile file("fuzz.json", all.substr(0, end));
  const Choices choices = choices_for(tail);
  const std::optional<Device> device = device_for(tail.next(), *choices.rate);
  Diagnostics diagnostics;
  const auto result = compile(file, choices, device, diagnostics);
  if (!result && !diagnostics.has_errors()) std::abort();  // refused without a word
  render_text(diagnostics);
  render_json(diagnostics);
  if (!result || diagnostics.has_errors()) return 0;
  write_all(*result, choices, file.text(), tail.next());
  result->law.scalar == ScalarType::float64 ? run<double>(result->law, tail) : run<float>(result->law, tail);
  return 0;
}
