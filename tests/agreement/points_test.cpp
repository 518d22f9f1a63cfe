// A batch's points are single networks: every one of them gives the bits that the single class gives, which are the
// same with and without jumps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/repetitions.hpp"
#include "support/shell_command.hpp"
#include "support/tunable_run.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

struct Machine {
  const char* compiler;
  const char* flags;
};
using Machines = std::vector<Machine>;

// The bits must be the same at any level of optimisation. The lower ones compile in half the time; --long takes the
// higher ones.
const Machine gxx{DASHPOT_GXX, is_thorough() ? "-O2" : "-O1"};
const Machine clangxx{DASHPOT_CLANGXX, is_thorough() ? "-O3 -march=native" : "-O1 -march=native"};

// With --long, both.
Machines alone(const Machine& machine) { return is_thorough() ? Machines{gxx, clangxx} : Machines{machine}; }

void run_or_throw(const std::string& line) {
  const Finished finished = run_command(line);
  if (finished.status != 0) throw std::runtime_error(line.substr(0, 400) + "\n" + finished.output.substr(0, 4000));
}

// Linear ones, closed-form slips with a brake that changes and without, a contact, loops, and static curves.
std::vector<std::string> networks(const fs::path& folder) {
  std::vector<std::string> files;
  for (const char* name : {"twenty_branches", "lone_spring", "lone_damper"})
    files.push_back(fmt::format(DASHPOT_CORNER_CASES "/{}.json", name));
  for (const char* name : {"second_order_maxwell", "generalised_kelvin_four", "visco_elasto_plastic",
                           "visco_elasto_plastic_organ", "maxwell_slip_ten", "virtual_wall"})
    files.push_back(fmt::format(DASHPOT_NETWORKS "/paper/{}.json", name));
  for (const char* name : {"ligament", "skin_in_contact"})
    files.push_back(fmt::format(DASHPOT_NETWORKS "/static/{}.json", name));
  files.push_back((folder / "pressed_at_0.json").string());
  write_text(files.back(), R"({ "dashpot": 1, "name": "pressed_at_0", "contact": { "at": "-2 mm" },
    "network": { "parallel": [ { "spring": 100 }, { "series": [ { "spring": 200 }, { "damper": 20 } ] } ] } })");
  for (std::uint64_t seed = 1; seed <= repetitions(4, 12); ++seed) {
    NetworkRecipe recipe;
    recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
    recipe.most_slips = seed % 2 == 0 ? 1 : 0;
    files.push_back((folder / fmt::format("random_{}.json", seed)).string());
    write_text(files.back(), json_text(random_network(seed, recipe)));
  }
  return files;
}

