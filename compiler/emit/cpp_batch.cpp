#include "emit/cpp_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/cpp_slips.hpp"
#include "emit/tunable_fields.hpp"
#include "law/expression_text.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

class BatchPrinter {
 public:
  explicit BatchPrinter(const UpdateLaw& law) : law_(law) { find_states(); }

  CppBatch print() {
    CppBatch batch;
    std::vector<Statement> update = law_.keep;
    update.insert(update.end(), law_.update.begin(), law_.update.end());
    update = needed_of(update);
    batch.output = lines_of(output_for(update));
    batch.update = lines_of(update);
    batch.energy = lines_of(law_.energy);
    batch.loads = loads();
    batch.loaded = batch.loads.size();
    for (const Statement* sum : derived_)
      append(batch.loads, fmt::format("const vector {} = {};", name(sum->target, 0), expression(sum->value, 0)),
             sum->purpose);
    batch.energy_loads = energy_loads();
    batch.commands = commands();
    const std::set<VariableId> changed = assigned_by({&law_.keep, &law_.update});
    batch.reset = lines_of_point(law_.start);
    each_state([&](VariableId id, const std::string& state, std::size_t number) {
      batch.states = number + 1;
      if (law_.variables[id].role == Role::state)
        batch.reset.push_back(fmt::format("put(state, {}, {});", number, rest_value(id)));
      if (changed.count(id) == 0) return;
      ++batch.stored;
      batch.stores.push_back(
          fmt::format("vector::put(state, {0} * block, vector::where(sampled, {1}, vector::at(state, {0} * block)));",
                      number, state));
    });
    for (std::string& line : lines_of_point(law_.rest)) batch.reset.push_back(std::move(line));
    batch.headers = headers_of(law_);
    if (!has_loops(law_)) batch.headers.push_back("dashpot/vector.hpp");
    batch.constants = constants();
    if (law_.tunable) append_set(batch);
    return batch;
  }

 private:
  // A state is a variable that is read before it is assigned, or that the energy reads. A sum of other states is no
  // state: adding it up again is as fast as fetching it from memory.
  void find_states() {
    std::set<VariableId> assigned;
    for (const auto* program : {&law_.output, &law_.keep, &law_.update}) find_reads(*program, assigned, kept_);
    for (const auto* program : {&law_.energy, &law_.rest})
      for (const Statement& statement : *program) find_reads(statement, {}, kept_);
    std::set<VariableId> tuned;
    find_reads(set_program(law_), tuned, kept_);
    for (const Tunable& parameter : law_.parameters()) kept_.insert(parameter.value);
    if (law_.last_brake != no_variable) kept_.insert(law_.last_brake);
    for (const Statement& statement : law_.update)
      if (law_.expressions[statement.value].operation == Operation::sum && kept_.erase(statement.target) != 0)
        derived_.push_back(&statement);
  }

  // States that the statement reads, but for those that are `assigned`.
  void find_reads(const Statement& statement, const std::set<VariableId>& assigned, std::set<VariableId>& found) const {
    each_read(law_, statement, [&](VariableId read) {
      if (law_.variables[read].is_kept() && assigned.count(read) == 0) found.insert(read);
    });
  }

  // The same of a program, whose own assignments come to those that are there.
  void find_reads(const std::vector<Statement>& program, std::set<VariableId>& assigned,
                  std::set<VariableId>& found) const {
    for (const Statement& statement : program) {
      find_reads(statement, assigned, found);
      each_assigned(law_, statement, [&](VariableId id) { assigned.insert(id); });
    }
  }

  // The statements of a program that the kept states, and the values that reset() gives, depend on.
  std::vector<Statement> needed_of(const std::vector<Statement>& program) const {
    std::set<VariableId> wanted = kept_;
    wanted.insert(law_.started_at);
    for (const PortStart& start : law_.starts) wanted.insert(start.value);
    return needed_for(std::move(wanted), program);
  }

  // The statements of the output that the command, `update` and the energy depend on. What only the single class
  // remembers is left out.
  std::vector<Statement> output_for(const std::vector<Statement>& update) const {
    std::set<VariableId> wanted = kept_;
    for (const VariableId given : {law_.force, law_.brake, law_.last_brake, law_.checked()}) wanted.insert(given);
    for (const auto* reader : {&update, &law_.energy})
      for (const Statement& statement : *reader)
        each_read(law_, statement, [&](VariableId read) { wanted.insert(read); });
    return needed_for(std::move(wanted), law_.output);
  }

  std::vector<Statement> needed_for(std::set<VariableId> wanted, const std::vector<Statement>& program) const {
    std::vector<Statement> needed;
    for (auto statement = program.rbegin(); statement != program.rend(); ++statement) {
      bool is_needed = false;
      each_assigned(law_, *statement, [&](VariableId found) { is_needed |= wanted.count(found) != 0; });
      if (!is_needed) continue;
      each_read(law_, *statement, [&](VariableId read) { wanted.insert(read); });
      needed.insert(needed.begin(), *statement);
    }
    return needed;
  }

