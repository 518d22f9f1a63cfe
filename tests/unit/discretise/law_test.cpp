// Laws of whole networks: what they cost, that the split is a split, and the forces against extended precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiled.hpp"
#include "law/evaluate.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"
#include "law/cost.hpp"
#include "law/law_text.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

constexpr double roundoff = 0x1p-53;

const char* const fig_5 = R"({ "parallel": [ { "series": [ { "damper": 5 }, { "spring": 12 } ] },
                                             { "series": [ { "damper": 6 }, { "spring": 10 } ] },
                                             { "spring": 5 } ] })";

std::string branches(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i)
    text += fmt::format("{}{{ \"series\": [ {{ \"spring\": {} }}, {{ \"damper\": 1 }} ] }}", i == 1 ? "" : ",", 10 * i);
  return network_text("{ \"parallel\": [" + text + "] }");
}

// Fails if a mode costs more than two multiplications and two additions a sample, many cost more guards than few, or
// the command depends on their number.
TEST(Law, CostsTwoMultiplicationsAndAdditionsAMode) {
  for (const int count : {1, 2, 8, 9, 100}) {
    const Compiled compiled(branches(count));
    const UpdateLaw& law = compiled.law();
    const Cost output = cost_of(law, law.output), update = cost_of(law, law.update);
    ASSERT_EQ(law.mode_form, ModeForm::product) << count;
    EXPECT_LE(output.multiplications, 3u) << count;
    EXPECT_LE(output.additions, 4u) << count;
    EXPECT_LE(update.multiplications, 2u * static_cast<unsigned>(count)) << count;
    EXPECT_LE(update.additions, 2u * static_cast<unsigned>(count)) << count;
    EXPECT_EQ(update.guards, static_cast<unsigned>(std::min(count, 8))) << count;
  }
}

// Fails if the step of the paper's Fig. 5 needs more than two modes' worth and the terms of spring, feedthrough and Δu.
TEST(Law, Fig5Cost) {
  const Compiled compiled(network_text(fig_5));
  const Cost output = cost_of(compiled.law(), compiled.law().output),
             update = cost_of(compiled.law(), compiled.law().update);
  EXPECT_LE(output.multiplications + update.multiplications, 2u * 2 + 3);
  EXPECT_LE(output.additions + update.additions, 2u * 2 + 4);
}

bool reads(const UpdateLaw& law, VariableId variable) {
  return std::any_of(law.expressions.begin(), law.expressions.end(),
                     [&](const Expression& e) { return e.operation == Operation::read && e.variable == variable; });
}

Choices choosing(std::variant<std::string, double> decomposition) {
  Choices choices;
  choices.decomposition = std::move(decomposition);
  return choices;
}

// Fails if a law that is named for it reads a velocity all the same, were it only to correct the rounding of b∞.
TEST(Law, VelocityFreeReadsNoVelocity) {
  for (const ScalarType scalar : {ScalarType::float64, ScalarType::float32}) {
    Choices choices = choosing("velocity-free");
    choices.scalar = scalar;
    const Compiled compiled(network_text(R"({ "series": [ { "damper": 1 }, { "damper": 10 } ] })"), choices);
    EXPECT_FALSE(reads(compiled.law(), compiled.law().velocity));
  }
}

// Fails if the text for people leaves out a coefficient or a phase.
TEST(Law, TextShowsEverything) {
  const Compiled compiled(network_text(fig_5));
  const std::string text = to_text(compiled.law(), compiled->network);
  for (const Coefficient& coefficient : compiled.law().coefficients)
    EXPECT_NE(text.find(coefficient.name), std::string::npos) << text;
  for (const char* phase : {"\noutput\n", "\nkeep\n", "\nupdate\n", "\nenergy\n"})
    EXPECT_NE(text.find(phase), std::string::npos);
}

// Fails if a relaxation that is over before the next sample, or digits that a float has not, go unsaid.
TEST(Law, WarnsOfWhatASampleOrAFloatCannotCarry) {
  Choices in_float;
  in_float.scalar = ScalarType::float32;
  const std::string fast = network_text(R"({ "series": [ { "damper": 1 }, { "spring": 600 } ] })");
  const std::string slow = network_text(R"({ "series": [ { "damper": 1 }, { "spring": 400 } ] })");
  EXPECT_TRUE(Compiled(fast).reports(DiagnosticCode::fast_relaxation));
  EXPECT_FALSE(Compiled(slow).reports(DiagnosticCode::fast_relaxation));
  const std::string wide = network_text(R"({ "parallel": [ { "spring": 1e5 },
                                                           { "series": [ { "damper": 1e-2 }, { "spring": 1e-3 } ] } ] })");
  EXPECT_TRUE(Compiled(wide, in_float).reports(DiagnosticCode::float_range));
  EXPECT_FALSE(Compiled(wide).reports(DiagnosticCode::float_range));
  EXPECT_FALSE(Compiled(slow, in_float).reports(DiagnosticCode::float_range));
}

// A motion on a grid that is exact in double, with a velocity of its own.
struct Sample {
  double position;
  double velocity;
};

std::vector<Sample> motion(std::uint64_t seed, std::size_t samples) {
  Random random(seed);
  std::vector<Sample> all;
  double position = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    position += std::floor(random.uniform(-64, 65)) * 0x1p-12;
    all.push_back({position, std::floor(random.uniform(-64, 65)) * 0x1p-6});
  }
  return all;
}

constexpr std::size_t samples = 200;

