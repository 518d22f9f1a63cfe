#include "emit/c99_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "certify/state_box.hpp"
#include "emit/banner.hpp"
#include "emit/c99_parts.hpp"
#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/slip_tables.hpp"
#include "law/expression_text.hpp"
#include "law/walk.hpp"
#include "lower/fuse_step.hpp"

namespace dashpot::compiler {
namespace {

using Lines = std::vector<std::string>;
using Program = std::vector<Statement>;

void append_all(Lines& lines, const Lines& more, const std::string& indentation = "") {
  for (const std::string& line : more) lines.push_back(indentation + line);
}

class C99Printer {
 public:
  C99Printer(const UpdateLaw& law, std::string name, const StateBox& box)
      : law_(law), box_(box), name_(std::move(name)), suffix_(law.scalar == ScalarType::float32 ? "f" : "") {}

  C99Program print() {
    C99Program program;
    program.before = before();
    program.states = states();
    program.bounds = bounds();
    program.begin = begin();
    program.reset = reset();
    program.output = output();
    program.update = update();
    program.set = set();
    program.energy = with_constants({&law_.energy}, lines_of(law_.energy));
    if (!reads_states(law_.energy)) program.energy.insert(program.energy.begin(), "(void)self;");
    if (law_.sheds()) program.kept_share = "self->" + law_.variables[law_.share].name;
    return program;
  }

 private:
  // A member of `command`, after a finite sample and after another.
  struct Answer {
    std::string member, value, safe;
  };

  // Of one axis in double, whatever the law computes in.
  std::vector<Answer> answers() const {
    std::vector<Answer> all;
    if (!law_.joints) {
      const std::string cast = law_.scalar == ScalarType::float32 ? "(double)" : "";
      const auto damping = [&](VariableId id) { return cast + (law_.brake_changes() ? name(id, 0) : "damping"); };
      return {{"damping", damping(law_.brake), damping(law_.last_brake)},
              {"force", cast + name(law_.force, 0), cast + number(0)}};
    }
    for (std::size_t i = 0; i < law_.joints->dampings.size(); ++i)
      all.push_back(
          {fmt::format("damping[{}]", i), name(law_.joints->dampings[i], 0), name(law_.joints->last_dampings[i], 0)});
    for (std::size_t i = 0; i < law_.joints->torques.size(); ++i)
      all.push_back({fmt::format("torque[{}]", i), name(law_.joints->torques[i], 0), number(0)});
    return all;
  }

  // The variables that must be finite for a sample to be kept.
  std::vector<VariableId> checked() const {
    if (law_.joints) return checked_numbers(law_);
    return {law_.position, law_.velocity, law_.checked()};
  }

  // Of arrays that hold them.
  Lines joint_inputs() const {
    Lines lines;
    if (!law_.joints) return lines;
    for (const auto& [inputs, array] :
         {std::pair(&law_.joints->positions, "position"), std::pair(&law_.joints->velocities, "velocity")})
      for (std::size_t i = 0; i < inputs->size(); ++i)
        lines.push_back(fmt::format("const {} {} = {}[{}];", scalar(), name((*inputs)[i], 0), array, i));
    return lines;
  }

  std::string finite(const std::string& a, const std::string& b, const std::string& c) const {
    return fmt::format("dashpot_all_finite{}({}, {}, {})", suffix_, a, b, c);
  }

  // A condition that all are finite, three at a time, the last repeated.
  std::string all_finite(const std::vector<VariableId>& variables) const {
    std::string text;
    const auto at = [&](std::size_t i) { return name(variables[std::min(i, variables.size() - 1)], 0); };
    for (std::size_t i = 0; i < variables.size(); i += 3)
      text += (text.empty() ? "" : " & ") + finite(at(i), at(i + 1), at(i + 2));
    return text;
  }

  std::string finite_or_zero(const std::string& number_there, const std::string& value) const {
    return fmt::format("({} != 0) ? {} : {}", finite(number_there, number_there, number_there), value, number(0));
  }

