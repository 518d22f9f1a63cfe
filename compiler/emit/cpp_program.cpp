#include "emit/cpp_program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/banner.hpp"
#include "emit/cpp_lines.hpp"
#include "emit/cpp_slips.hpp"
#include "emit/cpp_statements.hpp"
#include "law/walk.hpp"
#include "lower/fuse_step.hpp"

namespace dashpot::compiler {
namespace {

void append_array(const Coefficient& coefficient, ScalarType scalar, const std::string& alignment, std::size_t size,
                  std::vector<std::string>& lines) {
  std::string array = fmt::format("{}static constexpr scalar {}[{}] = {{", alignment, coefficient.name, size);
  for (std::size_t place = 0; place < coefficient.values.size(); ++place)
    array += (place == 0 ? "" : ", ") + cpp_literal(coefficient.values[place], scalar);
  lines.push_back(fmt::format("// {} [{}]", coefficient.meaning, coefficient.unit));
  append(lines, array + "};");
}

class CppPrinter {
 public:
  CppPrinter(const UpdateLaw& law, const Network& network, VectorRegisters registers, Timing timing)
      : law_(law),
        name_(network.name),
        bytes_(bytes_of(registers)),
        timing_(timing),
        statements_(law, network, timing),
        between_samples_(law, network, Timing::any) {}

  CppProgram print() {
    CppProgram program;
    program.headers = headers_of(law_);
    if (timing_ == Timing::constant) program.headers.insert(program.headers.begin(), "dashpot/branch_free.hpp");
    program.output = statements_.lines_of(law_.output);
    if (law_.joints) program.output.insert(program.output.begin(), joint_inputs());
    program.keep = statements_.kept_lines_of(law_.keep);
    program.update = statements_.lines_of(law_.guards);
    for (std::string& line : statements_.kept_lines_of(law_.update)) program.update.push_back(std::move(line));
    timing_ == Timing::constant ? check_by_masks(program) : check_and_return(program);
    program.step = timing_ == Timing::any && is_fusable(law_) ? fused(program) : two_phases();
    if (law_.joints && !is_fusable(law_))
      program.step.front() = "const dashpot::commands<scalar, axes, brakes> now = output(position, velocity);";
    program.energy = statements_.lines_of(law_.energy);
    for (auto* lines : {&program.update, &program.energy}) put_alias_before(*lines);
    put_alias_before(program.output, program.keep);
    program.set = between_samples_.lines_of(set_program(law_));
    append_tuning(law_, program.set);
    if (law_.sheds()) program.kept_share = name_of(law_.share);
    program.reset = reset();
    program.constants = constants();
    program.states = states();
    program.functions = functions();
    return program;
  }

 private:
  std::string name_of(VariableId id) const { return CppStatements::scalar_name(law_.variables[id]); }

  // Gives the caller's arguments the names that the law uses.
  std::string joint_inputs() const {
    std::string line;
    const auto append_inputs = [&](const std::vector<VariableId>& inputs, const char* array) {
      for (std::size_t i = 0; i < inputs.size(); ++i)
        line += fmt::format("{}{} = {}[{}]", line.empty() ? "const scalar " : ", ", name_of(inputs[i]), array, i);
    };
    append_inputs(law_.joints->positions, "position");
    append_inputs(law_.joints->velocities, "velocity");
    return line + ";";
  }

  // {{first, second}, {…}}
  std::string joint_command(const std::vector<VariableId>& dampings, const std::string& torques) const {
    return fmt::format("{{{}, {}}}", braced(dampings), torques);
  }
  std::string braced(const std::vector<VariableId>& variables) const {
    std::string text;
    for (const VariableId id : variables) text += (text.empty() ? "{" : ", ") + name_of(id);
    return text + "}";
  }