// Branches, trees, meshes and networks behind a surface, with parameters; those that dashpot ships, without coupled
// slips; one behind a static curve; and slips that each stand alone, deep among springs and dampers.
std::vector<std::string> tunable_networks(const fs::path& folder) {
  std::vector<std::string> files;
  for (const char* name : {"second_order_maxwell", "springpot", "standard_solid", "friction"})
    files.push_back(fmt::format(DASHPOT_NETWORKS "/tunable/{}_tunable.json", name));
  files.push_back((folder / "curved.json").string());
  write_text(files.back(), R"({ "dashpot": 1, "name": "curved", "static": { "power": 2, "force": "1 N", "at": "5 mm" },
    "parameters": { "K": { "value": 300, "tunable": true, "min": 30, "max": 900 },
                    "B": { "value": 3, "tunable": true, "min": 0, "max": 30 } },
    "network": { "parallel": [ { "spring": "K" }, { "damper": 1 }, { "series": [ { "spring": 200 }, { "damper": "B" } ] } ] } })");
  files.push_back((folder / "pressed_at_0_tunable.json").string());
  write_text(files.back(), R"({ "dashpot": 1, "name": "pressed_at_0_tunable", "contact": { "at": "-2 mm" },
    "parameters": { "K": { "value": 300, "tunable": true, "min": 30, "max": 900 } },
    "network": { "parallel": [ { "spring": "K" }, { "series": [ { "spring": "K" }, { "damper": 20 } ] } ] } })");
  // With names that the batch's class declares itself: a constant that an argument hides would be another number.
  files.push_back((folder / "like_the_batch.json").string());
  std::string branches = R"({ "damper": 2, "name": "point" })";
  for (const char* name : {"block", "states", "points", "storage", "put", "run", "vector", "lane"})
    branches += fmt::format(R"(, {{ "series": [ {{ "spring": 500 }}, {{ "slip": 0.2, "name": "{}" }} ] }})", name);
  for (const auto& [spring, damper] : {std::pair("positions", "forces"), std::pair("i", "number"),
                                       std::pair("state", "value"), std::pair("begin", "dampings")})
    branches += fmt::format(
        R"(, {{ "series": [ {{ "spring": 90, "name": "{}" }}, {{ "damper": 4, "name": "{}" }} ] }})", spring, damper);
  write_text(files.back(), fmt::format(R"({{ "dashpot": 1, "name": "like_the_batch", "parameters": {{
      "wanted": {{ "value": 300, "tunable": true, "min": 30, "max": 900 }},
      "clamped": {{ "value": 3, "tunable": true, "min": 0, "max": 30 }} }},
    "network": {{ "parallel": [ {{ "spring": "wanted" }}, {{ "damper": "clamped" }}, {} ] }} }})",
                                       branches));
  files.push_back((folder / "rubbing.json").string());
  write_text(files.back(), R"({ "dashpot": 1, "name": "rubbing",
    "parameters": { "K": { "value": 300, "tunable": true, "min": 0, "max": 900 },
                    "B": { "value": 3, "tunable": true, "min": 0, "max": 30 },
                    "Y": { "value": 0.4, "tunable": true, "min": 0, "max": 2 } },
    "network": { "parallel": [
      { "series": [ { "parallel": [ { "spring": 500 }, { "damper": "B" } ] },
                    { "parallel": [ { "spring": "K" },
                                    { "series": [ { "parallel": [ { "spring": 800 }, { "damper": 2 } ] },
                                                  { "parallel": [ { "slip": "Y" }, { "spring": 90 } ] } ] } ] } ] },
      { "series": [ { "spring": "K" }, { "slip": 0.2 } ] } ] } })");
  constexpr Kind without_slips[] = {Kind::parallel_branches, Kind::tree, Kind::graph, Kind::touched};
  for (std::uint64_t seed = 1; seed <= repetitions(4, 40); ++seed) {
    files.push_back((folder / fmt::format("tunable_{}.json", seed)).string());
    write_text(files.back(), tunable_network(seed, without_slips[seed % 4]));
  }
  return files;
}

// The largest value of each parameter; nothing of a network without any.
std::string largest_values(const std::string& file) {
  const std::string text = text_of(file);
  if (text.find("tunable\": true") == text.npos) return "";
  std::string values;
  const TunableLaw law(text);
  for (const compiler::Tunable& tunable : law.tunables())
    values += fmt::format("{}scalar({})", values.empty() ? "" : ", ", tunable.range.max);
  return values;
}

// Trees and loops of slips, alone and behind a surface; with parameters as well.
std::vector<std::string> coupled_networks(const fs::path& folder, bool tunable) {
  std::vector<std::string> files;
  if (tunable) files.push_back(DASHPOT_NETWORKS "/tunable/layers_tunable.json");
  else files.push_back(DASHPOT_NETWORKS "/tissues/needle_in_liver.json");
  constexpr Kind with_slips[] = {Kind::slips, Kind::slips_in_graph, Kind::touched_slips, Kind::touched_slips_in_graph};
  for (std::uint64_t seed = 1; seed <= repetitions(4, 60); ++seed) {
    files.push_back((folder / fmt::format("{}_{}.json", tunable ? "tunable" : "random", seed)).string());
    if (tunable) {
      write_text(files.back(), tunable_network(seed, with_slips[seed % 4]));
      continue;
    }
    NetworkRecipe recipe;
    recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
    recipe.most_nodes = 7;
    recipe.most_slips = 4;
    write_text(files.back(), json_text(random_network(seed, recipe)));
  }
  return files;
}

