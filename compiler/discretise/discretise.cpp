#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "discretise/mode_coefficients.hpp"
#include "discretise/update_law.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t largest_straight_line = 16;  // states; beyond, a rolled loop is faster when caches are cold

double unit_roundoff(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-53 : 0x1p-24; }

// A mode's force may be off by this much of its peak before a costlier form is taken.
double tolerated_error(ScalarType scalar) { return scalar == ScalarType::float64 ? 1e-12 : 1e-3; }

// The largest magnitudes that products of two kept numbers may fall to stay normal, and far below what can be felt.
double flush_threshold(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-200 : 0x1p-60; }

double rounded(const Real& value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? to_double(value) : double(value.convert_to<float>());
}

// Worst case over any run, relative to the mode's largest force. An error decays at the rate α, so that 1/α equal ones
// add up. Product: the rounding of aF, of the sum, and of `a` itself are each relative to F. Delta: only the sum's is;
// αF, α, the gain and its product are relative to what they add. Compensated: the sum's is carried to the second order.
double error_bound(ModeForm form, double loss, double roundoff) {
  switch (form) {
    case ModeForm::product: return 3 * roundoff / loss + 2 * roundoff;
    case ModeForm::delta: return roundoff / loss + 4 * roundoff;
    case ModeForm::compensated: return 6 * roundoff + 2 * roundoff * roundoff / loss;
  }
  return 0;
}

ModeForm cheapest_within(double tolerated, double smallest_loss, ScalarType scalar) {
  const double roundoff = unit_roundoff(scalar);
  const ModeForm plain = scalar == ScalarType::float64 ? ModeForm::product : ModeForm::delta;
  return error_bound(plain, smallest_loss, roundoff) <= tolerated ? plain : ModeForm::compensated;
}

std::string joined(std::string first, const std::string& second) {
  while (!first.empty() && first.back() == '_') first.pop_back();
  return first + "_" + second;
}

// `B1_K1` for a mode of B1 and K1; long lists are cut to their ends.
std::string name_of_mode(const Mode& mode, const Network& network) {
  std::string name;
  for (std::size_t element : mode.elements) {
    const std::string& part = network.elements[element].name;
    name = name.empty() ? part : joined(name, part);
  }
  if (mode.elements.size() <= 4 && name.size() <= 40) return name;
  return joined(joined(network.elements[mode.elements.front()].name, "to"),
                network.elements[mode.elements.back()].name);
}

// Distinct ignoring case, as all names in the emitted class.
std::vector<std::string> names_of_modes(const std::vector<Mode>& modes, const Network& network) {
  std::set<std::string> taken = {"relaxed", "velocity", "no", "step", "last", "sampled"};  // begin names of the law's own
  std::vector<std::string> names;
  for (const Mode& mode : modes) {
    const std::string name = name_of_mode(mode, network);
    const auto lowered = [](std::string text) {
      std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
      return text;
    };
    std::string unique = name;
    for (int i = 2; !taken.insert(lowered(unique)).second; ++i) unique = joined(name, std::to_string(i));
    names.push_back(unique);
  }
  return names;
}

class LawBuilder {
 public:
  LawBuilder(const Network& network, const LinearForm& form, const Candidate& choice, const Choices& choices,
             const Real& sample_period)
      : network_(network), form_(form) {
    law_.scalar = choices.scalar;
    law_.scheme = choices.scheme;
    law_.state_input = choice.state_input;
    law_.sample_period = rounded(sample_period, choices.scalar);
    law_.damping = rounded(Real(choice.damping), choices.scalar);
    law_.flush_threshold = flush_threshold(choices.scalar);
    for (const Mode& mode : form.modes)
      modes_.push_back(mode_coefficients(mode, choices.scheme, choice.state_input, sample_period));
    choose_mode_form();
  }

  UpdateLaw build() {
    declare_variables();
    build_output();
    build_update();
    build_energy();
    return std::move(law_);
  }

 private:
  void choose_mode_form() {
    if (modes_.size() > largest_straight_line) law_.lanes = law_.scalar == ScalarType::float64 ? 8 : 16;
    if (modes_.empty()) return;
    double smallest_loss = 1;
    for (const ModeCoefficients& mode : modes_) smallest_loss = std::min(smallest_loss, to_double(mode.loss));
    law_.mode_form = cheapest_within(tolerated_error(law_.scalar), smallest_loss, law_.scalar);
    law_.relative_error_bound = error_bound(law_.mode_form, smallest_loss, unit_roundoff(law_.scalar));
  }

