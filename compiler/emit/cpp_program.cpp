#include "emit/cpp_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "discretise/expression_text.hpp"
#include "emit/cpp_tunable.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t line_width = 112;

std::string origin_names(const std::vector<std::size_t>& elements, const Network& network) {
  std::string names;
  for (std::size_t i = 0; i < elements.size() && i < 4; ++i)
    names += (i == 0 ? "" : ", ") + network.elements[elements[i]].name;
  return elements.size() > 4 ? fmt::format("{} and {} more", names, elements.size() - 4) : names;
}

std::size_t indentation(const std::string& text) { return std::min(text.find_first_not_of(' '), text.size()); }

// The blank, not beyond `limit` and outside of [], that a line is best broken at: behind a plus, else behind a comma; 0
// where there is none.
std::size_t break_place(const std::string& text, std::size_t limit) {
  std::size_t plus = 0, comma = 0;
  int depth = 0;
  for (std::size_t i = 1; i <= limit && i < text.size(); ++i) {
    depth += (text[i] == '[') - (text[i] == ']');
    if (text[i] != ' ' || depth > 0) continue;
    if (text[i - 1] == '+') plus = i;
    if (text[i - 1] == ',') comma = i;
  }
  return plus > limit / 4 ? plus : comma;
}

std::vector<std::string> wrapped(std::string text) {
  std::vector<std::string> lines;
  const std::string further(indentation(text) + 4, ' ');
  while (text.size() > line_width) {
    const std::size_t place = break_place(text, line_width);
    if (place <= further.size()) break;
    lines.push_back(text.substr(0, place));
    text = further + text.substr(place + 1);
  }
  lines.push_back(std::move(text));
  return lines;
}

// The remark stands behind the statement where there is room, else above it.
void append(std::vector<std::string>& lines, const std::string& text, const std::string& remark = "") {
  const bool fits = text.size() + remark.size() + 4 <= line_width;
  if (!remark.empty() && !fits) lines.push_back(std::string(indentation(text), ' ') + "// " + remark);
  for (std::string& line : wrapped(text)) lines.push_back(std::move(line));
  if (!remark.empty() && fits) lines.back() += "  // " + remark;
}

const char* part_name(slip_part kind) {
  switch (kind) {
    case slip_part::block: return "block";
    case slip_part::slip: return "slip";
    case slip_part::series: return "series";
    case slip_part::parallel: return "parallel";
  }
  return "";
}

class CppPrinter {
 public:
  CppPrinter(const UpdateLaw& law, const Network& network) : law_(law), network_(network), rolled_(law.lanes > 1) {
    if (!rolled_) return;
    for (const Statement& statement : law.keep) find_vectors(statement.value);
  }

  CppProgram print() {
    CppProgram program;
    program.headers = {"dashpot/command.hpp"};
    if (!law_.networks.empty()) program.headers.push_back("dashpot/slip_network.hpp");
    if (!law_.couplings.empty()) program.headers.push_back("dashpot/slip_tree.hpp");
    program.output = lines_of(law_.output);
    program.command = law_.brake_changes() ? fmt::format("{{{}, {}}}", scalar_name(law_.variables[law_.brake]),
                                                         scalar_name(law_.variables[law_.force]))
                                           : "{damping, force}";
    program.safe_command = law_.brake_changes() ? fmt::format("{{{}, 0}}", scalar_name(law_.variables[law_.last_brake])) : "{damping, 0}";
    program.keep = lines_of(law_.keep);
    program.update = lines_of(law_.update);
    program.energy = lines_of(law_.energy);
    program.parameters = {"struct parameters {};"};
    program.set = {"// No parameter of this network can be set while it runs.", "unsigned set(const parameters&) noexcept { return 0; }"};
    program.reset = reset();
    program.constants = constants();
    program.states = states();
    program.functions = functions();
    return program;
  }

 private:
  std::vector<std::string> lines_of(const std::vector<Statement>& program) {
    std::vector<std::string> lines;
    summed_.clear();
    for (const Statement& statement : program)
      if (law_.variables[statement.target].size == 1) find_sums(statement.value);
    for (std::size_t i = 0; i < program.size();) {
      if (law_.variables[program[i].target].size == 1 || !rolled_) {
        print_unrolled(program[i++], lines);
        continue;
      }
      const std::size_t first = i, size = law_.variables[program[i].target].size;
      while (i < program.size() && law_.variables[program[i].target].size == size) ++i;
      print_loop(program, first, i, lines);
    }
    return lines;
  }

