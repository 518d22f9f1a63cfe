#include "lower/joint_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "discretise/law_writer.hpp"
#include "law/check_law.hpp"
#include "law/empty_law.hpp"
#include "law/walk.hpp"
#include "lower/append_law.hpp"
#include "lower/term_writer.hpp"
#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

using axes::operator+, axes::operator-, axes::operator*;
using axes::Pair;
using axes::Pose;
using axes::Symmetric;

// What one port sees of the joints' positions.
struct PortTerms {
  Term depth;           // w
  Pair<Term> gradient;  // g
};

// A table of the cells of a grid looked up where the tip is. Its numbers are those of axes::place() and axes::corner().
struct GridCell {
  Term within_x, within_y;           // s and t [m]
  std::array<Term, 16> coefficient;  // of the cell
};

GridCell cell_of(const axes::Grid& grid, const std::string& port, const Pair<Term>& tip) {
  const auto table = [&](const std::string& name, const char* unit, const char* meaning, std::size_t size,
                         const auto& value_at) {
    TermTable made{joined(port, name), unit, meaning, {}};
    for (std::size_t i = 0; i < size; ++i) made.values.push_back(value_at(i));
    return made;
  };
  const auto place_along = [&](std::size_t axis) {
    const Term cells = Term(1 / grid.spacing[axis]) * (tip[axis] - Term(grid.start[axis] - grid.spacing[axis]));
    return max(min(cells, Term(double(grid.knots[axis]))), Term(0.0));
  };
  const auto within = [&](std::size_t axis, const Term& place) {
    const char* const name = axis == 0 ? "map_corner_x" : "map_corner_y";
    return tip[axis] - pick(table(name, "m", "where each cell begins", grid.knots[axis] + 1,
                                  [&](std::size_t i) { return axes::corner(grid, axis, i); }),
                            place);
  };
  const Term column = place_along(0), row = place_along(1);
  const Term cell = pick(table("map_column", "1", "number of each column of cells", grid.knots[0] + 1,
                               [](std::size_t i) { return double(i); }),
                         column) +
                    pick(table("map_row", "1", "number of the first cell of each row", grid.knots[1] + 1,
                               [&](std::size_t i) { return double(i * grid.columns()); }),
                         row);
  GridCell found{within(0, column), within(1, row), {}};
  for (std::size_t k = 0; k < found.coefficient.size(); ++k) {
    const std::size_t power = k / 4 + k % 4;
    const std::string unit = power == 0   ? "m"
                             : power == 1 ? "1"
                             : power == 2 ? "1/m"
                                          : fmt::format("1/m^{}", power - 1);
    found.coefficient[k] = pick(table(fmt::format("map_s{}_t{}", k / 4, k % 4), unit.c_str(),
                                      fmt::format("coefficient of s^{} t^{} in each cell", k / 4, k % 4).c_str(),
                                      grid.cell.size(), [&](std::size_t i) { return grid.cell[i].coefficient[k]; }),
                                cell);
  }
  return found;
}

axes::Depth<Term> depth_of(const PortLaw& port, const Pair<Term>& tip) {
  return std::visit(
      [&](const auto& map) {
        if constexpr (std::is_same_v<std::decay_t<decltype(map)>, axes::Grid>) {
          const GridCell cell = cell_of(map, port.name, tip);
          return axes::bicubic(cell.coefficient, cell.within_x, cell.within_y);
        } else {
          return axes::depth(map, tip);
        }
      },
      port.map);
}

// A of a field given over knots: the cell's numbers looked up where the tip is.
class FieldCell {
 public:
  FieldCell(const axes::ViscousField& field, const Pair<Term>& tip)
      : field_(field),
        cells_(axes::cells_of(field)),
        within_{axes::way_from_first_knot(field, 0, tip[0]), axes::way_from_first_knot(field, 1, tip[1])} {
    cell_ = pick(table("field_column", "1", "number of each column of cells", cells_[0],
                       [](std::size_t i) { return double(i); }),
                 place(0)) +
            pick(table("field_row", "1", "number of the first cell of each row", cells_[1],
                       [this](std::size_t i) { return double(i * cells_[0]); }),
                 place(1));
    for (std::size_t axis = 0; axis < 2; ++axis)
      from_corner_[axis] = within_[axis] - pick(table(axis == 0 ? "field_corner_x" : "field_corner_y", "m",
                                                      "where each cell begins, from the first knot", cells_[axis],
                                                      [&](std::size_t i) { return double(i) * field_.spacing[axis]; }),
                                                place(axis));
  }

