// Springs and meshes while parameters change: their elongations, what set() does to their forces, and the tank of
// energy that limits it (theory, section 6). The tank holds the energy that changes of parameters have set free; a
// force may only be raised with energy from it. With the springs' energy V, V + tank never rises by more than the work
// that the tool does, set() included. Decisions become choices between two numbers, so that a sample takes the same
// steps whatever the values, except in the solvers of slips.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "discretise/tuned_block.hpp"
#include "discretise/tuned_mesh.hpp"
#include "discretise/tuned_numbers.hpp"
#include "discretise/tuned_slips.hpp"
#include "law/tunable_tables.hpp"

namespace dashpot::compiler {

class TunedSprings {
 public:
  // `numbers`: the expression of each number of the tables, followed by φ and α of relaxations. `held_force`: a state,
  // the force of all that joins tool and ground without a slip while the tool stays, π. Writer and tables must outlive
  // this object.
  TunedSprings(LawWriter& writer, const TunableTables& tables, std::vector<ExpressionId> numbers,
               VariableId held_force);

  // In set(): stiffness over one sample of the springs between tool and ground, and the numbers of meshes and slips.
  void tune(VariableId step_stiffness);
  // After that: for the meshes between tool and ground their stiffness over one sample without dampers, their b∞, and
  // their damping at low frequency.
  void tune_meshes(VariableId stiffness, VariableId feedthrough);
  void tune_viscosity(VariableId viscosity);
  // After all of those: keeps each force as far as energy allows, and computes the held forces again.
  void carry_over();

  // In output(), before the command is written: the force after the static spring's offset, if shedding has left one,
  // has been brought back to the tool's position where it lay beyond it.
  ExpressionId brought_home(ExpressionId force, ExpressionId position);
  // Also in output(): the place of a surface that shedding has pushed in, after it has followed a tool that left.
  ExpressionId followed(ExpressionId surface, ExpressionId depth);
  // Writes update() from the change and the place of the tool or, with a contact, of the surface.
  void write_update(ExpressionId change, ExpressionId position);
  // In reset(): loads what joins tool and ground with a position.
  void write_rest(ExpressionId position);
  void write_energy();

  TunedSlips& slips() { return slips_; }
  TunedNumbers& numbers() { return numbers_; }

 private:
  // What is known of a spring.
  struct SpringNames {
    std::string name;
    VariableId elongation = nothing;                         // z [m]
    VariableId offset = nothing;                             // r [m]; `nothing` if it is always 0
    VariableId carried = nothing;                            // k after the last change; `nothing` if it never changes
    VariableId sampled = nothing, sampled_offset = nothing;  // behind a static curve: z and r at the last sample
    ExpressionId stiffness = nothing;                        // k [N/m]
    bool changes = false;  // its force may change with the parameters: carried over by set()

    // During a change of parameters, in set().
    VariableId force = nothing, kept = nothing;
    ExpressionId wanted_energy = nothing;
  };

