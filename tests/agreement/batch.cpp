#include "batch.hpp"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>

#include "support/random.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t cases_a_program = 60;  // as many classes as a compiler takes at once without much memory
constexpr int motion_rows = 160;

void run_or_throw(const std::string& line) {
  const Finished finished = run_command(line);
  if (finished.status != 0) throw std::runtime_error(line.substr(0, 400) + "\n" + finished.output.substr(0, 4000));
}

// Runs all jobs on two threads; the first exception comes out.
template <class Job>
void in_parallel(std::size_t count, Job job) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < count;) try {
        job(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        failure = std::current_exception();
        next = count;
      }
  };
  std::thread other(work);
  work();
  other.join();
  if (failure) std::rethrow_exception(failure);
}

// Moves of all sizes, rests, and a quantised crawl.
std::string motion_csv(const Choice& choice) {
  Random random(static_cast<std::uint64_t>(choice.rate));
  std::string text = choice.gives_velocity ? "time,position,velocity\n" : "time,position\n";
  double position = 0;
  for (int n = 0; n < motion_rows; ++n) {
    if (n % 40 < 20) position += random.uniform(-1, 1) * random.log_uniform(1e-9, 1e-2);
    if (n % 40 >= 35) position = std::round(position / 3e-5) * 3e-5 + 3e-5;
    text += fmt::format("{},{}", n / choice.rate, position);
    if (choice.gives_velocity) text += fmt::format(",{}", random.uniform(-1, 1) * random.log_uniform(1e-6, 1));
    text += "\n";
  }
  return text;
}

class Batch {
 public:
  Batch(const std::vector<Case>& cases, const std::string& scalar, const fs::path& folder)
      : cases_(cases), scalar_(scalar), folder_(folder) {}

  std::vector<std::string> run() {
    write_inputs();
    emit();
    const std::size_t programs = (cases_.size() + cases_a_program - 1) / cases_a_program;
    in_parallel(programs, [this](std::size_t i) { build_and_run(i * cases_a_program); });
    std::vector<std::string> complaints(cases_.size());
    in_parallel(cases_.size(), [&](std::size_t i) { complaints[i] = complaint_about(cases_[i]); });
    return complaints;
  }

 private:
  fs::path network_file(const Case& c) const { return folder_ / (c.name() + ".json"); }
  fs::path motion_file(const Choice& choice) const {
    return folder_ / fmt::format("motion_{}_{}.csv", choice.rate, choice.gives_velocity);
  }
  fs::path emitted_output(const Case& c) const { return folder_ / (c.name() + ".emitted"); }
  std::string command_line(const char* command, const Choice& choice) const {
    return fmt::format("'{}' {} --rate {} --scalar {} {}", DASHPOT_EXECUTABLE, command, choice.rate, scalar_,
                       choice.options);
  }

  void write_inputs() const {
    for (const Case& c : cases_) {
      write_text(network_file(c), json_text(c.network));
      if (!fs::exists(motion_file(c.choice))) write_text(motion_file(c.choice), motion_csv(c.choice));
    }
  }

  void emit() const {
    std::map<std::string, std::string> lines;
    for (const Case& c : cases_) {
      const std::string line = command_line("compile", c.choice) + c.choice.emission;
      std::string& whole = lines.try_emplace(line, line + fmt::format(" -o '{}'", folder_.string())).first->second;
      whole += fmt::format(" '{}'", network_file(c).string());
    }
    for (const auto& [key, line] : lines) run_or_throw(line);
  }

