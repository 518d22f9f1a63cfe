#include "lower/drop_unread.hpp"

#include <set>

#include "law/check_law.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {

namespace {

// False if nothing was left to drop. After a drop, locals that only the dropped statement read are unread too.
bool drop_once(UpdateLaw& law) {
  std::set<VariableId> read = {law.force, law.checked(), law.stored};
  if (law.brake_changes()) read.insert(law.brake);
  if (law.joints)
    for (const auto* commands : {&law.joints->dampings, &law.joints->torques})
      read.insert(commands->begin(), commands->end());
  const auto add_reads = [&](const std::vector<Statement>& program) {
    for (const Statement& statement : program) each_read(law, statement, [&](VariableId id) { read.insert(id); });
  };
  for (const std::vector<Statement>* program : programs(law)) add_reads(*program);
  add_reads(law.rest);
  each_solved(law, [&](SolvedSlips& solved) {
    for (auto* found : {&solved.moved, &solved.sign})
      for (VariableId& id : *found)
        if (read.count(id) == 0) id = no_variable;
  });
  std::size_t dropped = 0;
  for (auto* program : {&law.output, &law.update, &law.energy, &law.tune, &law.carry, &law.rest})
    dropped += std::erase_if(*program, [&](const Statement& statement) {
      return law.variables[statement.target].role == Role::local && read.count(statement.target) == 0;
    });
  return dropped > 0;
}

}  // namespace

UpdateLaw without_unread_locals(UpdateLaw law) {
  while (drop_once(law)) continue;
  check_law(law, "dropping what is unread");
  return law;
}

}  // namespace dashpot::compiler
