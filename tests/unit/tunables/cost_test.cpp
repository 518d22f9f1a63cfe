// What an emitted header says that a step and a set() cost, counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "support/shrink.hpp"
#include "law/cost.hpp"
#include "lower/shed.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

std::size_t operations = 0;

// A number that counts what is done with it.
struct Counted {
  double value = 0;

  constexpr Counted() = default;
  constexpr Counted(double number) : value(number) {}
  constexpr explicit operator int() const { return static_cast<int>(value); }

  static constexpr Counted of(double number) {
    if (!std::is_constant_evaluated()) ++operations;
    return Counted(number);
  }
  friend constexpr Counted operator+(Counted a, Counted b) { return of(a.value + b.value); }
  friend constexpr Counted operator-(Counted a, Counted b) { return of(a.value - b.value); }
  friend constexpr Counted operator*(Counted a, Counted b) { return of(a.value * b.value); }
  friend constexpr Counted operator/(Counted a, Counted b) { return of(a.value / b.value); }
  constexpr Counted operator-() const { return Counted(-value); }
  constexpr Counted& operator+=(Counted b) { return *this = *this + b; }
  constexpr Counted& operator-=(Counted b) { return *this = *this - b; }
  constexpr Counted& operator*=(Counted b) { return *this = *this * b; }
  friend constexpr bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend constexpr bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend constexpr bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend constexpr bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
  friend constexpr bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
};

// The most that was counted, over what was said.
struct Share {
  double set = 0, calls = 0, update = 0;
};

// What the tables' set() is given.
std::vector<Counted> numbers_of(const compiler::UpdateLaw& law, const compiler::Evaluation<double>& at) {
  std::vector<Counted> numbers;
  for (const compiler::Statement& statement : law.tune)
    if (const auto* call = std::get_if<compiler::CallTunable>(&statement.step);
        call != nullptr && call->call == compiler::TunableCall::set)
      for (const compiler::ExpressionId given : call->given) {
        const compiler::Expression& e = law.expressions[given];
        numbers.push_back(e.operation == compiler::Operation::read ? at.value_of(e.variable)
                                                                   : law.coefficients[e.coefficient].values.front());
      }
  return numbers;
}

// What the calls of a sample are given, but for what other calls find.
class Sampled {
 public:
  Sampled(const compiler::UpdateLaw& law, compiler::TunableRun<Counted>& run) : law_(law), run_(run) {}

  std::size_t bound() const { return compiler::cost_of(law_, law_.output).called; }

  // The tool sticks to a surface that nothing but slips can move.
  void output(double position) {
    for (const compiler::Statement& statement : law_.output)
      if (const auto* call = std::get_if<compiler::CallTunable>(&statement.step)) {
        std::vector<Counted> given;
        for (const compiler::ExpressionId expression : call->given) {
          const compiler::VariableId id = law_.expressions[expression].variable;
          const bool is_tuned = law_.variables[id].role == compiler::Role::tuned;  // what the brake has left
          given.push_back(id == law_.position ? position
                          : id == law_.wanted ? 1.0
                          : is_tuned          ? 1e30
                                              : position - last_);
        }
        const auto answer = run_.call(call->call, given);
        if (call->call == compiler::TunableCall::push) change_ = answer.of(compiler::TunableResult::change);
        else change_ = position - last_;
      }
    position_ = position;
  }

  void update() {
    run_.call(compiler::TunableCall::update, {change_, position_});
    last_ = position_;
  }

 private:
  const compiler::UpdateLaw& law_;
  compiler::TunableRun<Counted>& run_;
  Counted change_;
  double position_ = 0, last_ = 0;
};

Share share_of(std::uint64_t seed, Kind kind) {
  const TunableLaw compiled(tunable_network(seed, kind));
  // Every other one on a motor that gives little, whose limits the law knows.
  const compiler::MotorReach reach = {0.05, seed % 4 == 0 ? 1e-3 : 0};
  compiler::UpdateLaw law =
      seed % 2 == 0 ? compiler::with_shedding(compiled.law(), reach, motion::translation) : compiled.law();
  const bool is_behind_map = seed % 3 == 1 && !law.tunable->head.contact.is_there;
  if (is_behind_map) law.tunable->head.map = {true, 1e-4, 1e5};
  compiler::TunableRun<Counted> run(*law.tunable);
  Sampled sampled(law, run);
  Random random(seed);
  std::vector<double> values = compiled.defaults();
  Share most;
  compiler::Evaluation<double> numbers(law);
  const std::size_t set_bound =
      compiler::operations_of(*law.tunable, compiler::TunableCall::set) + compiler::operations_of_energy(*law.tunable);
  run.call(compiler::TunableCall::set, numbers_of(law, numbers));
  const auto count = [](double& share, std::size_t bound, const auto& call) {
    operations = 0;
    call();
    if (operations > 0) share = std::max(share, double(operations) / double(bound));
  };
  for (double position : random_walk(random, 120)) {
    values = next_values(compiled.tunables(), values, random);
    numbers.set(values);
    count(most.set, set_bound, [&] { run.call(compiler::TunableCall::set, numbers_of(law, numbers)); });
    count(most.calls, sampled.bound(), [&] { sampled.output(position); });
    count(most.update, compiler::cost_of(law, law.update).called, [&] { sampled.update(); });
  }
  return most;
}

// What a change costs would be most of a period on a board: a standard solid's constants, and a Kelvin's.
TEST(TunableCost, of_constants_is_small) {
  const auto cost = [](const char* network) {
    const TunableLaw compiled(network);
    return compiler::operations_of(compiler::cost_of(compiled.law(), compiled.law().tune));
  };
  EXPECT_LE(cost(R"({ "dashpot": 1, "name": "solid",
    "parameters": { "K1": { "value": 200, "tunable": true, "min": 50, "max": 800 } },
    "network": { "series": [ { "parallel": [ { "spring": "K1" }, { "damper": 8 } ] }, { "spring": 600 } ] } })"),
            60u);
  EXPECT_LE(cost(R"({ "dashpot": 1, "name": "kelvin",
    "parameters": { "K": { "value": 200, "tunable": true, "min": 50, "max": 800 },
                    "B": { "value": 2, "tunable": true, "min": 0, "max": 8 } },
    "network": { "parallel": [ { "spring": "K" }, { "damper": "B" } ] } })"),
            12u);
}

// A loop would miss its period by a law that takes longer than its header says.
TEST(TunableCost, is_never_more_than_said_and_not_much_less) {
  for (const Kind kind : {Kind::parallel_branches, Kind::tree, Kind::graph, Kind::slips, Kind::touched,
                          Kind::touched_slips, Kind::slips_in_graph, Kind::touched_slips_in_graph}) {
    Share most;
    for (std::uint64_t seed = 1; seed <= repetitions(30, 1000); ++seed) {
      const Share share = share_of(seed, kind);
      ASSERT_LE(share.set, 1) << "seed " << seed;
      ASSERT_LE(share.calls, 1) << "seed " << seed;
      ASSERT_LE(share.update, 1) << "seed " << seed;
      most = {std::max(most.set, share.set), std::max(most.calls, share.calls), std::max(most.update, share.update)};
    }
    EXPECT_GE(most.set, 0.25);
    EXPECT_GE(most.calls, 0.25);
    EXPECT_GE(most.update, 0.25);
  }
}

}  // namespace
}  // namespace dashpot::testing