  // The parameters as in the file, what follows from them, and at rest at 0.
  Lines begin() {
    Lines lines;
    if (has_parameters()) lines.push_back("self->has_parameters = 0;");
    if (law_.joints)
      lines.push_back(fmt::format("const {} origin[{}] = {{0}};", scalar(), law_.joints->positions.size()));
    lines.push_back(fmt::format("{}_reset(self, {});", name_, law_.joints ? "origin" : "0"));
    return lines;
  }

  bool has_parameters() const { return !law_.parameters().empty(); }

  // A reset of a structure that is all zero begins with the parameters of the file too.
  Lines first_parameters() const {
    if (!has_parameters()) return {};
    Lines lines = {"if (self->has_parameters != 1) {  // as in the network's file"};
    for (const Variable& variable : law_.variables)
      if (variable.role == Role::tuned)
        lines.push_back(fmt::format("  self->{} = {};", variable.name, number(variable.rest_value)));
    append_all(lines, {"self->has_parameters = 1;"}, "  ");
    lines.push_back("}");
    return lines;
  }

  Lines set() { return with_constants({&law_.tune, &law_.carry}, lines_of(set_program(law_))); }

  // The statements of `output` alone read inputs; what is not finite is answered with the last safe command.
  Lines output() {
    Lines lines = joint_inputs();
    append_all(lines, lines_of(law_.output));
    append(lines, fmt::format("self->sampled = {};", all_finite(checked())));
    lines.push_back("if (self->sampled != 0) {");
    append_all(lines, lines_of(law_.keep), "  ");
    append_command(&Answer::value, lines);
    lines.push_back("} else {");
    append_command(&Answer::safe, lines);
    lines.push_back("}");
    Lines all = with_constants({&law_.output, &law_.keep}, std::move(lines));
    if (!law_.joints && !law_.brake_changes())
      all.insert(all.begin(),
                 fmt::format("const {} damping = {};  // b, the brake's part", scalar(), number(law_.damping)));
    return all;
  }

  void append_command(std::string Answer::*number_of, Lines& lines) const {
    for (const Answer& answer : answers())
      lines.push_back(fmt::format("  command.{} = {};", answer.member, answer.*number_of));
  }

  Lines update() {
    Lines lines;
    for (const GuardInTurn& guard : law_.guards) append_all(lines, turn(guard));
    append_all(lines, lines_of(law_.update));
    return with_constants({&law_.update}, std::move(lines), !law_.guards.empty());
  }

  Lines turn(const GuardInTurn& guard) const {
    const Variable& forces = law_.variables[guard.state];
    const std::string force = fmt::format("self->{}[j]", forces.name);
    return {fmt::format("// |F| below the threshold: F ← 0, of {} modes a sample in turn", guard.places),
            fmt::format("for (int j = self->{0}; (j < (self->{0} + {1})) && (j < {2}); ++j) {{", guard.name,
                        guard.places, forces.size),
            fmt::format("  {0} = dashpot_flush_below{1}(threshold, {0});", force, suffix_), "}",
            fmt::format("self->{0} = ((self->{0} + {1}) < {2}) ? (self->{0} + {1}) : 0;", guard.name, guard.places,
                        forces.lanes.padded(forces.size))};
  }

  // The constants that the programs read, before the lines.
  Lines with_constants(const std::vector<const Program*>& read, Lines lines, bool guards = false) const {
    std::set<CoefficientId> constants;
    for (const Program* program : read)
      for (const Statement& statement : *program)
        each_expression(law_, statement.value, [&](const Expression& e) {
          if (facts_of(e.operation).refers_to == Referent::coefficient) constants.insert(e.coefficient);
          guards |= facts_of(e.operation).guards > 0;
        });
    Lines all;
    if (guards)
      all.push_back(fmt::format("const {} threshold = {};  // smaller forces become zero: no state is subnormal",
                                scalar(), number(law_.flush_threshold)));
    for (CoefficientId id : constants) append_constant(law_.coefficients[id], all);
    append_all(all, lines);
    return all;
  }

