// The springs, slips and tank of a law whose parameters change while it runs: what its programs call. Emitted code and
// the compiler's evaluate() run this same class, so that they agree in every bit under -ffp-contract=off.
//
// The states are elongations and offsets of springs (tunable/springs.hpp). V + T never rises by more than the work that
// the tool does, set() included.
//
// No heap, no recursion, no division but in set(), in reset() and between coupled slips; every loop is bounded by the
// tables.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/parts.hpp>
#include <dashpot/tunable/answers.hpp>
#include <dashpot/tunable/shedding.hpp>
#include <dashpot/tunable/slips.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Sizes are those of the tables, at least 1 each but for `Slips` and `Ends`. `SlipParts` and `Corners` are those of all
// couplings together, `Ends` those of the largest graph.
template <class Scalar, int Springs, int Nodes, int Blocks, int SlipParts, int Slips, int Corners, int Ends>
class tunable_law {
 public:
  using tables = tunable_tables<Scalar>;

  // All members get `t`, the same tables each time; set() before all others.

  // New numbers, between samples: stiffnesses, dampings and yield forces by their place. Where none changes no bit of
  // the states does. Returns g of all that joins tool and ground without a slip but for dampers and meshes [N/m].
  template <int Count>
  constexpr Scalar set(const tables& t, const Scalar (&numbers)[Count]) noexcept {
    return set(t, static_cast<const Scalar*>(numbers));
  }
  constexpr Scalar set(const tables& t, const Scalar* numbers) noexcept {
    parts_.springs.begin_change(t);
    parts_.take_numbers(t, numbers);
    const Scalar stiffness = find_curves(t, numbers);
    if constexpr (Slips > 0) slips_.tune(t, curves_, numbers);
    carry_forces_over(t);
    find_held(t);
    return stiffness;
  }

  // What set() has found of meshes without a slip.
  constexpr const tunable_meshes<Scalar>& meshes(const tables&) const noexcept { return meshes_; }

  // Of those the viscosity at low frequency [N·s/m].
  template <int Count>
  constexpr Scalar viscosity(const tables& t, const Scalar (&numbers)[Count]) noexcept {
    return viscosity(t, static_cast<const Scalar*>(numbers));
  }
  constexpr Scalar viscosity(const tables& t, const Scalar* numbers) noexcept {
    Scalar sum = 0;
    parts_.each(t, t.blocks[0], [&](const tunable_part& part) {
      if (part.kind == tunable_kind::mesh) sum += parts_.viscosity(t, part, numbers);
    });
    return sum;
  }

  // π of what joins tool and ground without a slip [N].
  constexpr Scalar held(const tables&) const noexcept { return curves_.held[0]; }

  // At rest at `position`: what joins tool and ground is loaded by it, what is behind a slip is not. Returns π [N].
  constexpr Scalar reset(const tables& t, Scalar position) noexcept {
    parts_.springs.reset(t.spring_count);
    for (Scalar& elongation : curves_.elongation) elongation = 0;
    if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.each(t, t.blocks[0], [&](const tunable_part& part) { parts_.load(t, part, position); });
    find_held(t);
    shedding_.reset();
    if constexpr (Slips > 0) slips_.reset();
    return curves_.held[0];
  }

  // After reset(): what slips leave to a brake that has `left` for them [N·s/m].
  constexpr Scalar resting_brake(const tables& t, Scalar left) noexcept {
    const Scalar damping = least(slips_.damping_at_rest(t, curves_), left);
    slips_.reset_brake(damping);
    return damping;
  }

  // Of all slips, by the tool's displacement in this sample: the force that opposes it [N].
  Scalar slip(const tables& t, Scalar change) noexcept { return slips_.step(t, change, curves_); }

  // The same of slips behind a surface, and all beside them: by what the surface's change would be if it stuck to the
  // tool.
  tunable_push<Scalar> push(const tables& t, Scalar approach) noexcept {
    tunable_push<Scalar> pushed = {};
    pushed.force = slips_.push(t, approach, curves_, pushed.change);
    return pushed;
  }

  // What slips leave to a brake that has `left` for them, after slip() or push(), by where the tool is.
  tunable_brake<Scalar> slip_brake(const tables& t, Scalar position, Scalar left) noexcept {
    const Scalar now = least(slips_.damping_now(t, curves_), left),
                 wanted = least(slips_.commanded_damping(t, curves_, position), left);
    return {now * t.rate, slips_.reached_damping(t, wanted), wanted};
  }

  // The motor's part within its limits, and of all forces the share that is kept for it.
  constexpr tunable_limit<Scalar> limit(const tables& t, Scalar wanted) noexcept {
    const Scalar force = shedding_.command(t, wanted);
    return {force, shedding_.share()};
  }