  void print_unrolled(const Statement& statement, std::vector<std::string>& lines) {
    const Variable& target = law_.variables[statement.target];
    if (!statement.purpose.empty()) lines.push_back("// " + statement.purpose);
    if (statement.coupling != no_coupling) return print_step(statement, law_.couplings[statement.coupling], lines);
    if (statement.network != no_coupling) return print_step(statement, law_.networks[statement.network], lines);
    for (std::size_t place = 0; place < target.size; ++place) {
      const std::string line = assignment(target, place) + expression(statement.value, place) + ";";
      const bool has_origin = target.size > 1 && place < statement.origins.size();
      append(lines, line, has_origin ? origin_names(statement.origins[place], network_) : "");
    }
  }

  void print_step(const Statement& statement, const Coupling& coupling, std::vector<std::string>& lines) {
    const std::string& name = coupling.name;
    std::string held;
    for (VariableId id : coupling.held)
      held += (held.empty() ? "" : ", ") + (id == no_variable ? std::string("0") : scalar_name(law_.variables[id]));
    append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, coupling.held.size(), held));
    lines.push_back(fmt::format("scalar {}_elongation[{}] = {{}};", name, coupling.elongation.size()));
    lines.push_back(fmt::format("int {}_sign[{}] = {{}};", name, coupling.slips.size()));
    lines.push_back(fmt::format("dashpot::slip_tree_scratch<scalar, {}, {}, {}> {}_scratch;", coupling.nodes.size(),
                                coupling.slips.size(), coupling.corners(), name));
    if (coupling.is_pushed()) lines.push_back(fmt::format("scalar {}_change = 0;", name));
    append(lines, assignment(law_.variables[statement.target], 0) +
                      fmt::format("dashpot::slip_tree<scalar>({0}, {0}_scratch).{1}({2}, {0}_held, {0}_elongation, {0}_sign{3});", name,
                                  coupling.is_pushed() ? "push" : "step", expression(statement.value, 0),
                                  coupling.is_pushed() ? fmt::format(", {}_change", name) : ""));
    if (coupling.is_pushed())
      lines.push_back(assignment(law_.variables[coupling.surface_change], 0) + name + "_change;");
    for (std::size_t i = 0; i < coupling.elongation.size(); ++i)
      if (coupling.elongation[i] != no_variable)
        lines.push_back(assignment(law_.variables[coupling.elongation[i]], 0) + fmt::format("{}_elongation[{}];", name, i));
  }

  void print_step(const Statement& statement, const SlipNetwork& network, std::vector<std::string>& lines) {
    const std::string& name = network.name;
    std::string held, sign;
    for (VariableId id : network.held)
      held += (held.empty() ? "" : ", ") + (id == no_variable ? std::string("0") : scalar_name(law_.variables[id]));
    for (VariableId id : network.last_sign) sign += (sign.empty() ? "" : ", ") + fmt::format("static_cast<int>({})", scalar_name(law_.variables[id]));
    append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, network.held.size(), held));
    lines.push_back(fmt::format("scalar {}_moved[{}] = {{}};", name, network.node_count));
    append(lines, fmt::format("int {}_sign[{}] = {{{}}};", name, network.slip_count(), sign));
    lines.push_back(fmt::format("dashpot::slip_network_scratch<scalar, {}> {}_scratch;", network.node_count, name));
    append(lines, fmt::format("dashpot::slip_network<scalar> {0}_step({0}_links, {1}, {{{0}_between, {0}_to_tool, {0}_to_ground, {2}}}, {3}, {0}_scratch.room());",
                              name, network.slip_count(), literal(network.through), network.node_count));
    append(lines, assignment(law_.variables[statement.target], 0) +
                      fmt::format("{0}_step.step({1}, {0}_held, {0}_moved, {0}_sign);", name, expression(statement.value, 0)));
    for (std::size_t i = 0; i < network.moved.size(); ++i)
      if (network.moved[i] != no_variable) lines.push_back(assignment(law_.variables[network.moved[i]], 0) + fmt::format("{}_moved[{}];", name, i));
    for (std::size_t i = 0; i < network.sign.size(); ++i)
      lines.push_back(assignment(law_.variables[network.sign[i]], 0) + fmt::format("static_cast<scalar>({}_sign[{}]);", name, i));
  }

  // Elementwise statements in one loop, with the partial sums of those vectors that are added up later.
  void print_loop(const std::vector<Statement>& program, std::size_t first, std::size_t last,
                  std::vector<std::string>& lines) {
    for (std::size_t i = first; i < last; ++i) {
      const Variable& target = law_.variables[program[i].target];
      if (outlives_loop(target)) lines.push_back(fmt::format("{} {}[{}];", scalar(), target.name, padded(target.size)));
      if (summed_.count(program[i].target) != 0) clear_lane(target, lines);
    }
    lines.push_back(fmt::format("for (int i = 0; i < {}; i += {})", padded_size(program[first]), law_.lanes));
    lines.push_back(fmt::format("  for (int j = 0; j < {}; ++j) {{", law_.lanes));
    for (std::size_t i = first; i < last; ++i) {
      const Variable& target = law_.variables[program[i].target];
      append(lines, "    " + assignment(target, 0) + expression(program[i].value, 0) + ";", program[i].purpose);
    }
    for (std::size_t i = first; i < last; ++i)
      if (const Variable& target = law_.variables[program[i].target]; summed_.count(program[i].target) != 0)
        lines.push_back(fmt::format("    {}[j] += {};", lane(target), vector_name(target, 0)));
    lines.push_back("  }");
  }

  // One by one: from an empty initialiser a compiler may make a call of memset.
  void clear_lane(const Variable& vector, std::vector<std::string>& lines) const {
    lines.push_back(fmt::format("{} {}[{}];", scalar(), lane(vector), law_.lanes));
    lines.push_back(fmt::format("for (int j = 0; j < {}; ++j) {}[j] = 0;", law_.lanes, lane(vector)));
  }

  // Partial sums; called after their vector where a function has several.
  std::string lane(const Variable& vector) const { return summed_.size() == 1 ? "lane" : vector.name + "_lane"; }

  void find_sums(ExpressionId id) {
    const Expression& e = law_.expressions[id];
    if (e.operation == Operation::sum) summed_.insert(law_.expressions[e.left].left);
    if (e.operation == Operation::read || e.operation == Operation::constant || e.operation == Operation::sum) return;
    find_sums(e.left);
    if (e.operation == Operation::where) find_sums(e.condition);
    if (e.operation != Operation::flush) find_sums(e.right);
  }

  std::string assignment(const Variable& target, std::size_t place) const {
    const std::string name = target.size == 1 ? scalar_name(target) : vector_name(target, place);
    const bool is_declared = target.role != Role::local || outlives_loop(target);
    return (is_declared ? std::string() : fmt::format("const {} ", scalar())) + name + " = ";
  }

  void find_vectors(ExpressionId id) {
    const Expression& e = law_.expressions[id];
    if (e.operation == Operation::read && law_.variables[e.left].size > 1) outliving_.insert(&law_.variables[e.left]);
    if (e.operation == Operation::read || e.operation == Operation::constant) return;
    find_vectors(e.left);
    if (e.operation == Operation::where) find_vectors(e.condition);
    if (e.operation != Operation::flush && e.operation != Operation::sum) find_vectors(e.right);
  }

  // Of a rolled loop's locals those that are remembered after the command has been found finite need a place each.
  bool outlives_loop(const Variable& variable) const {
    return variable.role == Role::local && outliving_.count(&variable) != 0;
  }

  std::string expression(ExpressionId id, std::size_t place) {
    Spelling spelling;
    spelling.variable = [&](const Variable& variable) {
      used_variables_.insert(&variable);
      return variable.size == 1 ? scalar_name(variable) : vector_name(variable, place);
    };
    spelling.coefficient = [&](const Coefficient& coefficient) {
      used_coefficients_.insert(&coefficient);
      if (coefficient.element_names.empty()) return coefficient.name;
      return is_rolled(coefficient) ? coefficient.name + "[i + j]" : coefficient.element_names[place];
    };
    spelling.flush = [&](const std::string& value) {
      uses_flush_ = true;
      return fmt::format("dashpot::flush_below(threshold, {})", value);
    };
    // A sum is one operand: inside a longer expression its terms keep together.
    const bool is_whole = law_.expressions[id].operation == Operation::sum;
    spelling.clamp = [](const std::string& value, const std::string& limit) {
      return fmt::format("dashpot::clamp_to({}, {})", limit, value);
    };
    spelling.sum = [&](const Variable& vector) {
      const std::string terms = sum_text(vector);
      return is_whole || rolled_ || vector.size == 1 ? terms : "(" + terms + ")";
    };
    return expression_text(law_, id, spelling);
  }

  std::string sum_text(const Variable& vector) {
    if (rolled_) {
      uses_total_ = true;
      return fmt::format("total({})", lane(vector));
    }
    std::string text;
    for (std::size_t place = 0; place < vector.size; ++place)
      text += (place == 0 ? "" : " + ") + vector_name(vector, place);
    return text;
  }

  static std::string scalar_name(const Variable& variable) {
    const std::string& name = variable.element_names.empty() ? variable.name : variable.element_names.front();
    return variable.role == Role::state ? name + "_" : name;
  }

  std::string vector_name(const Variable& variable, std::size_t place) const {
    if (rolled_ && outlives_loop(variable)) return variable.name + "[i + j]";
    if (rolled_) return variable.role == Role::state ? variable.name + "_[i + j]" : variable.name;
    return variable.role == Role::state ? variable.element_names[place] + "_" : variable.element_names[place];
  }

  bool is_rolled(const Coefficient& coefficient) const { return rolled_ && coefficient.values.size() > 1; }

  std::size_t padded_size(const Statement& statement) const { return padded(law_.variables[statement.target].size); }
  std::size_t padded(std::size_t size) const { return (size + law_.lanes - 1) / law_.lanes * law_.lanes; }

  std::vector<std::string> constants() const {
    std::vector<std::string> lines;
    if (!law_.brake_changes())
      lines.push_back(fmt::format("static constexpr scalar damping = {};  // b, the brake's part", literal(law_.damping)));
    if (uses_flush_)
      lines.push_back(fmt::format("static constexpr scalar threshold = {};  // below, a force is zero: no subnormal state",
                                  literal(law_.flush_threshold)));
    for (const Coefficient& coefficient : law_.coefficients)
      if (used_coefficients_.count(&coefficient) != 0) append_constant(coefficient, lines);
    for (const Coupling& coupling : law_.couplings) append_table(coupling, lines);
    for (const SlipNetwork& network : law_.networks) append_tables(network, lines);
    return lines;
  }

  void append_table(const Coupling& coupling, std::vector<std::string>& lines) const {
    lines.push_back("// kind, children, slips, place, first corner, stiffness, compliance, yield force");
    lines.push_back(fmt::format("static constexpr dashpot::slip_node<scalar> {}[{}] = {{", coupling.name, coupling.nodes.size()));
    for (const slip_node<double>& node : coupling.nodes)
      lines.push_back(fmt::format("    {{dashpot::slip_part::{}, {}, {}, {}, {}, {}, {}, {}, {}}},", part_name(node.kind),
                                  node.first_child, node.child_count, node.slips, node.place, node.first_corner,
                                  literal(node.stiffness), literal(node.compliance), literal(node.yield)));
    lines.push_back("};");
  }

  void append_tables(const SlipNetwork& network, std::vector<std::string>& lines) const {
    lines.push_back("// ends, lowest and highest force of each slip; inner ends come first, then tool and ground");
    lines.push_back(fmt::format("static constexpr dashpot::slip_link<scalar> {}_links[{}] = {{", network.name, network.slip_count()));
    for (const slip_link<double>& link : network.links)
      lines.push_back(fmt::format("    {{{}, {}, {}, {}}},", link.a, link.b, literal(link.lowest), literal(link.highest)));
    lines.push_back("};");
    lines.push_back("// stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]");
    for (const auto& [what, values] : {std::pair("between", &network.between), std::pair("to_tool", &network.to_tool), std::pair("to_ground", &network.to_ground)}) {
      std::string table = fmt::format("static constexpr scalar {}_{}[{}] = {{", network.name, what, values->size());
      for (std::size_t i = 0; i < values->size(); ++i) table += (i == 0 ? "" : ", ") + literal((*values)[i]);
      append(lines, table + "};");
    }
  }

  void append_constant(const Coefficient& coefficient, std::vector<std::string>& lines) const {
    const std::string note = fmt::format("  // {} [{}]", coefficient.meaning, coefficient.unit);
    if (coefficient.element_names.empty()) {
      lines.push_back(fmt::format("static constexpr scalar {} = {};{}", coefficient.name, literal(coefficient.values[0]), note));
    } else if (!is_rolled(coefficient)) {
      for (std::size_t place = 0; place < coefficient.values.size(); ++place)
        lines.push_back(fmt::format("static constexpr scalar {} = {};{}", coefficient.element_names[place],
                                    literal(coefficient.values[place]), note));
    } else {
      std::string table = fmt::format("static constexpr scalar {}[{}] = {{", coefficient.name, padded(coefficient.values.size()));
      for (std::size_t place = 0; place < coefficient.values.size(); ++place)
        table += (place == 0 ? "" : ", ") + literal(coefficient.values[place]);
      lines.push_back("//" + note.substr(4));
      append(lines, table + "};");
    }
  }

  std::vector<std::string> reset() {
    std::vector<std::string> lines;
    const bool rests = law_.rest_position != no_variable;
    if (!rests) lines.push_back("static_cast<void>(position);");
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state) continue;
      if (rests && &variable == &law_.variables[law_.rest_position])
        lines.push_back(fmt::format("{} = dashpot::all_finite(position, position, position) ? {} : 0;", scalar_name(variable), rest_position()));
      else if (variable.size == 1)
        lines.push_back(fmt::format("{} = {};", scalar_name(variable), rest_value(variable)));
      else if (rolled_)
        lines.push_back(clearing(variable));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("{}_ = {};", name, rest_value(variable)));
    }
    return lines;
  }

  std::string rest_position() const {
    return law_.surface_at ? fmt::format("dashpot::pushed_in({}, position)", literal(*law_.surface_at)) : "position";
  }

  std::string clearing(const Variable& variable) {
    uses_clear_ = true;
    return fmt::format("clear({}_);", variable.name);
  }

  std::vector<std::string> states() const {
    std::vector<std::string> lines;
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state) continue;
      const std::string note = fmt::format("  // {} [{}]", variable.meaning, variable.unit);
      if (variable.size == 1)
        lines.push_back(fmt::format("scalar {} = {};{}", scalar_name(variable), rest_value(variable), note));
      else if (rolled_)
        lines.push_back(fmt::format("scalar {}_[{}] = {{}};{}", variable.name, padded(variable.size), note));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("scalar {}_ = {};{}", name, rest_value(variable), note));
    }
    return lines;
  }

  std::vector<std::string> functions() const {
    std::vector<std::string> lines;
    if (uses_total_)
      lines = {fmt::format("static scalar total(const scalar (&lane)[{}]) noexcept {{", law_.lanes),
               "  scalar sum = lane[0];",
               fmt::format("  for (int j = 1; j < {}; ++j) sum += lane[j];", law_.lanes),
               "  return sum;",
               "}",
               ""};
    if (uses_clear_)
      for (const char* line : {"// Through volatile: compilers turn a plain loop into a call of memset, which may not be there.",
                               "template <int size>", "static void clear(volatile scalar (&states)[size]) noexcept {",
                               "  for (int i = 0; i < size; ++i) states[i] = 0;", "}", ""})
        lines.push_back(line);
    return lines;
  }

  std::string rest_value(const Variable& state) const { return state.rest_value == 0 ? "0" : literal(state.rest_value); }

  std::string literal(double value) const { return cpp_literal(value, law_.scalar); }
  static const char* scalar() { return "scalar"; }

  const UpdateLaw& law_;
  const Network& network_;
  bool rolled_;
  bool uses_flush_ = false, uses_total_ = false, uses_clear_ = false;
  std::set<const Variable*> used_variables_;
  std::set<const Coefficient*> used_coefficients_;
  std::set<VariableId> summed_;  // of the program at hand
  std::set<const Variable*> outliving_;
};

}  // namespace

std::string cpp_literal(double value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? fmt::format("{:#}", value) : fmt::format("{:#}f", static_cast<float>(value));
}

CppProgram cpp_program(const UpdateLaw& law, const Network& network) {
  return law.tunable ? tunable_program(law) : CppPrinter(law, network).print();
}

}  // namespace dashpot::compiler
