// From reset to main(): the vector table, memory, the floating-point unit.
#include <cstdint>

extern "C" {

extern std::uint32_t stack_top;
extern std::uint32_t data_begin, data_end, data_image, bss_begin, bss_end;
extern void (*init_array_begin[])();
extern void (*init_array_end[])();

int main();
void uart0_received();
void uart0_sent();
void timer0_elapsed();

[[noreturn]] void reset_handler();
[[noreturn]] void unexpected();
}

namespace {

struct vector_table {
  std::uint32_t* stack;
  void (*system[15])();
  void (*interrupts[32])();
};

// Interrupt numbers of AN386: 0 UART0 receive, 1 UART0 transmit, 8 TIMER0.
[[gnu::section(".vectors"), gnu::used]] const vector_table vectors = {
    &stack_top,
    {reset_handler, unexpected, unexpected, unexpected, unexpected, unexpected, nullptr, nullptr, nullptr, nullptr,
     unexpected, unexpected, nullptr, unexpected, unexpected},
    {uart0_received, uart0_sent, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected,
     timer0_elapsed}};

void enable_floating_point() {
  auto& access = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);  // CPACR
  access = access | (0xFU << 20);
  asm volatile("dsb\n isb" ::: "memory");
}

}  // namespace

void reset_handler() {
  enable_floating_point();
  const std::uint32_t* from = &data_image;
  for (std::uint32_t* to = &data_begin; to != &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_begin; to != &bss_end; ++to) *to = 0;
  for (auto construct = init_array_begin; construct != init_array_end; ++construct) (*construct)();
  main();
  unexpected();
}

// The host sees silence. On a board with a motor this is where its power stage is switched off.
void unexpected() {
  asm volatile("cpsid i");
  for (;;) asm volatile("wfi");
}