  Term entry(std::size_t i, std::size_t j) const {
    std::array<Term, 4> c;
    for (std::size_t power = 0; power < 4; ++power) {
      const TermTable numbers = numbers_of(i, j, power);
      const bool is_one = std::all_of(numbers.values.begin(), numbers.values.end(),
                                      [&](double number) { return number == numbers.values.front(); });
      c[power] = is_one ? Term(numbers.values.front()) : pick(numbers, cell_);
    }
    return axes::bilinear(c, from_corner_[0], from_corner_[1]);
  }

 private:
  // At the last knot it is one beyond the last cell: tables repeat their last number there.
  Term place(std::size_t axis) const { return Term(1 / field_.spacing[axis]) * within_[axis]; }

  template <typename ValueAt>
  static TermTable table(const char* name, const char* unit, const char* meaning, std::size_t cells,
                         const ValueAt& value_at) {
    TermTable made{name, unit, meaning, {}};
    for (std::size_t i = 0; i <= cells; ++i) made.values.push_back(value_at(std::min(i, cells - 1)));
    return made;
  }
  TermTable numbers_of(std::size_t i, std::size_t j, std::size_t power) const {
    static constexpr const char* powers[] = {"", "_by_x", "_by_y", "_by_xy"};
    static constexpr const char* units[] = {"N·s/m", "N·s/m²", "N·s/m²", "N·s/m³"};
    TermTable made{
        fmt::format("field_{}{}{}", i + 1, j + 1, powers[power]), units[power], "value or derivative in each cell", {}};
    for (std::size_t row = 0; row < cells_[1]; ++row)
      for (std::size_t column = 0; column < cells_[0]; ++column)
        made.values.push_back(axes::cell_entry(field_, column, row, i, j)[power]);
    return made;
  }

  const axes::ViscousField& field_;
  std::array<std::size_t, 2> cells_;
  Pair<Term> within_;
  Term cell_;
  Pair<Term> from_corner_;
};

// Entries that are alike everywhere are looked up once.
axes::Matrix<Term> field_terms(const axes::ViscousField& field, const Pair<Term>& tip) {
  if (field.is_uniform()) {
    const axes::Matrix<double>& a = field.at_knot.front();
    return {axes::constant<Term>(a[0]), axes::constant<Term>(a[1])};
  }
  const FieldCell cell(field, tip);
  const auto everywhere = [&](const auto& is_so) {
    return std::all_of(field.at_knot.begin(), field.at_knot.end(), is_so);
  };
  const Term first = cell.entry(0, 0), upper = cell.entry(0, 1);
  const Term lower = field.is_symmetric()                                            ? upper
                     : everywhere([](const auto& a) { return a[1][0] == -a[0][1]; }) ? -upper
                                                                                     : cell.entry(1, 0);
  const Term last = everywhere([](const auto& a) { return a[0][0] == a[1][1]; }) ? first : cell.entry(1, 1);
  return {{{first, upper}, {lower, last}}};
}

// A port's law as a part of the law of all ports.
struct Merged {
  VariableId position, velocity;  // locals: w and its rate
  VariableId force;               // M
  Term damping;                   // b
  VariableId stored;
  VariableId rest_position;  // a state, or no_variable
  VariableId started_at;     // a local of `start`, or no_variable where it is w
  std::vector<Statement> output, energy, start;
};

class Merging {
 public:
  Merging(const std::vector<PortLaw>& ports, const JointPlan& plan)
      : ports_(ports),
        plan_(plan),
        law_(empty_law_like(ports.front().law)),
        writer_(law_, plan.joint_motion),
        terms_(writer_) {}

