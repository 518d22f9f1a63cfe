// steps LAW COUNT: runs a law for COUNT steps and nothing else, for count_instructions.sh.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "printed_law.hpp"
#include "printed_slip.hpp"
#include "runs.hpp"
#include "second_order_maxwell.hpp"
#include "second_order_maxwell_euler.hpp"
#include "visco_elasto_plastic.hpp"

namespace {

template <class Law>
int run(long count) {
  Law law;
  return std::printf("%g\n", dashpot::benchmarks::run_chain(law, count)) > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const long count = std::atol(argv[2]);
  if (std::strcmp(argv[1], "exact") == 0) return run<dashpot::generated::second_order_maxwell>(count);
  if (std::strcmp(argv[1], "euler") == 0) return run<dashpot::generated::second_order_maxwell_euler>(count);
  if (std::strcmp(argv[1], "printed") == 0) return run<dashpot::benchmarks::printed_law>(count);
  if (std::strcmp(argv[1], "slip") == 0) return run<dashpot::generated::visco_elasto_plastic>(count);
  if (std::strcmp(argv[1], "printed_slip") == 0) return run<dashpot::benchmarks::printed_slip>(count);
  return 2;
}
