// What a board may do with its motor and brake: the state machine behind the protocol, on the board's side.
//
//     idle ── reset ──▶ running ── host silent, bad command, bad model command, overspeed ──▶ safe ── reset ──▶ running
//
// `configure` leads to idle from anywhere. Outside of running the motor makes nothing and the brake its safe damping.
// Only a reset that quotes the number of the newest stop leads to running: one that was sent for an earlier stop does
// nothing.
#pragma once

#include <cstdint>

#include <dashpot/board/messages.hpp>
#include <dashpot/board/sequence_tracker.hpp>
#include <dashpot/board/silence_watchdog.hpp>
#include <dashpot/command.hpp>

namespace dashpot::board {

template <unsigned Axes>
struct basic_outputs {
  one_each<float, Axes> motor_torque = {};              // along +q [N·m] or [N]
  one_each<float, brakes_of<Axes>> brake_damping = {};  // [N·m·s/rad] or [N·s/m]
};

template <unsigned Axes>
class basic_supervisor {
  static constexpr unsigned brakes = brakes_of<Axes>;
  using outputs = basic_outputs<Axes>;
  using wish_message = basic_configure_message<Axes>;
  using dampings = one_each<float, brakes>;

 public:
  // `power_on_damping` is the safe damping until configure states another.
  constexpr basic_supervisor(const basic_description_message<Axes>& facts, const dampings& power_on_damping) noexcept
      : facts_(facts) {
    be_safe_with(power_on_damping);
  }

  // A refused configuration leaves the board idle, and deaf to reset.
  constexpr configured_message configure(const wish_message& wish) noexcept {
    stop(board_state::idle, stop_cause::none);
    const verdict answer = judge(wish);
    configured_ = answer == verdict::accepted;
    if (configured_) adopt(wish);
    return {answer, stops_};
  }

  // True when it led to running.
  constexpr bool reset(const reset_message& wish) noexcept {
    if (!configured_ || state_ == board_state::running || wish.stops != stops_) return false;
    state_ = board_state::running;
    watchdog_.arm(own_model() ? wish_.watchdog_periods : 0);
    return true;
  }

  // True when the command is newer than all before: only such a one is obeyed and feeds the watchdog. A board that runs
  // its own model takes it as a sign of life and ignores its numbers.
  constexpr bool obey(std::uint32_t sequence, const basic_command_message<Axes>& wish) noexcept {
    const arrival came = commands_.note(sequence);
    if (came != arrival::fresh && came != arrival::anew) return false;
    if (state_ != board_state::running) return true;
    if (came == arrival::anew) return stop(board_state::safe, stop_cause::commands_anew), true;
    watchdog_.arm(wish_.watchdog_periods);
    if (!own_model()) apply(wish, stop_cause::bad_command);
    return true;
  }

  // The encoders have moved by `counts` within `periods` of the board's own model. False where that cannot be: the
  // board has stopped then.
  constexpr bool accept_move(const one_each<std::int32_t, Axes>& counts, unsigned periods) noexcept {
    for (unsigned j = 0; j < Axes; ++j) {
      if (can_move(j, nth(counts, j), periods)) continue;
      if (state_ == board_state::running) stop(board_state::safe, stop_cause::encoder_jump);
      return false;
    }
    return true;
  }

  // What the board's own model asks for at `speed` [rad/s] or [m/s].
  constexpr void obey_model(const outputs& wish, const one_each<float, Axes>& speed) noexcept {
    if (state_ != board_state::running || !own_model()) return;
    for (unsigned j = 0; j < Axes; ++j) {
      const float limit = nth(wish_.max_speed, j);
      if (limit != 0 && !(nth(speed, j) <= limit && nth(speed, j) >= -limit))
        return stop(board_state::safe, stop_cause::overspeed);
    }
    apply(wish, stop_cause::bad_model_command);
  }

  // Once a period, whatever the state.
  constexpr void pass_period() noexcept {
    if (watchdog_.pass_period() && state_ == board_state::running) stop(board_state::safe, stop_cause::host_silent);
  }

  constexpr bool running() const noexcept { return state_ == board_state::running; }
  constexpr bool own_model() const noexcept { return wish_.controller == controller::own_model; }
  constexpr bool configured() const noexcept { return configured_; }
  constexpr const wish_message& configuration() const noexcept { return wish_; }
  constexpr const outputs& applied() const noexcept { return applied_; }
  constexpr const sequence_statistics& command_statistics() const noexcept { return commands_.statistics(); }

