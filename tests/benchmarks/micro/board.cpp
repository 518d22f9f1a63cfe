// Prints each law's name, trace and instructions a step, over semihosting, on a bare Cortex-M that QEMU plays with -icount shift=0:
// there an instruction takes a nanosecond, and SysTick counts the processor's clock of 25 MHz, 40 instructions a tick.
#include <cstdint>

#include "laws.hpp"
#include "step_cost.hpp"
#include "trace.hpp"

extern "C" {
extern std::uint32_t stack_top;
extern std::uint32_t data_begin, data_end, data_image, bss_begin, bss_end;
[[noreturn]] void reset_handler();
}

namespace {

// Stack and reset alone: no interrupt is ever enabled, and a fault locks the processor up, which ends the run.
struct vector_table {
  std::uint32_t* stack;
  void (*reset)();
};
[[gnu::section(".vectors"), gnu::used]] const vector_table vectors = {&stack_top, reset_handler};

using device_register = volatile std::uint32_t;
device_register& at(std::uint32_t address) { return *reinterpret_cast<device_register*>(address); }

constexpr std::uint32_t instructions_a_tick = 40, ticks_around = 1U << 24;

void enable_floating_point() {
  at(0xE000ED88) = at(0xE000ED88) | (0xFU << 20);  // CPACR
  asm volatile("dsb\n isb" ::: "memory");
}

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

int main_program() {
  dashpot::micro::for_each_law([](const char* name, auto law) {
    print(name);
    print(" ");
    print_number(dashpot::micro::trace_of(law), 16, 16);
    print(" ");
    print_number(instructions<decltype(law)>(), 10, 1);
    print("\n");
  });
  return 0;
}

}  // namespace

void reset_handler() {
  enable_floating_point();
  const std::uint32_t* from = &data_image;
  for (std::uint32_t* to = &data_begin; to != &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_begin; to != &bss_end; ++to) *to = 0;
  start_clock();
  main_program();
  semihost(0x18, reinterpret_cast<const void*>(0x20026));  // SYS_EXIT, the application is done
  for (;;) continue;
}
