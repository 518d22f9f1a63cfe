#include "lower/behind_map.hpp"

#include <algorithm>

#include "discretise/law_writer.hpp"
#include "law/check_law.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

class Mapping {
 public:
  Mapping(UpdateLaw law, const MotionMap& map, double added_damping, motion port_motion)
      : law_(std::move(law)), writer_(law_, port_motion), map_(map), added_damping_(added_damping) {}

  UpdateLaw result() {
    std::vector<Statement> output;
    std::swap(output, law_.output);
    std::vector<Statement> keep;
    std::swap(keep, law_.keep);
    write_place(law_.output);
    const VariableId mapped = write_value(law_.output);
    write_tangent();
    write_velocity(output, keep);
    for (auto* program : {&output, &keep})
      each_value(*program, [&](ExpressionId value) { return behind(value, mapped); });
    law_.output.insert(law_.output.end(), output.begin(), output.end());
    law_.keep = keep;
    write_force();
    write_brake();
    write_start();
    law_.mapped = mapped;
    law_.steepest = map_.steepest();
    law_.map_start = map_.start;
    check_law(law_, "static curve");
    return std::move(law_);
  }

 private:
  ExpressionId number(const char* name, const std::string& unit, const char* meaning, double value) {
    return writer_.constant(name, unit, meaning, Real(value), ConstantRole::map);
  }
  ExpressionId zero() { return number("centre", writer_.length(), "centre of the map", 0); }

  VariableId local(const char* name, const std::string& unit, const char* meaning) {
    return writer_.scalar(name, unit, meaning, Role::local);
  }

  // Which cell |u| is in, and how far from where that begins. A NaN or infinite position takes the first cell and is
  // refused afterwards.
  void write_place(std::vector<Statement>& program) {
    side_ = writer_.read(law_.position);
    if (map_.start != 0) {
      const VariableId depth = local("depth", writer_.length(), "how far the tool is beyond the unloaded surface");
      writer_.assign(program, depth,
                     writer_.subtract(
                         side_, number("surface_at", writer_.length(), "where the unloaded surface lies", map_.start)),
                     "x = u − u0");
      side_ = writer_.read(depth);
    }
    const VariableId distance = local("distance", writer_.length(), "distance of the tool from where the curve begins");
    writer_.assign(program, distance, writer_.where(side_, side_, writer_.subtract(zero(), side_)), "|x|");
    const VariableId in_cells = local("in_cells", "1", "that distance in cells, within the map");
    const ExpressionId cells = writer_.multiply(
        writer_.read(distance),
        number("cells_per_length", "1/" + writer_.length(), "cells of the map per length", 1 / map_.width()));
    writer_.assign(
        program, in_cells,
        writer_.clamp(cells, number("last_cell", "1", "number of the map's last cell", double(map_.cubics()))), "");
    cell_ = local("cell", "1", "cell of the map, counted from 0; the last is straight");
    writer_.assign(program, cell_, writer_.where(writer_.read(in_cells), writer_.read(in_cells), zero()), "");
    within_ = local("within", writer_.length(), "d, distance from where the cell begins");
    writer_.assign(program, within_,
                   writer_.subtract(writer_.read(distance),
                                    pick("cell_begins", writer_.length(), "where each cell begins",
                                         [this](std::size_t i) { return Real(map_.reach) * i / map_.cubics(); })),
                   "d = |x| − x_i");
    write_cubic(program);
  }

  // w = a + d (b + d bend), bend = c + e d
  void write_cubic(std::vector<Statement>& program) {
    const auto of_cell = [&](double MapCell::*member) {
      return [this, member](std::size_t i) { return Real(map_.cell[i].*member); };
    };
    cubic_ = local("map_cubic", "1/" + writer_.length(), "map_e d");
    writer_.assign(program, cubic_,
                   writer_.multiply(pick("map_e", "1/" + writer_.length() + "²", "coefficient of d³ in each cell",
                                         of_cell(&MapCell::e)),
                                    writer_.read(within_)),
                   "map_e d");
    bend_ = local("map_bend", "1/" + writer_.length(), "map_c + map_e d");
    writer_.assign(
        program, bend_,
        writer_.add(pick("map_c", "1/" + writer_.length(), "coefficient of d² in each cell", of_cell(&MapCell::c)),
                    writer_.read(cubic_)),
        "map_c + map_e d");
  }

  template <class ValueOf>
  ExpressionId pick(const char* name, const std::string& unit, const char* meaning, ValueOf value_of) {
    std::vector<Real> values;
    for (std::size_t i = 0; i <= map_.cubics(); ++i) values.push_back(value_of(i));
    return writer_.pick(name, unit, meaning, values, writer_.read(cell_), ConstantRole::map);
  }

  VariableId write_value(std::vector<Statement>& program) {
    const ExpressionId d = writer_.read(within_);
    const ExpressionId a = pick("map_a", writer_.length(), "w where each cell begins",
                                [this](std::size_t i) { return Real(map_.cell[i].a); });
    const ExpressionId value =
        writer_.add(a, writer_.multiply(d, writer_.add(slope(), writer_.multiply(d, writer_.read(bend_)))));
    const VariableId mapped = local("mapped", writer_.length(), "w, what the network sees of the tool");
    const VariableId size = local("mapped_size", writer_.length(), "|w|");
    writer_.assign(program, size, value, "|w| = map_a + d (map_b + d map_bend)");
    writer_.assign(program, mapped,
                   writer_.where(side_, writer_.read(size), writer_.subtract(zero(), writer_.read(size))),
                   "w with the sign of x");
    return mapped;
  }

  ExpressionId slope() {
    return pick("map_b", "1", "w′ where each cell begins", [this](std::size_t i) { return Real(map_.cell[i].b); });
  }

