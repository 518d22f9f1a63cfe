#include "lower/shed.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "discretise/law_writer.hpp"
#include "discretise/tunable_programs.hpp"
#include "law/check_law.hpp"
#include "law/walk.hpp"
#include "lower/drop_unread.hpp"

namespace dashpot::compiler {
namespace {

class Shedding {
 public:
  Shedding(UpdateLaw law, const MotorReach& reach, motion port_motion)
      : law_(std::move(law)), writer_(law_, port_motion), reach_(reach) {}

  UpdateLaw result() {
    const bool sheds_by_itself = law_.sheds();
    if (!sheds_by_itself) loosen_static_spring();
    write_command();
    if (sheds_by_itself) writer_.assign(law_.keep, law_.share, writer_.read(share_), "");
    else shed_by_states();
    check_law(law_, "shedding");
    return std::move(law_);
  }

 private:
  ExpressionId zero() {
    return writer_.constant("none_kept", "1", "share where nothing is kept", 0, ConstantRole::motor_reach);
  }
  ExpressionId one() {
    return writer_.constant("all_kept", "1", "share where no limit binds", 1, ConstantRole::motor_reach);
  }
  ExpressionId limit() {
    return writer_.constant("motor_limit", writer_.force(), "largest force of the motor", Real(reach_.limit),
                            ConstantRole::motor_reach);
  }
  ExpressionId step() {
    return writer_.constant("motor_step", writer_.force(), "largest change of the motor's force in a sample",
                            Real(reach_.step), ConstantRole::motor_reach);
  }
  ExpressionId divide(ExpressionId above, ExpressionId below) {
    return law_.expressions.add({Operation::divide, {above, below}});
  }

  bool is_static_product(const Expression& e) const {
    if (e.operation != Operation::multiply) return false;
    const Expression& factor = law_.expressions[e.operands[0]];
    return factor.operation == Operation::constant &&
           law_.coefficients[factor.coefficient].role == ConstantRole::static_stiffness;
  }

  bool has_static_spring() const {
    bool found = false;
    for (const Statement& statement : law_.output)
      each_expression(law_, statement.value, [&](const Expression& e) { found |= is_static_product(e); });
    return found;
  }

  // k0 x becomes k0 (x − r).
  ExpressionId loosened(ExpressionId id) {
    const Expression e = law_.expressions[id];
    Expression changed = e;
    for (std::size_t i = 0; i < facts_of(e.operation).operands; ++i) changed.operands[i] = loosened(e.operands[i]);
    if (is_static_product(e)) changed.operands[1] = writer_.subtract(changed.operands[1], writer_.read(shift_now_));
    return changed.operands == e.operands ? id : law_.expressions.add(changed);
  }

  void loosen_static_spring() {
    if (!has_static_spring()) return;
    shift_ = writer_.scalar("rest_shift", writer_.length(), "r, rest position of the static spring", Role::state);
    shift_now_ = shift_;
    std::vector<Statement> opening;
    if (!law_.surface_at) open_port(opening);
    for (Statement& statement : law_.output) statement.value = loosened(statement.value);
    law_.output.insert(after_map(), opening.begin(), opening.end());
    for (Statement& statement : law_.energy) statement.value = loosened_energy(statement.value);
  }

  // The first statement after a static curve's map: from there on w is known, which the springs follow.
  std::vector<Statement>::iterator after_map() {
    if (law_.mapped == no_variable) return law_.output.begin();
    return std::next(std::find_if(law_.output.begin(), law_.output.end(),
                                  [&](const Statement& s) { return s.target == law_.mapped; }));
  }

  // The median of 0, r and u.
  void open_port(std::vector<Statement>& opening) {
    shift_now_ = writer_.scalar("rest_shift_now", writer_.length(), "r", Role::local);
    const auto shift = [&] { return writer_.read(shift_); };
    const auto tool = [&] { return writer_.read(law_.moved()); };
    const ExpressionId least = writer_.where(writer_.subtract(shift(), tool()), tool(), shift());
    const ExpressionId most = writer_.where(writer_.subtract(shift(), tool()), shift(), tool());
    writer_.assign(opening, shift_now_,
                   writer_.where(shift(), writer_.where(tool(), least, none()), writer_.where(tool(), none(), most)),
                   "r: the median of 0, r and u");
  }

  ExpressionId none() {
    return writer_.constant("no_shift", writer_.length(), "no shift", 0, ConstantRole::motor_reach);
  }

  ExpressionId loosened_energy(ExpressionId id) {
    const Expression e = law_.expressions[id];
    if (e.operation == Operation::read && e.variable == law_.rest_position)
      return writer_.subtract(id, writer_.read(shift_));
    Expression changed = e;
    for (std::size_t i = 0; i < facts_of(e.operation).operands; ++i)
      changed.operands[i] = loosened_energy(e.operands[i]);
    return changed.operands == e.operands ? id : law_.expressions.add(changed);
  }

  void write_command() {
    const auto told = std::find_if(law_.output.begin(), law_.output.end(),
                                   [&](const Statement& s) { return s.target == law_.force; });
    law_.wanted = writer_.scalar("wanted", writer_.force(), "m before the motor's limits", Role::local);
    told->target = law_.wanted;
    reach_.step > 0 ? write_within_step() : write_within_limit();
    share_ = writer_.scalar("share", "1", "share of all forces that is kept", Role::local);
    const ExpressionId wanted = writer_.read(law_.wanted), force = writer_.read(law_.force);
    ExpressionId kept = divide(force, wanted);
    if (reach_.step > 0) kept = writer_.where(writer_.multiply(force, wanted), kept, zero());
    const ExpressionId beyond = writer_.multiply(writer_.subtract(wanted, force), wanted);
    writer_.assign(law_.output, share_, writer_.where(beyond, kept, one()),
                   "share = m/wanted where wanted is beyond m, else 1");
  }