std::vector<double> total_forces(const UpdateLaw& law, const std::vector<Sample>& motion) {
  Evaluation<double> evaluation(law);
  evaluation.reset();
  std::vector<double> forces;
  for (const Sample& sample : motion) {
    const auto now = evaluation.step(sample.position, sample.velocity);
    forces.push_back(now.damping * sample.velocity + now.force);
  }
  return forces;
}

// f_k = k0 u_k + b∞ v_k + Σ F_i, F_i ← a_i F_i + c_i Δu (or h c_i v): theory, section 3, in 60 digits.
std::vector<Exact> reference_forces(const Compilation& c, const std::vector<Sample>& motion) {
  const Exact h = 1 / Exact(c.rate);
  const bool exact_scheme = c.law.scheme == Scheme::exact;
  std::vector<Exact> modes(c.form.linear.modes.size(), 0), forces;
  double last = 0;
  for (const Sample& sample : motion) {
    const Exact drive = c.law.state_input == StateInput::position ? Exact(sample.position) - last : h * sample.velocity;
    Exact force = Exact(c.form.linear.static_stiffness) * sample.position +
                  Exact(c.form.linear.feedthrough_damping) * sample.velocity;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const Exact k(c.form.linear.modes[i].stiffness), x = Exact(c.form.linear.modes[i].relaxation_rate) * h;
      const Exact a = exact_scheme ? Exact(exp(-x)) : Exact(1 / (1 + x));
      modes[i] = a * modes[i] + (exact_scheme ? Exact(k * (1 - a) / x) : Exact(k * a)) * drive;
      force += modes[i];
    }
    forces.push_back(force);
    last = sample.position;
  }
  return forces;
}

// What the forces are made of, all with the same sign: rounding is relative to this.
double scale_of(const Compilation& c) {
  const Real damping = c.form.linear.feedthrough_damping + Real(c.law.damping) + zero_frequency_damping(c.form.linear);
  return to_double(glass_stiffness(c.form.linear) * Real(samples * 64 * 0x1p-12) + damping);
}

std::string complaint_about_forces(const Compiled& compiled, const std::vector<Sample>& motion) {
  const std::vector<double> found = total_forces(compiled.law(), motion);
  const std::vector<Exact> expected = reference_forces(*compiled.operator->(), motion);
  // The modes' own bound, and a rounding for each operation of the output and for the product b v.
  const Cost cost = cost_of(compiled.law(), compiled.law().output);
  const double operations =
      static_cast<double>(cost.additions + cost.multiplications + compiled->form.linear.modes.size() + 4);
  const double allowed =
      (compiled.law().relative_error_bound + operations * roundoff) * scale_of(*compiled.operator->());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (const double error = abs(Exact(found[i]) - expected[i]).convert_to<double>(); error > allowed)
      return fmt::format("sample {}: force {} is off by {:.3g}, more than {:.3g}", i, found[i], error, allowed);
  return "";
}

std::string complaint_about(const Network& network, const Choices& choices) {
  const std::string text = json_text(network);
  for (const char* name :
       {"paper", "zero-frequency", "quietest-passive", "velocity-free", "largest-observer", "virtual"}) {
    Choices named = choices;
    named.decomposition = name;
    const std::string complaint =
        complaint_about_forces(Compiled(text, named), motion(network.elements.size(), samples));
    if (!complaint.empty())
      return fmt::format("{} by {} at {}: {}", name_of(choices.scheme), name, *choices.rate, complaint);
  }
  return "";
}

NetworkRecipe small_graphs() {
  NetworkRecipe recipe;
  recipe.topology = Topology::graph;
  recipe.most_nodes = 8;
  return recipe;
}

// Fails if b u̇ + m is not the network's force for some candidate, scheme or drive of the states.
TEST(Law, EveryCandidateRendersTheNetwork) {
  for (const Scheme scheme : {Scheme::exact, Scheme::backward_euler})
    for (const StateInput input : {StateInput::position, StateInput::velocity})
      for (const double rate : {100.0, 1000.0}) {
        Choices choices;
        choices.scheme = scheme;
        choices.state_input = input;
        choices.rate = rate;
        EXPECT_EQ(first_failure(1, repetitions(3, 100), small_graphs(),
                                [&](const Network& network) { return complaint_about(network, choices); }),
                  "");
      }
}

// V = ½ k0 u² + Σ F_i²/2k_i never rises by more than f Δu, but for rounding.
std::string complaint_about_energy(const Network& network) {
  for (const Scheme scheme : {Scheme::exact, Scheme::backward_euler}) {
    Choices choices = choosing("velocity-free");
    choices.scheme = scheme;
    const Compiled compiled(json_text(network), choices);
    Evaluation<double> law(compiled.law());
    law.reset();
    double stored = 0, last = 0;
    for (const Sample& sample : motion(network.elements.size(), samples)) {
      const double force = law.step(sample.position, 0).force, work = force * (sample.position - last);
      const double gain = law.stored_energy() - stored;
      const double rounding = 1e-13 * scale_of(*compiled.operator->());
      if (gain > work + rounding) return fmt::format("{}: {} stored for {} of work", name_of(scheme), gain, work);
      stored += gain;
      last = sample.position;
    }
  }
  return "";
}

// Fails if a position driven law gives back more energy than was put in (theory, section 6, energy lemma).
TEST(Law, StoresNoMoreThanTheWorkDone) {
  EXPECT_EQ(first_failure(1, repetitions(24, 400), small_graphs(), complaint_about_energy), "");
}

}  // namespace
