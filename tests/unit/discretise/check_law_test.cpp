// A law that is none does not leave the pass that made it.
#include "law/check_law.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "compiled.hpp"

namespace dashpot::testing {
namespace {

using namespace compiler;

// The paper's Fig. 5: all phases, vectors and scalars.
UpdateLaw whole_law() {
  return Compiled(network_text(R"({ "parallel": [ { "series": [ { "damper": 5 }, { "spring": 12 } ] },
                                                  { "series": [ { "damper": 6 }, { "spring": 10 } ] },
                                                  { "spring": 5 } ] })"))
      .law();
}

// What the check says about the law when this has been done to it.
std::string complaint_after(const std::function<void(UpdateLaw&)>& spoil) {
  UpdateLaw law = whole_law();
  spoil(law);
  try {
    check_law(law, "a pass");
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

ExpressionId read(UpdateLaw& law, VariableId variable) { return law.expressions.add({Operation::read, {}, variable}); }

VariableId state_of_several(const UpdateLaw& law) {
  for (const Variable& v : law.variables)
    if (v.role == Role::state && v.size > 1) return law.variables.id_of(v);
  throw std::runtime_error("no vector among the states");
}

// Fails if a law as it is compiled does not pass.
TEST(CheckLaw, AcceptsCompiledLaws) {
  EXPECT_EQ(complaint_after([](UpdateLaw&) {}), "");
}

// Fails if a fault of any kind passes, or the pass that made it is not named.
TEST(CheckLaw, RefusesFaultyLawsAndNamesThePass) {
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.output.pop_back(); }), "a pass: the force is never assigned");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.energy.clear(); }), "a pass: the stored energy is never assigned");
  EXPECT_EQ(
      complaint_after([](UpdateLaw& law) { law.output.insert(law.output.begin(), law.output.back()); }).substr(0, 21),
      "a pass: output reads ");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.output.push_back(law.output.back()); }),
            "a pass: output assigns 'force' twice");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.output.push_back(law.update.front()); }).substr(0, 15),
            "a pass: output ");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) {
              law.update.push_back({law.rest_position, read(law, law.velocity), "", {}});
            }),
            "a pass: update reads the input 'velocity'");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) {
              law.update.push_back({law.rest_position, read(law, state_of_several(law)), "", {}});
            }),
            "a pass: 'mode_force' does not fit into 'last_position'");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.variables[state_of_several(law)].lanes = {8}; }).substr(0, 13),
            "a pass: 'mode");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.coefficients.begin()->role = ConstantRole::none; }).substr(0, 17),
            "a pass: constant ");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.coefficients.begin()->role = ConstantRole::yield; }),
            "a pass: constant 'static_stiffness' is of no part of the network");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) {
              law.coefficients.begin()->of = {OfElements{{0}}, OfElements{{1}}};
            }),
            "a pass: constant 'static_stiffness' has not one subject for each value");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) {
              law.update.front().value = law.expressions.add({Operation::add, {law.update.front().value, {}}});
            }),
            "a pass: an operand of 'add' does not stand before it");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.update.front().step = SolveTree{}; }),
            "a pass: a step solves no coupling");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) { law.update.front().value = {}; }),
            "a pass: a statement without target or value");
  EXPECT_EQ(complaint_after([](UpdateLaw& law) {
              law.tune.push_back({law.rest_position, read(law, law.velocity), "", {}});
            }),
            "a pass: tune reads the input 'velocity'");
}

}  // namespace
}  // namespace dashpot::testing
