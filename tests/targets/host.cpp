// Prints the commands of all laws, with all their bits, as the board does.
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "played_laws.hpp"

namespace {

template <class Scalar>
std::uint64_t bits_of(Scalar value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  return bits;
}

}  // namespace

int main() {
  dashpot::testing::play_all([](const char* name) { std::printf("%s\n", name); },
                             [](auto damping, auto force) {
                               const int digits = 2 * int(sizeof damping);
                               std::printf("%0*" PRIx64 " %0*" PRIx64 "\n", digits, bits_of(damping), digits,
                                           bits_of(force));
                             });
}
