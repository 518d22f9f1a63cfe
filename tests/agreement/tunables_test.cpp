// `dashpot simulate` with columns for tunable parameters, and set() of the emitted code: they agree in every bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cstring>
#include <sstream>

#include "support/shell_command.hpp"
#include "support/shrink.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing::tunables_test {
namespace {

namespace fs = std::filesystem;

constexpr double period = 1e-3;  // [s]

void run_or_fail(const std::string& line) {
  const Finished finished = run_command(line);
  ASSERT_EQ(finished.status, 0) << line.substr(0, 400) << "\n" << finished.output.substr(0, 4000);
}

// One network with a motion and a schedule of its values, as a table for `simulate` and in bytes for the emitted class.
struct Case {
  std::uint64_t seed;
  const char* scalar;
  std::size_t tunables = 0;

  std::string name() const { return fmt::format("tunable_{}", seed); }

  void write(const fs::path& folder) {
    const std::string text = tunable_network(seed, Kind(seed % kinds));
    const TunableLaw law(text);
    tunables = law.tunables().size();
    write_text(folder / (name() + ".json"), text);
    std::string table = "time,position,velocity", bytes;
    for (const compiler::Tunable& tunable : law.tunables()) table += "," + tunable.name;
    Random random(seed);
    std::vector<double> values = law.defaults();
    double last = 0;
    int n = 0;
    for (double position : random_walk(random, 120)) {
      if (random.chance(0.3)) values = next_values(law.tunables(), values, random);
      std::vector<double> row = {position, (position - last) / period, 1};
      table += fmt::format("\n{},{},{}", n++ * period, row[0], row[1]);
      for (double value : values) table += fmt::format(",{}", value);
      row.insert(row.end(), values.begin(), values.end());
      bytes.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(double));
      last = position;
    }
    write_text(folder / (name() + ".csv"), table + "\n");
    write_text(folder / (name() + ".in"), bytes);
  }

  // Every other law knows the limits of a motor that gives little of what is asked for, and sheds.
  bool is_limited() const { return seed % 2 == 0; }

  void write_device(const fs::path& folder) const {
    write_text(folder / (name() + ".device"),
               fmt::format(R"({{ "dashpot_device": 1, "name": "weak", "motion": "translation",
                                 "loop": {{ "rate": 1000 }}, "encoder": {{ "resolution": 1e-5 }},
                                 "motor": {{ "max_torque": 0.05{} }},
                                 "velocity": {{ "estimator": "backward_difference", "window": 1 }} }})",
                           seed % 4 == 0 ? R"(, "slew": 20)" : ""));
  }

  std::string command(const char* verb, const fs::path& folder) const {
    const std::string how = is_limited() ? fmt::format("--decomposition paper --device '{}/{}.device'{}",
                                                       folder.string(), name(), verb[0] == 'c' ? " --uncertified" : "")
                                         : "--rate 1000";
    return fmt::format("'{}' {} '{}/{}.json' {} --scalar {} -o", DASHPOT_EXECUTABLE, verb, folder.string(), name(), how,
                       scalar);
  }

  // What is different; empty where nothing is.
  std::string complaint(const fs::path& folder) const {
    std::istringstream rows(text_of(folder / (name() + ".simulated")));
    const std::string emitted = text_of(folder / (name() + ".out"));
    std::string row;
    std::getline(rows, row);
    std::size_t place = 0;
    for (int n = 1; std::getline(rows, row); ++n, place += 4 * sizeof(double)) {
      double columns[6] = {}, answer[2] = {};
      const char* text = row.data() - 1;
      for (double& column : columns) text = std::from_chars(text + 1, row.data() + row.size(), column).ptr;
      if (place + sizeof answer > emitted.size()) return "emitted code wrote too few rows";
      std::memcpy(answer, emitted.data() + place, sizeof answer);
      // Floats are written with their own shortest digits; both sides are taken back to the float that was meant.
      const auto same = [&](double one, double other) {
        return scalar[0] == 'd' ? one == other : static_cast<float>(one) == static_cast<float>(other);
      };
      if (!same(columns[4], answer[0]) || !same(columns[5], answer[1]))
        return fmt::format("row {}: simulated {} and {}, emitted {} and {}", n, columns[4], columns[5], answer[0],
                           answer[1]);
    }
    return place == emitted.size() && place > 0 ? "" : "rows are missing";
  }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (std::uint64_t seed = 1; seed <= repetitions(24, 240); ++seed)
    all.push_back({seed, seed % 5 == 0 ? "float" : "double"});
  return all;
}

}  // namespace

// Fails if a column of values is taken in another row, order or precision than set() takes it, or another law is run;
// or the limits of a motor are known to one of the two alone.
TEST(Agreement, OfSimulatedAndEmittedSet) {
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  std::vector<Case> all = cases();
  std::string includes = "#include \"emitted_driver.hpp\"\n", calls;
  for (Case& each : all) {
    each.write(folder);
    each.write_device(folder);
    run_or_fail(each.command("compile", folder) + fmt::format(" '{}'", folder.string()));
    run_or_fail(each.command("simulate", folder) +
                fmt::format(" '{0}/{1}.simulated' --input '{0}/{1}.csv'", folder.string(), each.name()));
    includes += fmt::format("#include \"{}.hpp\"\n", each.name());
    calls += fmt::format("  tunables::run<dashpot::generated::{0}, {1}>(\"{2}/{0}.in\", \"{2}/{0}.out\");\n",
                         each.name(), each.tunables, folder.string());
  }
  write_text(folder / "run.cpp", includes + "int main() {\n" + calls + "}\n");
  run_or_fail(fmt::format(
      "'{0}' -std=c++17 -O1 -ffp-contract=off -I'{1}' -I'{2}' -I'{3}' '{3}/run.cpp' -o '{3}/run' && '{3}/run'",
      DASHPOT_CXX, DASHPOT_RUNTIME_INCLUDE, DASHPOT_TUNABLES_DRIVER, folder.string()));
  for (const Case& each : all) {
    EXPECT_EQ(each.complaint(folder), "") << "seed " << each.seed;
    const std::string header = text_of(folder / (each.name() + ".hpp"));
    EXPECT_EQ(header.find("kept_share()") != std::string::npos, each.is_limited()) << "seed " << each.seed;
  }
}

}  // namespace dashpot::testing::tunables_test
