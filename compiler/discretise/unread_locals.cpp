#include "discretise/unread_locals.hpp"

namespace dashpot::compiler {
namespace {

void mark_read(const UpdateLaw& law, ExpressionId id, std::vector<bool>& read) {
  const Expression& e = law.expressions[id];
  if (e.operation == Operation::read) read[e.left] = true;
  if (e.operation == Operation::read || e.operation == Operation::constant) return;
  if (e.operation == Operation::pick) return mark_read(law, e.right, read);
  mark_read(law, e.left, read);
  if (e.operation == Operation::flush || e.operation == Operation::sum) return;
  mark_read(law, e.right, read);
  if (e.operation == Operation::where) mark_read(law, e.condition, read);
}

}  // namespace

void drop_unread_locals(UpdateLaw& law) {
  std::vector<bool> read(law.variables.size(), false);
  read[law.force] = read[law.stored] = true;
  if (law.brake_changes()) read[law.brake] = true;
  for (const auto* program : {&law.output, &law.keep, &law.update, &law.energy})
    for (const Statement& statement : *program) mark_read(law, statement.value, read);
  for (const Coupling& coupling : law.couplings)
    for (VariableId held : coupling.held)
      if (held != no_variable) read[held] = true;
  for (const SlipNetwork& network : law.networks)
    for (VariableId held : network.held)
      if (held != no_variable) read[held] = true;
  for (SlipNetwork& network : law.networks)
    for (VariableId& moved : network.moved)
      if (!read[moved]) moved = no_variable;
  for (Coupling& coupling : law.couplings)
    for (VariableId& sign : coupling.sign)
      if (!read[sign]) sign = no_variable;
  for (auto* program : {&law.output, &law.update, &law.energy})
    std::erase_if(*program, [&](const Statement& statement) {
      return law.variables[statement.target].role == Role::local && !read[statement.target];
    });
}

}  // namespace dashpot::compiler
