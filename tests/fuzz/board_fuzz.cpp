// The firmware under any bytes, frames, readings and periods: what reaches motor and brake is finite and within the
// board's limits, the motor makes nothing outside of running, running is entered only by a reset, and a host that is
// silent for as long as it said does not drive on.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "application.hpp"
#include "stand_in_model.hpp"

namespace {

using namespace dashpot::board;

void require(bool holds) {
  if (!holds) std::abort();
}

struct any_hardware {
  encoder_reading read_encoder() noexcept { return reading; }
  void drive(const outputs& wanted) noexcept {
    require(std::isfinite(wanted.motor_torque) && std::fabs(wanted.motor_torque) <= 50);
    require(wanted.brake_damping >= 0 && wanted.brake_damping <= 30);
    driven = wanted;
  }
  void set_period(std::uint32_t) noexcept {}
  bool send(const encoded_frame& whole) noexcept {
    require(whole.size <= max_frame_size);
    return sends;
  }

  encoder_reading reading;
  outputs driven;
  bool sends = true;
};

constexpr board_facts facts = {{1e-5, 50, 30, 100'000, 0, dashpot::motion::translation, "fuzzed"}, 5, 1, {}};

class input {
 public:
  input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool is_over() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  template <class Number>
  Number number() {
    Number any;
    unsigned char bytes[sizeof any];
    for (std::size_t i = 0; i < sizeof any; ++i) bytes[i] = byte();
    std::memcpy(&any, bytes, sizeof any);
    return any;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

using board_application = application<any_hardware, dashpot::generated::stand_in_model>;

// The line to the board, with a decoder of its own beside it: bytes that look like the start of a long frame hold back
// the frames behind them until they are found not to be one, so that a reset can be served long after it was sent.
class line {
 public:
  explicit line(board_application& board) : board_(board) {}

  void send(const std::uint8_t* bytes, std::size_t count) {
    for_each_frame(decoder_, bytes, count, [this](const frame& heard) {
      reset_heard = reset_heard || heard.type == message_type::reset;
      command_heard = command_heard || heard.type == message_type::command;
    });
    board_.receive(bytes, count);
  }

  template <class Message>
  void say(const Message& message, std::uint32_t sequence = 0) {
    const encoded_frame frame = encode(message, sequence);
    send(frame.bytes, frame.size);
  }

  bool reset_heard = false;
  bool command_heard = false;

 private:
  board_application& board_;
  frame_decoder decoder_;
};

configure_message configuration_of(input& what) {
  configure_message wish;
  const std::uint8_t how = what.byte();
  wish.period = how & 1 ? 1'000'000 : what.number<std::uint32_t>();
  wish.safe_damping = how & 2 ? 4 : what.number<float>();
  wish.max_speed = how & 4 ? 2 : what.number<float>();
  wish.watchdog_periods = what.byte() % 8;
  wish.sampling = static_cast<sampling>(what.byte() % 3);
  wish.controller = static_cast<controller>(what.byte() % 3);
  return wish;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  input what(data, size);
  any_hardware hardware;
  board_application board(hardware, facts);
  line to_board(board);
  std::uint32_t sequence = what.number<std::uint32_t>();
  unsigned silent = 0;  // periods since the last command that the board heard
  while (!what.is_over()) {
    const bool ran = board.state().running();
    to_board.reset_heard = to_board.command_heard = false;
    switch (what.byte() % 8) {
      case 0: {
        const std::uint8_t some = what.byte();
        to_board.send(&some, 1);
        break;
      }
      case 1: to_board.say(configuration_of(what)); break;
      case 2: {
        sample_message state;
        board.state().describe(state);
        to_board.say(reset_message{what.byte() % 4 != 0 ? state.stops : what.number<std::uint16_t>()});
        break;
      }
      case 3:
        sequence += what.byte() % 8 != 0 ? 1 : what.number<std::uint32_t>();
        to_board.say(command_message{what.number<float>(), what.number<float>()}, sequence);
        break;
      case 4: {
        const unsigned periods = what.byte() % 4 + 1;
        board.pass_period(periods);
        silent += periods;
        break;
      }
      case 5:
        hardware.reading = {what.number<std::int32_t>(), what.number<std::uint64_t>(), what.number<std::uint64_t>()};
        break;
      case 6:
        hardware.reading.counts =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(hardware.reading.counts) + what.byte() % 64u - 32u);
        break;
      default:
        hardware.sends = what.byte() % 2 != 0;
        to_board.say(ask_statistics_message());
        break;
    }
    const supervisor& state = board.state();
    require(!state.running() || ran || to_board.reset_heard);
    require(state.running() || hardware.driven.motor_torque == 0);
    require(hardware.driven.motor_torque == state.applied().motor_torque);
    if (to_board.command_heard) silent = 0;
    const unsigned patience = state.configuration().watchdog_periods;
    if (patience != 0 && silent >= patience) require(hardware.driven.motor_torque == 0 || state.own_model());
  }
  return 0;
}