  void write_within_limit() {
    writer_.assign(law_.output, law_.force, writer_.clamp(writer_.read(law_.wanted), limit()),
                   "m within the motor's limit");
  }

  void write_within_step() {
    const VariableId last = writer_.scalar("last_command", writer_.force(),
                                           "m of the sample before, within the motor's limits", Role::state);
    const VariableId top =
        writer_.scalar("most", writer_.force(), "largest force that the motor can reach", Role::local);
    const VariableId bottom =
        writer_.scalar("least", writer_.force(), "smallest force that the motor can reach", Role::local);
    const auto within = [&](ExpressionId value) { return reach_.limit > 0 ? writer_.clamp(value, limit()) : value; };
    writer_.assign(law_.output, top, within(writer_.add(writer_.read(last), step())), "m₋ ± motor_step");
    writer_.assign(law_.output, bottom, within(writer_.subtract(writer_.read(last), step())), "");
    const auto read = [&](VariableId variable) { return writer_.read(variable); };
    const ExpressionId above =
        writer_.where(writer_.subtract(read(bottom), read(law_.wanted)), read(bottom), read(law_.wanted));
    writer_.assign(law_.output, law_.force,
                   writer_.where(writer_.subtract(read(law_.wanted), read(top)), read(top), above),
                   "m within the motor's limits");
    writer_.assign(law_.update, last, read(writer_.kept(law_.force)), "m₋ = m");
    unscaled_.insert(last);
  }

  void shed_by_states() {
    law_.share = writer_.kept(share_);
    keep_spring();
    shrink_states();
  }

  // r ← r + (1 − share) (x − r), where x is the position of tool or surface
  void keep_spring() {
    if (shift_ == no_variable) return;
    const VariableId at = law_.surface_at ? local("surface_now") : law_.moved();
    const VariableId next = writer_.scalar("next_rest_shift", writer_.length(), "r", Role::local);
    const ExpressionId spread = writer_.subtract(writer_.read(at), writer_.read(shift_now_));
    const ExpressionId let_go = writer_.subtract(one(), writer_.read(share_));
    writer_.assign(law_.output, next, writer_.add(writer_.read(shift_now_), writer_.multiply(let_go, spread)),
                   law_.surface_at ? "r ← s − share (s − r)" : "r ← u − share (u − r)");
    const ExpressionId kept = writer_.read(writer_.kept(next));
    if (!law_.surface_at) return writer_.assign(law_.update, shift_, kept, "");
    const ExpressionId back = writer_.read(writer_.kept(returned(next)));
    writer_.assign(law_.update, shift_, writer_.subtract(kept, back), "");
    for (Statement& statement : law_.update)
      if (statement.target == law_.rest_position) statement.value = writer_.subtract(statement.value, back);
  }

  // Surface and r follow a tool that has left, until r is 0; what lies between them keeps its length.
  VariableId returned(VariableId shift) {
    const VariableId gap = local("gap");
    const VariableId back =
        writer_.scalar("returned", writer_.length(), "how far the surface follows a tool that has left", Role::local);
    const ExpressionId further = writer_.subtract(writer_.read(shift), writer_.read(gap));
    const ExpressionId least = writer_.where(further, writer_.read(gap), writer_.read(shift));
    writer_.assign(law_.output, back, writer_.where(writer_.read(gap), least, none()), "the smaller of gap and r");
    return back;
  }

  VariableId local(const char* name) const {
    for (const Variable& variable : law_.variables)
      if (variable.role == Role::local && variable.name == name) return law_.variables.id_of(variable);
    throw std::logic_error("shedding: a contact without a surface");
  }

  // Scales each force where the update assigns it. A sum of forces that are scaled already is not scaled again.
  void shrink_states() {
    std::set<VariableId> shrunk;
    for (Statement& statement : law_.update) {
      const Variable& target = law_.variables[statement.target];
      if (target.role != Role::state || target.unit != writer_.force() || unscaled_.count(statement.target) > 0)
        continue;
      bool is_sum = false, is_own = false;
      each_read(law_, statement,
                [&](VariableId read) { (shrunk.count(read) > 0 ? is_sum : is_own) |= is_force(read); });
      if (is_sum && is_own) throw std::logic_error("shedding: a sum of forces before and after");
      if (!is_sum) statement.value = writer_.multiply(statement.value, writer_.read(law_.share));
      shrunk.insert(statement.target);
    }
  }

  bool is_force(VariableId id) const { return law_.variables[id].unit == writer_.force(); }

  UpdateLaw law_;
  LawWriter writer_;
  MotorReach reach_;
  VariableId share_ = no_variable;
  VariableId shift_ = no_variable, shift_now_ = no_variable;
  std::set<VariableId> unscaled_;
};

}  // namespace

UpdateLaw with_shedding(UpdateLaw law, const MotorReach& reach, motion port_motion) {
  return Shedding(std::move(law), reach, port_motion).result();
}

UpdateLaw told_of_motor(UpdateLaw law, const MotorReach& reach) {
  if (!law.tunable) return law;
  law.tunable->head.motor_limit = reach.limit;
  law.tunable->head.motor_step = reach.step;
  return without_unread_locals(with_programs(std::move(law)));
}

}  // namespace dashpot::compiler
