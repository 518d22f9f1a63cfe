// Prints the commands of all laws, with all their bits, over semihosting, on a bare Cortex-M that QEMU plays.
#include <cstring>

#include "played_laws.hpp"
#include "support/semihosting.hpp"

namespace {

using dashpot::testing::print;
using dashpot::testing::print_number;

template <class Scalar>
void print_bits(Scalar value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  print_number(bits, 16, 2 * sizeof value);
}

}  // namespace

int main() {
  dashpot::testing::play_all([](const char* name) { print(name), print("\n"); },
                             [](auto damping, auto force) {
                               print_bits(damping);
                               print(" ");
                               print_bits(force);
                               print("\n");
                             });
  dashpot::testing::end_program();
  return 0;
}
