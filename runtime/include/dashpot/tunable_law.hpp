// A law whose parameters change while it runs. Emitted code and the compiler's evaluate() run this same class, so that
// they agree in every bit under -ffp-contract=off.
//
// The states are elongations and offsets of springs (tunable/springs.hpp). V + T never rises by more than the work that
// the tool does, set() included.
//
// No heap, no recursion, no division but in set(), in reset() and between coupled slips; every loop is bounded by the
// tables.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/parts.hpp>
#include <dashpot/tunable/sample.hpp>
#include <dashpot/tunable/shedding.hpp>
#include <dashpot/tunable/slips.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Sizes are those of the tables, at least 1 each but for `Slips` and `Ends`. `SlipParts` and `Corners` are those of all
// couplings together, `Ends` those of the largest graph.
template <class Scalar, int Tunables, int Springs, int Nodes, int Blocks, int SlipParts, int Slips, int Corners,
          int Ends>
class tunable_law {
 public:
  using tables = tunable_tables<Scalar>;

  // All members get `t`, the tables that the law was made with.
  explicit constexpr tunable_law(const tables& t) noexcept {
    if constexpr (Slips > 0) slips_.begin(t);
    parts_.values.begin_at_largest(t);
    tune(t);
    if constexpr (Slips > 0) slips_.remember_largest(t, curves_, numbers(t));
    parts_.values.begin(t);
    tune(t);
    find_held(t);
    if constexpr (Slips > 0) slips_.reset(left_to_brake(t, slips_.damping_at_rest(t, curves_)));
  }

