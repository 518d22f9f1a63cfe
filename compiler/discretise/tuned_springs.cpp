#include "discretise/tuned_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dashpot::compiler {

TunedSprings::TunedSprings(LawWriter& writer, const TunableTables& tables, std::vector<ExpressionId> numbers,
                           VariableId held_force)
    : writer_(writer),
      tables_(tables),
      head_(tables.head),
      numbers_(writer),
      given_(std::move(numbers)),
      slips_(numbers_, tables, blocks_),
      held_force_(held_force) {
  declare();
}

void TunedSprings::declare() {
  for (std::size_t i = 0; i < tables_.springs.size(); ++i) {
    SpringNames spring;
    spring.name = tables_.spring_names[i];
    spring.stiffness = given(tables_.springs[i]);
    springs_.push_back(std::move(spring));
  }
  const auto is_tuned = [&](const SpringNames& s) {
    return writer_.law().expressions[s.stiffness].operation != Operation::constant;
  };
  const bool some_change = std::any_of(springs_.begin(), springs_.end(), is_tuned);
  for (SpringNames& spring : springs_) {
    spring.changes = is_tuned(spring) || (some_change && &spring == static_spring());
    spring.elongation = state(spring, "elongation", writer_.length(), "z, elongation of the spring");
    if (is_tuned(spring))
      spring.carried =
          numbers_.scalar(joined(spring.name, "carried_stiffness"), writer_.stiffness(),
                          "k after the last change of parameters", is_behind_map() ? Role::state : Role::tuned);
    if (is_behind_map() && spring.changes)
      spring.sampled = state(spring, "sampled_elongation", writer_.length(), "z at the last sample");
  }
  declare_blocks();
  each_part([&](const BlockPart& part) {
    if (part.kind == PartKind::mesh) meshes_.emplace(&part, TunedMesh(numbers_, part, tables_.edges));
    each_spring(part, [&](SpringNames& spring) {
      if (keeps_offset(part) && (spring.changes || (sheds() && !has_contact())))
        spring.offset = state(spring, "offset", writer_.length(), "r, shift of the spring's rest length");
      if (spring.offset != nothing && spring.sampled != nothing)
        spring.sampled_offset = state(spring, "sampled_offset", writer_.length(), "r at the last sample");
    });
  });
  if (some_change || has_offsets())
    tank_ = numbers_.scalar("tank", "J", "energy set free by changes of parameters, not yet spent", Role::state);
  if (has_offsets())
    for (int i = 0; i < head_.hold.samples; ++i)
      owed_.push_back(numbers_.scalar(i == 0 ? "owed" : "owed_before", writer_.force(),
                                      "force that the motor still holds though r of a spring has moved", Role::state));
  if (is_behind_map() && some_change)
    sampled_tank_ = numbers_.scalar("sampled_tank", "J", "tank at the last sample", Role::state);
  if (is_behind_map() && static_spring() != nullptr && static_spring()->offset != nothing)
    stiffest_share_ =
        numbers_.scalar("stiffest_share", "1", "largest k of the static spring over its k now", Role::tuned);
  if (!sheds()) return;
  if (has_offsets() && !has_contact())
    shed_ = numbers_.scalar("shed", "1", "1 while shedding has left some r that is not 0", Role::state);
  if (comes_back())
    dent_ = numbers_.scalar("dent", writer_.length(), "how far shedding has pushed the surface in", Role::state);
}

// The held forces of blocks behind slips are computed once a sample and stored for the solvers.
void TunedSprings::declare_blocks() {
  for (std::size_t i = 0; i < tables_.blocks.size(); ++i) {
    blocks_.push_back({tables_.block_names[i]});
    bool has_springs = false;
    each_part_of(i, [&](const BlockPart& part) { has_springs |= part.kind != PartKind::damper; });
    if (i == 0) blocks_[i].held = held_force_;
    else if (has_springs)
      blocks_[i].held = numbers_.scalar(joined(blocks_[i].name, "held"), writer_.force(),
                                        "force if the block keeps its length", Role::state);
  }
  slips_.declare();
}

VariableId TunedSprings::state(const SpringNames& spring, const char* what, const std::string& unit,
                               const char* meaning) {
  return numbers_.scalar(joined(spring.name, what), unit, meaning, Role::state);
}

bool TunedSprings::has_offsets() const {
  return std::any_of(springs_.begin(), springs_.end(), [](const SpringNames& s) { return s.offset != nothing; });
}

TunedSprings::SpringNames* TunedSprings::static_spring() {
  return head_.static_spring == no_index ? nullptr : &springs_[static_cast<std::size_t>(head_.static_spring)];
}

// Whether a spring keeps an offset: only one between tool and ground or in a mesh does. Elsewhere its neighbour moves
// instead.
bool TunedSprings::keeps_offset(const BlockPart& part) {
  return part.kind == PartKind::mesh || (part.kind == PartKind::spring && !part.is_loose);
}

void TunedSprings::tune(VariableId step_stiffness) {
  numbers_.begin(writer_.law().tune);
  ExpressionId sum = nothing;
  each_part([&](const BlockPart& part) {
    if (part.kind == PartKind::mesh) meshes_.at(&part).tune(given(part), rate());
  });
  each_part_of(0, [&](const BlockPart& part) {
    if (part.kind == PartKind::spring || part.kind == PartKind::relaxation) sum = writer_.plus(sum, answer_of(part));
  });
  assign(step_stiffness, or_zero(sum), "g of all that joins tool and ground without a slip");
  if (!tables_.has_slips()) return;
  for (std::size_t i = has_contact() ? 0 : 1; i < blocks_.size(); ++i) tune_block(i);
  slips_.tune(given_);
}

