// Random networks, their text through the whole compiler: emitted code, built and run, against evaluate() bit for bit,
// and against integrators that know elements and nodes alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "emitted_runs.hpp"
#include "support/shrink.hpp"

namespace dashpot::testing {

void PrintTo(Family family, std::ostream* out) { *out << name_of(family); }

namespace {

constexpr std::size_t cases_a_program = 40;  // as many classes as a compiler takes at once without much memory

class Differential : public ::testing::TestWithParam<Family> {
 protected:
  static std::size_t networks() { return repetitions(DASHPOT_DIFFERENTIAL_NETWORKS, 20000) / 4; }

  // The first complaint about a program's worth of networks.
  std::string complaint_about(std::uint64_t first, std::uint64_t last) {
    std::vector<DifferentialCase> cases;
    for (std::uint64_t seed = first; seed <= last; ++seed) cases.push_back(differential_case(GetParam(), seed));
    const std::vector<std::vector<Answer>> emitted = emitted_answers(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      std::string complaint = first_difference(cases[i].evaluated, emitted[i]);
      if (complaint.empty() && has_reference(cases[i])) {
        ++against_reference_;
        complaint = departure_from_reference(cases[i]);
      }
      if (!complaint.empty()) return complaint + "\n" + cases[i].description;
    }
    return "";
  }

  std::size_t against_reference_ = 0;
};

// Fails if emitted code is not what `simulate` shows, or not the network that the author wrote.
TEST_P(Differential, EmittedCodeIsTheNetwork) {
  for (std::uint64_t seed = 1; seed <= networks(); seed += cases_a_program)
    ASSERT_EQ(complaint_about(seed, std::min<std::uint64_t>(seed + cases_a_program - 1, networks())), "");
  fmt::print("{} networks, {} of them against an integrator of their own\n", networks(), against_reference_);
  EXPECT_GE(3 * against_reference_, networks());
}

INSTANTIATE_TEST_SUITE_P(Of, Differential,
                         ::testing::Values(Family::linear_exact, Family::linear_backward_euler, Family::slips,
                                           Family::contact),
                         [](const ::testing::TestParamInfo<Family>& one) { return name_of(one.param); });

}  // namespace
}  // namespace dashpot::testing