  void append_constant(const Coefficient& c, Lines& lines) const {
    const std::string remark = fmt::format("{} [{}]", c.meaning, c.unit);
    if (c.is_table() || c.is_rolled()) {
      std::string table = fmt::format("static const {} {}[{}] = {{", scalar(), c.name, c.values.size());
      for (std::size_t place = 0; place < c.values.size(); ++place)
        table += (place == 0 ? "" : ", ") + number(c.values[place]);
      lines.push_back("// " + remark);
      return append(lines, table + "};");
    }
    for (std::size_t place = 0; place < c.values.size(); ++place)
      lines.push_back(
          fmt::format("const {} {} = {};  // {}", scalar(), name(c, place), number(c.values[place]), remark));
  }

  Lines lines_of(const Program& program) {
    Lines lines;
    for (std::size_t i = 0; i < program.size();) {
      const std::size_t size = law_.variables[program[i].target].size;
      if (!law_.variables[program[i].target].is_rolled()) {
        print_straight(program[i++], lines);
        continue;
      }
      const std::size_t first = i;
      while (i < program.size() && law_.variables[program[i].target].size == size) ++i;
      print_loop(program, first, i, lines);
    }
    return lines;
  }

  void print_straight(const Statement& statement, Lines& lines) {
    const Variable& target = law_.variables[statement.target];
    if (!statement.purpose.empty()) lines.push_back("// " + statement.purpose);
    if (visit_solved(law_, statement, [&](const auto& slips) { print_step(statement, slips, lines); })) return;
    for (place_ = 0; place_ < target.size; ++place_)
      append(lines, declaration(target) + name(statement.target, place_) + " = " + expression(statement.value) + ";");
  }

  // Slips that meet at inner nodes: the tables of the law, the step of templates/c99/.
  Lines before() const {
    C99Words words;
    words.name = name_;
    words.scalar = law_.scalar;
    words.has = {{"STEP", false}, {"PUSH", false}};
    for (const Coupling& coupling : law_.couplings) words.has[coupling.is_pushed() ? "PUSH" : "STEP"] = true;
    Lines lines;
    words.has["ROOTS"] = uses(law_, Operation::square_root);
    words.has["DECAYS"] = uses(law_, Operation::mean_decay);
    words.has["RANGES"] = law_.tunable.has_value();
    append_all(lines, c99_part("numbers.h", words));
    if (!law_.couplings.empty()) append_all(lines, c99_part("slip_tree.h", words));
    if (!law_.networks.empty()) append_all(lines, c99_part("slip_network.h", words));
    each_solved(law_, [&](const auto& slips) { append_tables_if(!is_tuned(slips), slips, lines); });
    return lines;
  }

  std::string number_or(double value, VariableId tuned) const {
    return tuned == no_variable ? number(value) : name(tuned, 0);
  }

  // Tables that parameters change are built for each step.
  template <class Slips>
  void append_tables_if(bool is_wanted, const Slips& slips, Lines& lines) const {
    if (!is_wanted) return;
    const TableWords words = {is_tuned(slips) ? "const " : "static const ",
                              std::string(scalar()),
                              name_ + "_node",
                              name_ + "_link",
                              name_ + "_",
                              [this](const std::string& table) { return name_ + "_" + table; },
                              [this](double value, VariableId tuned) { return number_or(value, tuned); }};
    append_tables(slips, words, lines);
    if (!is_tuned(slips)) lines.push_back("");
  }

  // The tables that parameters change, and the forces held.
  template <class Slips>
  void begin_step(const Slips& slips, Lines& lines) const {
    append_tables_if(is_tuned(slips), slips, lines);
    append(lines, fmt::format("const {} {}_held[{}] = {{{}}};", scalar(), slips.name, slips.held.size(),
                              held_forces(slips, number(0), [&](VariableId id) { return name(id, 0); })));
  }