  void declare_variables() {
    const bool rotary = network_.port_motion == motion::rotation;
    length_ = rotary ? "rad" : "m";
    force_unit_ = rotary ? "N·m" : "N";
    stiffness_unit_ = rotary ? "N·m/rad" : "N/m";
    damping_unit_ = rotary ? "N·m·s/rad" : "N·s/m";
    law_.position = declare({"position", length_, "port displacement u", Role::input});
    law_.velocity = declare({"velocity", length_ + "/s", "estimate of u̇", Role::input});
    law_.force = declare({"force", force_unit_, "motor's part m", Role::local});
    law_.stored = declare({"stored", "J", "energy in the springs", Role::local});
    const bool follows_position = some([](const ModeCoefficients& mode) { return mode.position_gain != 0; });
    const bool follows_velocity = some([](const ModeCoefficients& mode) { return mode.velocity_gain != 0; });
    if (follows_position || form_.static_stiffness > 0) {
      law_.rest_position = declare({"last_position", length_, "u of the sample before", Role::state});
      sampled_position_ = declare({"sampled_position", length_, "u of this sample", Role::state});
    }
    if (follows_position) {
      change_ = declare({"position_change", length_, "Δu since the sample before", Role::local});
      sampled_change_ = declare({"sampled_change", length_, "Δu of this sample", Role::state});
    }
    if (follows_velocity)
      sampled_velocity_ = declare({"sampled_velocity", length_ + "/s", "estimate of u̇ at this sample", Role::state});
    if (!modes_.empty()) declare_mode_variables();
  }

  void declare_mode_variables() {
    mode_names_ = names_of_modes(form_.modes, network_);
    decayed_sum_ = declare({"relaxed_force", force_unit_, "sum of the modes' forces, decayed to the next sample", Role::state});
    forces_ = declare_per_mode("force", force_unit_, "force of the mode, decayed to the next sample", Role::state);
    if (law_.mode_form != ModeForm::compensated) return;
    errors_ = declare_per_mode("error", force_unit_, "what rounding kept from the force", Role::state);
    increments_ = declare_per_mode("increment", force_unit_, "", Role::local);
    next_ = declare_per_mode("next", force_unit_, "", Role::local);
  }

  VariableId declare_per_mode(const std::string& name, const std::string& unit, const std::string& meaning, Role role) {
    std::vector<std::string> names = mode_names_;
    for (std::string& mode : names) mode = joined(mode, name);
    return declare({"mode_" + name, unit, meaning, role, modes_.size(), std::move(names)});
  }

  // f_k = k0 u_k + (Σc) Δu + S + (b∞ − b) u̇_k
  void build_output() {
    if (change_ != none)
      assign(law_.output, change_, difference(read(law_.position), read(law_.rest_position)), "Δu = u − u₋");
    Real step_gain = 0, velocity_gain = form_.feedthrough_damping - Real(law_.damping);
    for (const ModeCoefficients& mode : modes_) {
      step_gain += mode.position_gain;
      velocity_gain += mode.velocity_gain;
    }
    ExpressionId sum = none;
    sum = plus_product(sum, {"static_stiffness", stiffness_unit_, "k0", {}, {}}, form_.static_stiffness, law_.position);
    if (change_ != none)
      sum = plus_product(sum, {"step_stiffness", stiffness_unit_, "Σ c_i, answer of all modes within a sample", {}, {}}, step_gain, change_);
    sum = plus_product(sum, {"velocity_gain", damping_unit_, velocity_gain_meaning(), {}, {}}, velocity_gain, law_.velocity);
    if (decayed_sum_ != none) sum = sum == none ? read(decayed_sum_) : add(sum, read(decayed_sum_));
    if (sum == none) sum = constant({"no_force", force_unit_, "nothing is left to the motor", {}, {}}, {Real(0)});
    assign(law_.output, law_.force, sum, "m = f − b u̇", all_elements());
    if (sampled_position_ != none) assign(law_.keep, sampled_position_, read(law_.position), "");
    if (sampled_change_ != none) assign(law_.keep, sampled_change_, read(change_), "");
    if (sampled_velocity_ != none) assign(law_.keep, sampled_velocity_, read(law_.velocity), "");
  }

  std::string velocity_gain_meaning() const {
    return sampled_velocity_ == none ? "b∞ − b" : "b∞ − b + h Σ c_i, what the estimate drives within a sample";
  }

  // F_i ← a_i (F_i + c_i Δu): the decayed force is kept, so that its sum is ready for the next sample.
  void build_update() {
    if (!modes_.empty()) {
      if (law_.mode_form == ModeForm::compensated)
        build_compensated_update();
      else
        assign(law_.update, forces_, flushed(plain_update()), equation(), mode_elements());
      assign(law_.update, decayed_sum_, sum_of(forces_), "S = Σ a_i F_i");
    }
    if (sampled_position_ != none) assign(law_.update, law_.rest_position, read(sampled_position_), "u₋ = u");
  }

