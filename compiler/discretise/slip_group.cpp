#include "discretise/slip_group.hpp"

#include <algorithm>

#include "discretise/element_names.hpp"

namespace dashpot::compiler {
namespace {

bool all_equal(const std::vector<Real>& values, int expected) {
  return std::all_of(values.begin(), values.end(), [=](const Real& value) { return value == expected; });
}

template <class ValueOf>
std::vector<Real> column(const std::vector<Row>& rows, ValueOf value_of) {
  std::vector<Real> values;
  for (const Row& row : rows) values.push_back(value_of(row));
  return values;
}

bool has_modes(const NormalTree& component) {
  const std::vector<const NormalTree*> blocks = blocks_of(component);
  return std::any_of(blocks.begin(), blocks.end(), [](const NormalTree* block) { return !block->form.modes.empty(); });
}

// A damper holds no force once the tool rests.
bool holds_nothing(const LinearForm& form) { return form.static_stiffness == 0 && form.modes.empty(); }

void forget(std::size_t block, SlipResponse& response) {
  response.trial.held[block] = 0;
  response.force.held[block] = 0;
  for (Row& row : response.elongation) row.held[block] = 0;
}

}  // namespace

SlipGroup::SlipGroup(LawWriter& writer, const Network& network, const Real& sample_period,
                     const SlipDecomposition& settings)
    : writer_(writer), network_(network), sample_period_(sample_period), brake_(writer, settings) {}

SlipResponse SlipGroup::response_of(const NormalTree& component) const {
  std::vector<Real> stiffness;
  for (const NormalTree* block : blocks_of(component))
    stiffness.push_back(companion_stiffness(block->form, writer_.law().scheme, sample_period_));
  SlipResponse response = slip_response(component, stiffness);
  for (std::size_t i = 0; i < response.blocks.size(); ++i)
    if (holds_nothing(response.blocks[i].block->form)) forget(i, response);
  return response;
}

SlipGroup::MotorForce SlipGroup::motor_force(const SlipResponse& response, const ComponentSplit* split) const {
  if (split == nullptr) return {snapped(response.force), snapped(response.force), false};
  const Real &stuck = split->shares.front().feedthrough, &sliding = split->shares.back().feedthrough;
  MotorForce force{response.force, response.force, stuck != sliding};
  force.stuck.change -= stuck / sample_period_;
  force.sliding.change -= sliding / sample_period_;
  return {snapped(force.stuck), snapped(force.sliding), force.differs};
}

SlipGroup::RowShape SlipGroup::shape_of(const Row& row) {
  const auto factor_of = [](const Real& value) {
    return value == 0 ? Factor::zero : value == 1 ? Factor::one : value == -1 ? Factor::minus_one : Factor::other;
  };
  RowShape shape{{factor_of(row.change)}};
  for (const Real& value : row.held) shape.factors.push_back(factor_of(value));
  shape.factors.push_back(factor_of(row.excess));
  return shape;
}

SlipGroup::Shape SlipGroup::shape_of(const SlipResponse& response, const MotorForce& force) {
  Shape shape{shape_of(response.trial),
              shape_of(force.stuck),
              shape_of(force.sliding),
              same_but_for_excess(response.trial, force.stuck),
              same_but_for_excess(response.trial, force.sliding),
              force.differs,
              {}};
  for (std::size_t i = 0; i < response.blocks.size(); ++i) {
    const LinearForm& form = response.blocks[i].block->form;
    shape.blocks.push_back({form.static_stiffness > 0, !form.modes.empty(), shape_of(response.elongation[i])});
  }
  return shape;
}

bool SlipGroup::accepts(const NormalTree& component, const ComponentSplit* split) const {
  if (responses_.empty() || has_modes_ || has_modes(component) || SlipBrake::shape(split) != brake_shape_) return false;
  const SlipResponse response = response_of(component);
  return shape_of(response, motor_force(response, split)) == shape_of(responses_.front(), forces_.front());
}

void SlipGroup::add(const NormalTree& component, const ComponentSplit* split) {
  has_modes_ = has_modes(component);
  responses_.push_back(response_of(component));
  const SlipResponse& response = responses_.back();
  forces_.push_back(motor_force(response, split));
  brake_.add(split);
  brake_shape_ = SlipBrake::shape(split);
  names_.push_back(writer_.unique(name_of(response.slip_elements, network_)));
  blocks_.resize(response.blocks.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const NormalTree& block = *response.blocks[i].block;
    blocks_[i].forms.push_back(block.form);
    blocks_[i].elements.push_back(block.elements);
    blocks_[i].names.push_back(writer_.unique(name_of(block.elements, network_)));
    blocks_[i].has_spring = block.form.static_stiffness > 0;
    if (block.form.modes.empty()) continue;
    Names mode_names;
    for (const Mode& mode : block.form.modes)
      mode_names.push_back(writer_.unique(joined(name_of(mode.elements, network_), "mode")));
    blocks_[i].modes = std::make_unique<ModeBank>(writer_, block.form.modes, StateInput::position, sample_period_,
                                                  std::move(mode_names), blocks_[i].names.front(),
                                                  std::vector<Subject>{OfElements{block.elements}});
  }
}

double SlipGroup::smallest_loss() const {
  double smallest = 1;
  for (const Block& block : blocks_)
    if (block.modes) smallest = std::min(smallest, block.modes->smallest_loss());
  return smallest;
}

void SlipGroup::declare() {
  prefix_ = names_.front();
  for (Block& block : blocks_) {
    if (block.has_spring)
      block.spring_force = writer_.vector({block.names.front(), "spring_force"}, writer_.force(), "force of the spring",
                                          Role::state, block.names);
    if (block.modes) block.modes->declare();
  }
  brake_.declare(prefix_, names_, {prefix_});
}

// trial = force if stuck, slip = clamp(trial, ±Y), excess = trial − slip, f = f if stuck − factor · excess
ExpressionId SlipGroup::write_output(VariableId change, VariableId position) {
  std::vector<Statement>& output = writer_.law().output;
  now_.change = change;
  now_.trial = local("trial", "force of the slip if it held");
  std::vector<Row> trial = rows(&SlipResponse::trial);
  for (Row& row : trial) row.excess = 0;
  writer_.assign(output, now_.trial, expression({RowOf::trial}, trial, {change, nothing, nothing, nothing}),
                 "trial = force of the slip if it held", origins());
  std::vector<Real> yields;
  for (const SlipResponse& response : responses_) yields.push_back(response.yield_force);
  now_.slip = local("slip", "the slip's force");
  std::vector<Subject> slips;
  for (const SlipResponse& response : responses_) slips.push_back(OfElements{response.slip_elements});
  const ExpressionId limit = writer_.constants({prefix_, "yield"}, writer_.force(), "Y", yields, names_,
                                               {ConstantRole::yield, std::move(slips)});
  writer_.assign(output, now_.slip, writer_.clamp(writer_.read(now_.trial), limit), "slip = clamp(trial, ±Y)",
                 origins());
  now_.excess = local("excess", "what the slip does not hold");
  writer_.assign(output, now_.excess, writer_.subtract(writer_.read(now_.trial), writer_.read(now_.slip)),
                 "excess = trial − slip");
  // Above zero where the slip gives way: the excess has the sign of the slip's force.
  const ExpressionId sliding = writer_.multiply(writer_.read(now_.excess), writer_.read(now_.slip));
  const ExpressionId force = write_force(sliding);
  brake_.write_output({sliding}, position);
  // The sums come after all vectors, so that the loops for the vectors stay together.
  damping_ = summed("damping", brake_.changing_damping());
  shortfall_ = summed("shortfall", brake_.shortfall());
  compensation_ = summed("compensation", brake_.compensation());
  return names_.size() == 1 ? force : summed("force", writer_.reads(force));
}

// f′ = f if stuck − factor · excess − x Δu/h
ExpressionId SlipGroup::write_force(ExpressionId sliding) {
  const bool differs = forces_.front().differs;
  ExpressionId force = expression({RowOf::force}, rows(&MotorForce::sliding), now_);
  if (differs) {
    std::vector<Row> stuck = rows(&MotorForce::stuck);
    for (Row& row : stuck) row.excess = 0;
    force = writer_.where(sliding, force, expression({RowOf::stuck_force}, stuck, now_));
  }
  if (names_.size() == 1 && !differs) return force;
  if (writer_.reads(force) == now_.slip) return force;
  const VariableId shares = local("force", "the component's force");
  writer_.assign(
      writer_.law().output, shares, force,
      differs ? "f′ = f − x Δu/h, where the brake makes x of the damping" : "f = f if stuck − factor · excess",
      origins());
  return writer_.read(shares);
}

ExpressionId SlipGroup::summed(const std::string& what, VariableId vector) {
  if (vector == nothing || names_.size() == 1) return vector == nothing ? nothing : writer_.read(vector);
  const VariableId sum = writer_.scalar(joined(joined(prefix_, what), "sum"), "", "", Role::local);
  writer_.assign(writer_.law().output, sum, writer_.sum(vector), "");
  return writer_.read(sum);
}

// F0 ← F0 + k0 δ; modes by their own drive δ. All new forces are computed before any old one is overwritten.
void SlipGroup::write_update(VariableId) {
  std::vector<Statement>& update = writer_.law().update;
  Terms kept_terms = {kept(now_.change), nothing, nothing, nothing};
  std::vector<std::pair<VariableId, VariableId>> replaced;
  std::vector<VariableId> drives(blocks_.size(), nothing);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    if (block.modes) {
      drives[i] = writer_.vector({block.names.front(), "elongation"}, writer_.length(), "", Role::local, block.names);
      writer_.assign(update, drives[i], expression({RowOf::elongation, i}, elongations(i), kept_terms),
                     "δ of the block", {});
    }
    if (!block.has_spring) continue;
    std::vector<Row> next = elongations(i);
    for (std::size_t place = 0; place < next.size(); ++place) {
      next[place] = block.forms[place].static_stiffness * next[place];
      if (!block.modes) next[place].held[i] += 1;
      next[place] = snapped(next[place]);
    }
    ExpressionId force = expression({RowOf::spring, i}, next, kept_terms);
    if (block.modes) force = writer_.add(writer_.read(block.spring_force), force);
    if (is_only_state(i)) {
      writer_.assign(update, block.spring_force, writer_.flush(force), "F ← F + k δ", origins());
      continue;
    }
    const VariableId fresh =
        writer_.vector({block.names.front(), "spring_force_next"}, writer_.force(), "", Role::local, block.names);
    writer_.assign(update, fresh, writer_.flush(force), "F ← F + k δ", origins());
    replaced.emplace_back(block.spring_force, fresh);
  }
  for (const auto& [old, fresh] : replaced) writer_.assign(update, old, writer_.read(fresh), "");
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    if (blocks_[i].modes) blocks_[i].modes->write_update(drives[i], nothing);
  brake_.write_update(no_variable);
}

