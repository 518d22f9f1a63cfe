#include "discretise/tunable_programs.hpp"

#include <map>

#include "discretise/contact_surface.hpp"
#include "discretise/law_writer.hpp"
#include "law/check_law.hpp"

namespace dashpot::compiler {
namespace {

class ProgramsBuilder {
 public:
  ProgramsBuilder(UpdateLaw law, motion port_motion)
      : law_(std::move(law)), writer_(law_, port_motion), head_(law_.tunable->head) {}

  UpdateLaw build() {
    declare();
    head_.contact.is_there ? write_contact_output() : write_output();
    write_update();
    call(law_.rest, resting_, {TunableCall::reset, {law_.rest_position}}, "");
    for (std::vector<Statement>* program : {&law_.rest, &law_.tune})
      call(*program, held_, {TunableCall::port, {}, TunableResult::held, {tuned_.begin(), tuned_.end()}}, "");
    if (!head_.contact.is_there) writer_.assign(law_.rest, law_.last_brake, writer_.read(resting_), "");
    call(law_.energy, law_.stored, {TunableCall::stored_energy},
         "V + T: in the springs, and what changes of parameters have set free");
    check_law(law_, "discretise");
    return std::move(law_);
  }

 private:
  void declare() {
    law_.position = writer_.scalar("position", writer_.length(), "port displacement u", Role::input);
    law_.velocity = writer_.scalar("velocity", writer_.velocity(), "estimate of u̇", Role::input);
    law_.force = writer_.scalar("force", writer_.force(), "motor's part m", Role::local);
    law_.stored = writer_.scalar("stored", "J", "energy in the springs", Role::local);
    held_ = state("held_force", writer_.force(), "π, what springs hold");
    resting_ = state("resting_brake", writer_.damping(), "b of a tool in touch and at rest");
  }

  // What of the port the output reads, each once.
  ExpressionId tuned(TunableResult result, const char* name, const std::string& unit, const char* meaning) {
    auto found = tuned_.find(result);
    if (found == tuned_.end()) found = tuned_.emplace(result, state(name, unit, meaning)).first;
    return writer_.read(found->second);
  }
  ExpressionId stiffness() {
    return tuned(TunableResult::stiffness, "step_stiffness", writer_.stiffness(), "what springs answer in a sample");
  }
  ExpressionId damping() {
    return tuned(TunableResult::damping, "steady_brake", writer_.damping(), "b of what no slip changes");
  }
  ExpressionId gain() { return tuned(TunableResult::gain, "velocity_gain", writer_.damping(), "b∞ − b"); }
  ExpressionId recovery() {
    return tuned(TunableResult::recovery, "recovery_compliance", writer_.compliance(),
                 "−1/g of a surface that nothing touches");
  }
  ExpressionId feedthrough() {
    return tuned(TunableResult::feedthrough, "feedthrough_stiffness", writer_.stiffness(), "b∞/h");
  }

  VariableId state(const char* name, const std::string& unit, const char* meaning) {
    return writer_.scalar(name, unit, meaning, Role::state);
  }
  VariableId local(const char* name, const std::string& unit, const char* meaning) {
    return writer_.scalar(name, unit, meaning, Role::local);
  }
  ExpressionId product(ExpressionId first, VariableId second) { return writer_.multiply(first, writer_.read(second)); }

  void call(std::vector<Statement>& program, VariableId target, CallTunable step, std::string purpose) {
    program.push_back({target, nothing, std::move(purpose), {}, std::move(step)});
  }

  // m = g Δu + π + σ + (b∞ − b) u̇, of slips σ
  void write_output() {
    law_.rest_position = state("last_position", writer_.length(), "u of the sample before");
    change_ = local("position_change", writer_.length(), "Δu since the sample before");
    place_ = law_.position;
    writer_.assign(law_.output, change_,
                   writer_.subtract(writer_.read(law_.position), writer_.read(law_.rest_position)), "Δu = u − u₋");
    ExpressionId sum = writer_.add(product(stiffness(), change_), writer_.read(held_));
    if (head_.slip_count > 0) {
      const VariableId slips = local("slips_force", writer_.force(), "σ, of all slips");
      call(law_.output, slips, {TunableCall::slip, {change_}}, "σ of all slips");
      sum = writer_.add(sum, writer_.read(slips));
    }
    ExpressionId brake = damping(), driven = gain();
    sum = left_to_brake(sum, brake, &driven);
    writer_.assign(law_.output, law_.force, writer_.add(sum, product(driven, law_.velocity)), "m = f − b u̇");
    law_.brake = local("brake", writer_.damping(), "b");
    writer_.assign(law_.output, law_.brake, brake, "b");
    law_.last_brake = state("last_brake", writer_.damping(), "b of the sample before");
    writer_.assign(law_.keep, law_.last_brake, writer_.read(law_.brake), "");
  }