  std::set<VariableId> assigned_by(std::initializer_list<const std::vector<Statement>*> programs) const {
    std::set<VariableId> assigned;
    for (const std::vector<Statement>* program : programs)
      for (const Statement& statement : *program)
        each_assigned(law_, statement, [&](VariableId id) { assigned.insert(id); });
    return assigned;
  }

  // A program of one point between samples, in scalars: what it reads is fetched and what it assigns put back.
  std::vector<std::string> lines_of_point(const std::vector<Statement>& whole, bool sets_parameters = false) {
    const std::vector<Statement> program = needed_of(whole);
    std::set<VariableId> read, assigned;
    find_reads(program, assigned, read);
    std::vector<std::string> lines, stores;
    const std::vector<Tunable> parameters = law_.parameters();
    each_state([&](VariableId id, const std::string& state, std::size_t number) {
      const bool is_parameter = sets_parameters && std::any_of(parameters.begin(), parameters.end(),
                                                               [id](const Tunable& t) { return t.value == id; });
      const bool is_assigned = assigned.count(id) != 0 || is_parameter;
      if (read.count(id) != 0 || is_assigned)
        lines.push_back(fmt::format("{}scalar {} = state[{} * block];", is_assigned ? "" : "const ", state, number));
      if (is_assigned) stores.push_back(fmt::format("put(state, {}, {});", number, state));
    });
    if (sets_parameters) append_taken_values(lines);
    for (std::string& line : lines_of(program, Language::cpp)) lines.push_back(std::move(line));
    lines.insert(lines.end(), stores.begin(), stores.end());
    return lines;
  }

  // The parameters become `wanted`, and `clamped` tells which of them could not.
  void append_taken_values(std::vector<std::string>& lines) const {
    lines.push_back("unsigned clamped = 0;");
    for (const Fields& tunable : tunable_fields(law_, law_.scalar))
      lines.push_back(fmt::format("clamped |= dashpot::take_value(tunables[{0}], wanted.{1}, {2}) << {0};",
                                  tunable.at("index"), tunable.at("tunable"), tunable.at("scalar_variable")));
  }

  // Every point has parameters of its own, in the storage.
  void append_set(CppBatch& batch) {
    const std::vector<std::string> begin = {
        "// All points get the initial values of the parameters.",
        "void begin() noexcept {",
        "  for (long long point = 0; point < points_; ++point) {",
        "    for (int number = 0; number < states; ++number) put(state_of(point), number, 0);",
        "    set(point, {});",
        "  }",
        "}",
        ""};
    batch.constants.insert(batch.constants.begin(), begin.begin(), begin.end());
    batch.set = {
        "// For one point. Call this right after step(), and take the commands from output() of the same samples: in a",
        "// loop that is not late the motor then holds the old force no longer, and a spring that changes injects no",
        "// energy. Bit i of the result: parameter i was beyond its range and is now at its bound, or it was NaN and",
        "// has not changed.",
        "unsigned set(long long point, const parameters& wanted) noexcept {",
        "  scalar* const state = state_of(point);"};
    for (const std::string& line : lines_of_point(set_program(law_), true)) batch.set.push_back("  " + line);
    for (const char* line : {"  return clamped;", "}", ""}) batch.set.push_back(line);
  }

  // With the number of each in the storage.
  template <class Visit>
  void each_state(Visit visit) const {
    std::size_t number = 0;
    for (VariableId id : kept_)
      for (std::size_t place = 0; place < law_.variables[id].size; ++place) visit(id, name(id, place), number++);
  }

  std::vector<std::string> loads() const {
    std::vector<std::string> lines;
    std::set<VariableId> read = assigned_by({&law_.keep, &law_.update}), assigned;
    if (law_.last_brake != no_variable) read.insert(law_.last_brake);
    for (const auto* program : {&law_.output, &law_.keep, &law_.update}) find_reads(*program, assigned, read);
    each_state([&](VariableId id, const std::string& state, std::size_t number) {
      if (read.count(id) == 0) return;
      const Variable& variable = law_.variables[id];
      lines.push_back(fmt::format("vector {} = vector::at(state, {} * block);  // {} [{}]", state, number,
                                  variable.meaning, variable.unit));
    });
    return lines;
  }

  std::vector<std::string> energy_loads() const {
    std::set<VariableId> read;
    for (const Statement& statement : law_.energy) find_reads(statement, {}, read);
    std::vector<std::string> lines;
    each_state([&](VariableId id, const std::string& state, std::size_t number) {
      if (read.count(id) != 0)
        lines.push_back(fmt::format("const vector {} = vector::at(state, {} * block);", state, number));
    });
    return lines;
  }