  // Where a surface that something elastic holds stands when what was shed of it has followed a tool that has left.
  constexpr Scalar follow(const tables&, Scalar surface, Scalar depth) noexcept {
    return shedding_.followed(surface, surface - depth);
  }

  // Takes the states over a sample, by the change of the tool, or of the surface that it pushes, and to its position.
  // Returns π of what joins tool and ground without a slip [N].
  Scalar update(const tables& t, Scalar change, Scalar position) noexcept {
    curves_.elongation[0] = change;
    for (int i = 0; i < t.block_count; ++i)
      parts_.each(t, t.blocks[i], [&](const tunable_part& part) { parts_.advance(t, part, curves_.elongation[i]); });
    if (shedding_.is_limited(t)) shed(t, position);
    else if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.springs.end_changes();
    if (t.map.is_there && t.static_spring != no_index) parts_.springs.let_go(t);
    parts_.springs.bring_offsets_home(t);
    if constexpr (Slips > 0) slips_.keep(t);
    find_held(t);
    return curves_.held[0];
  }

  // V + T [J]
  Scalar stored_energy(const tables& t) const noexcept { return parts_.springs.stored_energy(t.spring_count); }

 private:
  static constexpr Scalar least(Scalar one, Scalar other) noexcept { return one < other ? one : other; }

  // A surface that something elastic holds, and not slips alone, which stay where they are.
  static constexpr bool comes_back(const tables& t) noexcept {
    return t.contact.is_there && (t.static_spring != no_index || t.slip_count == 0);
  }

  // After the parts have advanced, by the share that output() has found.
  constexpr void shed(const tables& t, Scalar position) noexcept {
    const Scalar share = shedding_.share();
    const Scalar at = comes_back(t) ? position - shedding_.dented(position) : position;
    if (t.static_spring != no_index && !t.contact.is_there) parts_.springs.set_elongation(t.static_spring, at);
    for (int i = 0; i < t.part_count && share < 1; ++i) parts_.shed(t, t.parts[i], share);
    if (t.static_spring != no_index && t.contact.is_there) parts_.springs.set_elongation(t.static_spring, at);
    for (int i = 0; i < t.part_count && parts_.springs.has_shed(); ++i) parts_.bring_shed_offsets_home(t, t.parts[i]);
    shedding_.keep();
  }

  // g and b∞ of every block.
  constexpr Scalar find_curves(const tables& t, const Scalar* numbers) noexcept {
    Scalar springs = 0;
    meshes_ = {};
    for (int i = 0; i < t.block_count; ++i) {
      curves_.feedthrough[i] = curves_.stiffness[i] = 0;
      parts_.each(t, t.blocks[i], [&](const tunable_part& part) {
        const Scalar through = parts_.feedthrough(t, part, numbers),
                     stiffness = parts_.step_stiffness(t, part, numbers);
        curves_.feedthrough[i] += through;
        curves_.stiffness[i] += stiffness;
        if (i > 0 || part.kind == tunable_kind::damper) return;
        if (part.kind == tunable_kind::mesh) {
          meshes_.stiffness += stiffness - through * t.rate;
          meshes_.feedthrough += through;
        } else {
          springs += stiffness;
        }
      });
    }
    // Of what no slip changes the brake has been told already.
    curves_.feedthrough[0] = 0;
    return springs;
  }

  // p = g δ + π: π of every block, and what its meshes need to be spread.
  constexpr void find_held(const tables& t) noexcept {
    for (int i = 0; i < t.block_count; ++i) {
      Scalar held = 0;
      parts_.each(t, t.blocks[i], [&](const tunable_part& part) { held += parts_.held_by(t, part); });
      curves_.held[i] = held;
    }
  }

  // After a change of the springs' stiffnesses. The spring between tool and ground makes up for what others could not
  // keep, but not behind a static curve, where nothing may hold more than it did.
  constexpr void carry_forces_over(const tables& t) noexcept {
    parts_.springs.carry_over(t);
    if (t.static_spring != no_index && !t.map.is_there) {
      Scalar missing = 0;
      parts_.each(t, t.blocks[0], [&](const tunable_part& part) {
        if (part.spring != no_index) missing += parts_.springs.missing_force(part.spring);
      });
      if (missing != 0) parts_.springs.make_up_for(t.static_spring, missing);
    }
    for (int i = 0; i < t.part_count; ++i) parts_.take_forces(t, t.parts[i]);
  }

  tunable_parts<Scalar, Springs, Nodes> parts_;
  tunable_curves<Scalar, Blocks> curves_;
  tunable_slips<Scalar, Blocks, SlipParts, Slips, Corners, Ends> slips_;
  tunable_shedding<Scalar> shedding_;
  tunable_meshes<Scalar> meshes_ = {};
};

}  // namespace dashpot