std::string class_of(const std::string& file) { return fs::path(file).stem().string(); }

// Which classes a batch is compared with.
enum class Single { in_both_forms, with_jumps };

// The class in constant time stands in a namespace of another name.
std::string program_of(const std::vector<std::string>& files, Single single) {
  std::string headers, timed, calls;
  for (const std::string& file : files) {
    const std::string name = class_of(file);
    headers += fmt::format("#include \"plain/{0}.hpp\"\n#include \"plain/{0}_batch.hpp\"\n", name);
    if (single == Single::in_both_forms) timed += fmt::format("#include \"timed/{}.hpp\"\n", name);
    const std::string other = (single == Single::in_both_forms ? "dashpot::timed::" : "dashpot::generated::") + name;
    if (const std::string largest = largest_values(file); !largest.empty()) {
      calls += fmt::format(
          "  {{\n    using scalar = dashpot::generated::{0}::scalar;\n    const scalar largest[] = {{{1}}};\n"
          "    failed |= points::differ_when_set<dashpot::generated::{0}, {2}, "
          "dashpot::generated::{0}_batch>(\"{0}\", largest);\n  }}\n",
          name, largest, other);
      continue;
    }
    calls += fmt::format(
        "  failed |= points::differ<dashpot::generated::{0}, {1}, "
        "dashpot::generated::{0}_batch>(\"{0}\");\n",
        name, other);
    if (name == "second_order_maxwell")
      calls += fmt::format(
          "  failed |= points::own_storage_differs<dashpot::generated::{0}, "
          "dashpot::generated::{0}_points<19>>(\"{0}_points\");\n",
          name);
  }
  return headers + "#define generated timed\n" + timed +
         "#undef generated\n#include \"points_driver.hpp\"\nint main() {\n  bool failed = false;\n" + calls +
         "  return failed;\n}\n";
}

// Of `files`, compiled into `folder`.
void expect_agreement(const TemporaryFolder& folder, const std::vector<std::string>& files, const std::string& choices,
                      Single single = Single::in_both_forms, const Machines& machines = {gxx, clangxx}) {
  std::string all;
  for (const std::string& file : files) all += fmt::format(" '{}'", file);
  const std::string compile =
      fmt::format("'{}' compile {}{} -o '{}/", DASHPOT_EXECUTABLE, choices, all, folder.path().string());
  run_or_throw(compile + "plain' --batch");
  if (single == Single::in_both_forms) run_or_throw(compile + "timed' --constant-time");
  write_text(folder.path() / "points.cpp", program_of(files, single));
  for (const Machine& machine : machines) {
    const std::string program = (folder.path() / "points").string();
    run_or_throw(fmt::format(
        "'{0}' -std=c++17 {1} -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion "
        "-Wdouble-promotion -Wshadow "
        "-Werror "
        "-I'{2}' -I'{3}' -I'{4}' '{5}.cpp' -o '{5}'",
        machine.compiler, machine.flags, DASHPOT_RUNTIME_INCLUDE, DASHPOT_DRIVER, folder.path().string(), program));
    const Finished finished = run_command("'" + program + "'");
    EXPECT_TRUE(finished.status == 0 && finished.output.empty())
        << machine.compiler << " " << machine.flags << " " << choices << "\n"
        << finished.output;
  }
}

void expect_agreement(const std::string& choices, const Machines& machines) {
  const TemporaryFolder folder;
  expect_agreement(folder, networks(folder.path()), choices, Single::in_both_forms, machines);
}

// Fails if a point's force, damping or energy differs in any bit from the single class's, at any sample, finite or not,
// in the fused step or in two phases, or if masks give other bits than jumps.
TEST(Points, AreSingleNetworksInDouble) { expect_agreement("--scheme exact", alone(gxx)); }

// Fails likewise in float, where modes are in delta form and registers hold twice as many.
TEST(Points, AreSingleNetworksInFloat) { expect_agreement("--scalar float --scheme backward-euler", alone(clangxx)); }