  void take_results(const SolvedSlips& slips, const char* moved, Lines& lines) const {
    each_result_text(
        slips, moved, [&](const std::string& sign) { return fmt::format("({}){}", scalar(), sign); },
        [&](VariableId target, const std::string& value) {
          lines.push_back(declaration(law_.variables[target]) + name(target, 0) + " = " + value + ";");
        });
  }

  void print_step(const Statement& statement, const Coupling& coupling, Lines& lines) {
    begin_step(coupling, lines);
    const std::string& own = coupling.name;
    lines.push_back(fmt::format("{} {}_elongation[{}] = {{0}};", scalar(), own, coupling.moved.size()));
    lines.push_back(fmt::format("int {}_sign[{}] = {{0}};", own, coupling.slip_count()));
    lines.push_back(
        fmt::format("{}_part_state {}_parts[{}] = {{{{0, 0, 0, 0, 0, 0, 0, 0}}}};", name_, own, coupling.nodes.size()));
    lines.push_back(fmt::format("{0}_corner {1}_corners[{2}] = {{{{0, 0, 0}}}}, {1}_merged[{3}] = {{{{0, 0, 0}}}};",
                                name_, own, coupling.corners(), slip_curve_room(coupling.slip_count())));
    lines.push_back(fmt::format("const {0}_tree {1}_tree = {{{0}_{1}, {2}, {1}_parts, {1}_corners, {1}_merged}};",
                                name_, own, coupling.nodes.size()));
    if (coupling.is_pushed()) lines.push_back(fmt::format("{} {}_change = 0;", scalar(), own));
    append(lines, declaration(law_.variables[statement.target]) + name(statement.target, 0) +
                      fmt::format(" = {0}_tree_{1}(&{2}_tree, {3}, {2}_held, {2}_elongation, {2}_sign{4});", name_,
                                  coupling.is_pushed() ? "push" : "step", own, expression(statement.value),
                                  coupling.is_pushed() ? fmt::format(", &{}_change", own) : ""));
    take_results(coupling, "elongation", lines);
  }

  void print_step(const Statement& statement, const SlipNetwork& network, Lines& lines) {
    begin_step(network, lines);
    const std::string& own = network.name;
    std::string sign;
    for (VariableId id : network.last_sign) sign += (sign.empty() ? "(int)" : ", (int)") + name(id, 0);
    lines.push_back(fmt::format("{0} {1}_moved[{2}] = {{0}}, {1}_joined[{3}] = {{0}}, {1}_numbers[{4}] = {{0}};",
                                scalar(), own, network.node_count, network.node_count * network.node_count,
                                8 * network.node_count));
    append(lines, fmt::format("int {0}_group[{1}] = {{0}}, {0}_sign[{2}] = {{{3}}};", own, network.node_count + 2,
                              network.slip_count(), sign));
    lines.push_back(fmt::format("{}_network {};", name_, own));
    for (const auto& [member, value] : std::initializer_list<std::pair<const char*, std::string>>{
             {"links", fmt::format("{}_{}_links", name_, own)},
             {"slips", std::to_string(network.slip_count())},
             {"nodes", std::to_string(network.node_count)},
             {"between", fmt::format("{}_{}_between", name_, own)},
             {"to_tool", fmt::format("{}_{}_to_tool", name_, own)},
             {"to_ground", fmt::format("{}_{}_to_ground", name_, own)},
             {"through", number_or(network.through, network.tuned ? network.tuned->through : no_variable)},
             {"change", expression(statement.value)},
             {"held", own + "_held"},
             {"moved", own + "_moved"},
             {"sign", own + "_sign"},
             {"group", own + "_group"},
             {"joined", own + "_joined"}})
      lines.push_back(fmt::format("{}.{} = {};", own, member, value));
    append(lines, declaration(law_.variables[statement.target]) + name(statement.target, 0) +
                      fmt::format(" = {0}_network_step(&{1}, {1}_numbers);", name_, own));
    take_results(network, "moved", lines);
  }