  void build_and_run(std::size_t first) const {
    const std::size_t last = std::min(first + cases_a_program, cases_.size());
    std::string includes = "#include <dashpot/command.hpp>\n#include \"driver.hpp\"\n", calls;
    for (std::size_t i = first; i < last; ++i) {
      const Case& c = cases_[i];
      includes += fmt::format("#include \"{}.hpp\"\n", c.name());
      calls += fmt::format("  agreement::run<dashpot::generated::{}>(agreement::read_motion(\"{}\", {:#}), \"{}\");\n",
                           c.name(), motion_file(c.choice).string(), c.choice.rate, emitted_output(c).string());
    }
    const fs::path program = folder_ / fmt::format("driver_{}", first);
    write_text(program.string() + ".cpp", includes + "int main() {\n" + calls + "}\n");
    // Half of the programs in the widest registers that this machine has.
    const char* machine = first / cases_a_program % 2 == 0 ? "-O2" : "-O3 -march=native";
    run_or_throw(fmt::format("'{}' -std=c++17 {} -ffp-contract=off -I'{}' -I'{}' -I'{}' '{}.cpp' -o '{}' && '{}'",
                             DASHPOT_CXX, machine, DASHPOT_RUNTIME_INCLUDE, DASHPOT_DRIVER, folder_.string(),
                             program.string(), program.string(), program.string()));
  }

  std::string complaint_about(const Case& c) const {
    const fs::path output = folder_ / (c.name() + ".simulated");
    run_or_throw(command_line("simulate", c.choice) + fmt::format(" '{}' --input '{}' -o '{}'",
                                                                  network_file(c).string(),
                                                                  motion_file(c.choice).string(), output.string()));
    const std::string csv = text_of(output);
    return scalar_ == "double" ? compare<double>(c, csv) : compare<float>(c, csv);
  }

  template <class Scalar>
  std::string compare(const Case& c, const std::string& csv) const {
    static const char* const columns[] = {"position", "velocity", "force", "damping", "motor_force"};
    const std::string bytes = text_of(emitted_output(c));
    std::istringstream rows(csv);
    std::string row;
    std::getline(rows, row);
    std::size_t place = 0;
    for (int n = 0; std::getline(rows, row); ++n) {
      const char* text = row.data() + row.find(',');
      for (const char* column : columns) {
        Scalar simulated = 0, emitted = 0;
        text = std::from_chars(text + 1, row.data() + row.size(), simulated).ptr;
        if (place + sizeof(Scalar) > bytes.size()) return "emitted code wrote too few rows";
        std::memcpy(&emitted, bytes.data() + place, sizeof(Scalar));
        place += sizeof(Scalar);
        if (std::memcmp(&simulated, &emitted, sizeof(Scalar)) != 0)
          return fmt::format("{} {} at {} Hz, {}, row {}: simulated {}, emitted {}", scalar_, c.choice.options,
                             c.choice.rate, column, n + 1, simulated, emitted);
      }
    }
    if (place != bytes.size() || place != motion_rows * std::size(columns) * sizeof(Scalar)) return "rows are missing";
    return "";
  }

  const std::vector<Case>& cases_;
  std::string scalar_;
  fs::path folder_;
};

}  // namespace

std::vector<Choice> all_choices() {
  static const char* const laws[] = {"--scheme exact",
                                     "--scheme exact --state-input position",
                                     "--scheme exact --state-input velocity",
                                     "--scheme backward-euler",
                                     "--scheme backward-euler --state-input position",
                                     "--scheme backward-euler --state-input velocity",
                                     "--scheme backward-euler --state-input nodal"};
  static const char* const decompositions[] = {
      "paper", "zero-frequency", "quietest-passive", "velocity-free", "largest-observer", "virtual", "0.375"};
  static const char* const registers[] = {"sse2", "avx512", "none", "avx2", "neon"};
  static const double rates[] = {1000, 100, 10000, 333.25, 5};
  std::vector<Choice> choices;
  for (std::size_t law = 0; law < std::size(laws); ++law)
    for (std::size_t shift : {0u, 2u, 5u}) {
      const std::size_t i = choices.size();
      choices.push_back(
          {rates[i % std::size(rates)],
           fmt::format("{} --decomposition {} --vector {}", laws[law],
                       decompositions[(law + shift) % std::size(decompositions)], registers[i % std::size(registers)]),
           i % 2 == 0, i % 4 < 2 ? "" : " --constant-time"});
    }
  return choices;
}

std::vector<std::string> complaints_about(const std::vector<Case>& cases, const std::string& scalar,
                                          const fs::path& folder) {
  return Batch(cases, scalar, folder).run();
}

}  // namespace dashpot::testing