  std::vector<std::string> lines_of(const std::vector<Statement>& program, Language language = Language::vectors) {
    const std::string type = language == Language::vectors ? "const vector " : "const scalar ";
    std::vector<std::string> lines;
    for (const Statement& statement : program) {
      const Variable& target = law_.variables[statement.target];
      if (!statement.purpose.empty()) lines.push_back("// " + statement.purpose);
      if (!statement.assigns()) {
        append_solver(statement, lines);
        continue;
      }
      const std::string declared = kept_.count(statement.target) != 0 ? "" : type;
      for (std::size_t place = 0; place < target.size; ++place)
        append(lines, fmt::format("{}{} = {};", declared, name(statement.target, place),
                                  expression(statement.value, place, language)));
    }
    return lines;
  }

  // Solvers take one point after the other: how many steps each takes depends on its values.
  void append_solver(const Statement& statement, std::vector<std::string>& lines) {
    each_assigned(law_, statement, [&](VariableId found) {
      if (kept_.count(found) == 0) lines.push_back(fmt::format("vector {};", name(found, 0)));
    });
    const std::string given = name(statement.target, 0) + "_given";
    append(lines, fmt::format("const vector {} = {};", given, expression(statement.value, 0)));
    SolverWords words;
    words.read = [this](VariableId id) { return name(id, 0) + "[lane]"; };
    words.assignment = [this](VariableId id, const std::string& value) {
      return fmt::format("{}.put(lane, {});", name(id, 0), value);
    };
    words.given = given + "[lane]";
    words.makes_tables = true;
    std::vector<std::string> of_one;
    append_step(law_, statement, words, of_one);
    lines.push_back("for (int lane = 0; lane < vector::width; ++lane) {");
    for (const std::string& line : of_one) lines.push_back("  " + line);
    lines.push_back("}");
  }

  std::vector<std::string> commands() const {
    std::vector<std::string> lines;
    if (law_.brake_changes())
      lines.push_back(fmt::format("vector::put(dampings, point, vector::where(sampled, {}, {}));", name(law_.brake, 0),
                                  name(law_.last_brake, 0)));
    lines.push_back("vector::put(forces, point, vector::where(sampled, force, scalar(0)));");
    return lines;
  }

  std::string name(VariableId id, std::size_t place) const {
    const Variable& variable = law_.variables[id];
    return (variable.element_names.empty() ? variable.name : variable.element_names[place]) +
           (variable.is_kept() ? "_" : "");
  }

  std::string expression(ExpressionId id, std::size_t place, Language language = Language::vectors) {
    Spelling spelling;
    spelling.language = language;
    spelling.variable = [&](VariableId variable) {
      return name(variable, law_.variables[variable].size == 1 ? 0 : place);
    };
    spelling.coefficient = [&](CoefficientId constant) {
      const Coefficient& c = law_.coefficients[constant];
      return c.element_names.empty() ? c.name : c.element_names[place];
    };
    spelling.sum = [this](VariableId vector) { return "(" + sum_text(vector) + ")"; };
    return expression_text(law_, id, spelling);
  }

  // In the order of the single class, whose rolled loops begin every lane at 0.
  std::string sum_text(VariableId summed) const {
    const Variable& vector = law_.variables[summed];
    const std::size_t lanes = vector.lanes.count;
    std::vector<std::string> parts(lanes, lanes > 1 ? "vector(0)" : "");
    for (std::size_t place = 0; place < vector.size; ++place) {
      std::string& part = parts[place % lanes];
      part += (part.empty() ? "" : " + ") + name(summed, place);
    }
    for (std::size_t half = lanes / 2; half > 0; half /= 2)
      for (std::size_t i = 0; i < half; ++i) parts[i] = "(" + parts[i] + ") + (" + parts[i + half] + ")";
    return parts.front();
  }

  // The position that is put in is finite.
  std::string rest_value(VariableId state) const {
    const VariableId start = law_.start_of(state);
    if (start == no_variable) return cpp_literal(law_.variables[state].rest_value, law_.scalar);
    if (start == law_.position) return "position";
    return fmt::format("dashpot::all_finite({0}) ? {0} : scalar(0)", name(start, 0));
  }

  std::vector<std::string> constants() const {
    std::vector<std::string> lines;
    if (uses(law_, Operation::flush) || uses(law_, Operation::relax))
      lines.push_back(
          fmt::format("static constexpr scalar threshold = {};  // smaller forces become zero: no state is subnormal",
                      cpp_literal(law_.flush_threshold, law_.scalar)));
    for (CoefficientId read : constants_read(law_))
      append_constant_of_each(law_.coefficients[read], law_.scalar, lines);
    append_constant_tables(law_, lines);
    return lines;
  }

  const UpdateLaw& law_;
  std::set<VariableId> kept_;
  std::vector<const Statement*> derived_;
};

}  // namespace

CppBatch cpp_batch(const UpdateLaw& law) {
  if (!law.guards.empty()) throw std::logic_error("many points of a law whose guards take turns");
  return BatchPrinter(law).print();
}

}  // namespace dashpot::compiler