  // Elementwise statements of vectors of one size, with the partial sums of those that are added up later.
  void print_loop(const Program& program, std::size_t first, std::size_t last, Lines& lines) {
    const std::size_t size = law_.variables[program[first].target].size;
    in_loop_.clear();
    for (std::size_t i = first; i < last; ++i)
      if (!outlives(program, first, last, program[i].target)) in_loop_.insert(program[i].target);
    for (std::size_t i = first; i < last; ++i) {
      const Variable& vector = law_.variables[program[i].target];
      if (vector.role == Role::local && in_loop_.count(program[i].target) == 0)
        lines.push_back(fmt::format("{} {}[{}];", scalar(), vector.name, size));
      if (is_summed(program[i].target))
        lines.push_back(fmt::format("{} {}_lane[{}] = {{{}}};", scalar(), vector.name, vector.lanes.count, number(0)));
    }
    lines.push_back(fmt::format("for (int j = 0; j < {}; ++j) {{", size));
    for (std::size_t i = first; i < last; ++i) {
      const Variable& target = law_.variables[program[i].target];
      const std::string declared = in_loop_.count(program[i].target) != 0 ? declaration(target) : "";
      append(lines, "  " + declared + name(program[i].target, 0) + " = " + expression(program[i].value) + ";",
             program[i].purpose);
    }
    for (std::size_t i = first; i < last; ++i) {
      const Variable& vector = law_.variables[program[i].target];
      if (is_summed(program[i].target))
        lines.push_back(
            fmt::format("  {}_lane[j % {}] += {};", vector.name, vector.lanes.count, name(program[i].target, 0)));
    }
    lines.push_back("}");
    for (std::size_t i = first; i < last; ++i)
      if (is_summed(program[i].target)) append_all(lines, joined_lanes(law_.variables[program[i].target]));
  }

  // The second half of the partial sums is added to the first until one is left.
  Lines joined_lanes(const Variable& vector) const {
    return {fmt::format("for (int half = {}; half > 0; half /= 2) {{", vector.lanes.count / 2),
            fmt::format("  for (int j = 0; j < half; ++j) {{ {0}_lane[j] += {0}_lane[j + half]; }}", vector.name), "}"};
  }

  // Whether a local is read elsewhere than in the loop that assigns it; sums apart, which have their lanes.
  bool outlives(const Program& program, std::size_t first, std::size_t last, VariableId id) const {
    if (law_.variables[id].role != Role::local) return true;
    bool found = false;
    for (const Program* other : programs(law_))
      for (std::size_t i = 0; i < other->size(); ++i) {
        if (other == &program && i >= first && i < last) continue;
        each_expression(law_, (*other)[i].value,
                        [&](const Expression& e) { found |= e.operation == Operation::read && e.variable == id; });
      }
    return found;
  }

  bool is_summed(VariableId id) const {
    bool found = false;
    for (const Program* program : programs(law_))
      for (const Statement& statement : *program)
        each_expression(law_, statement.value,
                        [&](const Expression& e) { found |= e.operation == Operation::sum && e.variable == id; });
    return found;
  }

  bool reads_states(const Program& program) const {
    bool found = false;
    for (const Statement& statement : program) {
      each_read(law_, statement, [&](VariableId id) { found |= law_.variables[id].is_kept(); });
    }
    return found;
  }

  std::string expression(ExpressionId id) const {
    Spelling spelling;
    spelling.language = Language::c99;
    spelling.suffix = suffix_;
    spelling.law = name_;
    spelling.variable = [this](VariableId variable) { return name(variable, place_); };
    spelling.coefficient = [this](CoefficientId constant) { return name(law_.coefficients[constant], place_); };
    // A sum is one operand: inside a longer expression its terms keep together.
    const bool is_whole = law_.expressions[id].operation == Operation::sum;
    spelling.sum = [this, is_whole](VariableId vector) { return sum(vector, is_whole); };
    return expression_text(law_, id, spelling);
  }

