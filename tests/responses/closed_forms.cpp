#include "closed_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "emit/emission.hpp"
#include "law/cost.hpp"

namespace dashpot::responses {

long double ClosedForm::ModeAnswer::decay(long double samples) const { return std::exp(-decay_rate * samples); }
long double ClosedForm::ModeAnswer::loss(long double samples) const { return -std::expm1(-decay_rate * samples); }

ClosedForm::ClosedForm(const EmittedLaw& law) {
  const compiler::LinearForm& form = law.compilation().form.linear;
  static_stiffness_ = form.static_stiffness.convert_to<long double>();
  feedthrough_damping_ = form.feedthrough_damping.convert_to<long double>();
  period_ = 1 / static_cast<long double>(law.rate());
  for (const compiler::Mode& mode : form.modes) {
    ModeAnswer answer;
    answer.stiffness = mode.stiffness.convert_to<long double>();
    answer.relaxation_rate = mode.relaxation_rate.convert_to<long double>();
    const long double x = answer.relaxation_rate * period_;
    answer.decay_rate = law.is_exact() ? x : std::log1p(x);
    answer.step_stiffness = answer.stiffness / x * answer.loss(1);
    modes_.push_back(answer);
  }
}

std::vector<double> ClosedForm::force(const Motion& motion) const {
  std::vector<double> result;
  std::vector<long double> start(modes_.size(), 0);
  long double position = 0;
  for (const Segment& segment : motion) {
    const long double velocity = segment.increment / period_;
    const auto mode_force = [&](std::size_t i, int n) {
      const ModeAnswer& mode = modes_[i];
      return start[i] * mode.decay(n) + velocity * mode.stiffness / mode.relaxation_rate * mode.loss(n);
    };
    for (int n = 1; n <= segment.samples; ++n) {
      long double force = static_stiffness_ * (position + n * segment.increment) + feedthrough_damping_ * velocity;
      for (std::size_t i = 0; i < modes_.size(); ++i) force += mode_force(i, n);
      result.push_back(static_cast<double>(force));
    }
    for (std::size_t i = 0; i < modes_.size(); ++i) start[i] = mode_force(i, segment.samples);
    position += segment.samples * segment.increment;
  }
  return result;
}

double stated_tolerance(const EmittedLaw& law) {
  if (!law.is_float()) return 1e-12;
  const compiler::UpdateLaw& program = law.compilation().law;
  const compiler::Cost cost = compiler::cost_of(program, program.output);
  return program.relative_error_bound + 0x1p-24 * double(8 + cost.additions + cost.multiplications);
}

void expect_felt_force(const EmittedLaw& law, const Motion& motion, const std::vector<double>& expected) {
  const std::vector<Sample> samples = samples_of(motion, 1 / law.rate());
  ASSERT_EQ(samples.size(), expected.size());
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  std::vector<Command> commands;
  double largest_part = 0;
  for (const Sample& sample : samples) {
    commands.push_back(model->step(sample.position, sample.velocity));
    largest_part =
        std::max({largest_part, std::abs(commands.back().force), commands.back().damping * std::abs(sample.velocity)});
  }
  const double tolerance = stated_tolerance(law) * largest_part;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double felt = felt_force(commands[i], samples[i].velocity);
    if (std::abs(felt - expected[i]) <= tolerance) continue;
    ADD_FAILURE() << law.title() << ": sample " << i + 1 << " feels " << felt << " where " << expected[i]
                  << " is expected, off by " << std::abs(felt - expected[i]) / largest_part << " of the largest part, "
                  << stated_tolerance(law) << " is allowed";
    return;
  }
}

}  // namespace dashpot::responses
