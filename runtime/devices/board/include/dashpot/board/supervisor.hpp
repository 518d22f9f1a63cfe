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

struct outputs {
  float motor_torque = 0;   // along +q [N·m] or [N]
  float brake_damping = 0;  // [N·m·s/rad] or [N·s/m]
};

class supervisor {
 public:
  // `power_on_damping` is the safe damping until configure states another.
  constexpr supervisor(const description_message& facts, float power_on_damping) noexcept
      : facts_(facts), safe_{0, power_on_damping}, applied_(safe_) {}

  // A refused configuration leaves the board idle, and deaf to reset.
  constexpr configured_message configure(const configure_message& wish) noexcept {
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
  constexpr bool obey(std::uint32_t sequence, const command_message& wish) noexcept {
    const arrival came = commands_.note(sequence);
    if (came != arrival::fresh && came != arrival::anew) return false;
    if (state_ != board_state::running) return true;
    if (came == arrival::anew) return stop(board_state::safe, stop_cause::commands_anew), true;
    watchdog_.arm(wish_.watchdog_periods);
    if (!own_model()) apply({wish.motor_torque, wish.brake_damping}, stop_cause::bad_command);
    return true;
  }

  // The encoder has moved by `counts` within `periods` of the board's own model. False where that cannot be: the board
  // has stopped then. A quarter of the counter's range is as likely a wrap as a move, whatever the speed limit.
  constexpr bool accept_move(std::int32_t counts, unsigned periods) noexcept {
    constexpr std::int32_t unbelievable = 1 << 30;
    const float moved = static_cast<float>(counts < 0 ? -static_cast<std::int64_t>(counts) : counts);
    const float step = static_cast<float>(facts_.encoder_step);
    const float time = static_cast<float>(wish_.period) * 1e-9F * static_cast<float>(periods);
    const bool too_far = wish_.max_speed != 0 && !((moved - 1) * step <= wish_.max_speed * time);
    if (!too_far && counts < unbelievable && counts > -unbelievable) return true;
    if (state_ == board_state::running) stop(board_state::safe, stop_cause::encoder_jump);
    return false;
  }

  // What the board's own model asks for at `speed` [rad/s] or [m/s].
  constexpr void obey_model(outputs wish, float speed) noexcept {
    if (state_ != board_state::running || !own_model()) return;
    if (wish_.max_speed != 0 && !(speed <= wish_.max_speed && speed >= -wish_.max_speed)) {
      stop(board_state::safe, stop_cause::overspeed);
    } else {
      apply(wish, stop_cause::bad_model_command);
    }
  }

  // Once a period, whatever the state.
  constexpr void pass_period() noexcept {
    if (watchdog_.pass_period() && state_ == board_state::running) stop(board_state::safe, stop_cause::host_silent);
  }

  constexpr bool running() const noexcept { return state_ == board_state::running; }
  constexpr bool own_model() const noexcept { return wish_.controller == controller::own_model; }
  constexpr bool configured() const noexcept { return configured_; }
  constexpr const configure_message& configuration() const noexcept { return wish_; }
  constexpr const outputs& applied() const noexcept { return applied_; }
  constexpr const sequence_statistics& command_statistics() const noexcept { return commands_.statistics(); }

  constexpr void describe(sample_message& sample) const noexcept {
    sample.motor_torque = applied_.motor_torque;
    sample.brake_damping = applied_.brake_damping;
    sample.command_sequence = commands_.newest();
    sample.stops = stops_;
    sample.state = state_;
    sample.cause = cause_;
  }

 private:
  constexpr verdict judge(const configure_message& wish) const noexcept {
    if (!is_choice(wish)) return verdict::no_such_choice;
    if (wish.period < facts_.shortest_period) return verdict::period_too_short;
    if (!(wish.safe_damping >= 0 && wish.safe_damping <= facts_.max_damping)) return verdict::damping_out_of_range;
    if (!(wish.max_speed >= 0 && all_finite(wish.max_speed))) return verdict::speed_limit_wrong;
    if (wish.controller == controller::own_model) return judge_model(wish);
    return wish.watchdog_periods == 0 ? verdict::watchdog_needed : verdict::accepted;
  }

  // A model is certified for its own period: it cannot run at the pace of commands.
  static constexpr bool is_choice(const configure_message& wish) noexcept {
    if (wish.controller == controller::host) return wish.sampling <= sampling::free_running;
    return wish.controller == controller::own_model && wish.sampling == sampling::free_running;
  }

  constexpr verdict judge_model(const configure_message& wish) const noexcept {
    if (facts_.model_period == 0) return verdict::no_model;
    return wish.period == facts_.model_period ? verdict::accepted : verdict::model_period_differs;
  }

  constexpr void adopt(const configure_message& wish) noexcept {
    wish_ = wish;
    safe_.brake_damping = wish.safe_damping;
    applied_ = safe_;
    commands_.restart();
  }

  constexpr void stop(board_state into, stop_cause cause) noexcept {
    state_ = into;
    cause_ = cause;
    ++stops_;
    applied_ = safe_;
    watchdog_.arm(0);
  }

  constexpr void apply(outputs wish, stop_cause if_bad) noexcept {
    if (!all_finite(wish.motor_torque, wish.brake_damping, 0.0F)) {
      stop(board_state::safe, if_bad);
    } else {
      applied_ = {within(-facts_.max_torque, wish.motor_torque, facts_.max_torque),
                  within(0, wish.brake_damping, facts_.max_damping)};
    }
  }

  static constexpr float within(float low, float value, float high) noexcept {
    return value < low ? low : (value > high ? high : value);
  }

  description_message facts_;
  configure_message wish_;
  outputs safe_;
  outputs applied_;
  silence_watchdog watchdog_;
  sequence_tracker commands_;
  board_state state_ = board_state::idle;
  stop_cause cause_ = stop_cause::none;
  std::uint16_t stops_ = 0;
  bool configured_ = false;
};

}  // namespace dashpot::board
