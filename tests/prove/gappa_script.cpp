#include "gappa_script.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <regex>
#include <set>

#include "discretise/rounding.hpp"
#include "law/walk.hpp"
#include "scalar_program.hpp"

namespace dashpot::testing {
namespace {

using compiler::ExpressionId;
using compiler::Operation;
using compiler::Role;
using compiler::Statement;
using compiler::UpdateLaw;

// m·2^e, as Gappa writes a number exactly.
std::string exact(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return fmt::format("{}b{}", static_cast<long long>(std::ldexp(mantissa, 53)), exponent - 53);
}

double half_ulp(double value, compiler::ScalarType scalar) {
  const double next = scalar == compiler::ScalarType::float64 ? std::nextafter(value, INFINITY)
                                                              : double(std::nextafter(float(value), INFINITY));
  return (next - value) / 2;
}

// Each of `names` as a whole word, with `ending` behind it.
std::string with_ending(std::string text, const std::set<std::string>& names, const std::string& ending) {
  static const std::regex word("[A-Za-z_][A-Za-z0-9_]*");
  std::string result;
  std::size_t done = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), word), end; match != end; ++match) {
    const auto at = static_cast<std::size_t>(match->position());
    result += text.substr(done, at - done) + match->str() + (names.count(match->str()) > 0 ? ending : "");
    done = at + static_cast<std::size_t>(match->length());
  }
  return result + text.substr(done);
}

class Script {
 public:
  Script(const compiler::Compilation& compilation, const compiler::InputRange& range, const compiler::StateBox& box)
      : c_(compilation), law_(compilation.law), range_(range), box_(box) {}

  std::vector<std::string> texts() {
    define(law_.output, outputs_);
    define(law_.update, nexts_);
    assume_inputs();
    bound_force();
    bound_states();
    std::vector<std::string> all = {text(goals_, "")};
    for (const auto& [state, goals] : by_cases_) all.push_back(text(goals, case_by_case(state)));
    return all;
  }

 private:
  std::string text(const std::vector<std::string>& goals, const std::string& hint) const {
    std::string all =
        fmt::format("@rnd = float<{}, ne>;\n", law_.scalar == compiler::ScalarType::float64 ? "ieee_64" : "ieee_32");
    for (const std::string& name : floats_) all += fmt::format("{0} = rnd({0}_any);\n", name);
    for (const auto& [name, value] : constants_) all += fmt::format("{} = {};\n", name, exact(value));
    std::vector<std::string> assumptions = assumptions_;
    for (const auto& [state, proved] : by_cases_)
      if (hint.empty()) assumptions.push_back(proved.front());
    return all + definitions_ + "{ " + joined(assumptions, " /\\\n  ") + " ->\n  " + joined(goals, " /\\\n  ") +
           " }\n" + hint;
  }

  static std::string joined(const std::vector<std::string>& all, const char* between) {
    std::string text;
    for (const std::string& one : all) text += (text.empty() ? "" : between) + one;
    return text;
  }

  // name = what is computed; name_real = the same without rounding, and with constants that were not rounded either.
  void define(const std::vector<Statement>& program, std::set<std::string>& defined) {
    // A state below the threshold is within the box too, so that the guard does not affect any bound.
    static const std::regex guard("\\bflush\\(");
    const bool is_update = &program == &law_.update;
    for (const ScalarAssignment& a : scalar_program(law_, program)) {
      const std::string value = std::regex_replace(a.value, guard, "(");
      const std::string rounded = with_ending(value, defined, is_update ? "next" : "");
      const std::string name = is_update ? a.target + "next" : a.target;
      std::set<std::string> real = is_update ? all_constants() : std::set<std::string>();
      definitions_ += fmt::format("{} rnd= {};\n", name, rounded);
      if (!is_update) real = defined;
      definitions_ += fmt::format("{}_real = {};\n", name,
                                  is_update ? with_ending(with_ending(value, defined, "next"), real, "_real")
                                            : with_ending(value, real, "_real"));
      defined.insert(a.target);
    }
  }

  std::set<std::string> all_constants() {
    std::set<std::string> names;
    for (const compiler::Coefficient& c : law_.coefficients)
      for (std::size_t place = 0; place < c.values.size(); ++place) names.insert(scalar_name(c, place));
    return names;
  }

  bool appears(const std::string& name) const {
    return std::regex_search(definitions_, std::regex("\\b" + name + "\\b"));
  }