  std::string equation() const {
    const std::string drive = change_ != none && sampled_velocity_ != none ? "c_i Δu + h c_i' v"
                              : change_ != none                         ? "c_i Δu"
                                                                        : "h c_i v";
    return law_.mode_form == ModeForm::product ? "F ← a (F + " + drive + ")" : "F ← F + (a " + drive + " − α F)";
  }

  ExpressionId plain_update() {
    if (law_.mode_form == ModeForm::product) return add(multiply(per_mode("decay", "1", decay_meaning(), &ModeCoefficients::decay), read(forces_)), drive());
    return add(read(forces_), increment());
  }

  const char* decay_meaning() const { return law_.scheme == Scheme::exact ? "a = e^{−λh}" : "a = 1/(1 + λh)"; }

  ExpressionId increment() {
    return difference(drive(), multiply(per_mode("loss", "1", "α = 1 − a", &ModeCoefficients::loss), read(forces_)));
  }

  // y = δ + e; t = F + y; e = y − (t − F); F = t
  void build_compensated_update() {
    assign(law_.update, increments_, add(increment(), read(errors_)), "y = (a c Δu − α F) + e", mode_elements());
    assign(law_.update, next_, add(read(forces_), read(increments_)), "t = F + y");
    assign(law_.update, errors_, flushed(difference(read(increments_), difference(read(next_), read(forces_)))), "e = y − (t − F)");
    assign(law_.update, forces_, flushed(read(next_)), "F = t", mode_elements());
  }

  ExpressionId drive() {
    ExpressionId sum = none;
    if (change_ != none)
      sum = multiply(per_mode("gain", stiffness_unit_, "a c", [](const ModeCoefficients& m) { return Real(m.decay * m.position_gain); }), read(sampled_change_));
    if (sampled_velocity_ != none) {
      const ExpressionId by_velocity = multiply(
          per_mode("velocity_drive", damping_unit_, "a c h", [](const ModeCoefficients& m) { return Real(m.decay * m.velocity_gain); }), read(sampled_velocity_));
      sum = sum == none ? by_velocity : add(sum, by_velocity);
    }
    return sum;
  }

  // V = ½ k0 u² + Σ F_i²/(2 k_i), from the decayed forces a F; a mode that vanishes within a sample stores nothing.
  void build_energy() {
    ExpressionId sum = none;
    if (form_.static_stiffness > 0) {
      const ExpressionId weight = constant({"half_static_stiffness", stiffness_unit_, "½ k0", {}, {}}, {form_.static_stiffness / 2});
      sum = multiply(multiply(weight, read(law_.rest_position)), read(law_.rest_position));
    }
    if (!modes_.empty()) {
      const VariableId stored_in_modes = declare_per_mode("energy", "J", "", Role::local);
      const std::string unit = length_ + "/" + force_unit_;
      assign(law_.energy, stored_in_modes, multiply(multiply(per_mode("energy_weight", unit, "1/(2 k a²)", energy_weights()), read(forces_)), read(forces_)), "F²/(2k)", mode_elements());
      sum = sum == none ? sum_of(stored_in_modes) : add(sum, sum_of(stored_in_modes));
    }
    if (sum == none) sum = constant({"no_energy", "J", "no spring", {}, {}}, {Real(0)});
    assign(law_.energy, law_.stored, sum, "V = ½ k0 u² + Σ F_i²/(2 k_i)", all_elements());
  }

