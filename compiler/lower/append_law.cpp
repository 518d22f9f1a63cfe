#include "lower/append_law.hpp"

#include <algorithm>
#include <set>

#include "law/walk.hpp"
#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

class Appending {
 public:
  Appending(LawWriter& writer, const std::string& name, const UpdateLaw& own,
            const std::map<VariableId, VariableId>& known)
      : writer_(writer), law_(writer.law()), name_(name), own_(own) {
    result_.place = known;
  }

  AppendedLaw result() {
    append_tables();
    result_.output = program(own_.output);
    result_.keep = program(own_.keep);
    result_.update = program(own_.update);
    result_.energy = program(own_.energy);
    result_.start = program(own_.start);
    for (GuardInTurn guard : own_.guards) {
      guard.state = result_.at(guard.state);
      guard.name = writer_.unique(joined(name_, guard.name));
      result_.guards.push_back(std::move(guard));
    }
    law_.mode_form = std::max(law_.mode_form, own_.mode_form);
    law_.relative_error_bound = std::max(law_.relative_error_bound, own_.relative_error_bound);
    return std::move(result_);
  }

 private:
  bool is_left_out(VariableId id) const {
    return id == own_.last_brake && id != no_variable && !reads(own_, own_.output, id) && !reads(own_, own_.update, id);
  }

  template <class Entry>
  Entry renamed(Entry entry) {
    entry.name = writer_.unique(joined(name_, entry.name));
    if constexpr (requires { entry.element_names; })
      for (std::string& name : entry.element_names) name = writer_.unique(joined(name_, name));
    return entry;
  }

  void remember(const std::string& name, const std::string& own) { law_.names_in_ports[name] = {name_, own}; }

  Coefficient constant(const Coefficient& own) {
    Coefficient all = renamed(own);
    remember(all.name, own.name);
    for (std::size_t i = 0; i < own.element_names.size(); ++i) remember(all.element_names[i], own.element_names[i]);
    return all;
  }

  void append_tables() {
    std::set<VariableId> of_start;
    for (const Statement& s : own_.start) of_start.insert(s.target);
    std::map<std::string, std::string> names;
    for (const Variable& v : own_.variables) {
      const VariableId id = own_.variables.id_of(v);
      if (result_.place.count(id) > 0 || is_left_out(id)) continue;
      Variable added = v;
      // reset() is a function of its own, so its locals may have the names of locals of output().
      if (of_start.count(id) > 0 && names.count(v.name) > 0) added.name = names.at(v.name);
      else added = renamed(v), names.emplace(v.name, added.name);
      if (added.role == Role::input) added.role = Role::local;
      result_.place[id] = law_.variables.add(std::move(added));
    }
    const std::size_t coefficients = law_.coefficients.size();
    expressions_ = law_.expressions.size(), couplings_ = law_.couplings.size(), networks_ = law_.networks.size();
    for (const Coefficient& c : own_.coefficients) law_.coefficients.add(constant(c));
    for (Expression e : own_.expressions) {
      for (std::size_t i = 0; i < operands(e).size(); ++i)
        e.operands[i] = ExpressionId(e.operands[i].place() + expressions_);
      if (!e.variable.is_nothing()) e.variable = is_left_out(e.variable) ? no_variable : result_.at(e.variable);
      if (!e.coefficient.is_nothing()) e.coefficient = CoefficientId(e.coefficient.place() + coefficients);
      law_.expressions.add(e);
    }
    for (Coupling coupling : own_.couplings) {
      move(static_cast<SolvedSlips&>(coupling));
      const std::string own = coupling.name;
      remember(law_.couplings[law_.couplings.add(renamed(std::move(coupling)))].name, own);
    }
    for (SlipNetwork network : own_.networks) {
      move(static_cast<SolvedSlips&>(network));
      move(network.last_sign);
      const std::string own = network.name;
      const SlipNetworkId id = law_.networks.add(renamed(std::move(network)));
      for (const char* table : tables_of_slip_network) remember(law_.networks[id].name + table, own + table);
    }
  }

  void move(std::vector<VariableId>& ids) const {
    for (VariableId& id : ids) id = result_.at(id);
  }
  void move(SolvedSlips& solved) const {
    for (auto* ids : {&solved.held, &solved.moved, &solved.sign}) move(*ids);
    solved.surface = result_.at(solved.surface);
  }

  std::vector<Statement> program(const std::vector<Statement>& statements) const {
    std::vector<Statement> moved;
    for (Statement s : statements) {
      if (is_left_out(s.target)) continue;
      s.target = result_.at(s.target);
      s.value = ExpressionId(s.value.place() + expressions_);
      s.origins.clear();
      match(
          s.step, [](Assign&) {},
          [&](SolveTree& tree) { tree.coupling = CouplingId(tree.coupling.place() + couplings_); },
          [&](SolveNetwork& net) { net.network = SlipNetworkId(net.network.place() + networks_); });
      moved.push_back(std::move(s));
    }
    return moved;
  }

  LawWriter& writer_;
  UpdateLaw& law_;
  const std::string& name_;
  const UpdateLaw& own_;
  std::size_t expressions_ = 0, couplings_ = 0, networks_ = 0;
  AppendedLaw result_;
};

}  // namespace

AppendedLaw append_law(LawWriter& writer, const std::string& name, const UpdateLaw& own,
                       const std::map<VariableId, VariableId>& known) {
  return Appending(writer, name, own, known).result();
}

}  // namespace dashpot::compiler
