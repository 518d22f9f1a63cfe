// The surface that a tool touches and leaves (theory, section 5, "Contact"), written into a law: where the surface goes
// in a sample, and when the command lets go.
//
// The state is the surface's displacement s from where it lies unloaded. The tool would have it change by Δ = u − at −
// s₋. With f(Δ) ≥ 0 it goes along; else it goes where f = 0, and a gap opens.
#pragma once

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// The brake's b of what is behind slips.
struct BrakeBehindSlips {
  ExpressionId changing = nothing;      // nothing where it does not change
  ExpressionId compensation = nothing;  // β, whose β v̂ the motor takes back; nothing without
  Real steady = 0;                      // of what does not [N·s/m]
  Real largest = 0;                     // of both together [N·s/m]
};

// While the tool touches.
struct CommandInTouch {
  ExpressionId felt;                      // by the tool [N]
  ExpressionId motor;                     // m [N]
  ExpressionId changing_brake = nothing;  // of b, what changes and what does not [N·s/m]
  Real steady_brake = 0;
};

class ContactSurface {
 public:
  // `encoder_step`: how far the gap may open before the command lets go [m].
  ContactSurface(LawWriter& writer, double at, double encoder_step);

  void declare();

  VariableId before() const { return surface_; }     // s₋
  VariableId approach() const { return approach_; }  // Δ
  VariableId depth() const { return depth_; }        // of the tool behind the unloaded surface
  VariableId change() const { return change_; }      // Δs
  VariableId now() const { return now_; }            // s
  VariableId released() const { return released_; }  // above 0 where the tool is free

  void write_approach();
  // For p = g δ + π: the surface's change. `held` is π, no variable for 0; the second is given −1/g.
  void write_change(const Real& stiffness, VariableId held);
  void write_change(ExpressionId recovery_compliance, VariableId held);
  // Where it is, its change being known.
  void write_surface();
  // The brake's b and the motor's part while the tool touches; both 0 when it is free. `opposing` is f′ = f − b∞ Δs/h,
  // also without what slips leave to the brake.
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
