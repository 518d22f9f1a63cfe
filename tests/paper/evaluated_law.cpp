#include "evaluated_law.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "compile.hpp"
#include "law/evaluate.hpp"

namespace dashpot::paper {
namespace {

class EvaluatedLaw final : public Law {
 public:
  explicit EvaluatedLaw(Compiled compilation) : compilation_(std::move(compilation)), law_(compilation_->law) {}
  void reset(double position) override { law_.reset(position); }
  command<double> output(double position, double velocity) override { return law_.output(position, velocity); }
  void update() override { law_.update(); }

 private:
  Compiled compilation_;
  compiler::Evaluation<double> law_;
};

std::string network_file(const char* kind, const std::string& elements) {
  return fmt::format(R"({{ "dashpot": 1, "name": "wall", "motion": "translation", "network": {{ "{}": [ {} ] }} }})",
                     kind, elements);
}

}  // namespace

Compiled compiled(const std::string& network, const compiler::Choices& choices,
                  const std::optional<compiler::Device>& device) {
  compiler::Diagnostics diagnostics;
  const compiler::SourceFile file("swept network", network);
  std::optional<compiler::Compilation> result = compiler::compile(file, choices, device, diagnostics);
  if (!result) throw std::runtime_error("refused: " + network);
  return std::make_shared<const compiler::Compilation>(std::move(*result));
}

LawMaker law_of(const Compiled& compilation) {
  return {Maker::evaluated, [compilation] { return std::make_unique<EvaluatedLaw>(compilation); }};
}

std::string kelvin_element(double stiffness, double damping) {
  return network_file("parallel", fmt::format(R"({{ "spring": {} }}, {{ "damper": {} }})", stiffness, damping));
}

std::string maxwell_element(double stiffness, double damping) {
  return network_file("series", fmt::format(R"({{ "damper": {} }}, {{ "spring": {} }})", damping, stiffness));
}

compiler::SampledLoop loop_around(const Compiled& compilation, const compiler::Device& device) {
  compiler::Diagnostics diagnostics;
  const auto port = compiler::PortDevice::of(device, compilation->network, diagnostics);
  if (!port) throw std::runtime_error("the device does not fit the network");
  return compiler::sampled_loop(*port, device.description.loop.sample_period);
}

}  // namespace dashpot::paper
