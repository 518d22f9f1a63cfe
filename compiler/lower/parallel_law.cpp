#include "lower/parallel_law.hpp"

#include <algorithm>

#include "law/check_law.hpp"
#include "law/empty_law.hpp"
#include "lower/append_law.hpp"

namespace dashpot::compiler {
namespace {

class InParallel {
 public:
  InParallel(const std::vector<ParallelPort>& ports, double added_damping, motion port_motion)
      : ports_(ports),
        added_damping_(added_damping),
        law_(empty_law_like(ports.front().law)),
        writer_(law_, port_motion) {}

  UpdateLaw result() {
    declare();
    for (const ParallelPort& port : ports_)
      appended_.push_back(append_law(writer_, port.name, port.law,
                                     {{port.law.position, law_.position}, {port.law.velocity, law_.velocity}}));
    for (AppendedLaw& port : appended_) {
      for (auto [from, to] : {std::pair(&port.output, &law_.output),
                              {&port.keep, &law_.keep},
                              {&port.update, &law_.update},
                              {&port.energy, &law_.energy}})
        to->insert(to->end(), from->begin(), from->end());
      law_.guards.insert(law_.guards.end(), port.guards.begin(), port.guards.end());
    }
    write_share();
    write_brake();
    write_force();
    write_energy();
    for (std::size_t i = 0; i < ports_.size(); ++i) write_start(i);
    check_law(law_, "several ports");
    return std::move(law_);
  }

 private:
  void declare() {
    law_.position = writer_.scalar("position", writer_.length(), "port displacement u", Role::input);
    law_.velocity = writer_.scalar("velocity", writer_.velocity(), "estimate of u̇", Role::input);
    law_.force = writer_.scalar("force", writer_.force(), "motor's part m", Role::local);
    law_.stored = writer_.scalar("stored", "J", "energy in the springs", Role::local);
  }

  // The port's force, within its share of the motor.
  ExpressionId force_of(std::size_t i) {
    const ExpressionId force = writer_.read(appended_[i].at(ports_[i].law.force));
    if (!ports_[i].clamps_at) return force;
    return writer_.clamp(force, writer_.constant(joined(ports_[i].name, "motor_limit"), writer_.force(),
                                                 "the port's share of the motor's largest force",
                                                 Real(*ports_[i].clamps_at), ConstantRole::motor_reach));
  }

  ExpressionId wanted_of(std::size_t i) {
    const UpdateLaw& own = ports_[i].law;
    return writer_.read(appended_[i].at(own.sheds() ? own.wanted : own.force));
  }

  void write_force() {
    const bool is_limited =
        std::any_of(ports_.begin(), ports_.end(), [](const ParallelPort& p) { return p.clamps_at || p.law.sheds(); });
    ExpressionId force = nothing, wanted = nothing;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      force = writer_.plus(force, force_of(i));
      if (is_limited) wanted = writer_.plus(wanted, wanted_of(i));
    }
    if (is_limited) {
      law_.wanted =
          writer_.scalar(writer_.unique("wanted"), writer_.force(), "m before the motor's limits", Role::local);
      writer_.assign(law_.output, law_.wanted, wanted, "Σ m of all ports before the motor's limits");
    }
    writer_.assign(law_.output, law_.force, force, "m = Σ m of all ports");
  }

  // The smallest of the ports' kept shares.
  void write_share() {
    VariableId least = no_variable;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const UpdateLaw& own = ports_[i].law;
      if (!own.sheds()) continue;
      const auto kept =
          std::find_if(own.keep.begin(), own.keep.end(), [&](const Statement& s) { return s.target == own.share; });
      const VariableId share = appended_[i].at(own.expressions[kept->value].variable);
      if (least == no_variable) {
        least = share;
        continue;
      }
      const VariableId both =
          writer_.scalar(writer_.unique("share"), "1", "share of all forces that is kept", Role::local);
      writer_.assign(law_.output, both,
                     writer_.where(writer_.subtract(writer_.read(share), writer_.read(least)), writer_.read(least),
                                   writer_.read(share)),
                     "smallest share that any port keeps");
      least = both;
    }
    if (least != no_variable) law_.share = writer_.kept(least);
  }

  void write_brake() {
    double steady = added_damping_, at_rest = 0, least = added_damping_, most = added_damping_;
    ExpressionId brake = nothing;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const UpdateLaw& own = ports_[i].law;
      least += own.damping;
      most += own.largest_damping;
      if (!own.brake_changes()) {
        steady += own.damping;
        continue;
      }
      brake = writer_.plus(brake, writer_.read(appended_[i].at(own.brake)));
      at_rest += own.variables[own.last_brake].rest_value;
    }
    law_.damping = rounded(Real(least), law_.scalar);
    law_.largest_damping = rounded(Real(most), law_.scalar);
    if (brake == nothing) return;
    if (steady > 0)
      brake = writer_.plus(
          brake, writer_.constant("steady_damping", writer_.damping(), "b of the ports whose brake does not change",
                                  Real(steady), ConstantRole::steady_damping));
    law_.brake = writer_.scalar(writer_.unique("brake_command"), writer_.damping(), "b", Role::local);
    writer_.assign(law_.output, law_.brake, brake, "b = Σ b of all ports");
    law_.last_brake = writer_.kept(law_.brake);
    law_.variables[law_.last_brake].rest_value = rounded(Real(steady + at_rest), law_.scalar);
  }

  void write_energy() {
    ExpressionId sum = nothing;
    for (std::size_t i = 0; i < ports_.size(); ++i)
      sum = writer_.plus(sum, writer_.read(appended_[i].at(ports_[i].law.stored)));
    writer_.assign(law_.energy, law_.stored, sum, "V of all ports");
  }

  // Where reset() finds the port: where the tool is, how far it has pushed a surface in, or where its curve is there.
  void write_start(std::size_t i) {
    const UpdateLaw& own = ports_[i].law;
    if (own.rest_position == no_variable) return;
    law_.start.insert(law_.start.end(), appended_[i].start.begin(), appended_[i].start.end());
    const VariableId started_at = appended_[i].at(own.started_at);
    law_.starts.push_back({appended_[i].at(own.rest_position), started_at == no_variable ? law_.position : started_at});
  }

  const std::vector<ParallelPort>& ports_;
  double added_damping_;
  UpdateLaw law_;
  LawWriter writer_;
  std::vector<AppendedLaw> appended_;
};

}  // namespace

UpdateLaw parallel_law(const std::vector<ParallelPort>& ports, double added_damping, motion port_motion) {
  return InParallel(ports, added_damping, port_motion).result();
}

}  // namespace dashpot::compiler