  void assume_inputs() {
    const auto assume = [&](const std::string& name, double bound) {
      if (!appears(name)) return;
      floats_.push_back(name);
      assumptions_.push_back(fmt::format("|{}| <= {}", name, exact(bound)));
    };
    assume(scalar_name(law_.variables[law_.position], 0), range_.position);
    assume(scalar_name(law_.variables[law_.velocity], 0), range_.velocity);
    for (const auto& [state, bound] : box_) assume(state, bound.magnitude());
    for (const compiler::Coefficient& c : law_.coefficients)
      for (std::size_t place = 0; place < c.values.size(); ++place) {
        const std::string name = scalar_name(c, place);
        if (appears(name)) constants_[name] = c.values[place];
        if (appears(name + "_real"))
          assumptions_.push_back(
              fmt::format("|{0}_real - {0}| <= {1}", name, exact(half_ulp(c.values[place], law_.scalar))));
      }
  }

  void bound_force() {
    const std::string force = scalar_name(law_.variables[law_.force], 0);
    const double sum = compiler::sum_of_terms(law_, range_, box_);
    goals_.push_back(fmt::format("|{0} - {0}_real| <= {1}", force, exact(own_share() * sum)));
    double modes = 0;
    for (const Statement& statement : law_.update)
      for (std::size_t place = 0; place < law_.variables[statement.target].size; ++place)
        if (loss_of(statement.value, place))
          modes += box_.at(scalar_name(law_.variables[statement.target], place)).magnitude();
    if (modes > sum * (1 + 1e-9))
      throw std::logic_error("the modes are no part of the sum that the certificate speaks of");
  }

  // Parts of what the certificate states: that of the force's own operations, and what is left beside it and the modes'
  // own errors.
  double own_share() const { return 8 * compiler::unit_roundoff(law_.scalar); }
  double share_of_sums() const {
    return c_.certificate.energy.rounding_share - law_.relative_error_bound - own_share();
  }

  // An error decays at the rate α, so that one step may add α times what the banner states for all steps.
  void bound_states() {
    for (const Statement& statement : law_.update)
      for (std::size_t place = 0; place < law_.variables[statement.target].size; ++place) {
        const std::string state = scalar_name(law_.variables[statement.target], place);
        const double largest = box_.at(state).magnitude();
        const std::optional<double> loss = loss_of(statement.value, place);
        const double share = loss ? law_.relative_error_bound * *loss / (1 + 1e-5) : share_of_sums();
        const bool by_cases = loss && law_.mode_form == compiler::ModeForm::delta;
        std::vector<std::string>& goals = by_cases ? by_cases_[state] : goals_;
        goals.push_back(fmt::format("|{}next| <= {}", state, exact(largest)));
        goals.push_back(fmt::format("|{0}next - {0}next_real| <= {1}", state, exact(share * largest)));
      }
  }

  // A force and its loss go together, which intervals show only if they are short: those of the force and of what
  // drives it are split.
  std::string case_by_case(const std::string& state) const {
    std::string ranges = state + " in 8";
    for (const char* drive : {"sampled_position_change_", "sampled_velocity_"})
      if (appears(drive)) ranges += fmt::format(", {} in 8", drive);
    return fmt::format("{0}next, {0}next - {0}next_real $ {1};\n", state, ranges);
  }

  // α of the mode that the expression advances; empty where it advances none.
  std::optional<double> loss_of(ExpressionId id, std::size_t place) const {
    std::optional<double> loss;
    compiler::each_expression(law_, id, [&](const compiler::Expression& e) {
      if (e.operation != Operation::constant) return;
      const compiler::Coefficient& c = law_.coefficients[e.coefficient];
      const double value = c.values[c.values.size() == 1 ? 0 : place];
      if (c.role == compiler::ConstantRole::decay) loss = 1 - value;
      if (c.role == compiler::ConstantRole::loss) loss = value;
    });
    return loss;
  }

  const compiler::Compilation& c_;
  const UpdateLaw& law_;
  const compiler::InputRange& range_;
  const compiler::StateBox& box_;
  std::set<std::string> outputs_, nexts_;
  std::vector<std::string> floats_, assumptions_, goals_;
  std::map<std::string, double> constants_;
  std::string definitions_;
  std::map<std::string, std::vector<std::string>> by_cases_;  // goals of each state that are proved apart
};

}  // namespace

std::vector<std::string> gappa_scripts(const compiler::Compilation& compilation, const compiler::InputRange& range,
                                       const compiler::StateBox& box) {
  return Script(compilation, range, box).texts();
}

}  // namespace dashpot::testing