  UpdateLaw result() {
    declare();
    name_numbers(terms_);
    for (const PortLaw& port : ports_) merged_.push_back(append(port));
    write_output();
    write_energy();
    write_start();
    law_.position = law_.joints->positions.front();
    law_.velocity = law_.joints->velocities.front();
    law_.force = law_.joints->torques.front();
    check_law(law_, "joints");
    return std::move(law_);
  }

 private:
  bool rotates() const { return plan_.joint_motion == motion::rotation; }
  std::string joint_unit() const { return rotates() ? "rad" : "m"; }
  std::string torque_unit() const { return rotates() ? "N·m" : "N"; }
  std::string damping_unit() const { return rotates() ? "N·m·s/rad" : "N·s/m"; }

  void declare() {
    JointPorts& joints = law_.joints.emplace();
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string number = std::to_string(i + 1);
      joints.positions.push_back(
          writer_.scalar(writer_.unique("q" + number), joint_unit(), "position of joint " + number, Role::input));
      joints.velocities.push_back(
          writer_.scalar(writer_.unique("v" + number), joint_unit() + "/s", "estimate of its velocity", Role::input));
      const auto [low, high] = plan_.ranges[i];
      if (rotates() && low < high) terms_.bound(joints.positions.back(), low, high);
    }
    for (std::size_t i = 0; i < 2; ++i)
      joints.torques.push_back(writer_.scalar(writer_.unique("torque_" + std::to_string(i + 1)), torque_unit(),
                                              "torque of motor " + std::to_string(i + 1), Role::local));
    for (std::size_t k = 0; k < plan_.brakes.size(); ++k)
      joints.dampings.push_back(writer_.scalar(writer_.unique("damping_" + std::to_string(k + 1)), damping_unit(),
                                               "damping of brake " + std::to_string(k + 1), Role::local));
  }

  void name_numbers(TermWriter& terms) const {
    terms.call(1, "one", "1", "1");
    terms.call(0.5, "half", "1", "1/2");
    terms.call(0.25, "quarter", "1", "1/4");
    terms.call(0, "nothing", "1", "0");
    terms.call(plan_.arm.proximal, "proximal_link", "m", "length of the link at the motor");
    terms.call(plan_.arm.distal, "distal_link", "m", "length of the link at the tip");
    terms.call(plan_.arm.distal * plan_.arm.distal, "distal_link_squared", "m²",
               "square of the length of the link at the tip");
    terms.call(plan_.arm.base, "base", "m", "distance of the motor axes");
    terms.call(plan_.arm.base / 2, "half_base", "m", "half the distance of the motor axes");
    for (std::size_t k = 0; k < plan_.brakes.size(); ++k) {
      terms.call(plan_.added[k], "added_damping_" + std::to_string(k + 1), damping_unit(),
                 "added to the brake's command for passivity");
      terms.call(plan_.brakes[k].most, "most_damping_" + std::to_string(k + 1), damping_unit(),
                 "largest damping of the brake, less what is added");
    }
    if (plan_.gate) {
      const axes::CurlGate& gate = *plan_.gate;
      for (std::size_t k = 0; k < 2; ++k)
        terms.call(gate.factor[k], "gate_factor_" + std::to_string(k + 1), "1",
                   "factor of the brake's damping that couplings may use");
      terms.call(gate.reserve, "gate_reserve", damping_unit(), "part of that kept back for limits that grow");
      terms.call(gate.recovery, "gate_recovery", damping_unit(), "largest growth of a limit in a sample");
      terms.call(0.5 / gate.gain, "gate_half", "1", "1/(2γ), γ the gain of the velocity estimators");
      terms.call(1 / gate.gain, "gate_share", "1", "1/γ, γ the gain of the velocity estimators");
    }
    for (const PortLaw& port : ports_) {
      terms.call(port.law.damping, joined(port.name, "damping"), "N·s/m", "b of the port");
      const auto call = [&](double value, const std::string& name, const char* unit, const char* meaning) {
        terms.call(value, joined(port.name, name), unit, meaning);
      };
      match(
          port.map,
          [&](const axes::Plane& plane) { call(plane.offset, "offset", "m", "distance of the plane from the origin"); },
          [&](const axes::Circle& circle) {
            call(circle.centre[0], "centre_x", "m", "x of the circle's centre");
            call(circle.centre[1], "centre_y", "m", "y of the circle's centre");
            call(circle.radius, "radius", "m", "radius of the circle");
          },
          [&](const axes::Band& band) { call(band.radius, "radius", "m", "radius of the band"); },
          [&](const axes::Grid& grid) {
            for (std::size_t axis = 0; axis < 2; ++axis) {
              const std::string of = axis == 0 ? "x" : "y";
              call(1 / grid.spacing[axis], "cells_per_length_" + of, "1/m", "cells of the grid per length");
              call(grid.start[axis] - grid.spacing[axis], "grid_before_" + of, "m",
                   "where the cell before the first knot begins");
              call(double(grid.knots[axis]), "last_cell_" + of, "1", "number of the grid's last cell");
            }
          });
    }
    if (!plan_.field.is_uniform())
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::string of = axis == 0 ? "x" : "y";
        const double length = double(plan_.field.knots[axis] - 1) * plan_.field.spacing[axis];
        terms.call(plan_.field.start[axis], "field_start_" + of, "m", "the first knot of the field's grid");
        terms.call(length, "field_length_" + of, "m", "from the first knot to the last");
        terms.call(1 / plan_.field.spacing[axis], "field_cells_per_length_" + of, "1/m",
                   "cells of the field's grid per length");
      }
    terms.call(axes::blunting * axes::blunting, "blunting_squared", "m²", "keeps the distance above zero");
  }

  Merged append(const PortLaw& port) {
    const UpdateLaw& own = port.law;
    AppendedLaw appended = append_law(writer_, port.name, own);
    for (auto [from, to] : {std::pair(&appended.keep, &law_.keep), {&appended.update, &law_.update}})
      to->insert(to->end(), from->begin(), from->end());
    const Term damping = own.brake_changes() ? Term(appended.at(own.brake)) : Term(own.damping);
    return {appended.at(own.position),   appended.at(own.velocity),
            appended.at(own.force),      damping,
            appended.at(own.stored),     appended.at(own.rest_position),
            appended.at(own.started_at), std::move(appended.output),
            std::move(appended.energy),  std::move(appended.start)};
  }

  Pair<Term> inputs(const std::vector<VariableId>& ids) const { return {Term(ids[0]), Term(ids[1])}; }

  void name_pose(TermWriter& terms, const Pose<Term>& pose) const {
    const char* const axis[] = {"x", "y"};
    for (std::size_t i = 0; i < 2; ++i) {
      terms.call(pose.tip[i], std::string("tip_") + axis[i], "m", std::string("position of the tip, ") + axis[i]);
      for (std::size_t j = 0; j < 2; ++j)
        terms.call(pose.column[j][i], std::string(axis[i]) + "_by_q" + std::to_string(j + 1), rotates() ? "m/rad" : "1",
                   std::string("∂") + axis[i] + "/∂q" + std::to_string(j + 1));
    }
  }

  std::vector<PortTerms> port_terms(TermWriter& terms, const Pose<Term>& pose) const {
    std::vector<PortTerms> all;
    for (const PortLaw& port : ports_) {
      const axes::Depth<Term> depth = depth_of(port, pose.tip);
      all.push_back({depth.value, axes::at_joints(pose, depth.gradient)});
      for (std::size_t j = 0; j < 2; ++j)
        terms.call(all.back().gradient[j], joined(port.name, "by_q" + std::to_string(j + 1)), rotates() ? "m/rad" : "1",
                   "∂w/∂q" + std::to_string(j + 1));
    }
    return all;
  }

  std::vector<Term> chosen(const Symmetric<Term>& target, const Pose<Term>& pose) const {
    switch (plan_.rule) {
      case axes::BrakeRule::diagonal: return axes::diagonal(plan_.brakes, target);
      case axes::BrakeRule::non_injecting:
        return axes::non_injecting(plan_.brakes, target, axes::isotropic_motion(pose.column));
      case axes::BrakeRule::virtual_brake: break;
    }
    return std::vector<Term>(plan_.brakes.size(), Term(0.0));
  }

  // Everything is counted before anything is written, so that what is used twice is computed once.
  void write_output() {
    const Pair<Term> q = inputs(law_.joints->positions), v = inputs(law_.joints->velocities);
    const Pose<Term> pose = axes::pose(plan_.arm, q);
    name_pose(terms_, pose);
    const std::vector<PortTerms> ports = port_terms(terms_, pose);
    Symmetric<Term> target{Term(0.0), Term(0.0), Term(0.0)};
    Term turning(0.0);
    if (!plan_.field.is_zero()) {
      const axes::JointField<Term> at_joints =
          axes::at_joints(pose, field_terms(plan_.field, pose.tip), plan_.field.is_symmetric());
      target = {at_joints.p, at_joints.r, at_joints.s};
      turning = at_joints.sigma;
      terms_.call(turning, "turning", damping_unit(), "σ, antisymmetric part of the field, at the joints");
    }
    Pair<Term> torque{Term(0.0), Term(0.0)};
    for (std::size_t i = 0; i < ports.size(); ++i) {
      target = target + merged_[i].damping * axes::outer(ports[i].gradient);
      torque = torque + Term(merged_[i].force) * ports[i].gradient;
    }
    terms_.call(target.xx, "wanted_11", damping_unit(), "B* of joint 1");
    terms_.call(target.xy, "wanted_12", damping_unit(), "B* between the joints");
    terms_.call(target.yy, "wanted_22", damping_unit(), "B* of joint 2");
    const std::vector<Term> brakes = chosen(target, pose);
    std::optional<axes::Gated<Term>> passed;
    if (plan_.gate) {
      passed = behind_gate(target, turning, brakes, v, torque);
    } else {
      const Symmetric<Term> rest = target - axes::made_by(plan_.brakes, brakes);
      torque[0] = torque[0] + (rest.xx * v[0] + (rest.xy + turning) * v[1]);
      torque[1] = torque[1] + ((rest.xy - turning) * v[0] + rest.yy * v[1]);
    }
    std::vector<Term> commands;
    for (std::size_t k = 0; k < brakes.size(); ++k) commands.push_back(brakes[k] + Term(plan_.added[k]));
    const std::vector<Term> rates = rates_of(ports, v);
    for (const PortTerms& port : ports) terms_.count(port.depth);
    for (const Term& rate : rates) terms_.count(rate);
    for (const Term& command : commands) terms_.count(command);
    for (const Term& one : torque) terms_.count(one);
    if (passed)
      for (const Term& one : passed->left) terms_.count(one);
    for (std::size_t i = 0; i < ports.size(); ++i) {
      terms_.assign(law_.output, merged_[i].position, ports[i].depth, "w of port " + ports_[i].name);
      if (reads_velocity(i)) terms_.assign(law_.output, merged_[i].velocity, rates[i], "ẇ = Σ ∂w/∂q v");
      law_.output.insert(law_.output.end(), merged_[i].output.begin(), merged_[i].output.end());
    }
    for (std::size_t k = 0; k < commands.size(); ++k)
      terms_.assign(law_.output, law_.joints->dampings[k], commands[k], k == 0 ? "D, what the brakes make of B*" : "");
    for (std::size_t j = 0; j < 2; ++j)
      terms_.assign(law_.output, law_.joints->torques[j], torque[j], j == 0 ? "τ = Σ ∂w/∂q M + (B* − D) v" : "");
    if (passed) keep_limits(*passed);
    for (const VariableId damping : law_.joints->dampings) law_.joints->last_dampings.push_back(writer_.kept(damping));
  }

  // Adds to the torque what the gate lets the motors make of ports and field, in the brakes' coordinates.
  axes::Gated<Term> behind_gate(const Symmetric<Term>& target, const Term& turning, const std::vector<Term>& brakes,
                                const Pair<Term>& v, Pair<Term>& torque) {
    for (std::size_t k = 0; k < 2; ++k)
      limits_[k] = writer_.scalar(
          writer_.unique("coupling_left_" + std::to_string(k + 1)), damping_unit(),
          "what the torque limiter (gate) has left of the allowance of brake " + std::to_string(k + 1), Role::state);
    const Pair<double> along[] = {plan_.brakes[0].along, plan_.brakes[1].along};
    const Pair<Pair<double>> dual = axes::dual(along[0], along[1]);
    const auto [p, r, s] = axes::along_brakes(dual, target);
    const Term sigma = Term(axes::dot(axes::turned(dual[0]), dual[1])) * turning;
    const axes::Gated<Term> passed =
        axes::gated(*plan_.gate, Pair<Term>{brakes[0], brakes[1]}, r, sigma, {Term(limits_[0]), Term(limits_[1])});
    const Pair<Term> rate{axes::dot(axes::constant<Term>(along[0]), v), axes::dot(axes::constant<Term>(along[1]), v)};
    const Pair<Term> made{(p - brakes[0]) * rate[0] + passed.coupling[0] * rate[1],
                          passed.coupling[1] * rate[0] + (s - brakes[1]) * rate[1]};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string number = std::to_string(k + 1);
      terms_.call(passed.coupling[k], "coupling_" + number, damping_unit(),
                  "what the torque limiter (gate) lets the motors make along brake " + number);
      torque = torque + made[k] * axes::constant<Term>(along[k]);
    }
    return passed;
  }

  void keep_limits(const axes::Gated<Term>& passed) {
    for (std::size_t k = 0; k < 2; ++k) {
      const VariableId now = writer_.scalar(writer_.unique("coupling_left_now_" + std::to_string(k + 1)),
                                            damping_unit(), "what it leaves for the next sample", Role::local);
      terms_.assign(law_.output, now, passed.left[k], k == 0 ? "limit of the other coupling at the next sample" : "");
      writer_.assign(law_.update, limits_[k], writer_.read(writer_.kept(now)), "");
    }
  }

  bool reads_velocity(std::size_t port) const {
    const UpdateLaw& own = ports_[port].law;
    return reads(own, own.output, own.velocity) || reads(own, own.keep, own.velocity);
  }

  std::vector<Term> rates_of(const std::vector<PortTerms>& ports, const Pair<Term>& v) const {
    std::vector<Term> rates;
    for (std::size_t i = 0; i < ports.size(); ++i)
      rates.push_back(reads_velocity(i) ? axes::dot(ports[i].gradient, v) : Term(0.0));
    return rates;
  }

  void write_energy() {
    ExpressionId sum = nothing;
    for (const Merged& port : merged_) {
      law_.energy.insert(law_.energy.end(), port.energy.begin(), port.energy.end());
      sum = writer_.plus(sum, writer_.read(port.stored));
    }
    law_.stored = writer_.scalar("stored", "J", "energy in the springs of all ports", Role::local);
    writer_.assign(law_.energy, law_.stored, sum, "Σ V of all ports");
  }

  // Where each port is at the joint positions given to reset(). That is a function of its own, so its locals may have
  // the names of other functions' locals.
  void write_start() {
    LawWriter writer(law_, plan_.joint_motion);
    TermWriter terms(writer, terms_);
    const Pose<Term> pose = axes::pose(plan_.arm, inputs(law_.joints->positions));
    name_pose(terms, pose);
    std::vector<std::pair<std::size_t, Term>> starts;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (merged_[i].rest_position == no_variable) continue;
      const Term start = depth_of(ports_[i], pose.tip).value;
      terms.count(start);
      starts.emplace_back(i, start);
    }
    for (const auto& [i, start] : starts) {
      const Merged& port = merged_[i];
      terms.assign(law_.start, port.position, start, "w of port " + ports_[i].name);
      law_.start.insert(law_.start.end(), port.start.begin(), port.start.end());
      law_.starts.push_back({port.rest_position, port.started_at != no_variable ? port.started_at : port.position});
    }
  }

  const std::vector<PortLaw>& ports_;
  const JointPlan& plan_;
  UpdateLaw law_;
  LawWriter writer_;
  TermWriter terms_;
  std::vector<Merged> merged_;
  Pair<VariableId> limits_{};  // of the gate
};

}  // namespace

UpdateLaw joint_law(const std::vector<PortLaw>& ports, const JointPlan& plan) { return Merging(ports, plan).result(); }

}  // namespace dashpot::compiler
