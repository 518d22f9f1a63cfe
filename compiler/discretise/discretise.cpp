#include "discretise/discretise.hpp"

#include <algorithm>
#include <cmath>

#include "discretise/contact_surface.hpp"
#include "discretise/element_names.hpp"
#include "discretise/law_brake.hpp"
#include "discretise/mode_bank.hpp"
#include "discretise/rounding.hpp"
#include "discretise/slip_parts.hpp"
#include "discretise/tunable_network.hpp"
#include "discretise/tunable_programs.hpp"
#include "law/check_law.hpp"
#include "network/rate_limits.hpp"

namespace dashpot::compiler {
namespace {

Names names_of_modes(const std::vector<Mode>& modes, const Network& network, LawWriter& writer) {
  Names names;
  for (const Mode& mode : modes) names.push_back(writer.unique(name_of(mode.elements, network)));
  return names;
}

UpdateLaw blank_law(const Candidate& choice, const Choices& choices, const Real& sample_period) {
  UpdateLaw law;
  law.scalar = choices.scalar;
  law.scheme = choices.scheme;
  law.state_input = choice.state_input;
  law.sample_period = rounded(sample_period, choices.scalar);
  law.damping = law.largest_damping = rounded(Real(choice.damping), choices.scalar);
  law.flush_threshold = flush_threshold(choices.scalar);
  return law;
}

class LawBuilder {
 public:
  LawBuilder(const Network& network, const NormalForm& form, const Decomposition& decomposition, const Choices& choices,
             const Real& sample_period)
      : law_(blank_law(decomposition.choice(), choices, sample_period)),
        writer_(law_, network.port_motion),
        network_(network),
        form_(form.linear),
        linear_damping_(law_.damping),
        sample_period_(sample_period),
        modes_(writer_, form.linear.modes, law_.state_input, sample_period,
               names_of_modes(form.linear.modes, network, writer_), ""),
        slips_(writer_, network, sample_period, form, decomposition.slips),
        brake_(writer_, decomposition.slips, slips_, linear_damping_, sample_period) {
    // A static curve's map begins at the surface.
    if (network.contact) contact_.emplace(writer_, network.surface_behind_map(), decomposition.encoder_step);
  }

  UpdateLaw build() {
    settle_form();
    declare_inputs();
    modes_.declare();
    slips_.declare();
    contact_ ? write_contact_output() : write_output();
    write_update();
    write_energy();
    check_law(law_, "discretise");
    return std::move(law_);
  }

 private:
  void settle_form() {
    const double smallest_loss = std::min(modes_.smallest_loss(), slips_.smallest_loss());
    law_.mode_form = cheapest_form(smallest_loss, law_.scalar);
    if (!modes_.empty() || !slips_.empty())
      law_.relative_error_bound = error_bound(law_.mode_form, smallest_loss, unit_roundoff(law_.scalar));
  }

  void declare_inputs() {
    law_.position = writer_.scalar("position", writer_.length(), "port displacement u", Role::input);
    law_.velocity = writer_.scalar("velocity", writer_.velocity(), "estimate of u̇", Role::input);
    law_.force = writer_.scalar("force", writer_.force(), "motor's part m", Role::local);
    law_.stored = writer_.scalar("stored", "J", "energy in the springs", Role::local);
    if (contact_) {
      contact_->declare();
      change_ = contact_->change();
      return;
    }
    const bool follows_change = modes_.follows_position() || !slips_.empty();
    if (follows_change || form_.static_stiffness > 0)
      law_.rest_position = writer_.scalar("last_position", writer_.length(), "u of the sample before", Role::state);
    if (follows_change)
      change_ = writer_.scalar("position_change", writer_.length(), "Δu since the sample before", Role::local);
  }

  // f_k = S + k0 u_k + (Σc) Δu + (b∞ − b) u̇_k, added up in two halves: the sample comes last, and so does S, which
  // update() stores last; neither then waits for every addition.
  void write_output() {
    if (change_ != nothing)
      writer_.assign(law_.output, change_,
                     writer_.subtract(writer_.read(law_.position), writer_.read(law_.rest_position)), "Δu = u − u₋");
    const ExpressionId held = modes_.empty() ? nothing : writer_.read(modes_.decayed_sum());
    const ExpressionId placed = plus_product(ConstantRole::static_stiffness, nothing, "static_stiffness",
                                             writer_.stiffness(), "k0", form_.static_stiffness, law_.position);
    const ExpressionId stepped =
        plus_product(ConstantRole::step_stiffness, nothing, "step_stiffness", writer_.stiffness(),
                     "Σ c_i, stiffness of all modes within a sample", modes_.step_stiffness(), change_);
    const Real of_motor = feedthrough_of_motor(), of_modes = modes_.velocity_gain(), together = of_motor + of_modes;
    const Real velocity_gain = abs(together) <= negligible_share * abs(of_modes) ? Real(0) : together;
    const char* meaning = modes_.follows_velocity() ? "b∞ − b + h Σ c_i, force for an estimated velocity" : "b∞ − b";
    const ExpressionId driven = plus_product(ConstantRole::velocity_gain, nothing, "velocity_gain", writer_.damping(),
                                             meaning, velocity_gain, law_.velocity);
    ExpressionId sum = stepped == nothing ? writer_.plus(held, writer_.plus(placed, driven))
                                          : writer_.plus(writer_.plus(held, placed), writer_.plus(stepped, driven));
    sum = slips_.write_output(sum, change_, law_.position);
    sum = brake_.without_feedthrough(sum, law_.position, change_);
    sum = brake_.left_to_motor(sum);
    brake_.write_command();
    if (sum == nothing)
      sum = writer_.constant("no_force", writer_.force(), "the motor has nothing to do", 0, ConstantRole::zero);
    writer_.assign(law_.output, law_.force, sum, "m = f − b u̇", {effective_elements(network_)});
  }