// g of a part over a sample.
ExpressionId TunedSprings::answer_of(const BlockPart& part) {
  switch (part.kind) {
    case PartKind::spring: break;
    case PartKind::damper: return writer_.multiply(given(part.damping), rate());
    case PartKind::relaxation: return writer_.multiply(stiffness_of(part), given(part.share));
    case PartKind::mesh: return meshes_.at(&part).stiffness();
  }
  return stiffness_of(part);
}

// g and b∞ of a block that is solved together with slips; the brake's command has the dampers of block 0 already.
void TunedSprings::tune_block(std::size_t index) {
  TunedBlock& block = blocks_[index];
  ExpressionId through = nothing;
  each_part_of(index, [&](const BlockPart& part) {
    block.stiffness = writer_.plus(block.stiffness, answer_of(part));
    if (part.kind == PartKind::damper) through = writer_.plus(through, given(part.damping));
    if (part.kind == PartKind::mesh) through = writer_.plus(through, meshes_.at(&part).feedthrough());
  });
  if (block.stiffness != nothing)
    block.stiffness = local_of(joined(block.name, "answer_alone"), writer_.stiffness(), block.stiffness);
  if (index == 0 || through == nothing || !head_.slip_rule.takes_part) return;
  block.feedthrough = numbers_.tuned(joined(block.name, "feedthrough"), writer_.damping(), "b∞ of the block", through);
}

void TunedSprings::carry_over() {
  numbers_.go_on(writer_.law().carry);
  if (is_behind_map()) begin_change();
  for (SpringNames& spring : springs_)
    if (spring.changes)
      spring.force = local(joined(spring.name, "force_before"), writer_.force(), force(spring, before(spring)), "");
  carry_forces_over();
  find_held();
}

// Behind a static curve several changes between two samples count as one, from the state before the first.
void TunedSprings::begin_change() {
  for (SpringNames& spring : springs_) {
    if (spring.sampled != nothing) assign(spring.elongation, read(spring.sampled), "");
    if (spring.sampled_offset != nothing) assign(spring.offset, read(spring.sampled_offset), "");
  }
  if (sampled_tank_ != nothing) assign(tank_, read(sampled_tank_), "");
}

void TunedSprings::keep_sampled() {
  for (SpringNames& spring : springs_) {
    if (spring.sampled != nothing) assign(spring.sampled, read(spring.elongation), "");
    if (spring.sampled_offset != nothing) assign(spring.sampled_offset, read(spring.offset), "");
    if (spring.carried != nothing) assign(spring.carried, spring.stiffness, "");
  }
  if (sampled_tank_ != nothing) assign(sampled_tank_, read(tank_), "");
}

// Stiffness or damping of a mesh's edges.
std::vector<ExpressionId> TunedSprings::given(const BlockPart& part) const {
  std::vector<ExpressionId> all;
  for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
    const MeshEdge& edge = tables_.edges[static_cast<std::size_t>(i)];
    all.push_back(edge.spring != no_index ? springs_[static_cast<std::size_t>(edge.spring)].stiffness
                                          : given_[static_cast<std::size_t>(edge.damping)]);
  }
  return all;
}

// Each force stays as it is, as far as the energy that springs and tank already hold allows. What forces that the motor
// still holds may need of the tank is not for that.
void TunedSprings::carry_forces_over() {
  ExpressionId whole = nothing, at_hand = nothing;
  if (!owed_.empty()) {
    whole = read(local("whole_tank", "J", read(tank_), ""));
    const ExpressionId rest = local_of("tank_less_owed", "J", writer_.subtract(whole, owed_after(0)));
    at_hand = local_of("tank_at_hand", "J", writer_.where(rest, rest, zero()));
    assign(tank_, at_hand, "the tank, but for what forces that are still held may need");
  }
  for (SpringNames& spring : springs_)
    if (spring.changes) is_behind_map() ? keep_force(spring) : keep_what_it_can(spring);
  for (SpringNames& spring : springs_)
    if (spring.changes)
      is_behind_map() ? soften(spring) : head_.acts_late ? pay_while_old_forces_act(spring) : pay_for_the_rest(spring);
  is_behind_map() ? find_stiffest_share() : make_up_for_others();
  each_part([&](const BlockPart& part) {
    each_spring(part, [&](SpringNames& spring) {
      if (spring.changes) keeps_offset(part) ? move_offset(spring) : move_end(spring);
    });
  });
  for (SpringNames& spring : springs_)
    if (spring.carried != nothing && !is_behind_map()) assign(spring.carried, spring.stiffness, "");
  if (!owed_.empty()) assign(tank_, writer_.add(whole, writer_.subtract(read(tank_), at_hand)), "");
}

ExpressionId TunedSprings::before(const SpringNames& spring) {
  return spring.carried == nothing ? spring.stiffness : read(spring.carried);
}