  std::vector<Real> energy_weights() const {
    const Real vanishing = law_.scalar == ScalarType::float64 ? Real("1e-100") : Real("1e-12");
    std::vector<Real> weights;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      const Real& a = modes_[i].decay;
      weights.push_back(a < vanishing ? Real(0) : Real(1 / (2 * form_.modes[i].stiffness * a * a)));
    }
    return weights;
  }

  template <class Predicate>
  bool some(Predicate predicate) const { return std::any_of(modes_.begin(), modes_.end(), predicate); }

  std::vector<std::vector<std::size_t>> mode_elements() const {
    std::vector<std::vector<std::size_t>> origins;
    for (const Mode& mode : form_.modes) origins.push_back(mode.elements);
    return origins;
  }

  std::vector<std::vector<std::size_t>> all_elements() const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < network_.elements.size(); ++i)
      if (network_.elements[i].has_effect) all.push_back(i);
    return {all};
  }

  VariableId declare(Variable variable) {
    law_.variables.push_back(std::move(variable));
    return static_cast<VariableId>(law_.variables.size() - 1);
  }

  ExpressionId node(Operation operation, std::uint32_t left, std::uint32_t right = 0) {
    law_.expressions.push_back({operation, left, right});
    return static_cast<ExpressionId>(law_.expressions.size() - 1);
  }
  ExpressionId read(VariableId variable) { return node(Operation::read, variable); }
  ExpressionId add(ExpressionId left, ExpressionId right) { return node(Operation::add, left, right); }
  ExpressionId difference(ExpressionId left, ExpressionId right) { return node(Operation::subtract, left, right); }
  ExpressionId multiply(ExpressionId left, ExpressionId right) { return node(Operation::multiply, left, right); }
  ExpressionId flushed(ExpressionId value) { return node(Operation::flush, value); }
  ExpressionId sum_of(VariableId vector) { return node(Operation::sum, read(vector)); }

  ExpressionId constant(Coefficient coefficient, const std::vector<Real>& values) {
    for (const Real& value : values) coefficient.values.push_back(rounded(value, law_.scalar));
    law_.coefficients.push_back(std::move(coefficient));
    return node(Operation::constant, static_cast<std::uint32_t>(law_.coefficients.size() - 1));
  }

  template <class ValueOf>
  ExpressionId per_mode(const char* name, const std::string& unit, const char* meaning, ValueOf value_of) {
    std::vector<Real> values;
    for (const ModeCoefficients& mode : modes_) values.push_back(std::invoke(value_of, mode));
    return per_mode(name, unit, meaning, values);
  }

  ExpressionId per_mode(const char* name, const std::string& unit, const char* meaning, const std::vector<Real>& values) {
    std::vector<std::string> names = mode_names_;
    for (std::string& mode : names) mode = joined(mode, name);
    return constant({name, unit, meaning, {}, std::move(names)}, values);
  }

  // Terms whose coefficient rounds to zero leave no trace in the program.
  ExpressionId plus_product(ExpressionId sum, Coefficient coefficient, const Real& value, VariableId variable) {
    if (rounded(value, law_.scalar) == 0) return sum;
    const ExpressionId product = multiply(constant(std::move(coefficient), {value}), read(variable));
    return sum == none ? product : add(sum, product);
  }

  void assign(std::vector<Statement>& program, VariableId target, ExpressionId value, std::string purpose,
              std::vector<std::vector<std::size_t>> origins = {}) {
    program.push_back({target, value, std::move(purpose), std::move(origins)});
  }

  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  const Network& network_;
  const LinearForm& form_;
  UpdateLaw law_;
  std::vector<ModeCoefficients> modes_;
  std::vector<std::string> mode_names_;
  std::string length_, force_unit_, stiffness_unit_, damping_unit_;
  VariableId change_ = none, sampled_position_ = none, sampled_change_ = none, sampled_velocity_ = none;
  VariableId decayed_sum_ = none, forces_ = none, errors_ = none, increments_ = none, next_ = none;
};

void warn_about_fast_relaxations(const Network& network, const LinearForm& form, double period, Diagnostics& diagnostics) {
  for (const Mode& mode : form.modes) {
    const double relaxation_time = to_double(1 / mode.relaxation_rate);
    if (relaxation_time >= 2 * period) continue;
    diagnostics.report<DiagnosticCode::fast_relaxation>(network.elements[mode.elements.front()].span, relaxation_time,
                                                        name_of_mode(mode, network), period);
    diagnostics.note<DiagnosticCode::fast_relaxation_remedy>({}, std::ceil(2 / relaxation_time));
  }
}

// The stiffest mode's rounding against the slowest mode's whole force.
void warn_about_float_range(const Network& network, const LinearForm& form, Diagnostics& diagnostics) {
  if (form.modes.empty()) return;
  Real stiffest = form.static_stiffness;
  for (const Mode& mode : form.modes) stiffest = std::max(stiffest, mode.stiffness);
  const Mode& slowest = form.modes.front();
  const double ratio = to_double(slowest.stiffness / stiffest);
  if (ratio > unit_roundoff(ScalarType::float32)) return;
  diagnostics.report<DiagnosticCode::float_range>(network.name_span, name_of_mode(slowest, network), ratio);
}

}  // namespace

UpdateLaw discretise(const Network& network, const LinearForm& form, const Decomposition& decomposition,
                     const Choices& choices, double rate, Diagnostics& diagnostics) {
  const Candidate& choice = decomposition.choice();
  const LinearForm& realised = choice.state_input == StateInput::nodal ? decomposition.realisation : form;
  const Real sample_period = 1 / Real(rate);
  warn_about_fast_relaxations(network, realised, to_double(sample_period), diagnostics);
  if (choices.scalar == ScalarType::float32) warn_about_float_range(network, realised, diagnostics);
  return LawBuilder(network, realised, choice, choices, sample_period).build();
}

}  // namespace dashpot::compiler