  std::string sum(VariableId id, bool is_whole) const {
    const Variable& vector = law_.variables[id];
    if (vector.is_rolled()) return vector.name + "_lane[0]";
    std::string text;
    for (std::size_t place = 0; place < vector.size; ++place) text += (place == 0 ? "" : " + ") + name(id, place);
    return vector.size == 1 || is_whole ? text : "(" + text + ")";
  }

  std::string name(VariableId id, std::size_t place) const {
    const Variable& variable = law_.variables[id];
    const std::string owner = variable.is_kept() ? "self->" : "";
    if (variable.is_rolled()) return owner + variable.name + (in_loop_.count(id) != 0 ? "" : "[j]");
    if (variable.element_names.empty()) return owner + variable.name;
    return owner + variable.element_names[variable.size == 1 ? 0 : place];
  }

  std::string name(const Coefficient& c, std::size_t place) const {
    if (c.element_names.empty()) return c.name;
    return c.is_rolled() ? c.name + "[j]" : c.element_names[c.values.size() == 1 ? 0 : place];
  }

  std::string declaration(const Variable& target) const {
    return target.role == Role::local ? fmt::format("const {} ", scalar()) : "";
  }

  Lines states() const {
    Lines lines;
    for (const Variable& variable : law_.variables) {
      if (!variable.is_kept()) continue;
      const std::string remark = fmt::format("{} [{}]", variable.meaning, variable.unit);
      if (variable.is_rolled()) {
        lines.push_back(fmt::format("{} {}[{}];  // {}", scalar(), variable.name, variable.size, remark));
        continue;
      }
      for (std::size_t place = 0; place < variable.size; ++place)
        lines.push_back(fmt::format("{} {};  // {}", scalar(), member(variable, place), remark));
    }
    for (const GuardInTurn& guard : law_.guards)
      lines.push_back(fmt::format("int {};  // first place of {} that is guarded next", guard.name,
                                  law_.variables[guard.state].name));
    if (has_parameters()) lines.push_back("int has_parameters;  // 1 once they are there: as in the file, or set");
    return lines;
  }

  // One comparison a line, joined by &&. A force with an error that is carried along is within where both together are:
  // the difference is exact where it is not far from them, and a sum has the right sign. What states differ by is
  // worked out in double.
  Lines bounds() const {
    std::map<int, Lines> by_depth;
    if (box_.empty()) return {};
    const std::map<std::string, std::string> members = members_by_state();
    const std::vector<CarriedError> carried = carried_errors(law_);
    for_each_state([&](const Variable& variable, std::size_t place) {
      const auto own = std::find_if(carried.begin(), carried.end(),
                                    [&](const CarriedError& c) { return c.force == law_.variables.id_of(variable); });
      const StateBounds& bound = box_.at(state_name(variable, place));
      const std::string there = members.at(state_name(variable, place));
      if (!bound.others.empty()) {
        std::string taken;
        for (const auto& [other, factor] : bound.others)
          taken += fmt::format("{}{:#} * (double){}", taken.empty() ? "" : " + ", factor, members.at(other));
        Lines& lines = by_depth[depth_of(bound)];
        lines.push_back(fmt::format("((double){} - ({}) >= {:#})", there, taken, bound.low));
        lines.push_back(fmt::format("((double){} - ({}) <= {:#})", there, taken, bound.high));
      } else if (own != carried.end()) {
        by_depth[0].push_back(fmt::format("(({0} - {1}) + {3} >= 0) && (({0} - {2}) + {3} <= 0)", there,
                                          number(bound.low), number(bound.high),
                                          members.at(state_name(law_.variables[own->error], place))));
      } else {
        by_depth[0].push_back(
            fmt::format("({0} >= {1}) && ({0} <= {2})", there, number(bound.low), number(bound.high)));
      }
    });
    Lines all;
    for (const auto& [depth, lines] : by_depth)
      for (const std::string& line : lines) all.push_back((all.empty() ? "" : "&& ") + line);
    return all;
  }