  void check_and_return(CppProgram& program) const {
    program.command = law_.joints            ? joint_command(law_.joints->dampings, braced(law_.joints->torques))
                      : law_.brake_changes() ? fmt::format("{{{}, {}}}", name_of(law_.brake), name_of(law_.force))
                                             : "{damping, force}";
    program.check = {"sampled_ = false;",
                     fmt::format("if (!dashpot::all_finite({})) return {};", checked_names(), safe_command()),
                     "sampled_ = true;"};
    program.wait = {"if (!sampled_) return;", "sampled_ = false;"};
  }

  std::string checked_names() const {
    std::string names;
    for (VariableId id : checked_numbers(law_)) names += (names.empty() ? "" : ", ") + name_of(id);
    return names;
  }

  std::string safe_command() const {
    if (law_.joints) return joint_command(law_.joints->last_dampings, "{}");
    return law_.brake_changes() ? fmt::format("{{{}, 0}}", name_of(law_.last_brake)) : "{damping, 0}";
  }

  static std::vector<std::string> two_phases() {
    return {"const dashpot::command<scalar> now = output(position, velocity);", "update();", "return now;"};
  }

  // Nothing is kept of a sample that is not finite: the previous values stay.
  void check_by_masks(CppProgram& program) const {
    program.check = {fmt::format("sampled_ = dashpot::all_finite(position, velocity, {});", name_of(law_.checked())),
                     "const auto sampled = dashpot::branch_free::mask_of<scalar>(sampled_);"};
    program.command = fmt::format("{{{}, dashpot::branch_free::chosen(sampled, force, scalar(0))}}",
                                  law_.brake_changes() ? name_of(law_.last_brake) : "damping");
    if (!program.update.empty())
      program.wait.push_back("const auto sampled = dashpot::branch_free::mask_of<scalar>(sampled_);");
    program.wait.push_back("sampled_ = false;");
  }

  // Where lines of one function have loops.
  void put_alias_before(std::vector<std::string>& lines, const std::vector<std::string>& more = {}) const {
    const auto uses_vectors = [](const std::string& line) { return line.find("vector::") != line.npos; };
    if (std::any_of(lines.begin(), lines.end(), uses_vectors) || std::any_of(more.begin(), more.end(), uses_vectors))
      lines.insert(lines.begin(),
                   fmt::format("using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, {}>{}>;",
                               lanes_of_loops(law_).count, bytes_ > 0 ? fmt::format(", {}", bytes_) : ""));
  }

  // update() uses the locals of output() at once. `sampled_` is cleared last: cleared earlier, it would delay the
  // states.
  std::vector<std::string> fused(const CppProgram& program) {
    const std::map<VariableId, VariableId> carried = carried_numbers(law_);
    std::vector<Statement> kept = law_.keep;
    std::erase_if(kept, [&](const Statement& statement) { return carried.count(statement.target) != 0; });
    std::vector<std::string> lines = program.output;
    const std::vector<std::string> check = {fmt::format("if (!dashpot::all_finite({})) {{", checked_names()),
                                            "  sampled_ = false;", fmt::format("  return {};", safe_command()), "}"};
    const std::vector<std::string> end = {"sampled_ = false;", fmt::format("return {};", program.command)};
    for (const auto& more : {check, statements_.lines_of(kept), statements_.lines_of(law_.update, carried), end})
      lines.insert(lines.end(), more.begin(), more.end());
    put_alias_before(lines);
    return lines;
  }

  std::vector<std::string> constants() const {
    std::vector<std::string> lines;
    if (!law_.brake_changes() && !law_.joints)
      lines.push_back(
          fmt::format("static constexpr scalar damping = {};  // b, the brake's part", literal(law_.damping)));
    if (uses(law_, Operation::flush) || uses(law_, Operation::relax) || !law_.guards.empty())
      lines.push_back(
          fmt::format("static constexpr scalar threshold = {};  // smaller forces become zero: no state is subnormal",
                      literal(law_.flush_threshold)));
    for (CoefficientId read : constants_read(law_)) append_constant(law_.coefficients[read], lines);
    append_constant_tables(law_, lines);
    return lines;
  }