// ½ F0²/k0 + Σ F²/(2k)
ExpressionId SlipGroup::energy() {
  ExpressionId sum = nothing;
  for (Block& block : blocks_) {
    if (block.has_spring) {
      std::vector<Real> weights;
      for (const LinearForm& form : block.forms) weights.push_back(1 / (2 * form.static_stiffness));
      std::vector<Subject> subjects;
      for (const ElementList& elements : block.elements) subjects.push_back(OfElements{elements});
      const ExpressionId weight =
          writer_.constants({block.names.front(), "compliance"}, writer_.compliance(), "1/(2 k)", weights, block.names,
                            {ConstantRole::spring_compliance, std::move(subjects)});
      const ExpressionId squared = writer_.multiply(writer_.multiply(weight, writer_.read(block.spring_force)),
                                                    writer_.read(block.spring_force));
      const VariableId stored =
          writer_.vector({block.names.front(), "spring_energy"}, "J", "", Role::local, block.names);
      writer_.assign(writer_.law().energy, stored, squared, "F²/(2k)", origins());
      sum = writer_.plus(sum, block.names.size() == 1 ? writer_.read(stored) : writer_.sum(stored));
    }
    if (block.modes) sum = writer_.plus(sum, block.modes->energy());
  }
  return sum;
}

