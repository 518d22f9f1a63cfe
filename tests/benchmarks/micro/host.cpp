// Prints each law's name and trace, as the board does.
#include <cinttypes>
#include <cstdio>

#include "laws.hpp"
#include "trace.hpp"

int main() {
  dashpot::micro::for_each_law(
      [](const char* name, auto law) { std::printf("%s %016" PRIx64 "\n", name, dashpot::micro::trace_of(law)); });
}