  // At rest at `position`: what joins tool and ground is loaded by it, what is behind a slip is not.
  constexpr void reset(const tables& t, Scalar position) noexcept {
    parts_.springs.reset(t.spring_count);
    for (Scalar& elongation : curves_.elongation) elongation = 0;
    if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) { parts_.load(t, part, position); });
    find_held(t);
    shedding_.reset();
    if constexpr (Slips > 0) slips_.reset(left_to_brake(t, slips_.damping_at_rest(t, curves_)));
  }

  // b of a tool that is in touch and at rest [N·s/m].
  constexpr Scalar damping_at_rest(const tables& t) noexcept {
    if (t.contact.is_there) return 0;
    Scalar damping = damping_;
    if constexpr (Slips > 0) damping += left_to_brake(t, slips_.damping_at_rest(t, curves_));
    return damping;
  }

  // In: where the tool, or the surface that it pushes, was in the sample before; where the tool is, and its velocity.
  tunable_sample<Scalar> output(const tables& t, Scalar last, Scalar position, Scalar velocity) noexcept {
    tunable_sample<Scalar> sample = wanted(t, last, position, velocity);
    if (!shedding_.is_limited(t)) return sample;
    sample.force = shedding_.command(t, sample.wanted);
    if (comes_back(t))
      sample.position = shedding_.followed(sample.position, sample.position - (position - t.contact.at));
    return sample;
  }

  // Takes the states over the sample that output() has seen last, by its change and to its position.
  void update(const tables& t, Scalar change, Scalar position) noexcept {
    curves_.elongation[0] = change;
    for (int i = 0; i < t.block_count; ++i)
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { parts_.advance(t, part, curves_.elongation[i]); });
    if (shedding_.is_limited(t)) shed(t, position);
    else if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.springs.bring_offsets_home(t);
    if constexpr (Slips > 0) slips_.keep(t);
    find_held(t);
  }

  // Of all forces, what the last output() has kept for the motor to be able to follow.
  constexpr Scalar kept_share() const noexcept { return shedding_.share(); }

  // Bit i of the result: wanted[i] was no number within the range. What is no number at all leaves its parameter as it
  // is. Where nothing changes, no bit of the states does. To be called between samples.
  constexpr unsigned set(const tables& t, const Scalar* wanted) noexcept {
    const auto change = parts_.values.take(t, wanted);
    if (!change.is_new) return change.clamped;
    parts_.springs.begin_change(t.spring_count);
    tune(t);
    carry_forces_over(t);
    find_held(t);
    return change.clamped;
  }

  // V + T [J]
  Scalar stored_energy(const tables& t) const noexcept { return parts_.springs.stored_energy(t.spring_count); }

  Scalar value(int tunable) const noexcept { return parts_.values.value(tunable); }

 private:
  constexpr auto numbers(const tables& t) const noexcept {
    return [this, &t](int index) { return parts_.number(t, index); };
  }

  // Were there no limits of the motor.
  tunable_sample<Scalar> wanted(const tables& t, Scalar last, Scalar position, Scalar velocity) noexcept {
    tunable_answer<Scalar> answer = {0, velocity_gain_, damping_};
    if (!t.contact.is_there) {
      const Scalar change = position - last;
      answer.opposing = step_stiffness_ * change + curves_.held[0];
      if constexpr (Slips > 0) {
        answer.opposing += slips_.step(t, change, curves_);
        leave_to_brake(t, change, position, answer);
      }
      return held_sample(change, position, velocity, answer);
    }
    const Scalar depth = position - t.contact.at, approach = depth - last;
    Scalar change = -(curves_.held[0] * release_compliance_);
    if (!(change > approach)) change = approach;
    if (t.slip_count == 0) answer.opposing = step_stiffness_ * change + curves_.held[0];
    if constexpr (Slips > 0)
      if (t.slip_count > 0) {
        answer.opposing = slips_.push(t, approach, curves_, change);  // which sets `change`
        answer.opposing -= feedthrough_ * t.rate * change;
        leave_to_brake(t, change, position, answer);
      }
    return touching_sample(t.contact, t.threshold, last, depth, change, velocity, answer);
  }

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

  // Of b∞ behind slips, what the brake has left.
  constexpr Scalar left_to_brake(const tables& t, Scalar damping) const noexcept {
    if (!t.slip_rule.takes_part) return 0;
    const Scalar left = t.max_damping - damping_;
    return damping < left ? damping : left;
  }

  void leave_to_brake(const tables& t, Scalar change, Scalar position, tunable_answer<Scalar>& answer) noexcept {
    if (!t.slip_rule.takes_part) return;
    answer.opposing -= left_to_brake(t, slips_.damping_now(t, curves_)) * t.rate * change;
    const Scalar wanted = left_to_brake(t, slips_.commanded_damping(t, curves_, position)),
                 damping = slips_.reached_damping(t, wanted);
    answer.damping += damping;
    if (!t.contact.is_there) answer.gain += clamp_to(make_up_, wanted - damping);
  }

  // Everything that follows from the parameters.
  constexpr void tune(const tables& t) noexcept {
    parts_.find_stiffnesses(t);
    tune_brake(t);
    for (int i = 1; i < t.block_count; ++i) {
      curves_.feedthrough[i] = 0;
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { curves_.feedthrough[i] += parts_.feedthrough(t, part); });
    }
    // Last, so that every mesh is left as the steps need it.
    for (int i = 0; i < t.block_count; ++i) {
      curves_.stiffness[i] = 0;
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { curves_.stiffness[i] += parts_.step_stiffness(t, part); });
    }
    release_compliance_ = curves_.stiffness[0] > 0 ? 1 / curves_.stiffness[0] : Scalar(0);
    step_stiffness_ = 0;
    parts_.each(t, t.blocks[0],
                [&](const tunable_part<Scalar>& part) { step_stiffness_ += parts_.step_stiffness_at_port(t, part); });
    if constexpr (Slips > 0) slips_.tune(t, curves_, numbers(t));
  }

  constexpr void tune_brake(const tables& t) noexcept {
    feedthrough_ = 0;
    Scalar relaxing = 0;
    parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
      const Scalar through = parts_.feedthrough(t, part);
      feedthrough_ += through;
      relaxing += parts_.relaxing_damping(t, part, through);
    });
    const Scalar wanted = brake_damping(t, feedthrough_ + relaxing);
    damping_ = wanted < t.max_damping ? wanted : t.max_damping;
    // Where a surface can be left the motor compensates nothing.
    if (t.contact.is_there && damping_ > feedthrough_) damping_ = feedthrough_;
    velocity_gain_ = feedthrough_ - damping_;
    const Scalar assured =
        t.slip_rule.assured_share * damping_ - (velocity_gain_ < 0 ? -velocity_gain_ : velocity_gain_);
    make_up_ = assured > 0 ? assured : Scalar(0);
  }

  constexpr Scalar brake_damping(const tables& t, Scalar zero_frequency) const noexcept {
    switch (t.rule) {
      case brake_rule::constant: break;
      case brake_rule::observed: return parts_.number(t, t.observed);
      case brake_rule::zero_frequency: return zero_frequency;
      case brake_rule::half_zero_frequency:
        return zero_frequency / 2 > feedthrough_ ? zero_frequency / 2 : feedthrough_;
      case brake_rule::feedthrough: return feedthrough_;
      case brake_rule::within_viscosity: return zero_frequency < t.damping ? zero_frequency : t.damping;
    }
    return t.damping;
  }

  // p = g δ + π: π of every block, and what its meshes need to be spread.
  constexpr void find_held(const tables& t) noexcept {
    for (int i = 0; i < t.block_count; ++i) {
      Scalar held = 0;
      parts_.each(t, t.blocks[i], [&](const tunable_part<Scalar>& part) { held += parts_.held_by(t, part); });
      curves_.held[i] = held;
    }
  }

  // After a change of the springs' stiffnesses. The spring between tool and ground makes up for what others could not
  // keep.
  constexpr void carry_forces_over(const tables& t) noexcept {
    parts_.springs.carry_over(t.spring_count);
    if (t.static_spring != no_index) {
      Scalar missing = 0;
      parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
        if (part.spring != no_index) missing += parts_.springs.missing_force(part.spring);
      });
      if (missing != 0) parts_.springs.make_up_for(t.static_spring, missing);
    }
    for (int i = 0; i < t.part_count; ++i) parts_.take_forces(t, t.parts[i]);
  }

  tunable_parts<Scalar, Tunables, Springs, Nodes> parts_;
  tunable_curves<Scalar, Blocks> curves_;
  tunable_slips<Scalar, Blocks, SlipParts, Slips, Corners, Ends> slips_;
  tunable_shedding<Scalar> shedding_;
  Scalar step_stiffness_ = 0;                                 // g of block 0 without b∞/h [N/m]
  Scalar release_compliance_ = 0;                             // 1/g of block 0 [m/N]
  Scalar feedthrough_ = 0, damping_ = 0, velocity_gain_ = 0;  // b∞, b, b∞ − b, without slips [N·s/m]
  Scalar make_up_ = 0;                                        // of b that the motor makes up at most [N·s/m]
};

}  // namespace dashpot