bool SlipGroup::is_only_state(std::size_t block) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    if (blocks_[i].modes || (i != block && blocks_[i].has_spring)) return false;
  return true;
}

std::vector<Row> SlipGroup::rows(Row SlipResponse::*row) const {
  std::vector<Row> all;
  for (const SlipResponse& response : responses_) all.push_back(response.*row);
  return all;
}

std::vector<Row> SlipGroup::rows(Row MotorForce::*row) const {
  std::vector<Row> all;
  for (const MotorForce& force : forces_) all.push_back(force.*row);
  return all;
}

std::vector<Row> SlipGroup::elongations(std::size_t block) const {
  std::vector<Row> all;
  for (const SlipResponse& response : responses_) all.push_back(response.elongation[block]);
  return all;
}

// π = F0 + Σ a F; nothing for a lone damper.
ExpressionId SlipGroup::held_force(const Block& block) {
  const ExpressionId spring = block.has_spring ? writer_.read(block.spring_force) : nothing;
  return writer_.plus(spring, block.modes ? writer_.read(block.modes->decayed_sum()) : nothing);
}

std::string SlipGroup::called(Quantity quantity) const {
  switch (quantity.of) {
    case RowOf::trial: return "trial";
    case RowOf::force: return "force";
    case RowOf::stuck_force: return "stuck_force";
    case RowOf::elongation: return joined(blocks_[quantity.block].names.front(), "elongation");
    case RowOf::spring: return joined(blocks_[quantity.block].names.front(), "spring");
  }
  return "";
}

