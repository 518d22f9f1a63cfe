// The board under the reference firmware: Arm's MPS2+ with the AN386 image (Cortex-M4F, 25 MHz), as QEMU has it. UART0
// is the byte stream to the host, TIMER0 the sample clock, TIMER1 the clock of the timestamps. It has no motor, brake
// or encoder: plant_board.hpp. A port to another board replaces this pair of files and the linker script.
#pragma once

#include <cstddef>
#include <cstdint>

#include <dashpot/board/frame.hpp>

namespace dashpot::board {

// One object: the interrupts feed it.
class mps2_an386 {
 public:
  static constexpr std::uint32_t clock_rate = 25'000'000;  // [Hz]

  mps2_an386() noexcept;

  void set_period(std::uint32_t nanoseconds) noexcept;
  bool send(const encoded_frame& whole) noexcept;

  // Takes up to `room` bytes that came from the host. Returns how many.
  std::size_t receive(std::uint8_t* into, std::size_t room) noexcept;
  // How many periods have ended since the last call.
  unsigned periods_passed() noexcept;
  // Hands the UART what it takes.
  void transmit() noexcept;
  // Until an interrupt, unless there is something to do already.
  void sleep() noexcept;

  // Of the processor's clock, counting up.
  static std::uint32_t ticks() noexcept;
  // Since it was switched on [ns].
  std::uint64_t now() noexcept;

 private:
  std::uint64_t clock_ = 0;  // ticks of TIMER1, extended
};

}  // namespace dashpot::board