  constexpr void describe(basic_sample_message<Axes>& sample) const noexcept {
    for (unsigned j = 0; j < Axes; ++j) nth(sample.motor_torque, j) = nth(applied_.motor_torque, j);
    for (unsigned i = 0; i < brakes; ++i) nth(sample.brake_damping, i) = nth(applied_.brake_damping, i);
    sample.command_sequence = commands_.newest();
    sample.stops = stops_;
    sample.state = state_;
    sample.cause = cause_;
  }

 private:
  // A quarter of the counter's range is as likely a wrap as a move, whatever the speed limit.
  constexpr bool can_move(unsigned joint, std::int32_t counts, unsigned periods) const noexcept {
    constexpr std::int32_t unbelievable = 1 << 30;
    const float limit = nth(wish_.max_speed, joint);
    const float moved = static_cast<float>(counts < 0 ? -static_cast<std::int64_t>(counts) : counts);
    const float step = static_cast<float>(nth(facts_.encoder_step, joint));
    const float time = static_cast<float>(wish_.period) * 1e-9F * static_cast<float>(periods);
    const bool too_far = limit != 0 && !((moved - 1) * step <= limit * time);
    return !too_far && counts < unbelievable && counts > -unbelievable;
  }

  constexpr verdict judge(const wish_message& wish) const noexcept {
    if (!is_choice(wish)) return verdict::no_such_choice;
    if (wish.period < facts_.shortest_period) return verdict::period_too_short;
    for (unsigned i = 0; i < brakes; ++i) {
      const float damping = nth(wish.safe_damping, i);
      if (!(damping >= 0 && damping <= nth(facts_.max_damping, i))) return verdict::damping_out_of_range;
    }
    for (unsigned j = 0; j < Axes; ++j) {
      const float limit = nth(wish.max_speed, j);
      if (!(limit >= 0 && all_finite(limit))) return verdict::speed_limit_wrong;
    }
    if (wish.controller == controller::own_model) return judge_model(wish);
    return wish.watchdog_periods == 0 ? verdict::watchdog_needed : verdict::accepted;
  }

  // A model is certified for its own period: it cannot run at the pace of commands.
  static constexpr bool is_choice(const wish_message& wish) noexcept {
    if (wish.controller == controller::host) return wish.sampling <= sampling::free_running;
    return wish.controller == controller::own_model && wish.sampling == sampling::free_running;
  }

  constexpr verdict judge_model(const wish_message& wish) const noexcept {
    if (facts_.model_period == 0) return verdict::no_model;
    return wish.period == facts_.model_period ? verdict::accepted : verdict::model_period_differs;
  }

  constexpr void adopt(const wish_message& wish) noexcept {
    wish_ = wish;
    be_safe_with(wish.safe_damping);
    commands_.restart();
  }

  constexpr void be_safe_with(const dampings& damping) noexcept {
    for (unsigned i = 0; i < brakes; ++i) nth(safe_.brake_damping, i) = nth(damping, i);
    applied_ = safe_;
  }

  constexpr void stop(board_state into, stop_cause cause) noexcept {
    state_ = into;
    cause_ = cause;
    ++stops_;
    applied_ = safe_;
    watchdog_.arm(0);
  }

  // `wish` is a command of the host, or outputs of the own model.
  template <class Wish>
  constexpr void apply(const Wish& wish, stop_cause if_bad) noexcept {
    if (!is_finite(wish)) return stop(board_state::safe, if_bad);
    for (unsigned j = 0; j < Axes; ++j) {
      const float most = nth(facts_.max_torque, j);
      nth(applied_.motor_torque, j) = within(-most, nth(wish.motor_torque, j), most);
    }
    for (unsigned i = 0; i < brakes; ++i)
      nth(applied_.brake_damping, i) = within(0, nth(wish.brake_damping, i), nth(facts_.max_damping, i));
  }

  template <class Wish>
  static constexpr bool is_finite(const Wish& wish) noexcept {
    bool finite = true;
    for (unsigned j = 0; j < Axes; ++j) finite = finite && all_finite(nth(wish.motor_torque, j));
    for (unsigned i = 0; i < brakes; ++i) finite = finite && all_finite(nth(wish.brake_damping, i));
    return finite;
  }

  static constexpr float within(float low, float value, float high) noexcept {
    return value < low ? low : (value > high ? high : value);
  }

  basic_description_message<Axes> facts_;
  wish_message wish_;
  outputs safe_;
  outputs applied_;
  silence_watchdog watchdog_;
  sequence_tracker commands_;
  board_state state_ = board_state::idle;
  stop_cause cause_ = stop_cause::none;
  std::uint16_t stops_ = 0;
  bool configured_ = false;
};

using outputs = basic_outputs<1>;
using supervisor = basic_supervisor<1>;
using arm_outputs = basic_outputs<arm_axes>;
using arm_supervisor = basic_supervisor<arm_axes>;

}  // namespace dashpot::board
