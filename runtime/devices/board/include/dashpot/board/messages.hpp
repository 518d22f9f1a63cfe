// What host and board say to each other, protocol version 1: the payloads of README.md, field by field in wire order.
//
// Everything is in the joints' own coordinates: [rad], [N·m], [N·m·s/rad] where motion is rotation, [m], [N], [N·s/m]
// where it is translation. Four messages hold one value for each joint and brake, and are messages of their own for a
// board of two axes; the others are the same for every board.
#pragma once

#include <cstddef>
#include <cstdint>

#include <dashpot/board/axes.hpp>
#include <dashpot/board/wire_scalars.hpp>
#include <dashpot/command.hpp>

namespace dashpot::board {

// Any two types differ in four bits or more (words of the extended Hamming code), and a type fixes the length: an error
// of up to three bits can never make one message look like another of a different length.
enum class message_type : std::uint8_t {
  hello = 0x0F,           // host → board
  configure = 0x33,       // host → board
  reset = 0x3C,           // host → board
  command = 0x55,         // host → board
  ask_statistics = 0x5A,  // host → board
  description = 0x96,     // board → host, answers hello
  configured = 0x99,      // board → host, answers configure
  sample = 0xA5,          // board → host, answers reset and, as configured, command or the board's clock
  statistics = 0xC3,      // board → host, answers ask_statistics
  // In place of those of the same name, with a board of two axes:
  arm_description = 0x66,
  arm_configure = 0x69,
  arm_command = 0xAA,
  arm_sample = 0xCC,
};

enum class sampling : std::uint8_t { on_command, free_running };

enum class controller : std::uint8_t { host, own_model };

// Idle and safe are alike to the hand: motor 0, brake at its safe damping.
enum class board_state : std::uint8_t { idle, running, safe };

enum class stop_cause : std::uint8_t {
  none,
  host_silent,
  bad_command,
  bad_model_command,
  overspeed,
  encoder_jump,   // further in a period than the speed limit permits, or than the counter can tell from a wrap
  commands_anew,  // the host's numbers began anew without a configure
};

enum class verdict : std::uint8_t {
  accepted,
  period_too_short,
  watchdog_needed,       // the host controls and asks for no watchdog
  damping_out_of_range,  // the safe damping is not within 0 … max_damping
  no_model,              // the firmware was built without one
  model_period_differs,
  no_such_choice,     // a sampling or controller not named here, or an own model sampled on command
  speed_limit_wrong,  // negative or not finite
};

struct hello_message {
  static constexpr message_type type = message_type::hello;
  template <class Self, class Visitor>
  static constexpr void fields(Self&, Visitor&&) noexcept {}
};

template <unsigned Axes>
struct basic_description_message {
  static constexpr message_type type = Axes == 1 ? message_type::description : message_type::arm_description;
  one_each<double, Axes> encoder_step = {};           // [rad] or [m] a count
  one_each<float, Axes> max_torque = {};              // [N·m] or [N]; infinite: unlimited
  one_each<float, brakes_of<Axes>> max_damping = {};  // [N·m·s/rad] or [N·s/m]; 0: there is no such brake
  std::uint32_t shortest_period = 0;                  // [ns]
  std::uint32_t model_period = 0;                     // of the board's own model [ns]; 0: it has none
  dashpot::motion motion = dashpot::motion::translation;
  char name[Axes == 1 ? 16 : 15] = {};  // of the firmware; filled up with zeros, not necessarily ended by one

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.encoder_step, m.max_torque, m.max_damping, m.shortest_period, m.model_period, m.motion, m.name);
  }
};

template <unsigned Axes>
struct basic_configure_message {
  static constexpr message_type type = Axes == 1 ? message_type::configure : message_type::arm_configure;
  std::uint32_t period = 0;                            // [ns]
  one_each<float, brakes_of<Axes>> safe_damping = {};  // [N·m·s/rad] or [N·s/m]
  one_each<float, Axes> max_speed = {};  // above it the board's own model is stopped [rad/s] or [m/s]; 0: none
  std::uint16_t watchdog_periods = 0;    // without a command, before the board goes safe; 0: never (own model only)
  board::sampling sampling = sampling::on_command;
  board::controller controller = controller::host;

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.period, m.safe_damping, m.max_speed, m.watchdog_periods, m.sampling, m.controller);
  }
};

struct configured_message {
  static constexpr message_type type = message_type::configured;
  board::verdict verdict = verdict::accepted;
  std::uint16_t stops = 0;  // what reset must quote

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.verdict, m.stops);
  }
};

// Quoting the number of the stop that it ends makes a reset harmless when it arrives twice or late.
struct reset_message {
  static constexpr message_type type = message_type::reset;
  std::uint16_t stops = 0;  // as last seen in a sample or in configured

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.stops);
  }
};

