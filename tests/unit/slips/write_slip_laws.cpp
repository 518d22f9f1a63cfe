// Writes headers for random networks with slips, and slip_laws_emitted.hpp that includes them all:
//     write_slip_laws FOLDER COUNT
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "slip_laws.hpp"

namespace {

void write(const std::string& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder + "/" + name) << text;
}

}  // namespace

int main(int, char** arguments) {
  using namespace dashpot;
  const std::string folder = arguments[1];
  const auto count = std::strtoull(arguments[2], nullptr, 10);
  std::string includes, visits;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    compiler::Diagnostics diagnostics;
    const auto files = compiler::emit_cpp(testing::slip_law(seed), {}, diagnostics);
    if (!files) {
      fmt::print(stderr, "slips_{} is not emitted\n", seed);
      return 1;
    }
    for (const compiler::OutputFile& file : *files) write(folder, file.name, file.text);
    includes += fmt::format("#include \"slips_{}.hpp\"\n", seed);
    visits += fmt::format("  visitor.template operator()<slips_{0}>({0});\n", seed);
  }
  write(folder, "slip_laws_emitted.hpp",
        fmt::format("#pragma once\n\n{}\nnamespace dashpot::generated {{\n\ntemplate <class Visitor>\nvoid "
                    "for_each_slip_law(Visitor visitor) "
                    "{{\n{}}}\n\n}}  // namespace dashpot::generated\n",
                    includes, visits));
  return 0;
}
