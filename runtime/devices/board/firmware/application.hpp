// What the firmware does, on any hardware: serves the host's frames, takes samples, runs the board's own model where it
// is asked to, and lets the supervisor decide what reaches motor and brake.
//
// Hardware is any type with
//     encoder_reading read_encoder() noexcept;
//     void drive(const outputs&) noexcept;               // motor and brake, at once
// or, with two axes, arm_reading and arm_outputs, and
//     void set_period(std::uint32_t nanoseconds) noexcept;
//     bool send(const encoded_frame&) noexcept;          // the whole frame or, with false, nothing of it
// and calls of pass_period() from its timer, at that period. One thread: no call from within an interrupt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include <dashpot/board/frame.hpp>
#include <dashpot/board/frame_decoder.hpp>
#include <dashpot/board/supervisor.hpp>

#include "encoder_reading.hpp"
#include "model_runner.hpp"

namespace dashpot::board {

// What a firmware states about its board at compile time.
template <unsigned Axes>
struct basic_board_facts {
  basic_description_message<Axes> description;             // model_period is filled in by the application
  one_each<float, brakes_of<Axes>> power_on_damping = {};  // until the host states another [N·m·s/rad] or [N·s/m]
  float arm_radius = 1;                                    // of the own model (model_runner.hpp) [m]
  one_each<velocity_description, Axes> velocity;           // of the own model
  std::uint32_t first_sample = 0;                          // its number: any will do, and all wrap around
};
using board_facts = basic_board_facts<1>;
using arm_board_facts = basic_board_facts<arm_axes>;

struct model_cost {
  std::uint32_t ticks = 0;  // of the board's clock
  std::uint32_t calls = 0;
};

template <class Hardware, class Model>
class application {
  using reading_type = decltype(std::declval<Hardware&>().read_encoder());
  static constexpr unsigned axes = reading_type::axes;
  using description_type = basic_description_message<axes>;
  using configure_type = basic_configure_message<axes>;
  using command_type = basic_command_message<axes>;

 public:
  application(Hardware& hardware, const basic_board_facts<axes>& facts, model_cost cost = {}) noexcept
      : hardware_(hardware),
        description_(with_model(facts.description)),
        cost_(cost),
        supervisor_(description_, facts.power_on_damping),
        runner_(facts.description.encoder_step, facts.velocity, facts.arm_radius),
        samples_sent_(facts.first_sample) {
    hardware_.drive(supervisor_.applied());
  }

  void receive(const std::uint8_t* bytes, std::size_t count) noexcept {
    for_each_frame(decoder_, bytes, count, [this](const frame& from) { serve(from); });
  }

  // The timer's period is over; `periods` of them where some were slept through.
  void pass_period(unsigned periods) noexcept {
    for (unsigned i = 0; i < periods; ++i) supervisor_.pass_period();
    hardware_.drive(supervisor_.applied());
    if (!free_running()) return;
    missed_periods_ += periods - 1;
    take_sample(periods);
  }

  const basic_supervisor<axes>& state() const noexcept { return supervisor_; }

 private:
  static description_type with_model(description_type facts) noexcept {
    facts.model_period = model_runner<Model, axes>::period;
    return facts;
  }

  bool free_running() const noexcept {
    return supervisor_.configured() && supervisor_.configuration().sampling == sampling::free_running;
  }

  // Frames that only a board sends are an echo, and those of another number of axes are not for this board: nothing to
  // do.
  void serve(const frame& from) noexcept {
    switch (from.type) {
      case message_type::hello: send(description_); break;
      case configure_type::type: configure(decode<configure_type>(from)); break;
      case message_type::reset: reset(decode<reset_message>(from)); break;
      case command_type::type: obey(from.sequence, decode<command_type>(from)); break;
      case message_type::ask_statistics: send(statistics()); break;
      default: break;
    }
  }

  void configure(const configure_type& wish) noexcept {
    const configured_message answer = supervisor_.configure(wish);
    hardware_.drive(supervisor_.applied());
    if (answer.verdict == verdict::accepted) hardware_.set_period(wish.period);
    runner_.forget();
    send(answer);
  }

  void reset(const reset_message& wish) noexcept {
    if (supervisor_.reset(wish)) runner_.restart();
    send_sample(hardware_.read_encoder());
  }

  void obey(std::uint32_t sequence, const command_type& wish) noexcept {
    if (!supervisor_.obey(sequence, wish)) return;
    hardware_.drive(supervisor_.applied());
    if (!free_running()) take_sample(1);
  }

  // `periods` after the one before. The command leaves before anything else is done with the sample.
  void take_sample(unsigned periods) noexcept {
    const reading_type reading = hardware_.read_encoder();
    const auto moved = runner_.watch(reading);
    if (supervisor_.running() && supervisor_.own_model()) {
      if (supervisor_.accept_move(moved.counts, periods)) {
        const auto answer = runner_.step(reading);
        supervisor_.obey_model(answer.wish, answer.speed);
      }
      hardware_.drive(supervisor_.applied());
    }
    send_sample(reading);
  }

  void send_sample(const reading_type& reading) noexcept {
    basic_sample_message<axes> sample;
    for (unsigned j = 0; j < axes; ++j) {
      nth(sample.counts, j) = nth(reading.counts, j);
      nth(sample.edge_time, j) = nth(reading.edge_time, j);
    }
    sample.timestamp = reading.timestamp;
    supervisor_.describe(sample);
    send(sample, samples_sent_++);
  }

  statistics_message statistics() const noexcept {
    const decoder_statistics& frames = decoder_.statistics();
    const sequence_statistics& commands = supervisor_.command_statistics();
    return {frames.received,
            frames.corrupted,
            frames.discarded_bytes,
            frames.foreign_version,
            commands.lost,
            commands.repeated,
            commands.late,
            dropped_,
            missed_periods_,
            cost_.ticks,
            cost_.calls};
  }

  template <class Message>
  void send(const Message& message, std::uint32_t sequence = 0) noexcept {
    if (!hardware_.send(encode(message, sequence))) ++dropped_;
  }

  Hardware& hardware_;
  description_type description_;
  model_cost cost_;
  basic_supervisor<axes> supervisor_;
  model_runner<Model, axes> runner_;
  frame_decoder decoder_;
  std::uint32_t samples_sent_;
  std::uint32_t dropped_ = 0;
  std::uint32_t missed_periods_ = 0;
};

}  // namespace dashpot::board