  // How many differences deep this bound is built on others.
  int depth_of(const StateBounds& bound) const {
    int depth = 0;
    for (const auto& [other, factor] : bound.others) depth = std::max(depth, 1 + depth_of(box_.at(other)));
    return depth;
  }

  template <class Action>
  void for_each_state(Action action) const {
    for (const Variable& variable : law_.variables)
      for (std::size_t place = 0; variable.role == Role::state && place < variable.size; ++place)
        action(variable, place);
  }

  std::map<std::string, std::string> members_by_state() const {
    std::map<std::string, std::string> members;
    for_each_state([&](const Variable& variable, std::size_t place) {
      members[state_name(variable, place)] =
          "self->" + (variable.is_rolled() ? fmt::format("{}[{}]", variable.name, place) : member(variable, place));
    });
    return members;
  }

  Lines reset() {
    Lines lines;
    if (law_.rest_position == no_variable && law_.starts.empty()) lines.push_back("(void)position;");
    else lines = finite_position();
    append_all(lines, lines_of(law_.start));
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state) continue;
      const std::string rest = rest_of(law_.variables.id_of(variable));
      if (variable.is_rolled())
        lines.push_back(
            fmt::format("for (int j = 0; j < {}; ++j) {{ self->{}[j] = {}; }}", variable.size, variable.name, rest));
      else
        for (std::size_t place = 0; place < variable.size; ++place)
          lines.push_back(fmt::format("self->{} = {};", member(variable, place), rest));
    }
    for (const GuardInTurn& guard : law_.guards) lines.push_back(fmt::format("self->{} = 0;", guard.name));
    append_all(lines, lines_of(law_.rest));
    Lines all = first_parameters();
    append_all(all, with_constants({&law_.start, &law_.rest}, std::move(lines)));
    return all;
  }

  // What states start at is worked out from it.
  Lines finite_position() const {
    Lines lines;
    if (law_.joints) {
      for (std::size_t i = 0; i < law_.joints->positions.size(); ++i)
        if (const VariableId joint = law_.joints->positions[i]; reads(law_, law_.start, joint)) {
          const std::string given = fmt::format("position[{}]", i);
          lines.push_back(fmt::format("const {} {} = {};", scalar(), name(joint, 0), finite_or_zero(given, given)));
        }
    } else if (!law_.start.empty()) {
      lines.push_back(fmt::format("position = {};", finite_or_zero("position", "position")));
    }
    return lines;
  }

  std::string rest_of(VariableId state) const {
    const VariableId start = law_.start_of(state);
    if (start == no_variable) return number(law_.variables[state].rest_value);
    return finite_or_zero(law_.variables[start].name, law_.variables[start].name);
  }

  static const std::string& member(const Variable& variable, std::size_t place) {
    return variable.element_names.empty() ? variable.name : variable.element_names[place];
  }

  std::string_view scalar() const { return name_of(law_.scalar); }
  std::string number(double value) const { return cpp_literal(value, law_.scalar); }

  const UpdateLaw& law_;
  const StateBox& box_;
  std::string name_;  // of the network
  std::string suffix_;
  std::size_t place_ = 0;         // of the straight statement at hand
  std::set<VariableId> in_loop_;  // locals of the loop at hand that need no array
};

}  // namespace

C99Program c99_program(const UpdateLaw& law, const std::string& name, const StateBox& box) {
  return C99Printer(law, name, box).print();
}

void add_program(const C99Program& program, CodeModel& model) {
  model.lists["before"] = as_list(program.before);
  model.lists["states"] = as_list(program.states);
  model.lists["begin"] = as_list(program.begin);
  model.lists["reset"] = as_list(program.reset);
  model.lists["output"] = as_list(program.output);
  model.lists["update"] = as_list(program.update);
  model.lists["energy"] = as_list(program.energy);
}

}  // namespace dashpot::compiler