// A stiffer spring keeps its force, and what that sets free goes into the tank. A softer one keeps its energy, with
// F √(k′/k). Where commands act late, it keeps its elongation instead, with F k′/k: larger forces of before the change
// still act then, and what the spring loses pays for them. A stiffness that no parameter changes leaves both as they
// are.
void TunedSprings::keep_what_it_can(SpringNames& spring) {
  spring.kept = spring.force;
  if (spring.carried == nothing) return;
  const ExpressionId k = before(spring), next = spring.stiffness, f = read(spring.force);
  const ExpressionId left = writer_.divide(next, k);
  const ExpressionId softer = writer_.multiply(f, head_.acts_late ? left : writer_.square_root(left));
  spring.kept = local(joined(spring.name, "force_kept"), writer_.force(),
                      writer_.where(writer_.subtract(k, next), writer_.where(next, softer, zero()), f),
                      head_.acts_late ? "F, or F k′/k where the new stiffness k′ is lower"
                                      : "F, or F √(k′/k) where the new stiffness k′ is lower");
  const ExpressionId now = local_of(joined(spring.name, "energy_before"), "J", energy(f, k));
  spring.wanted_energy = local_of(joined(spring.name, "energy_after"), "J", energy(f, next));
  const ExpressionId freed =
      writer_.where(writer_.subtract(next, k), writer_.subtract(now, spring.wanted_energy), zero());
  const ExpressionId of_rise = writer_.add(read(tank_), freed);
  assign(tank_, head_.acts_late ? of_rise : writer_.add(of_rise, writer_.where(next, zero(), now)), "");
}

// For a spring that goes from k to a softer k′: raises its force from F k′/k towards F with the energy in the tank. F₊
// costs ½ k (F₊ − F k′/k)²/(k′ (k − k′)), which is what it stores more than before and what the larger force of before
// the change may give out at most while it still acts, whatever the tool does (theory, section 6).
void TunedSprings::pay_while_old_forces_act(SpringNames& spring) {
  if (spring.carried == nothing) return;
  const ExpressionId k = before(spring), next = spring.stiffness, f = read(spring.force), tank = read(tank_);
  const ExpressionId short_of =
      local_of(joined(spring.name, "force_short"), writer_.force(), writer_.subtract(f, read(spring.kept)));
  const ExpressionId differs = local_of(joined(spring.name, "falls_short"), writer_.force(),
                                        writer_.where(next, size_of(short_of, joined(spring.name, "short")), zero()));
  const ExpressionId twice =
      local_of(joined(spring.name, "stiffness_that_pays"), writer_.stiffness(),
               writer_.divide(writer_.multiply(writer_.multiply(two(), next), writer_.subtract(k, next)), k));
  const ExpressionId cost =
      local_of(joined(spring.name, "energy_missing"), "J", writer_.divide(writer_.multiply(short_of, short_of), twice));
  const ExpressionId paid =
      local_of(joined(spring.name, "force_paid"), writer_.force(), writer_.square_root(writer_.multiply(twice, tank)));
  const ExpressionId most = writer_.add(read(spring.kept), writer_.where(f, paid, writer_.multiply(minus_one(), paid)));
  raise_force(spring, differs, cost, most);
}

// Raises the kept force towards F as far as the energy in the tank allows.
void TunedSprings::pay_for_the_rest(SpringNames& spring) {
  if (spring.carried == nothing) return;
  const ExpressionId next = spring.stiffness, f = read(spring.force), kept = read(spring.kept), tank = read(tank_);
  const ExpressionId held = local_of(joined(spring.name, "energy_held"), "J", energy(kept, next));
  const ExpressionId cost =
      local_of(joined(spring.name, "energy_missing"), "J", writer_.subtract(spring.wanted_energy, held));
  const ExpressionId most =
      local_of(joined(spring.name, "force_most"), writer_.force(),
               writer_.square_root(writer_.multiply(writer_.multiply(two(), next), writer_.add(held, tank))));
  const ExpressionId differs =
      local_of(joined(spring.name, "falls_short"), writer_.force(),
               writer_.where(next, size_of(writer_.subtract(kept, f), joined(spring.name, "force_short")), zero()));
  raise_force(spring, differs, cost, writer_.where(f, most, writer_.multiply(minus_one(), most)));
}

// Where `differs` is above 0, to F if the tank has the energy that this costs, else to the most that it pays for.
void TunedSprings::raise_force(SpringNames& spring, ExpressionId differs, ExpressionId cost, ExpressionId most) {
  const ExpressionId f = read(spring.force), kept = read(spring.kept), tank = read(tank_);
  const ExpressionId unpaid = local_of(joined(spring.name, "energy_unpaid"), "J", writer_.subtract(cost, tank));
  const VariableId result = local(joined(spring.name, "force_after"), writer_.force(),
                                  writer_.where(differs, writer_.where(unpaid, most, f), kept),
                                  "F as before, as far as the energy in the tank allows");
  assign(tank_, writer_.where(differs, writer_.where(unpaid, zero(), writer_.subtract(tank, cost)), tank), "");
  spring.kept = result;
}

// Behind a static curve a stiffer spring keeps its force, and what that sets free goes into the tank.
void TunedSprings::keep_force(SpringNames& spring) {
  spring.kept = spring.force;
  if (spring.carried == nothing) return;
  const ExpressionId k = before(spring), next = spring.stiffness, f = read(spring.force);
  const ExpressionId now = local_of(joined(spring.name, "energy_before"), "J", energy(f, k));
  spring.wanted_energy = local_of(joined(spring.name, "energy_after"), "J", energy(f, next));
  const ExpressionId freed = writer_.subtract(now, spring.wanted_energy);
  assign(tank_, writer_.where(writer_.subtract(next, k), writer_.add(read(tank_), freed), read(tank_)), "");
}