  void append_constant(const Coefficient& coefficient, std::vector<std::string>& lines) const {
    if (!coefficient.is_rolled()) return append_constant_of_each(coefficient, law_.scalar, lines);
    append_array(coefficient, law_.scalar, alignment(), coefficient.lanes.padded(coefficient.values.size()), lines);
  }

  std::vector<std::string> reset() {
    std::vector<std::string> lines;
    const bool rests = law_.rest_position != no_variable;
    if (!rests && law_.starts.empty()) lines.push_back("static_cast<void>(position);");
    else lines = law_.joints ? joint_starts() : statements_.lines_of(law_.start);
    if (!law_.joints && !law_.start.empty())
      lines.insert(lines.begin(), "if (!dashpot::all_finite(position)) position = 0;");
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state || is_of_rest(law_.variables.id_of(variable))) continue;
      const VariableId start = law_.start_of(law_.variables.id_of(variable));
      if (start == law_.position)
        lines.push_back(CppStatements::scalar_name(variable) +
                        " = dashpot::all_finite(position, position, position) ? position : 0;");
      else if (start != no_variable)
        lines.push_back(fmt::format("{0} = dashpot::all_finite({1}) ? {1} : 0;", CppStatements::scalar_name(variable),
                                    name_of(start)));
      else if (variable.size == 1)
        lines.push_back(fmt::format("{} = {};", CppStatements::scalar_name(variable), rest_value(variable)));
      else if (variable.is_rolled()) lines.push_back(clearing(variable));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("{}_ = {};", name, rest_value(variable)));
    }
    for (const GuardInTurn& guard : law_.guards) lines.push_back(guard.name + "_ = 0;");
    for (std::string& line : between_samples_.lines_of(law_.rest)) lines.push_back(std::move(line));
    return lines;
  }

  bool is_of_rest(VariableId state) const {
    bool found = false;
    for (const Statement& statement : law_.rest)
      each_assigned(law_, statement, [&](VariableId assigned) { found |= assigned == state; });
    return found;
  }

  std::vector<std::string> joint_starts() {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < law_.joints->positions.size(); ++i)
      if (const VariableId joint = law_.joints->positions[i]; reads(law_, law_.start, joint))
        lines.push_back(fmt::format("const scalar {0} = dashpot::all_finite(position[{1}]) ? position[{1}] : 0;",
                                    name_of(joint), i));
    for (std::string& line : statements_.lines_of(law_.start)) lines.push_back(std::move(line));
    return lines;
  }

  std::string clearing(const Variable& variable) {
    uses_clear_ = true;
    return fmt::format("clear({}_);", variable.name);
  }

  // The last position comes last, away from the forces: a compiler stores neighbours as one vector, and a force would
  // then wait for its neighbour, and the next step for both.
  std::vector<const Variable*> states_in_order() const {
    std::vector<const Variable*> all;
    for (const Variable& variable : law_.variables)
      if (variable.is_kept()) all.push_back(&variable);
    if (law_.rest_position != no_variable)
      std::stable_partition(all.begin(), all.end(),
                            [&](const Variable* v) { return v != &law_.variables[law_.rest_position]; });
    return all;
  }

  std::vector<std::string> states() {
    std::vector<std::string> lines;
    for (const Variable* state : states_in_order()) {
      const Variable& variable = *state;
      const std::string note = fmt::format("  // {} [{}]", variable.meaning, variable.unit);
      if (variable.size == 1)
        lines.push_back(
            fmt::format("scalar {} = {};{}", CppStatements::scalar_name(variable), rest_value(variable), note));
      else if (variable.is_rolled())
        lines.push_back(fmt::format("{}scalar {}_[{}] = {{}};{}", alignment(), variable.name,
                                    variable.lanes.padded(variable.size), note));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("scalar {}_ = {};{}", name, rest_value(variable), note));
    }
    for (const GuardInTurn& guard : law_.guards)
      lines.push_back(fmt::format("int {}_ = 0;  // first place of {}_ that is guarded next", guard.name,
                                  law_.variables[guard.state].name));
    append_kept_tables(law_, lines);
    return lines;
  }

  std::vector<std::string> functions() const {
    std::vector<std::string> lines;
    if (uses_clear_)
      for (const char* line :
           {"// Through volatile: compilers turn a plain loop into a call of memset, which may not be there.",
            "template <unsigned size>", "static void clear(volatile scalar (&states)[size]) noexcept {",
            "  for (unsigned i = 0; i < size; ++i) states[i] = 0;", "}", ""})
        lines.push_back(line);
    return lines;
  }

  // A register that straddles two lines of the cache takes two reads.
  std::string alignment() const { return bytes_ > 0 ? fmt::format("alignas({}) ", bytes_) : ""; }

  std::string rest_value(const Variable& state) const {
    return state.rest_value == 0 ? "0" : literal(state.rest_value);
  }

  std::string literal(double value) const { return cpp_literal(value, law_.scalar); }

  const UpdateLaw& law_;
  std::string name_;
  std::size_t bytes_;  // of a register
  Timing timing_;
  CppStatements statements_;
  CppStatements between_samples_;  // of set() and reset(), whose time no sample waits for
  bool uses_clear_ = false;
};

}  // namespace