// Fails likewise where rounding is carried along.
TEST(Points, AreSingleNetworksWithCompensation) { expect_agreement("--scalar float --rate 100000", alone(gxx)); }

// Fails likewise where parameters change between samples, each point's by themselves, and points are put to rest.
TEST(Points, AreSingleNetworksWithParametersOfTheirOwn) {
  const TemporaryFolder folder;
  expect_agreement(folder, tunable_networks(folder.path()), "--rate 1000", Single::in_both_forms, alone(gxx));
}

// Fails likewise in float, on a motor that makes little of what is asked for, so that forces are let go of.
TEST(Points, AreSingleNetworksWithParametersOnAWeakMotor) {
  const TemporaryFolder folder;
  const std::string device = (folder.path() / "weak.device").string();
  write_text(device, R"({ "dashpot_device": 1, "name": "weak", "motion": "translation", "loop": { "rate": "1 kHz" },
                          "encoder": { "resolution": "10 um" }, "motor": { "max_torque": "0.05 N", "slew": "20 N/s" },
                          "velocity": { "estimator": "backward_difference", "window": 1 } })");
  expect_agreement(folder, tunable_networks(folder.path()),
                   fmt::format("--device '{}' --decomposition paper --uncertified --scalar float", device),
                   Single::in_both_forms, alone(clangxx));
}

// Fails likewise where slips are solved together, one point after the other, in double and in float.
TEST(Points, AreSingleNetworksWithCoupledSlips) {
  for (const auto& [choices, machine] :
       {std::pair("--rate 1000", gxx), std::pair("--rate 5000 --scalar float --scheme backward-euler", clangxx)}) {
    const TemporaryFolder folder;
    expect_agreement(folder, coupled_networks(folder.path(), false), choices, Single::with_jumps, alone(machine));
  }
}

// Fails likewise where what the solvers read is another at each point, since parameters change it.
TEST(Points, AreSingleNetworksWithCoupledSlipsAndParameters) {
  const TemporaryFolder folder;
  expect_agreement(folder, coupled_networks(folder.path(), true), "--rate 1000", Single::with_jumps, alone(clangxx));
}

// Fails likewise where the brake's coil needs twenty samples from one regime to another, and the motor makes up for it
// on its way.
TEST(Points, AreSingleNetworksBehindASlowCoil) {
  const TemporaryFolder folder;
  const std::string device = (folder.path() / "coil.json").string();
  write_text(device, R"({ "dashpot_device": 1, "name": "coil", "motion": "translation", "loop": { "rate": "1 kHz" },
                          "encoder": { "resolution": "10 um" }, "velocity": { "estimator": "butterworth", "order": 2, "cutoff": "100 Hz" },
                          "brake": { "kind": "shorted_motor", "max_damping": "50 N s/m", "coil_lag": "20 ms" } })");
  const std::string tunable = (folder.path() / "rubbing_tunable.json").string();
  write_text(tunable, R"({ "dashpot": 1, "name": "rubbing_tunable",
    "parameters": { "K": { "value": 300, "tunable": true, "min": 30, "max": 900 } },
    "network": { "parallel": [ { "series": [ { "slip": 0.01 }, { "parallel": [ { "spring": "K" }, { "damper": 2 } ] } ] },
                               { "series": [ { "slip": 0.02 }, { "spring": 20 } ] }, { "damper": 5 } ] } })");
  const std::string on_device = fmt::format("--uncertified --device '{}' --decomposition ", device);
  expect_agreement(folder, {tunable}, on_device + "paper", Single::with_jumps);
  EXPECT_NE(text_of(folder.path() / "plain/rubbing_tunable_batch.hpp").find("vector::square_root"), std::string::npos)
      << "no root of the brake's damping is taken";
  expect_agreement(folder, {DASHPOT_NETWORKS "/paper/visco_elasto_plastic.json"}, on_device + "gated");
  EXPECT_NE(text_of(folder.path() / "plain/visco_elasto_plastic_batch.hpp").find("coil_share"), std::string::npos)
      << "no command waits for the coil";
}

}  // namespace
}  // namespace dashpot::testing