// A softer spring keeps its force if the tank has enough energy for all of it, else its elongation.
void TunedSprings::soften(SpringNames& spring) {
  if (spring.carried == nothing) return;
  const ExpressionId k = before(spring), next = spring.stiffness, f = read(spring.force), tank = read(tank_);
  const ExpressionId softer =
      local_of(joined(spring.name, "is_softer"), writer_.stiffness(), writer_.subtract(k, next));
  const ExpressionId now = local_of(joined(spring.name, "energy_before"), "J", energy(f, k));
  const ExpressionId cost =
      local_of(joined(spring.name, "energy_missing"), "J", writer_.subtract(spring.wanted_energy, now));
  const ExpressionId unpaid =
      local_of(joined(spring.name, "energy_unpaid"), "J",
               writer_.where(next, writer_.where(writer_.subtract(cost, tank), one(), zero()), one()));
  const ExpressionId elongation =
      local_of(joined(spring.name, "elongation_before"), writer_.length(), writer_.divide(f, k));
  const ExpressionId left =
      local_of(joined(spring.name, "elongation_left"), writer_.length(),
               writer_.subtract(size_of(elongation, joined(spring.name, "elongation")), largest_change()));
  const ExpressionId freed = local_of(
      joined(spring.name, "energy_freed"), "J",
      writer_.where(left, writer_.divide(writer_.multiply(softer, writer_.multiply(left, left)), two()), zero()));
  spring.kept = local(joined(spring.name, "force_kept"), writer_.force(),
                      writer_.where(softer, writer_.where(unpaid, writer_.multiply(next, elongation), f), f),
                      "F as before if the tank has the energy for it, else F k′/k");
  const ExpressionId paid = writer_.where(unpaid, writer_.add(tank, freed), writer_.subtract(tank, cost));
  assign(tank_, writer_.where(softer, paid, tank), "");
}

void TunedSprings::find_stiffest_share() {
  if (stiffest_share_ == nothing) return;
  const ExpressionId k = static_spring()->stiffness;
  const ExpressionId most = numbers_.constant("largest_stiffness", writer_.stiffness(),
                                              "largest k of the static spring", head_.map.largest_stiffness);
  assign(stiffest_share_, writer_.where(k, writer_.divide(most, k), zero()), "");
}

ExpressionId TunedSprings::largest_change() {
  return numbers_.constant("largest_change", writer_.length(), "largest change of w while a force is held",
                           head_.map.largest_change);
}

// The spring between tool and ground takes over the force that others could not keep.
void TunedSprings::make_up_for_others() {
  SpringNames* spring = static_spring();
  if (spring == nullptr || !spring->changes) return;
  ExpressionId sum = nothing;
  each_part_of(0, [&](const BlockPart& part) {
    if (part.spring == no_index) return;
    const SpringNames& other = springs_[static_cast<std::size_t>(part.spring)];
    if (other.changes) sum = writer_.plus(sum, writer_.subtract(read(other.force), read(other.kept)));
  });
  const ExpressionId k = spring->stiffness, kept = read(spring->kept);
  const ExpressionId missing = local_of("missing_force", writer_.force(), or_zero(sum));
  const ExpressionId all = local_of("energy_at_hand", "J", writer_.add(energy(kept, k), read(tank_)));
  const ExpressionId most =
      local_of("most_force", writer_.force(), writer_.square_root(writer_.multiply(writer_.multiply(two(), k), all)));
  const ExpressionId wanted = local_of("wanted_force", writer_.force(), writer_.add(kept, missing));
  const ExpressionId lowest = local_of("least_force", writer_.force(), writer_.multiply(minus_one(), most));
  const ExpressionId within = local_of("made_up_force", writer_.force(),
                                       writer_.where(writer_.subtract(wanted, most), most,
                                                     writer_.where(writer_.subtract(lowest, wanted), lowest, wanted)));
  const ExpressionId is_missing =
      local_of("is_missing", writer_.force(), writer_.where(k, size_of(missing, "missing"), zero()));
  const ExpressionId rest = local_of("energy_left", "J", writer_.subtract(all, energy(within, k)));
  spring->kept = local(joined(spring->name, "force_made_up"), writer_.force(), writer_.where(is_missing, within, kept),
                       "F of the static spring, with what the others have lost");
  assign(tank_, writer_.where(is_missing, writer_.where(rest, rest, zero()), read(tank_)), "");
}

// Above zero where the force or the stiffness has changed.
ExpressionId TunedSprings::change_of(const SpringNames& spring) {
  const ExpressionId of_force =
      size_of(writer_.subtract(read(spring.kept), read(spring.force)), joined(spring.name, "force_change"));
  if (spring.carried == nothing) return of_force;
  const ExpressionId of_stiffness =
      size_of(writer_.subtract(spring.stiffness, read(spring.carried)), joined(spring.name, "stiffness_change"));
  return local_of(joined(spring.name, "is_changed"), "1", writer_.add(of_force, of_stiffness));
}

