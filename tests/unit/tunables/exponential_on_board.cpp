// Says through semihosting, as 32 hexadecimal digits, what exponential_bits() is on this machine: double, then float.
#include "exponential_bits.hpp"

namespace {

int semihost(int operation, const void* argument) {
  int result;
  asm volatile("mov r0, %1\n mov r1, %2\n bkpt 0xab\n mov %0, r0"
               : "=r"(result)
               : "r"(operation), "r"(argument)
               : "r0", "r1", "memory");
  return result;
}

void say(unsigned long long value) {
  char text[17] = {};
  for (int i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[(value >> (60 - 4 * i)) & 15];
  semihost(4, text);
}

}  // namespace

extern "C" {
void uart0_received() {}
void uart0_sent() {}
void timer0_elapsed() {}
}

int main() {
  say(dashpot::testing::exponential_bits<double, unsigned long long>());
  say(dashpot::testing::exponential_bits<float, unsigned long long>());
  return semihost(0x18, reinterpret_cast<const void*>(0x20026));  // the application's normal end
}
