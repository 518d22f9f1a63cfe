// Any text as a network file: it is refused in words, or it becomes a law whose commands are finite or safe.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "compile.hpp"
#include "discretise/evaluate.hpp"
#include "source/render.hpp"

namespace {

using namespace dashpot::compiler;

// Choices follow from the text itself, so that every finding can be repeated from it alone.
Choices choices_for(std::uint8_t seed) {
  Choices choices;
  choices.scheme = seed & 1 ? Scheme::backward_euler : Scheme::exact;
  choices.scalar = seed & 2 ? ScalarType::float32 : ScalarType::float64;
  if (seed & 4) choices.decomposition = "velocity-free";
  if (seed & 8) choices.rate = 100000.0;
  return choices;
}

template <class Scalar>
void run(const UpdateLaw& law) {
  Evaluation<Scalar> model(law);
  model.reset(Scalar(0.001));
  for (int k = 0; k < 20; ++k) {
    const Scalar position = k == 10 ? Scalar(NAN) : Scalar(0.001 * k);
    const auto [damping, force] = model.step(position, Scalar(1));
    if (!(damping >= 0) || !std::isfinite(damping) || !std::isfinite(force)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::uint8_t seed = 0;
  for (std::size_t i = 0; i < size; ++i) seed = static_cast<std::uint8_t>(seed * 31 + data[i]);
  const SourceFile file("fuzz.json", std::string(data, data + size));
  Diagnostics diagnostics;
  const auto result = compile(file, choices_for(seed), std::nullopt, diagnostics);
  if (!result && !diagnostics.has_errors()) std::abort();  // refused without a word
  render_text(diagnostics);
  render_json(diagnostics);
  if (!result || diagnostics.has_errors()) return 0;
  result->law.scalar == ScalarType::float64 ? run<double>(result->law) : run<float>(result->law);
  Diagnostics emission;
  if (!emit_cpp(*result, {}, emission) && !emission.has_errors()) std::abort();
  return 0;
}