void TunedSprings::move_end(SpringNames& spring) {
  const ExpressionId changed = change_of(spring);
  const ExpressionId there =
      writer_.where(spring.stiffness, writer_.divide(read(spring.kept), spring.stiffness), zero());
  assign(spring.elongation, writer_.where(changed, there, read(spring.elongation)), "z = F/k");
}

// r = z − F/k, or 0 where that is no more than a rounding error of z.
void TunedSprings::move_offset(SpringNames& spring) {
  const ExpressionId changed = change_of(spring), z = read(spring.elongation);
  const ExpressionId offset =
      local_of(joined(spring.name, "offset_exact"), writer_.length(),
               writer_.where(spring.stiffness, writer_.subtract(z, writer_.divide(read(spring.kept), spring.stiffness)),
                             zero()));
  const ExpressionId quarter = writer_.constant("quarter", "1", "a quarter", Real(0.25), ConstantRole::plain_number);
  const ExpressionId seen = size_of(writer_.subtract(writer_.add(z, writer_.multiply(offset, quarter)), z),
                                    joined(spring.name, "offset_seen"));
  assign(spring.offset, writer_.where(changed, writer_.where(seen, offset, zero()), read(spring.offset)),
         "r = z − F/k");
}

void TunedSprings::tune_meshes(VariableId stiffness, VariableId feedthrough) {
  ExpressionId answer = nothing, through = nothing;
  each_part_of(0, [&](const BlockPart& part) {
    if (part.kind != PartKind::mesh) return;
    const TunedMesh& mesh = meshes_.at(&part);
    answer = writer_.plus(answer, writer_.subtract(mesh.stiffness(), writer_.multiply(mesh.feedthrough(), rate())));
    through = writer_.plus(through, mesh.feedthrough());
  });
  assign(stiffness, or_zero(answer), "g − b∞/h of the meshes");
  assign(feedthrough, or_zero(through), "b∞ of the meshes");
}

void TunedSprings::tune_viscosity(VariableId viscosity) {
  ExpressionId sum = nothing;
  each_part_of(0, [&](const BlockPart& part) {
    if (part.kind == PartKind::mesh) sum = writer_.plus(sum, meshes_.at(&part).viscosity(given(part)));
  });
  assign(viscosity, or_zero(sum), "zero-frequency damping of the meshes");
}

void TunedSprings::write_rest(ExpressionId position) {
  numbers_.begin(writer_.law().rest);
  if (const SpringNames* spring = static_spring()) assign(spring->elongation, position, "z = u");
  each_part_of(0, [&](const BlockPart& part) {
    if (part.kind == PartKind::mesh) stretch(part, meshes_.at(&part).loaded(given(part), position), false);
  });
  if (is_behind_map()) keep_sampled();
  assign(held_force_, held(0), "force if the tool stays");
}

ExpressionId TunedSprings::followed(ExpressionId surface, ExpressionId depth) {
  if (!sheds()) return surface;
  const ExpressionId gap = local_of("gap_behind", writer_.length(), writer_.subtract(surface, depth));
  const ExpressionId dent = read(dent_);
  const ExpressionId least = writer_.where(writer_.subtract(dent, gap), gap, dent);
  const VariableId returned =
      local("returned", writer_.length(), writer_.where(gap, writer_.where(dent, least, zero()), zero()),
            "the smaller of gap and dent");
  returned_ = writer_.kept(returned);
  return writer_.subtract(surface, read(returned));
}

ExpressionId TunedSprings::brought_home(ExpressionId force, ExpressionId position) {
  const SpringNames* spring = static_spring();
  if (shed_ == nothing || is_behind_map() || spring == nullptr) return force;
  const ExpressionId r = read(spring->offset);
  const ExpressionId middle = middle_of_nothing(r, position, joined(spring->name, "offset"));
  const VariableId now = local(joined(spring->name, "offset_now"), writer_.length(),
                               writer_.where(read(shed_), middle, r), "r: the median of 0, r and u");
  static_offset_now_ = writer_.kept(now);
  return writer_.add(force, writer_.multiply(spring->stiffness, writer_.subtract(r, read(now))));
}

void TunedSprings::write_update(ExpressionId change, ExpressionId position) {
  numbers_.begin(writer_.law().update);
  if (static_offset_now_ != nothing) assign(static_spring()->offset, read(static_offset_now_), "");
  if (!owed_.empty()) pay_what_is_owed(change);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const ExpressionId stretched = i == 0 ? change : slips_.elongation(i);
    each_part_of(i, [&](const BlockPart& part) { advance(part, stretched); });
  }
  if (sheds()) shed(position);
  else if (const SpringNames* spring = static_spring()) assign(spring->elongation, position, "z = u");
  if (is_behind_map()) let_go();
  bring_offsets_home();
  if (!owed_.empty()) remember_what_is_owed();
  if (is_behind_map()) keep_sampled();
  slips_.keep();
  find_held();
}

// The most that held forces may need of the tank from so many samples on.
ExpressionId TunedSprings::owed_after(std::size_t samples) {
  ExpressionId sum = nothing;
  for (std::size_t i = 0; i + samples < owed_.size(); ++i)
    sum = writer_.plus(sum, writer_.multiply(read(owed_[i]), change_in(owed_.size() - samples - i)));
  return sum;
}

