// Prints each law's name, trace and instructions a step, over semihosting.
#include <cstdint>

#include "laws.hpp"
#include "support/board_instructions.hpp"
#include "support/semihosting.hpp"
#include "trace.hpp"

namespace {

using dashpot::testing::print;
using dashpot::testing::print_number;

}  // namespace

int main() {
  dashpot::testing::start_clock();
  dashpot::micro::for_each_law([](const char* name, auto law) {
    print(name);
    print(" ");
    print_number(dashpot::micro::trace_of(law), 16, 16);
    print(" ");
    print_number(dashpot::testing::instructions<decltype(law)>(), 10, 1);
    print("\n");
  });
  dashpot::testing::end_program();
  return 0;
}
