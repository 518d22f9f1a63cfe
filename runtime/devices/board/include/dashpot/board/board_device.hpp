// A board at the other end of a byte stream, as a device of the servo loop (dashpot/device.hpp, and for two axes
// dashpot/arm_device.hpp).
//
//     std::string error;
//     auto stream = dashpot::board::open_transport("serial:/dev/ttyACM0?baud=921600", error);
//     dashpot::board_device device(std::move(*stream), description);
//     device.start(error);                            // speaks to the board, compares, configures, resets
//     device.read(sample); device.write(actuation);   // once a period; no heap, no lock, no blocking call
//
// arm_board_device is the same with an arm_description, arm_sample and arm_actuation. One thread at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <dashpot/arm_device.hpp>
#include <dashpot/board/axes.hpp>
#include <dashpot/board/delay_gauge.hpp>
#include <dashpot/board/link.hpp>
#include <dashpot/board/sequence_tracker.hpp>
#include <dashpot/board/wide_counter.hpp>
#include <dashpot/device.hpp>

namespace dashpot {

namespace board {

std::uint64_t monotonic_nanoseconds() noexcept;  // CLOCK_BOOTTIME, which goes on while the machine is suspended [ns]

// What the servo loop calls the parts of a device of so many axes.
template <unsigned Axes>
struct loop_types {
  using description = arm_description;
  using sample = arm_sample;
  using actuation = arm_actuation;
  using report = arm_report;
};
template <>
struct loop_types<1> {
  using description = device_description;
  using sample = device_sample;
  using actuation = dashpot::actuation;
  using report = device_report;
};

}  // namespace board

struct board_options {
  board::sampling sampling = board::sampling::on_command;  // on_command: the host's clock paces the board
  board::controller controller = board::controller::host;
  // Without a command, before the board goes safe by itself. Empty: as many as the device allows to be missed, as many
  // again as it allows to be lost, and two.
  std::optional<std::uint16_t> watchdog_periods;
  double late_limit = 0;            // a sample later than this is stale [s]; 0: missed_deadlines_allowed + 1 periods
  int start_time = 2000;            // the board must have answered everything by then [ms]
  std::uint32_t first_command = 0;  // its number: any will do, and all wrap around
  std::uint64_t (*now)() noexcept = &board::monotonic_nanoseconds;  // [ns]
};

// Wrapping around.
struct board_statistics {
  board::decoder_statistics frames;  // what came from the board
  board::sequence_statistics samples;
  std::uint32_t delayed = 0;  // samples that came in order but later than the limit
  std::uint32_t commands_sent = 0;
  std::uint32_t commands_dropped = 0;  // not sent because the stream was full
};

template <unsigned Axes>
class basic_board_device {
  using description_type = typename board::loop_types<Axes>::description;
  using sample_type = typename board::loop_types<Axes>::sample;
  using actuation_type = typename board::loop_types<Axes>::actuation;
  using report_type = typename board::loop_types<Axes>::report;

 public:
  basic_board_device(board::transport stream, const description_type& description, board_options options = {}) noexcept;

  // Brings the board to running: hello, comparison of its description with ours, configure, reset. Blocks up to
  // options.start_time; repeats what is not answered. False with the reason in `error`: silence, another protocol
  // version or number of axes, a board that is not the described one, a configuration that the board refuses. No sample
  // from before its end is ever read: by the time that a loop runs, the handle may be elsewhere.
  bool start(std::string& error);

  // ok            `sample` is new
  // no_data       nothing came, in no more reads in a row than loop.missed_deadlines_allowed
  // stale         nothing new came for longer, or only repeated or overtaken samples, or the sample is later than the
  //               limit; in the last case it is stored
  // corrupted     only damaged frames came
  // fault         the board has left running (cause(), board_state(), stop_cause()); `sample` is new
  // disconnected  the stream is closed, or start() has not succeeded
  // Where `sample` is not new it is left as it was. `velocity` is never measured; `report` is what the board says.
  device_status read(sample_type& sample) noexcept;

  // ok            the command has left
  // stale         the stream is full; the board still obeys an older command
  // fault         not finite; motor 0 and the safe damping were sent instead
  // disconnected  as above
  device_status write(const actuation_type& command) noexcept;

  const description_type& description() const noexcept { return description_; }

  // Blocks until something came from the board or the time is over. Not for the loop.
  void wait_for_sample(int milliseconds) noexcept { link_.stream().wait_readable(milliseconds); }

  // Asks the board to leave its safe state. Does not wait: the samples tell when it has.
  device_status reset() noexcept;

  // Asks for the board's own counts; some reads later they are in counts_of_board(), empty until the first answer.
  device_status ask_statistics() noexcept;
  const std::optional<board::statistics_message>& counts_of_board() const noexcept { return counts_of_board_; }

  board_statistics statistics() const noexcept;
  board::board_state board_state() const noexcept { return newest_.state; }
  board::stop_cause stop_cause() const noexcept { return newest_.cause; }
  const char* cause() const noexcept;  // of the board's not running, in words
  // After start() has succeeded.
  const board::basic_description_message<Axes>& description_of_board() const noexcept { return *description_of_board_; }
  // As the board sent it: with the commands in force and the newest command it knows.
  const board::basic_sample_message<Axes>& newest_sample() const noexcept { return newest_; }

 private:
  bool greet(std::string& error);
  bool configure(std::string& error);
  bool set_running(std::string& error);
  void hear_of_every_configuration();
  std::uint16_t watchdog_periods() const noexcept;
  template <class Question, class Answered>
  bool ask_until(Question&& question, Answered&& answered);
  bool explain_silence(const char* question, std::string& error) const;

  template <class Message>
  device_status send(const Message& message, std::uint32_t sequence = 0) noexcept;
  bool receive() noexcept;
  void drop_backlog() noexcept;
  void take(const board::frame& from) noexcept;
  void take_sample(const board::frame& from) noexcept;
  void take_configured(const board::frame& from) noexcept;
  device_status hand_out(sample_type& sample) noexcept;
  report_type report() const noexcept;

  board::link link_;
  description_type description_;
  board_options options_;
  std::int64_t late_limit_;  // [ns]
  board::sequence_tracker samples_;
  board::delay_gauge gauge_;
  std::optional<board::basic_description_message<Axes>> description_of_board_;
  std::optional<board::configured_message> configured_;
  board::basic_sample_message<Axes> newest_;
  std::optional<board::statistics_message> counts_of_board_;
  board::one_each<board::wide_counter, Axes> counters_;
  std::uint64_t deadline_ = 0;  // of start() [ns]
  std::uint32_t next_command_;
  std::uint32_t commands_sent_ = 0;          // since construction
  std::uint32_t commands_this_session_ = 0;  // since start(), as far as it goes
  std::uint32_t handed_out_ = 0;             // number of the newest sample, as the loop sees it
  std::uint16_t stops_ = 0;                  // the newest that the board has told
  unsigned configures_sent_ = 0;
  unsigned configures_answered_ = 0;
  std::uint32_t delayed_ = 0;
  unsigned reads_in_vain_ = 0;  // in a row
  bool backlog_ = false;        // what came between start() and the first read() may wait
  bool fresh_ = false;          // that read() has not handed out
  bool started_ = false;
  bool of_other_axes_ = false;  // the board has described itself as one
};

using board_device = basic_board_device<1>;
using arm_board_device = basic_board_device<arm_axes>;

}  // namespace dashpot
