// Instructions of a step on a bare Cortex-M that QEMU plays with -icount shift=0: there an instruction takes a
// nanosecond, and SysTick counts the processor's clock of 25 MHz, 40 instructions a tick.
#pragma once

#include <cstdint>

#include "step_cost.hpp"

namespace dashpot::testing {

using device_register = volatile std::uint32_t;
inline device_register& at(std::uint32_t address) { return *reinterpret_cast<device_register*>(address); }

inline constexpr std::uint32_t instructions_a_tick = 40, ticks_around = 1U << 24;

inline void start_clock() {
  at(0xE000E014) = ticks_around - 1;  // SYST_RVR
  at(0xE000E018) = 0;                 // SYST_CVR
  at(0xE000E010) = 5;                 // SYST_CSR: enabled, the processor's clock
}

// SysTick counts down and around.
inline std::uint32_t now() { return (ticks_around - at(0xE000E018)) % ticks_around; }

template <class Law>
std::uint32_t instructions() {
  constexpr std::uint32_t calls = 10'000;
  const board::model_cost cost = board::measure_steps<Law>(calls, [] { return now(); });
  return ((cost.ticks % ticks_around) * instructions_a_tick + calls / 2) / calls;
}

}  // namespace dashpot::testing
