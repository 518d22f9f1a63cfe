// Prints each law's name, trace and instructions a step, over semihosting, on a bare Cortex-M that QEMU plays with
// -icount shift=0: there an instruction takes a nanosecond, and SysTick counts the processor's clock of 25 MHz, 40
// instructions a tick.
#include <cstdint>

#include "laws.hpp"
#include "step_cost.hpp"
#include "trace.hpp"

// The start-up's table names them; no interrupt is ever enabled.
extern "C" {
void uart0_received() {}
void uart0_sent() {}
void timer0_elapsed() {}
}

namespace {

using device_register = volatile std::uint32_t;
device_register& at(std::uint32_t address) { return *reinterpret_cast<device_register*>(address); }

constexpr std::uint32_t instructions_a_tick = 40, ticks_around = 1U << 24;

void start_clock() {
  at(0xE000E014) = ticks_around - 1;  // SYST_RVR
  at(0xE000E018) = 0;                 // SYST_CVR
  at(0xE000E010) = 5;                 // SYST_CSR: enabled, the processor's clock
}

// SysTick counts down and around.
std::uint32_t now() { return (ticks_around - at(0xE000E018)) % ticks_around; }

void semihost(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void print(const char* text) { semihost(4, text); }  // SYS_WRITE0

void print_number(std::uint64_t value, unsigned base, int digits) {
  char text[24] = {};
  char* place = text + sizeof text - 1;
  for (int n = 0; n < digits || value != 0; ++n, value /= base) *--place = "0123456789abcdef"[value % base];
  print(place);
}

template <class Law>
std::uint32_t instructions() {
  constexpr std::uint32_t calls = 10'000;
  const dashpot::board::model_cost cost = dashpot::board::measure_steps<Law>(calls, [] { return now(); });
  return ((cost.ticks % ticks_around) * instructions_a_tick + calls / 2) / calls;
}

}  // namespace

int main() {
  start_clock();
  dashpot::micro::for_each_law([](const char* name, auto law) {
    print(name);
    print(" ");
    print_number(dashpot::micro::trace_of(law), 16, 16);
    print(" ");
    print_number(instructions<decltype(law)>(), 10, 1);
    print("\n");
  });
  semihost(0x18, reinterpret_cast<const void*>(0x20026));  // SYS_EXIT, the application is done
  return 0;
}