  void write_tangent() {
    tangent_ = local("tangent", "1", "w′");
    const ExpressionId s = writer_.read(bend_);
    const ExpressionId twice = writer_.add(writer_.add(s, s), writer_.read(cubic_));
    writer_.assign(law_.output, tangent_, writer_.add(slope(), writer_.multiply(writer_.read(within_), twice)),
                   "w′ = map_b + d (2 map_bend + map_e d)");
  }

  void write_velocity(const std::vector<Statement>& output, const std::vector<Statement>& keep) {
    if (!reads(law_, output, law_.velocity) && !reads(law_, keep, law_.velocity)) return;
    velocity_ = local("mapped_velocity", writer_.velocity(), "estimate of ẇ");
    writer_.assign(law_.output, velocity_, writer_.multiply(writer_.read(tangent_), writer_.read(law_.velocity)),
                   "ẇ = w′ u̇");
  }

  // Replaces every value of the statements by changed(value).
  template <class Changed>
  static void each_value(std::vector<Statement>& program, const Changed& changed) {
    for (Statement& statement : program) statement.value = changed(statement.value);
  }

  // Reads w and its rate in place of position and velocity.
  ExpressionId behind(ExpressionId id, VariableId mapped) {
    const Expression e = law_.expressions[id];
    if (e.operation == Operation::read && e.variable == law_.position) return writer_.read(mapped);
    if (e.operation == Operation::read && e.variable == law_.velocity) return writer_.read(velocity_);
    Expression changed = e;
    for (std::size_t i = 0; i < operands(e).size(); ++i) changed.operands[i] = behind(e.operands[i], mapped);
    return changed.operands == e.operands ? id : law_.expressions.add(changed);
  }

  Statement& assignment_of(VariableId target) {
    return *std::find_if(law_.output.begin(), law_.output.end(),
                         [&](const Statement& statement) { return statement.target == target; });
  }

  void write_force() {
    const VariableId behind = local("mapped_force", writer_.force(), "M, the motor's force behind the map");
    assignment_of(law_.force).target = behind;
    for (auto* program : {&law_.output, &law_.keep})
      each_value(*program, [&](ExpressionId value) { return reading(value, law_.force, behind); });
    writer_.assign(law_.output, law_.force, writer_.multiply(writer_.read(tangent_), writer_.read(behind)), "m = w′ M");
  }

  ExpressionId reading(ExpressionId id, VariableId before, VariableId now) {
    const Expression e = law_.expressions[id];
    if (e.operation == Operation::read && e.variable == before) return writer_.read(now);
    Expression changed = e;
    for (std::size_t i = 0; i < operands(e).size(); ++i) changed.operands[i] = reading(e.operands[i], before, now);
    return changed.operands == e.operands ? id : law_.expressions.add(changed);
  }

  // b = w′² b_w, and what the certificate adds at the tool.
  void write_brake() {
    const bool has_brake = law_.largest_damping > 0 || law_.tunable;
    if (!has_brake && added_damping_ == 0) return;
    const VariableId square = local("tangent_squared", "1", "w′²");
    writer_.assign(law_.output, square, writer_.multiply(writer_.read(tangent_), writer_.read(tangent_)), "w′²");
    const VariableId before = law_.brake;
    const ExpressionId behind = before != no_variable
                                    ? writer_.read(before)
                                    : writer_.constant("mapped_damping", writer_.damping(), "b_w, b behind the map",
                                                       Real(law_.damping), ConstantRole::steady_damping);
    ExpressionId told = has_brake ? writer_.multiply(writer_.read(square), behind) : nothing;
    if (added_damping_ > 0)
      told = writer_.plus(told, writer_.constant("damping_at_tool", writer_.damping(), "added for passivity",
                                                 Real(added_damping_), ConstantRole::steady_damping));
    law_.brake = writer_.scalar("brake_command", writer_.damping(), "b", Role::local);
    writer_.assign(law_.output, law_.brake, told, "b = w′² b_w");
    remember_brake();
    const double least = map_.least_tangent(0, map_.reach), most = map_.steepest();
    law_.damping = law_.damping * least * least + added_damping_;
    law_.largest_damping = law_.largest_damping * most * most + added_damping_;
  }

  // With tunables the state that kept b_w now keeps b. It starts at 0, since set() does not know where the tool is.
  void remember_brake() {
    if (!law_.tunable) return void(law_.last_brake = writer_.kept(law_.brake));
    for (Statement& statement : law_.keep)
      if (statement.target == law_.last_brake) statement.value = writer_.read(law_.brake);
    std::erase_if(law_.rest, [&](const Statement& statement) { return statement.target == law_.last_brake; });
  }

  // reset() needs w at the position that it is given.
  void write_start() {
    if (law_.rest_position == no_variable) return;
    std::vector<Statement> start;
    std::swap(start, law_.start);
    write_place(law_.start);
    const VariableId mapped = write_value(law_.start);
    each_value(start, [&](ExpressionId value) { return behind(value, mapped); });
    law_.start.insert(law_.start.end(), start.begin(), start.end());
    if (law_.started_at == no_variable) law_.started_at = mapped;
  }

  UpdateLaw law_;
  LawWriter writer_;
  const MotionMap& map_;
  double added_damping_;
  ExpressionId side_ = nothing;
  VariableId cell_ = no_variable, within_ = no_variable, cubic_ = no_variable, bend_ = no_variable,
             tangent_ = no_variable, velocity_ = no_variable;
};

}  // namespace

UpdateLaw behind_map(UpdateLaw law, const MotionMap& map, double added_damping, motion port_motion) {
  return Mapping(std::move(law), map, added_damping, port_motion).result();
}

}  // namespace dashpot::compiler
