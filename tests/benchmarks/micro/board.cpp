// Prints each law's name, trace and instructions a step, over semihosting, on a bare Cortex-M that QEMU plays with
// -icount shift=0: there an instruction takes a nanosecond, and SysTick counts the processor's clock of 25 MHz, 40
// instructions a tick.
#include <cstdint>

#include "laws.hpp"
#include "step_cost.hpp"
#include "support/semihosting.hpp"
#include "trace.hpp"

namespace {

using dashpot::testing::print;
using dashpot::testing::print_number;

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
  dashpot::testing::end_program();
  return 0;
}
