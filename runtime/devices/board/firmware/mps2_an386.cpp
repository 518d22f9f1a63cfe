#include "mps2_an386.hpp"

#include "byte_ring.hpp"

namespace dashpot::board {
namespace {

using device_register = volatile std::uint32_t;

// CMSDK APB UART.
struct uart {
  device_register data;
  device_register state;
  device_register control;
  device_register interrupt;  // read: pending; write: clear
  device_register divider;
};
constexpr std::uint32_t transmit_full = 1, receive_full = 2;
constexpr std::uint32_t enable_both_ways_with_interrupts = 0xF;
constexpr std::uint32_t transmit_interrupt = 1, receive_interrupt = 2;

// CMSDK APB timer, counting down.
struct timer {
  device_register control;
  device_register value;
  device_register reload;
  device_register interrupt;  // write: clear
};
constexpr std::uint32_t enable_timer = 1, timer_interrupt = 8;

uart& uart0() { return *reinterpret_cast<uart*>(0x40004000); }
timer& timer0() { return *reinterpret_cast<timer*>(0x40000000); }
timer& timer1() { return *reinterpret_cast<timer*>(0x40001000); }
device_register& interrupt_enable() { return *reinterpret_cast<device_register*>(0xE000E100); }

constexpr std::uint32_t uart0_receive = 1U << 0, uart0_transmit = 1U << 1, timer0_interrupt = 1U << 8;
constexpr std::uint32_t nanoseconds_per_tick = 1'000'000'000U / mps2_an386::clock_rate;
constexpr std::uint32_t baud = 921'600;  // [1/s]; QEMU does not mind

// Shared with the interrupts.
byte_ring<512> received;
std::atomic<std::uint32_t> periods{0};

// The main loop's alone.
byte_ring<1024> leaving;

bool uart_full() { return (uart0().state & transmit_full) != 0; }

void start_uart() {
  uart0().divider = mps2_an386::clock_rate / baud;
  uart0().control = enable_both_ways_with_interrupts;
}

void start_clock() {
  timer1().reload = 0xFFFF'FFFFU;
  timer1().value = 0xFFFF'FFFFU;
  timer1().control = enable_timer;
}

}  // namespace

mps2_an386::mps2_an386() noexcept {
  start_clock();
  start_uart();
  set_period(1'000'000);
  interrupt_enable() = uart0_receive | uart0_transmit | timer0_interrupt;
}

void mps2_an386::set_period(std::uint32_t nanoseconds) noexcept {
  timer0().control = 0;
  timer0().reload = nanoseconds / nanoseconds_per_tick - 1;
  timer0().value = nanoseconds / nanoseconds_per_tick - 1;
  timer0().interrupt = 1;
  timer0().control = enable_timer | timer_interrupt;
}

bool mps2_an386::send(const encoded_frame& whole) noexcept {
  if (leaving.room() < whole.size) return false;
  for (std::size_t i = 0; i < whole.size; ++i) leaving.push(whole.bytes[i]);
  return true;
}

std::size_t mps2_an386::receive(std::uint8_t* into, std::size_t room) noexcept {
  std::size_t count = 0;
  while (count < room && received.pop(into[count])) ++count;
  return count;
}

unsigned mps2_an386::periods_passed() noexcept { return periods.exchange(0, std::memory_order_acq_rel); }

void mps2_an386::transmit() noexcept {
  std::uint8_t byte = 0;
  while (!uart_full() && leaving.pop(byte)) uart0().data = byte;
}

// An interrupt that comes after the check still ends the wait: it stays pending while interrupts are off.
void mps2_an386::sleep() noexcept {
  asm volatile("cpsid i" ::: "memory");
  const bool idle =
      received.empty() && periods.load(std::memory_order_relaxed) == 0 && (leaving.empty() || uart_full());
  if (idle) asm volatile("wfi" ::: "memory");
  asm volatile("cpsie i" ::: "memory");
}

std::uint32_t mps2_an386::ticks() noexcept { return 0xFFFF'FFFFU - timer1().value; }

// Called every period, far more often than the 171 s in which the timer wraps around.
std::uint64_t mps2_an386::now() noexcept {
  clock_ += ticks() - static_cast<std::uint32_t>(clock_);
  return clock_ * nanoseconds_per_tick;
}

}  // namespace dashpot::board

using namespace dashpot::board;

extern "C" void uart0_received() {
  uart0().interrupt = receive_interrupt;
  while ((uart0().state & receive_full) != 0) received.push(static_cast<std::uint8_t>(uart0().data));
}

extern "C" void uart0_sent() { uart0().interrupt = transmit_interrupt; }

extern "C" void timer0_elapsed() {
  timer0().interrupt = 1;
  periods.fetch_add(1, std::memory_order_release);
}