// While the tool moves by Δ, the force that the motor holds too long may give out its size times |Δ|. That is taken
// from the tank, and what the coming samples may still need stays reserved in it.
void TunedSprings::pay_what_is_owed(ExpressionId change) {
  ExpressionId sum = nothing;
  for (const VariableId owed : owed_) sum = writer_.plus(sum, read(owed));
  const ExpressionId to_come = owed_after(1);
  const ExpressionId paid = writer_.multiply(sum, size_of(change, "owed_change"));
  assign(tank_, writer_.subtract(read(tank_), paid), "tank ← tank − Σ owed · |movement of the tool|");
  const ExpressionId rest = to_come == nothing ? read(tank_) : writer_.subtract(read(tank_), to_come);
  free_ = read(local("tank_free", "J", rest, ""));
}

void TunedSprings::remember_what_is_owed() {
  for (std::size_t i = owed_.size(); i-- > 1;) assign(owed_[i], read(owed_[i - 1]), "");
  assign(owed_[0], or_zero(newly_owed_), "k |r − r′| of the springs whose r has moved in this sample");
}

// The largest movement of the tool in so many samples.
ExpressionId TunedSprings::change_in(std::size_t samples) {
  const std::string name = samples == 1 ? "largest_change" : fmt::format("largest_change_of_{}", samples);
  return numbers_.constant(name, writer_.length(), "largest movement of the tool while a force is held",
                           double(samples) * head_.hold.change);
}

// Above 0 if the tank has too little energy for a move of an offset: `cost`, and what the force `jump`, which the motor
// still holds, may give out. Otherwise that is taken from the tank.
ExpressionId TunedSprings::unpaid(const SpringNames& spring, const char* what, ExpressionId cost, ExpressionId jump) {
  const auto called = [&](const char* of) { return joined(joined(spring.name, what), of); };
  if (owed_.empty()) {
    const ExpressionId lacking = local_of(called("unpaid"), "J", writer_.subtract(cost, read(tank_)));
    assign(tank_, writer_.where(lacking, read(tank_), writer_.subtract(read(tank_), cost)), "");
    return lacking;
  }
  const ExpressionId size = size_of(jump, called("jump"));
  if (head_.hold.rest > 0)
    cost =
        local_of(called("cost_held"), "J",
                 writer_.add(cost, writer_.multiply(size, numbers_.constant("change_after", writer_.length(),
                                                                            "movement of the tool after that, weighted "
                                                                            "by what the amplifier still holds",
                                                                            head_.hold.rest))));
  const ExpressionId whole =
      local_of(called("cost_at_most"), "J", writer_.add(cost, writer_.multiply(size, change_in(owed_.size()))));
  const ExpressionId lacking = local_of(called("unpaid"), "J", writer_.subtract(whole, free_));
  assign(tank_, writer_.where(lacking, read(tank_), writer_.subtract(read(tank_), cost)), "");
  free_ = local_of(joined(called("tank"), "free"), "J", writer_.where(lacking, free_, writer_.subtract(free_, whole)));
  newly_owed_ =
      writer_.plus(newly_owed_, local_of(called("owed"), writer_.force(), writer_.where(lacking, zero(), size)));
  return lacking;
}

void TunedSprings::advance(const BlockPart& part, ExpressionId change) {
  if (part.kind == PartKind::damper) return;
  if (part.kind == PartKind::mesh) return stretch(part, meshes_.at(&part).moved(change), true);
  SpringNames& spring = springs_[static_cast<std::size_t>(part.spring)];
  if (&spring == static_spring()) return;
  const ExpressionId z = read(spring.elongation);
  const ExpressionId way = part.kind == PartKind::spring ? change
                                                         : writer_.subtract(writer_.multiply(given(part.share), change),
                                                                            writer_.multiply(given(part.loss), z));
  assign(spring.elongation, writer_.flush(writer_.add(z, way)),
         part.kind == PartKind::spring ? "z ← z + δ" : "z ← z + φ δ − α z");
}

// Stretches the springs of a mesh by their elongations in a sample, from where they were or, with `goes_on` false, from
// 0.
void TunedSprings::stretch(const BlockPart& part, const std::vector<ExpressionId>& elongations, bool goes_on) {
  for (std::size_t i = 0; i < elongations.size(); ++i) {
    const MeshEdge& edge = tables_.edges[static_cast<std::size_t>(part.first_edge) + i];
    if (edge.spring == no_index) continue;
    const SpringNames& spring = springs_[static_cast<std::size_t>(edge.spring)];
    const ExpressionId z = goes_on ? writer_.add(read(spring.elongation), elongations[i]) : elongations[i];
    assign(spring.elongation, writer_.flush(z), goes_on ? "z ← z + δ" : "z = δ");
  }
}

// Multiplies all forces by the share that is kept.
void TunedSprings::shed(ExpressionId position) {
  const ExpressionId share = read(writer_.law().share);
  const ExpressionId binds = local_of("let_go", "1", writer_.subtract(one(), share));
  ExpressionId at = position;
  if (comes_back()) {
    assign(dent_, writer_.subtract(read(dent_), read(returned_)), "less what has come back");
    const ExpressionId left = writer_.multiply(share, writer_.subtract(position, read(dent_)));
    assign(dent_, writer_.where(binds, writer_.subtract(position, left), read(dent_)), "dent ← s − share (s − dent)");
    at = writer_.subtract(position, read(dent_));
  } else if (const SpringNames* spring = static_spring()) {
    assign(spring->elongation, at, "z = u");
  }
  each_part([&](const BlockPart& part) {
    each_spring(part, [&](SpringNames& spring) { shed(part, spring, share, binds); });
  });
  if (const SpringNames* spring = static_spring(); spring != nullptr && has_contact())
    assign(spring->elongation, at, "z = s − dent");
  if (shed_ != nothing) {
    assign(shed_, writer_.where(binds, one(), read(shed_)), "");
    for (SpringNames& spring : springs_)
      if (spring.offset != nothing && &spring != static_spring()) bring_shed_offset_home(spring);
  }
}

