// For programs that QEMU plays on a bare Cortex-M: what they print, and how they end. One source of a program includes
// it.
#pragma once

#include <cstdint>

// The start-up's table names them; no interrupt is ever enabled.
extern "C" {
void uart0_received() {}
void uart0_sent() {}
void timer0_elapsed() {}
}

namespace dashpot::testing {

inline void semihost(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

inline void print(const char* text) { semihost(4, text); }  // SYS_WRITE0

// With at least so many digits.
inline void print_number(std::uint64_t value, unsigned base, int digits) {
  char text[24] = {};
  char* place = text + sizeof text - 1;
  for (int n = 0; n < digits || value != 0; ++n, value /= base) *--place = "0123456789abcdef"[value % base];
  print(place);
}

// SYS_EXIT, because the application is done.
inline void end_program() { semihost(0x18, reinterpret_cast<const void*>(0x20026)); }

}  // namespace dashpot::testing
