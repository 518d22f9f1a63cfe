// generated/ is what the compiler writes, byte for byte, so that a change of emitted code is seen where it is reviewed.
// With --update the folder is written anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

const fs::path source = DASHPOT_SOURCE;
const fs::path recorded = source / "generated";

// Networks that are compiled with the same choices into one folder of generated/.
struct Recording {
  std::string folder;
  std::string choices;
  std::vector<fs::path> networks;
};

std::vector<fs::path> networks_in(const std::string& room) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source / "networks" / room))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Folders in networks/ that hold networks, each after the one that it is in.
std::vector<std::string> rooms() {
  std::set<std::string> rooms;
  for (const auto& entry : fs::recursive_directory_iterator(source / "networks"))
    if (entry.path().extension() == ".json" && entry.path().filename() != "network.schema.json")
      rooms.insert(entry.path().parent_path().lexically_relative(source / "networks").generic_string());
  return {rooms.begin(), rooms.end()};
}

// Every network with the defaults, and each form that the defaults do not show once.
std::vector<Recording> recordings() {
  const fs::path paper = source / "networks/paper";
  const std::string pantograph = "--device '" + (source / "runtime/devices/pantograph_2dof.json").string() + "'";
  std::vector<Recording> all = {
      {"forms/backward_euler", "--scheme backward-euler", {paper / "second_order_maxwell.json"}},
      {"forms/nodal", "--scheme backward-euler --state-input nodal", {paper / "generalised_kelvin_two.json"}},
      {"forms/velocity", "--state-input velocity", {paper / "maxwell_damper_at_tool.json"}},
      {"forms/float_delta", "--scalar float", {paper / "second_order_maxwell.json"}},
      {"forms/float_compensated", "--scalar float --rate 100000", {paper / "second_order_maxwell.json"}},
      {"forms/rolled", "", {source / "tests/responses/networks/twenty_branches.json"}},
      {"forms/rolled_avx512", "--vector avx512", {source / "tests/responses/networks/twenty_branches.json"}},
      {"forms/constant_time",
       "--constant-time",
       {paper / "visco_elasto_plastic.json", source / "networks/tunable/second_order_maxwell_tunable.json"}},
      {"forms/c99",
       "--target c99",
       {paper / "second_order_maxwell.json", paper / "visco_elasto_plastic.json",
        source / "networks/tunable/friction_tunable.json"}},
      {"forms/c99_axes", pantograph + " --target c99", {source / "networks/axes/kelvin_field.json"}},
      {"forms/hal", "--target hal", {paper / "second_order_maxwell.json"}},
      {"forms/batch",
       "--batch",
       {paper / "second_order_maxwell.json", source / "networks/tunable/second_order_maxwell_tunable.json"}},
  };
  for (const std::string& room : rooms()) all.push_back({room, room == "axes" ? pantograph : "", networks_in(room)});
  return all;
}

// Relative path in generated/ → text.
std::map<std::string, std::string> written_now() {
  const TemporaryFolder folder;
  std::map<std::string, std::string> files;
  for (const Recording& recording : recordings()) {
    const fs::path target = folder.path() / recording.folder;
    std::string line = "'" DASHPOT_EXECUTABLE "' compile " + recording.choices + " -o '" + target.string() + "'";
    for (const fs::path& network : recording.networks) line += " '" + network.string() + "'";
    const Finished finished = run_command(line);
    if (finished.status != 0) throw std::runtime_error(finished.output);
    for (const auto& entry : fs::directory_iterator(target))
      files[recording.folder + "/" + entry.path().filename().string()] = text_of(entry.path());
  }
  return files;
}

std::set<std::string> recorded_headers() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(recorded))
    if (entry.path().extension() == ".hpp") names.insert(entry.path().lexically_relative(recorded).generic_string());
  return names;
}

void update() {
  const std::map<std::string, std::string> files = written_now();
  for (const std::string& name : recorded_headers())
    if (files.count(name) == 0) fs::remove(recorded / name);
  for (const auto& [name, text] : files) write_text(recorded / name, text);
  std::printf("%zu headers recorded in %s\n", files.size(), recorded.c_str());
}

// Fails if the compiler writes anything else than what is committed; the difference is printed.
TEST(Generated, IsWhatTheCompilerWrites) {
  for (const auto& [name, text] : written_now()) {
    if (!fs::exists(recorded / name))
      ADD_FAILURE() << "generated/" << name << " is not recorded; generated_test --update writes it";
    else
      EXPECT_EQ(text_of(recorded / name), text)
          << "generated/" << name << "; if it is meant, generated_test --update records it";
  }
}

// Fails if a header stays behind that no network makes any more.
TEST(Generated, HoldsNothingElse) {
  const std::map<std::string, std::string> files = written_now();
  for (const std::string& name : recorded_headers()) EXPECT_EQ(files.count(name), 1u) << "generated/" << name;
}

// Fails if what is committed depends on the machine that recorded it.
TEST(Generated, NamesNoPathAndNoDate) {
  for (const std::string& name : recorded_headers()) {
    const std::string text = text_of(recorded / name);
    EXPECT_EQ(text.find(source.string()), text.npos) << name;
    EXPECT_EQ(text.find("/tmp"), text.npos) << name;
  }
}

}  // namespace
}  // namespace dashpot::testing

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--update") {
    dashpot::testing::update();
    return 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