template <unsigned Axes>
struct basic_command_message {
  static constexpr message_type type = Axes == 1 ? message_type::command : message_type::arm_command;
  one_each<float, Axes> motor_torque = {};              // along +q [N·m] or [N]
  one_each<float, brakes_of<Axes>> brake_damping = {};  // [N·m·s/rad] or [N·s/m]

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.motor_torque, m.brake_damping);
  }
};

template <unsigned Axes>
struct basic_sample_message {
  static constexpr message_type type = Axes == 1 ? message_type::sample : message_type::arm_sample;
  std::uint64_t timestamp = 0;                          // board clock when the counts were taken [ns]
  one_each<std::uint64_t, Axes> edge_time = {};         // board clock at the newest encoder edge [ns]; 0: not measured
  one_each<std::int32_t, Axes> counts = {};             // encoder; wraps around
  one_each<float, Axes> motor_torque = {};              // in force from this sample on [N·m] or [N]
  one_each<float, brakes_of<Axes>> brake_damping = {};  // in force from this sample on [N·m·s/rad] or [N·s/m]
  std::uint32_t command_sequence = 0;                   // of the newest command, obeyed or not; 0 before the first
  std::uint16_t stops = 0;                              // how often the board has left running or was configured
  board_state state = board_state::idle;
  stop_cause cause = stop_cause::none;  // of the newest stop

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.timestamp, m.edge_time, m.counts, m.motor_torque, m.brake_damping, m.command_sequence, m.stops, m.state,
          m.cause);
  }
};

using description_message = basic_description_message<1>;
using configure_message = basic_configure_message<1>;
using command_message = basic_command_message<1>;
using sample_message = basic_sample_message<1>;
using arm_description_message = basic_description_message<arm_axes>;
using arm_configure_message = basic_configure_message<arm_axes>;
using arm_command_message = basic_command_message<arm_axes>;
using arm_sample_message = basic_sample_message<arm_axes>;

struct ask_statistics_message {
  static constexpr message_type type = message_type::ask_statistics;
  template <class Self, class Visitor>
  static constexpr void fields(Self&, Visitor&&) noexcept {}
};

// Counted since power-on and wrapping around.
struct statistics_message {
  static constexpr message_type type = message_type::statistics;
  std::uint32_t received = 0;         // intact frames
  std::uint32_t corrupted = 0;        // frames whose CRC was wrong
  std::uint32_t discarded_bytes = 0;  // bytes that belonged to no intact frame
  std::uint32_t foreign_version = 0;  // intact frames of another protocol version
  std::uint32_t lost = 0;             // commands that never came, by their sequence numbers
  std::uint32_t repeated = 0;         // commands that came again
  std::uint32_t late = 0;             // commands that came after a newer one
  std::uint32_t dropped = 0;          // own frames not sent because the stream was full
  std::uint32_t missed_periods = 0;   // periods in which the board took no sample though it should have
  std::uint32_t model_ticks = 0;      // board clock ticks that model_calls steps of the own model take
  std::uint32_t model_calls = 0;      // 0: not measured

  template <class Self, class Visitor>
  static constexpr void fields(Self& m, Visitor&& visit) noexcept {
    visit(m.received, m.corrupted, m.discarded_bytes, m.foreign_version, m.lost, m.repeated, m.late, m.dropped,
          m.missed_periods, m.model_ticks, m.model_calls);
  }
};

template <class Message>
constexpr std::size_t payload_size() noexcept {
  byte_counter counter;
  const Message message;
  Message::fields(message, counter);
  return counter.count();
}

inline constexpr std::size_t no_such_message = static_cast<std::size_t>(-1);

// Bytes of payload that a type byte stands for.
constexpr std::size_t payload_size(std::uint8_t type) noexcept {
  switch (static_cast<message_type>(type)) {
    case message_type::hello: return payload_size<hello_message>();
    case message_type::configure: return payload_size<configure_message>();
    case message_type::reset: return payload_size<reset_message>();
    case message_type::command: return payload_size<command_message>();
    case message_type::ask_statistics: return payload_size<ask_statistics_message>();
    case message_type::description: return payload_size<description_message>();
    case message_type::configured: return payload_size<configured_message>();
    case message_type::sample: return payload_size<sample_message>();
    case message_type::statistics: return payload_size<statistics_message>();
    case message_type::arm_description: return payload_size<arm_description_message>();
    case message_type::arm_configure: return payload_size<arm_configure_message>();
    case message_type::arm_command: return payload_size<arm_command_message>();
    case message_type::arm_sample: return payload_size<arm_sample_message>();
  }
  return no_such_message;
}

}  // namespace dashpot::board