  void declare();
  void declare_blocks();
  VariableId state(const SpringNames& spring, const char* what, const std::string& unit, const char* meaning);
  bool sheds() const { return tables_.sheds(); }
  bool has_contact() const { return head_.contact.is_there; }
  // Whether a surface that was pushed in comes back: an elastic part brings it back, slips alone leave it there.
  bool comes_back() const { return has_contact() && (head_.static_spring != no_index || !tables_.has_slips()); }
  bool has_offsets() const;
  SpringNames* static_spring();
  static bool keeps_offset(const BlockPart& part);
  template <class Visit>
  void each_part(Visit visit) {
    for (const BlockPart& part : tables_.parts) visit(part);
  }
  template <class Visit>
  void each_part_of(std::size_t block, Visit visit) {
    const TunableBlock& parts = tables_.blocks[block];
    for (int i = parts.first_part; i < parts.first_part + parts.part_count; ++i)
      visit(tables_.parts[static_cast<std::size_t>(i)]);
  }
  template <class Visit>
  void each_spring(const BlockPart& part, Visit visit) {
    if (part.spring != no_index) visit(springs_[static_cast<std::size_t>(part.spring)]);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (const int spring = tables_.edges[static_cast<std::size_t>(i)].spring; spring != no_index)
        visit(springs_[static_cast<std::size_t>(spring)]);
  }
  ExpressionId given(int number) const { return given_[static_cast<std::size_t>(number)]; }
  ExpressionId answer_of(const BlockPart& part);
  void tune_block(std::size_t index);
  void begin_change();
  void keep_sampled();
  std::vector<ExpressionId> given(const BlockPart& part) const;
  ExpressionId stiffness_of(const BlockPart& part) { return springs_[static_cast<std::size_t>(part.spring)].stiffness; }
  void carry_forces_over();
  ExpressionId before(const SpringNames& spring);
  void keep_what_it_can(SpringNames& spring);
  void pay_for_the_rest(SpringNames& spring);
  void pay_while_old_forces_act(SpringNames& spring);
  void raise_force(SpringNames& spring, ExpressionId differs, ExpressionId cost, ExpressionId most);
  void keep_force(SpringNames& spring);
  void soften(SpringNames& spring);
  void find_stiffest_share();
  bool is_behind_map() const { return head_.map.is_there; }
  ExpressionId largest_change();
  void make_up_for_others();
  ExpressionId change_of(const SpringNames& spring);
  void move_end(SpringNames& spring);
  void move_offset(SpringNames& spring);
  void advance(const BlockPart& part, ExpressionId change);
  void stretch(const BlockPart& part, const std::vector<ExpressionId>& elongations, bool goes_on);
  void shed(ExpressionId position);
  void shed(const BlockPart& part, SpringNames& spring, ExpressionId share, ExpressionId binds);
  void bring_shed_offset_home(SpringNames& spring);
  ExpressionId middle_of_nothing(ExpressionId x, ExpressionId y, const std::string& name);
  void let_go();
  void bring_offsets_home();
  ExpressionId owed_after(std::size_t samples);
  void pay_what_is_owed(ExpressionId change);
  void remember_what_is_owed();
  ExpressionId change_in(std::size_t samples);
  ExpressionId unpaid(const SpringNames& spring, const char* what, ExpressionId cost, ExpressionId jump);
  ExpressionId jump_of(const SpringNames& spring, const char* what, ExpressionId before, ExpressionId after);
  ExpressionId cost_of_jump(const SpringNames& spring, ExpressionId jump, ExpressionId before, ExpressionId after);
  void find_held();
  ExpressionId held(std::size_t block);
  ExpressionId force_of_edge(const SpringNames& spring);
  ExpressionId stretched(const SpringNames& spring);
  ExpressionId force(const SpringNames& spring, ExpressionId stiffness);
  ExpressionId energy(ExpressionId force, ExpressionId stiffness);
  ExpressionId read(VariableId variable) { return writer_.read(variable); }
  void assign(VariableId target, ExpressionId value, std::string purpose);
  VariableId local(const std::string& name, const std::string& unit, ExpressionId value, std::string purpose);
  ExpressionId local_of(const std::string& name, const std::string& unit, ExpressionId value);
  ExpressionId size_of(ExpressionId value, const std::string& name);
  ExpressionId zero() { return numbers_.zero(); }
  ExpressionId one() { return numbers_.one(); }
  ExpressionId or_zero(ExpressionId value) { return value == nothing ? zero() : value; }
  ExpressionId minus_one() { return writer_.constant("minus_one", "1", "minus one", -1, ConstantRole::plain_number); }
  ExpressionId two() { return writer_.constant("two", "1", "two", 2, ConstantRole::plain_number); }
  ExpressionId half() { return writer_.constant("half", "1", "a half", Real(0.5), ConstantRole::plain_number); }
  ExpressionId rate() { return writer_.constant("rate", "Hz", "1/h", head_.rate, ConstantRole::sample_rate); }

  LawWriter& writer_;
  const TunableTables& tables_;
  const TunableHead& head_;
  TunedNumbers numbers_;
  std::vector<ExpressionId> given_;
  std::vector<SpringNames> springs_;
  std::map<const BlockPart*, TunedMesh> meshes_;
  std::vector<TunedBlock> blocks_;
  TunedSlips slips_;
  VariableId held_force_;
  VariableId tank_ = nothing, sampled_tank_ = nothing, stiffest_share_ = nothing, shed_ = nothing, dent_ = nothing,
             returned_ = nothing, static_offset_now_ = nothing;
  // Forces that the motor still holds although moves of offsets have taken them from the springs, one for each of the
  // last samples, the newest first; empty if that is not counted [N].
  std::vector<VariableId> owed_;
  ExpressionId free_ = nothing;  // in update(): energy in the tank that no coming sample can need
  ExpressionId newly_owed_ = nothing;
};

}  // namespace dashpot::compiler