void TunedSprings::shed(const BlockPart& part, SpringNames& spring, ExpressionId share, ExpressionId binds) {
  const ExpressionId z = read(spring.elongation);
  const auto choose = [&](VariableId changed, ExpressionId value, const char* purpose) {
    assign(changed, writer_.where(binds, value, read(changed)), purpose);
  };
  if (has_contact()) {
    if (&spring != static_spring()) choose(spring.elongation, writer_.multiply(z, share), "z ← share z");
    if (spring.offset != nothing) choose(spring.offset, writer_.multiply(read(spring.offset), share), "r ← share r");
  } else if (keeps_offset(part)) {
    choose(spring.offset, writer_.subtract(z, writer_.multiply(share, writer_.subtract(z, read(spring.offset)))),
           "r ← z − share (z − r)");
  } else {
    choose(spring.elongation, writer_.multiply(share, z), "z ← share z");
  }
}

// The offset is no further from 0 than the spring's elongation: the median of 0, r and z.
void TunedSprings::bring_shed_offset_home(SpringNames& spring) {
  const ExpressionId r = read(spring.offset), z = read(spring.elongation);
  const ExpressionId middle = writer_.where(read(shed_), middle_of_nothing(r, z, joined(spring.name, "offset")), r);
  if (owed_.empty()) return assign(spring.offset, middle, "r: the median of 0, r and z");
  const ExpressionId home = local_of(joined(spring.name, "offset_home"), writer_.length(), middle);
  const ExpressionId jump = jump_of(spring, "turn_jump", r, home);
  const ExpressionId lacking = unpaid(spring, "turn", cost_of_jump(spring, jump, r, home), jump);
  assign(spring.offset, writer_.where(lacking, r, home),
         "r: the median of 0, r and z, if the tank has the energy for it");
}

// k (r − r′), of an offset that moves from r to r′.
ExpressionId TunedSprings::jump_of(const SpringNames& spring, const char* what, ExpressionId before,
                                   ExpressionId after) {
  const ExpressionId jump = writer_.multiply(spring.stiffness, writer_.subtract(before, after));
  return owed_.empty() ? jump : local_of(joined(spring.name, what), writer_.force(), jump);
}

// ½ k (z − r′)² − ½ k (z − r)², of an offset that moves from r to r′; `jump` is k (r − r′).
ExpressionId TunedSprings::cost_of_jump(const SpringNames& spring, ExpressionId jump, ExpressionId before,
                                        ExpressionId after) {
  const ExpressionId z = read(spring.elongation);
  const ExpressionId both = writer_.add(writer_.subtract(z, after), writer_.subtract(z, before));
  return writer_.multiply(writer_.multiply(jump, both), half());
}

ExpressionId TunedSprings::middle_of_nothing(ExpressionId x, ExpressionId y, const std::string& name) {
  const ExpressionId beyond = writer_.subtract(y, x);
  const ExpressionId least = local_of(joined(name, "least"), writer_.length(), writer_.where(beyond, x, y));
  const ExpressionId most = local_of(joined(name, "most"), writer_.length(), writer_.where(beyond, y, x));
  const ExpressionId below = writer_.subtract(zero(), most);
  return writer_.where(least, least, writer_.where(below, most, zero()));
}

// Behind a static curve: the static spring gives up the force beyond what it would hold with its largest stiffness and
// no offset, as soon as that sets free as much energy as the held command may give out meanwhile.
void TunedSprings::let_go() {
  SpringNames* spring = static_spring();
  if (spring == nullptr || spring->offset == nothing) return;
  const std::string& name = spring->name;
  const ExpressionId r = read(spring->offset), z = read(spring->elongation), k = spring->stiffness;
  const ExpressionId stretched = local_of(joined(name, "stretched"), writer_.length(), writer_.subtract(z, r));
  const ExpressionId stiffest =
      local_of(joined(name, "stiffest"), writer_.length(), writer_.multiply(read(stiffest_share_), z));
  const ExpressionId kept = local_of(joined(name, "stretch_kept"), writer_.length(),
                                     middle_of_nothing(stretched, stiffest, joined(name, "stretch")));
  const ExpressionId change = size_of(writer_.subtract(stretched, kept), joined(name, "stretch_change"));
  const ExpressionId both = size_of(writer_.add(stretched, kept), joined(name, "stretch_both"));
  const ExpressionId left = local_of(joined(name, "stretch_left"), writer_.length(),
                                     writer_.subtract(writer_.divide(both, two()), largest_change()));
  const ExpressionId too_early = local_of(joined(name, "too_early"), writer_.length(), writer_.subtract(zero(), left));
  const ExpressionId offset = size_of(r, joined(name, "offset_there"));
  const auto where_it_does = [&](ExpressionId then, ExpressionId otherwise) {
    return writer_.where(offset, writer_.where(change, writer_.where(too_early, otherwise, then), otherwise),
                         otherwise);
  };
  const ExpressionId freed = writer_.multiply(writer_.multiply(k, change), left);
  assign(tank_, where_it_does(writer_.add(read(tank_), freed), read(tank_)), "");
  assign(spring->offset, where_it_does(writer_.subtract(z, kept), r),
         "gives up the force beyond that of the largest k without r");
}