// One subject for each component.
Derivation SlipGroup::row_of(const Term& term, bool is_subtracted) const {
  const bool is_of_block = term.quantity.of == RowOf::elongation || term.quantity.of == RowOf::spring;
  std::vector<Subject> subjects;
  for (std::size_t place = 0; place < responses_.size(); ++place) {
    OfRow row{responses_[place].slip_elements, term.quantity.of, {}, term.factor, {}, is_subtracted};
    if (is_of_block) row.block = blocks_[term.quantity.block].elements[place];
    if (term.factor == RowFor::held) row.held = blocks_[term.held_block].elements[place];
    subjects.push_back(std::move(row));
  }
  return {ConstantRole::row, std::move(subjects)};
}

// If a row differs from the trial row only in its excess term, the trial value is used again; if that term takes off
// the whole excess, the row is the slip's force itself. Locals of the output that a row of the update reads are kept.
ExpressionId SlipGroup::expression(Quantity quantity, const std::vector<Row>& rows, Terms terms) {
  const bool in_output = quantity.of != RowOf::elongation && quantity.of != RowOf::spring;
  const bool like_trial = quantity.of != RowOf::trial && std::equal(rows.begin(), rows.end(), responses_.begin(),
                                                                    [](const Row& row, const SlipResponse& response) {
                                                                      return same_but_for_excess(row, response.trial);
                                                                    });
  const std::vector<Real> excess = column(rows, [](const Row& row) { return row.excess; });
  const auto at_hand = [&](VariableId local) { return in_output ? local : kept(local); };
  if (like_trial && all_equal(excess, -1)) return writer_.read(at_hand(now_.slip));
  ExpressionId sum = nothing;
  if (like_trial) {
    sum = writer_.read(at_hand(now_.trial));
  } else {
    sum = term({quantity, RowFor::change}, column(rows, [](const Row& row) { return row.change; }),
               writer_.read(terms.change), sum);
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      if (const ExpressionId held = held_force(blocks_[i]); held != nothing)
        sum = term({quantity, RowFor::held, i}, column(rows, [i](const Row& row) { return row.held[i]; }), held, sum);
  }
  if (!all_equal(excess, 0)) sum = term({quantity, RowFor::excess}, excess, writer_.read(at_hand(now_.excess)), sum);
  return sum == nothing ? writer_.constant(joined(prefix_, called(quantity) + "_none"), writer_.force(), "nothing", 0,
                                           ConstantRole::zero)
                        : sum;
}

// If all values are 0, 1 or −1, nothing is multiplied.
ExpressionId SlipGroup::term(const Term& term, std::vector<Real> values, ExpressionId variable, ExpressionId sum) {
  if (all_equal(values, 0)) return sum;
  if (all_equal(values, 1)) return writer_.plus(sum, variable);
  const bool falls =
      std::all_of(values.begin(), values.end(), [](const Real& value) { return value < 0; }) && sum != nothing;
  if (falls)
    for (Real& value : values) value = -value;
  const ExpressionId product =
      all_equal(values, 1) ? variable : writer_.multiply(factors(term, values, falls), variable);
  return falls ? writer_.subtract(sum, product) : writer_.plus(sum, product);
}

ExpressionId SlipGroup::factors(const Term& term, const std::vector<Real>& values, bool is_subtracted) {
  const auto written = [&](const std::string& by, const std::string& unit, const char* meaning) {
    return writer_.constants({prefix_, called(term.quantity) + "_by_" + by}, unit, meaning, values, names_,
                             row_of(term, is_subtracted));
  };
  switch (term.factor) {
    case RowFor::change: return written("change", writer_.stiffness(), "factor of the change of position");
    case RowFor::held: return written(blocks_[term.held_block].names.front(), "1", "factor of the force held there");
    case RowFor::excess: return written("excess", "1", "factor of the excess");
  }
  return nothing;
}

VariableId SlipGroup::kept(VariableId local) { return writer_.kept(local); }

VariableId SlipGroup::local(const std::string& what, const std::string& meaning) {
  return writer_.vector({prefix_, what}, writer_.force(), meaning, Role::local, names_);
}

std::vector<std::vector<std::size_t>> SlipGroup::origins() const {
  std::vector<std::vector<std::size_t>> all;
  for (const SlipResponse& response : responses_) {
    std::vector<std::size_t> elements = response.slip_elements;
    for (const CompanionBlock& block : response.blocks)
      elements.insert(elements.end(), block.block->elements.begin(), block.block->elements.end());
    std::sort(elements.begin(), elements.end());
    all.push_back(std::move(elements));
  }
  return all;
}

}  // namespace dashpot::compiler