  // f′ = k0 s + (Σc) Δs + S, or f − b∞ Δs/h where slips are behind the surface.
  void write_contact_output() {
    const Real& feedthrough = form_.feedthrough_damping;
    contact_->write_approach();
    const VariableId opposing =
        writer_.scalar("opposing", writer_.force(), "f′, the network's force without b∞ Δs/h", Role::local);
    ExpressionId sum = nothing;
    if (!slips_.empty()) {
      sum = slips_.write_push(contact_->approach(), contact_->change(), {linear_stiffness(), write_held()});
      contact_->write_surface();
      sum = plus_product(ConstantRole::feedthrough_stiffness, sum, "feedthrough_stiffness", writer_.stiffness(),
                         "−b∞/h", -feedthrough / sample_period_, contact_->change());
      sum = brake_.without_feedthrough(sum, contact_->now(), contact_->change());
    } else {
      contact_->write_change(linear_stiffness(), write_held());
      contact_->write_surface();
      sum = plus_product(ConstantRole::static_stiffness, sum, "static_stiffness", writer_.stiffness(), "k0",
                         form_.static_stiffness, contact_->now());
      sum = plus_product(ConstantRole::step_stiffness, sum, "step_stiffness", writer_.stiffness(),
                         "Σ c_i, stiffness of all modes within a sample", modes_.step_stiffness(), contact_->change());
      if (!modes_.empty()) sum = writer_.plus(sum, writer_.read(modes_.decayed_sum()));
    }
    if (sum == nothing)
      sum = writer_.constant("none", writer_.force(), "no force on a free tool", 0, ConstantRole::zero);
    writer_.assign(law_.output, opposing, sum, "f′ = f − b∞ Δs/h", {effective_elements(network_)});
    contact_->write_command(opposing, feedthrough, brake_.behind_contact());
  }

  // g = k0 + b∞/h + Σ c_i
  Real linear_stiffness() const {
    return form_.static_stiffness + modes_.step_stiffness() + form_.feedthrough_damping / sample_period_;
  }

  // π = k0 s₋ + S, of the linear part at the tool; no variable for a lone damper.
  VariableId write_held() {
    ExpressionId held = plus_product(ConstantRole::static_stiffness, nothing, "static_stiffness", writer_.stiffness(),
                                     "k0", form_.static_stiffness, contact_->before());
    if (!modes_.empty()) held = writer_.plus(held, writer_.read(modes_.decayed_sum()));
    if (held == nothing) return no_variable;
    const VariableId force =
        writer_.scalar("held_force", writer_.force(), "force of the linear part if the surface stays", Role::local);
    writer_.assign(law_.output, force, held, "k0 s₋ + S");
    return force;
  }

  // b∞ − b. If the brake's command is b∞ but for rounding, the result is 0: no velocity estimate should be needed for
  // it.
  Real feedthrough_of_motor() const {
    const bool all_in_brake = rounded(form_.feedthrough_damping, law_.scalar) == linear_damping_;
    return all_in_brake ? Real(0) : Real(form_.feedthrough_damping - Real(linear_damping_));
  }

  void write_update() {
    slips_.write_update(change_);
    brake_.write_update(contact_ ? contact_->released() : no_variable);
    // Separate statements, so that every compiler creates the states in the same order.
    const VariableId velocity = modes_.follows_velocity() ? writer_.kept(law_.velocity) : nothing;
    const VariableId change = modes_.follows_position() ? writer_.kept(change_) : nothing;
    modes_.write_update(change, velocity);
    if (law_.rest_position != no_variable)
      writer_.assign(law_.update, law_.rest_position,
                     writer_.read(writer_.kept(contact_ ? contact_->now() : law_.position)),
                     contact_ ? "s₋ = s" : "u₋ = u");
  }

