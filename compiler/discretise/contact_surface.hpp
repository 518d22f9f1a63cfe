// The surface that a tool touches and leaves (theory, section 5, "Contact"), written into a law: where the surface goes
// in a sample, and when the command ends.
//
// The state is the surface's displacement s from where it lies unloaded, s₋ the one of the sample before. Stuck to the
// tool, it would change by Δ = u − at − s₋. If the force f(Δ) ≥ 0, it does; else it goes to where f = 0, and a gap
// opens.
#pragma once

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// The part of the brake's b that belongs to the elements behind slips.
struct BrakeBehindSlips {
  ExpressionId changing = nothing;      // the part that changes; `nothing` if none does
  ExpressionId compensation = nothing;  // β: the motor takes β v̂ back; `nothing` if there is none
  Real steady = 0;                      // the part that does not change [N·s/m]
  Real largest = 0;                     // the largest sum of both [N·s/m]
};

// The command while the tool touches.
struct CommandInTouch {
  ExpressionId felt;                      // force that the tool feels [N]
  ExpressionId motor;                     // m, force of the motor [N]
  ExpressionId changing_brake = nothing;  // the part of b that changes [N·s/m]
  Real steady_brake = 0;                  // the part that does not [N·s/m]
};

class ContactSurface {
 public:
  // `encoder_step`: the largest gap at which the command goes on [m].
  ContactSurface(LawWriter& writer, double at, double encoder_step);

  void declare();

  VariableId before() const { return surface_; }     // s₋
  VariableId approach() const { return approach_; }  // Δ
  VariableId depth() const { return depth_; }        // how far the tool is beyond the unloaded surface
  VariableId change() const { return change_; }      // Δs
  VariableId now() const { return now_; }            // s
  VariableId released() const { return released_; }  // above 0 where the tool is free

  void write_approach();
  // The surface's change, if what is behind it has the force g Δs + π. `held` is π, no variable for 0; the second is
  // given −1/g.
  void write_change(const Real& stiffness, VariableId held);
  void write_change(ExpressionId recovery_compliance, VariableId held);
  // The surface's new place, after write_change().
  void write_surface();
  // The brake's b and the motor's part while the tool touches; both 0 when it is free. `opposing` is f′ = f − b∞ Δs/h,
  // less the part that the brake makes behind slips.
  void write_command(VariableId opposing, const Real& feedthrough_damping, const BrakeBehindSlips& slips);
  void write_command(VariableId opposing, const CommandInTouch& touching);

 private:
  ExpressionId depth_now();
  void write_start();
  ExpressionId none();
  ExpressionId release_of(VariableId opposing, ExpressionId felt, ExpressionId none);

  LawWriter& writer_;
  double at_, encoder_step_;
  VariableId surface_ = nothing, depth_ = nothing, approach_ = nothing, change_ = nothing, gap_ = nothing,
             now_ = nothing, released_ = nothing;
};

}  // namespace dashpot::compiler