// Moves the offsets a part of the way back to 0, as far as the energy in the tank allows.
void TunedSprings::bring_offsets_home() {
  ExpressionId owed = nothing;
  for (SpringNames& spring : springs_) {
    if (spring.offset == nothing) continue;
    const ExpressionId r = read(spring.offset);
    const ExpressionId retention = numbers_.constant("retention", "1", "share of r that is left after a sample",
                                                     head_.retention, ConstantRole::retention);
    const ExpressionId after =
        local_of(joined(spring.name, "offset_after"), writer_.length(), writer_.flush(writer_.multiply(retention, r)));
    const ExpressionId jump = jump_of(spring, "offset_jump", r, after);
    ExpressionId whole = cost_of_jump(spring, jump, r, after);
    if (is_behind_map())
      whole = writer_.add(whole, writer_.multiply(size_of(jump, joined(spring.name, "offset_jump")), largest_change()));
    const ExpressionId cost = local_of(joined(spring.name, "offset_cost"), "J", whole);
    const ExpressionId lacking = unpaid(spring, "offset", cost, jump);
    assign(spring.offset, writer_.where(lacking, r, after), "r moves towards 0 if the tank has the energy for it");
    if (shed_ != nothing) owed = writer_.plus(owed, size_of(read(spring.offset), joined(spring.name, "offset_left")));
  }
  if (shed_ != nothing) assign(shed_, writer_.where(owed, read(shed_), zero()), "0 as soon as no r is left");
}

void TunedSprings::find_held() {
  assign(held_force_, held(0), "force if the tool stays");
  for (std::size_t i = 1; i < blocks_.size(); ++i)
    if (blocks_[i].held != nothing) assign(blocks_[i].held, held(i), "force if the block keeps its length");
}

// The force of a block that keeps its length, π; leaves meshes ready to be moved.
ExpressionId TunedSprings::held(std::size_t block) {
  ExpressionId sum = nothing;
  each_part_of(block, [&](const BlockPart& part) {
    if (part.kind == PartKind::damper) return;
    if (part.kind == PartKind::mesh) {
      std::vector<ExpressionId> forces;
      for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
        const int spring = tables_.edges[static_cast<std::size_t>(i)].spring;
        forces.push_back(spring == no_index ? nothing : force_of_edge(springs_[static_cast<std::size_t>(spring)]));
      }
      sum = writer_.plus(sum, meshes_.at(&part).held(forces));
      return;
    }
    const SpringNames& spring = springs_[static_cast<std::size_t>(part.spring)];
    ExpressionId part_force = force(spring, spring.stiffness);
    if (part.kind == PartKind::relaxation)
      part_force = writer_.subtract(
          part_force, writer_.multiply(spring.stiffness, writer_.multiply(given(part.loss), read(spring.elongation))));
    sum = writer_.plus(sum, part_force);
  });
  return or_zero(sum);
}

ExpressionId TunedSprings::force_of_edge(const SpringNames& spring) {
  return local_of(joined(spring.name, "force"), writer_.force(), force(spring, spring.stiffness));
}

void TunedSprings::write_energy() {
  numbers_.begin(writer_.law().energy);
  ExpressionId sum = tank_ == nothing ? ExpressionId(nothing) : read(tank_);
  for (const SpringNames& spring : springs_)
    sum = writer_.plus(sum,
                       writer_.multiply(writer_.multiply(force(spring, spring.stiffness), stretched(spring)), half()));
  assign(writer_.law().stored, or_zero(sum), "V + tank: in the springs, and set free by changes of parameters");
}

ExpressionId TunedSprings::stretched(const SpringNames& spring) {
  const ExpressionId z = read(spring.elongation);
  return spring.offset == nothing ? z : writer_.subtract(z, read(spring.offset));
}

ExpressionId TunedSprings::force(const SpringNames& spring, ExpressionId stiffness) {
  return writer_.multiply(stiffness, stretched(spring));
}

// F²/2k; nothing where there is no spring.
ExpressionId TunedSprings::energy(ExpressionId force, ExpressionId stiffness) {
  const ExpressionId all = writer_.multiply(force, writer_.divide(force, stiffness));
  return writer_.where(stiffness, writer_.divide(all, two()), zero());
}

void TunedSprings::assign(VariableId target, ExpressionId value, std::string purpose) {
  numbers_.assign(target, value, std::move(purpose));
}

VariableId TunedSprings::local(const std::string& name, const std::string& unit, ExpressionId value,
                               std::string purpose) {
  return numbers_.local(name, unit, value, std::move(purpose));
}

ExpressionId TunedSprings::local_of(const std::string& name, const std::string& unit, ExpressionId value) {
  return numbers_.named(name, unit, value);
}

// |x|, so that it is above zero where x is not zero.
ExpressionId TunedSprings::size_of(ExpressionId value, const std::string& name) {
  const ExpressionId x = local_of(name, "1", value);
  return local_of(joined(name, "size"), "1", writer_.where(x, x, writer_.subtract(zero(), x)));
}

}  // namespace dashpot::compiler