std::vector<std::string> headers_of(const UpdateLaw& law) {
  std::vector<std::string> headers = {"dashpot/command.hpp"};
  if (!law.networks.empty()) headers.push_back("dashpot/slip_network.hpp");
  if (uses(law, Operation::mean_decay)) headers.push_back("dashpot/exponential.hpp");
  if (uses(law, Operation::square_root)) headers.push_back("dashpot/elementary.hpp");
  if (!law.couplings.empty()) headers.push_back("dashpot/slip_tree.hpp");
  if (law.tunable) headers.push_back("dashpot/tunable_range.hpp");
  if (has_loops(law)) headers.push_back("dashpot/vector.hpp");
  return headers;
}

std::string cpp_literal(double value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? fmt::format("{:#}", value) : fmt::format("{:#}f", static_cast<float>(value));
}

CppProgram cpp_program(const UpdateLaw& law, const Network& network, VectorRegisters registers, Timing timing) {
  return CppPrinter(law, network, registers, timing).print();
}

void add_program(const CppProgram& program, CodeModel& model) {
  model.fields["command"] = program.command;
  for (const std::string& header : program.headers) model.lists["headers"].push_back({{"header", header}});
  model.lists["kept_share"];
  if (!program.kept_share.empty()) model.lists["kept_share"].push_back({{"share", program.kept_share}});
  model.lists["reset"] = as_list(program.reset);
  model.lists["output"] = as_list(program.output);
  model.lists["check"] = as_list(program.check);
  model.lists["keep"] = as_list(program.keep);
  model.lists["wait"] = as_list(program.wait);
  model.lists["update"] = as_list(program.update);
  model.lists["step"] = as_list(program.step);
  model.lists["energy"] = as_list(program.energy);
  model.lists["functions"] = as_list(program.functions);
  model.lists["constants"] = as_list(program.constants);
  model.lists["states"] = as_list(program.states);
}

void append_constant_of_each(const Coefficient& coefficient, ScalarType scalar, std::vector<std::string>& lines) {
  if (coefficient.is_table()) return append_array(coefficient, scalar, "", coefficient.values.size(), lines);
  const std::vector<std::string> lone = {coefficient.name};
  const std::vector<std::string>& names = coefficient.element_names.empty() ? lone : coefficient.element_names;
  for (std::size_t place = 0; place < coefficient.values.size(); ++place)
    lines.push_back(fmt::format("static constexpr scalar {} = {};  // {} [{}]", names[place],
                                cpp_literal(coefficient.values[place], scalar), coefficient.meaning, coefficient.unit));
}

}  // namespace dashpot::compiler
