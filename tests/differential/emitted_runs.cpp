#include "emitted_runs.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "source/render.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

void emit(const DifferentialCase& one, const fs::path& folder) {
  compiler::Diagnostics diagnostics;
  const auto files = compiler::emit_cpp(one.compilation, {}, diagnostics);
  if (!files) throw std::runtime_error(compiler::render_text(diagnostics) + one.description);
  for (const compiler::OutputFile& file : *files) write_text(folder / file.name, file.text);
}

void append(std::string& bytes, double value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }

std::string motions_of(const std::vector<DifferentialCase>& cases) {
  std::string bytes;
  for (const DifferentialCase& one : cases) {
    append(bytes, double(one.motion.size()));
    append(bytes, one.compilation.law.surface_at.value_or(0));
    for (const Sample& sample : one.motion) append(bytes, sample.position), append(bytes, sample.velocity);
  }
  return bytes;
}

std::string program_of(const std::vector<DifferentialCase>& cases) {
  std::string includes = "#include <dashpot/command.hpp>\n#include \"emitted_driver.hpp\"\n", calls;
  for (const DifferentialCase& one : cases) {
    includes += fmt::format("#include \"{}.hpp\"\n", one.compilation.network.name);
    calls +=
        fmt::format("  differential::run<dashpot::generated::{}>(motions, answers);\n", one.compilation.network.name);
  }
  return includes +
         "int main(int, char** files) {\n  std::FILE* motions = std::fopen(files[1], \"rb\");\n"
         "  std::FILE* answers = std::fopen(files[2], \"wb\");\n  if (!motions || !answers) return 1;\n" +
         calls + "  return std::fclose(answers);\n}\n";
}

}  // namespace

std::vector<std::vector<Answer>> emitted_answers(const std::vector<DifferentialCase>& cases) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  for (const DifferentialCase& one : cases) emit(one, folder);
  write_text(folder / "motions", motions_of(cases));
  write_text(folder / "program.cpp", program_of(cases));
  const Finished finished =
      run_command(fmt::format("cd '{}' && '{}' -std=c++17 -O1 -ffp-contract=off -I'{}' -I'{}' -I. program.cpp -o "
                              "program && ./program motions answers",
                              folder.string(), DASHPOT_CXX, DASHPOT_RUNTIME_INCLUDE, DASHPOT_DRIVER));
  if (finished.status != 0) throw std::runtime_error(finished.output.substr(0, 4000));
  const std::string bytes = text_of(folder / "answers");
  std::vector<std::vector<Answer>> answers;
  std::size_t place = 0;
  for (const DifferentialCase& one : cases) {
    answers.emplace_back(one.motion.size());
    const std::size_t size = one.motion.size() * sizeof(Answer);
    if (place + size > bytes.size()) throw std::runtime_error("emitted code answered too little");
    std::memcpy(answers.back().data(), bytes.data() + place, size);
    place += size;
  }
  return answers;
}

std::string first_difference(const std::vector<Answer>& evaluated, const std::vector<Answer>& emitted) {
  for (std::size_t k = 0; k < evaluated.size(); ++k)
    if (std::memcmp(&evaluated[k], &emitted[k], sizeof(Answer)) != 0)
      return fmt::format("sample {}: damping {}, force {}, energy {} evaluated; {}, {}, {} emitted", k,
                         evaluated[k].damping, evaluated[k].force, evaluated[k].energy, emitted[k].damping,
                         emitted[k].force, emitted[k].energy);
  return "";
}

}  // namespace dashpot::testing