  // Takes out of the force what slips leave to the brake, and adds to b and to the motor's gain what is theirs.
  ExpressionId left_to_brake(ExpressionId force, ExpressionId& brake, ExpressionId* gain) {
    if (!head_.slip_rule.takes_part) return force;
    const VariableId now = local("slips_feedthrough", writer_.stiffness(), "b∞/h behind slips, left to the brake"),
                     damping = local("slips_brake", writer_.damping(), "b of what is behind slips");
    CallTunable step = {
        TunableCall::slip_brake, {law_.position}, TunableResult::now, {{TunableResult::damping, damping}}};
    brake = writer_.add(brake, writer_.read(damping));
    if (gain != nullptr) {
      const VariableId make_up =
          local("slips_gain", writer_.damping(), "what the motor makes up for a coil on its way");
      step.found.push_back({TunableResult::make_up, make_up});
      *gain = writer_.add(*gain, writer_.read(make_up));
    }
    call(law_.output, now, std::move(step), "b of the slips' regime");
    return writer_.subtract(force, product(writer_.read(now), change_));
  }

  // f′ = g Δs + π, or what slips answer beside it, less b∞ Δs/h
  void write_contact_output() {
    ContactSurface surface(writer_, head_.contact.at, head_.contact.encoder_step);
    surface.declare();
    change_ = surface.change();
    surface.write_approach();
    ExpressionId sum = nothing;
    if (head_.slip_count == 0) {
      surface.write_change(recovery(), held_);
      sum = writer_.add(product(stiffness(), change_), writer_.read(held_));
    } else {
      const VariableId pushed = local("pushed_force", writer_.force(), "of all slips and what is beside them");
      call(law_.output, pushed,
           {TunableCall::push, {surface.approach()}, TunableResult::force, {{TunableResult::change, change_}}},
           "f of all slips, and Δs");
      sum = writer_.subtract(writer_.read(pushed), product(feedthrough(), change_));
    }
    surface.write_surface();
    ExpressionId brake = damping();
    sum = left_to_brake(sum, brake, nullptr);
    const VariableId opposing = local("opposing", writer_.force(), "f′, the network's force but for b∞ Δs/h");
    writer_.assign(law_.output, opposing, sum, "f′ = f − b∞ Δs/h");
    const ExpressionId driven = product(gain(), law_.velocity);
    const ExpressionId braked = writer_.add(writer_.read(opposing), product(brake, law_.velocity));
    surface.write_command(opposing, {writer_.add(braked, driven), writer_.add(writer_.read(opposing), driven), brake});
    place_ = surface.now();
    if (head_.static_spring == no_index && head_.slip_count > 0) return;
    place_ = local("surface_back", writer_.length(), "s, where what was shed has followed the tool");
    call(law_.output, place_, {TunableCall::follow, {surface.now(), surface.depth()}},
         "a dent comes back with the tool");
  }

  void write_update() {
    const VariableId placed = writer_.kept(place_);
    call(law_.update, held_, {TunableCall::update, {writer_.kept(change_), placed}}, "");
    writer_.assign(law_.update, law_.rest_position, writer_.read(placed), head_.contact.is_there ? "s₋ = s" : "u₋ = u");
  }

  UpdateLaw law_;
  LawWriter writer_;
  const tunable_tables<double>& head_;
  std::map<TunableResult, VariableId> tuned_;
  VariableId held_, resting_, change_, place_;
};

}  // namespace

UpdateLaw with_programs(UpdateLaw law, motion port_motion) {
  return ProgramsBuilder(std::move(law), port_motion).build();
}

}  // namespace dashpot::compiler