  // V = ½ k0 u² + Σ F_i²/(2 k_i)
  void write_energy() {
    ExpressionId sum = nothing;
    if (form_.static_stiffness > 0) {
      const ExpressionId weight = writer_.constant("half_static_stiffness", writer_.stiffness(), "½ k0",
                                                   form_.static_stiffness / 2, ConstantRole::half_static_stiffness);
      sum = writer_.multiply(writer_.multiply(weight, writer_.read(law_.rest_position)),
                             writer_.read(law_.rest_position));
    }
    sum = writer_.plus(sum, modes_.energy());
    sum = slips_.energy(sum);
    if (sum == nothing) sum = writer_.constant("no_energy", "J", "no spring", 0, ConstantRole::zero);
    writer_.assign(law_.energy, law_.stored, sum, "V = ½ k0 u² + Σ F_i²/(2 k_i)", {effective_elements(network_)});
  }

  // A term whose coefficient rounds to zero is left out of the program.
  ExpressionId plus_product(ConstantRole role, ExpressionId sum, const std::string& name, const std::string& unit,
                            const std::string& meaning, const Real& value, VariableId variable) {
    if (rounded(value, law_.scalar) == 0) return sum;
    return writer_.plus(sum,
                        writer_.multiply(writer_.constant(name, unit, meaning, value, role), writer_.read(variable)));
  }

  UpdateLaw law_;
  LawWriter writer_;
  const Network& network_;
  const LinearForm& form_;
  double linear_damping_;  // b of the part that reaches ground without a slip [N·s/m]
  Real sample_period_;
  ModeBank modes_;
  SlipParts slips_;
  LawBrake brake_;
  std::optional<ContactSurface> contact_;
  VariableId change_ = nothing;
};

// Only the fastest is shown: a rate that is high enough for it is high enough for all.
void warn_about_fast_relaxations(const Network& network, const LinearForm& form, double period,
                                 Diagnostics& diagnostics) {
  const auto is_fast = [&](const Mode& mode) { return to_double(1 / mode.relaxation_rate) < 2 * period; };
  const auto count = std::count_if(form.modes.begin(), form.modes.end(), is_fast);
  if (count == 0) return;
  const Mode& fastest = form.modes.back();
  const double relaxation_time = to_double(1 / fastest.relaxation_rate);
  diagnostics.report<DiagnosticCode::fast_relaxation>(network.elements[fastest.elements.front()].span, relaxation_time,
                                                      name_of(fastest.elements, network), period);
  if (count > 1) diagnostics.note<DiagnosticCode::further_fast_relaxations>({}, count);
  if (2 / relaxation_time <= highest_rate)
    diagnostics.note<DiagnosticCode::fast_relaxation_remedy>({}, std::ceil(2 / relaxation_time));
}

// Warns if a rounding error of the stiffest mode is as large as the whole force of the slowest.
void warn_about_float_range(const Network& network, const LinearForm& form, Diagnostics& diagnostics) {
  if (form.modes.empty()) return;
  Real stiffest = form.static_stiffness;
  for (const Mode& mode : form.modes) stiffest = std::max(stiffest, mode.stiffness);
  const Mode& slowest = form.modes.front();
  const double ratio = to_double(slowest.stiffness / stiffest);
  if (ratio > unit_roundoff(ScalarType::float32)) return;
  diagnostics.report<DiagnosticCode::float_range>(network.name_span, name_of(slowest.elements, network), ratio);
}

// The form of the linear part whose modes are the law's states.
const LinearForm& realised_part(const NormalForm& form, const Decomposition& decomposition) {
  return decomposition.choice().state_input == StateInput::nodal ? decomposition.realisation : form.linear;
}

}  // namespace

UpdateLaw discretise(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                     const Choices& choices, double rate) {
  NormalForm realised = form;
  realised.linear = realised_part(form, decomposition);
  return LawBuilder(network, realised, decomposition, choices, 1 / Real(rate)).build();
}

void warn_about_rate_and_scalar(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                                const Choices& choices, double rate, Diagnostics& diagnostics) {
  const LinearForm& realised = realised_part(form, decomposition);
  warn_about_fast_relaxations(network, realised, to_double(1 / Real(rate)), diagnostics);
  if (choices.scalar == ScalarType::float32) warn_about_float_range(network, realised, diagnostics);
}

std::optional<UpdateLaw> discretise_tunable(const Network& network, const Network& present, const NormalForm& form,
                                            const Decomposition& decomposition, const Choices& choices, double rate,
                                            const PortDevice& device, Diagnostics& diagnostics) {
  const Real sample_period = 1 / Real(rate);
  UpdateLaw law = blank_law(decomposition.choice(), choices, sample_period);
  law.tunable = tunable_tables_of(linear_part(present, form), network, decomposition, choices, sample_period, device,
                                  diagnostics);
  law.mode_form = ModeForm::delta;
  if (!law.tunable) return std::nullopt;
  return with_programs(std::move(law));
}

}  // namespace dashpot::compiler
