// What the project itself ships in these formats: networks, devices, and the examples of the two references.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "front_end_run.hpp"
#include "network/axes_device.hpp"
#include "network/axes_network.hpp"
#include "source/render.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

const fs::path root = DASHPOT_SOURCE_DIR;

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_description(const fs::path& path) {
  return path.extension() == ".json" && path.stem().extension() != ".schema";
}

template <class Iterator>
std::vector<fs::path> descriptions_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : Iterator(folder))
    if (is_description(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> examples_in(const fs::path& readme) {
  const std::string text = read_file(readme);
  const std::string fence = "```json\n";
  std::vector<std::string> examples;
  for (std::size_t begin = text.find(fence); begin != std::string::npos; begin = text.find(fence, begin + 1)) {
    const std::size_t from = begin + fence.size();
    examples.push_back(text.substr(from, text.find("```", from) - from));
  }
  return examples;
}

bool is_of_two_axes(const std::string& text) { return axes_of(SourceFile("file.json", text)) > 1; }

// What is said of a file of two axes.
std::string said_of_axes(const std::string& text) {
  const SourceFile source("file.json", text);
  Diagnostics diagnostics;
  if (text.find("dashpot_device") != text.npos) {
    const auto decl = parse_axes_device(source, diagnostics);
    if (decl) build_axes_device(*decl, diagnostics);
  } else if (const auto decl = parse_axes_network(source, diagnostics)) {
    build_axes_network(*decl, diagnostics);
  }
  return render_text(diagnostics);
}

// If this fails, a network or a device of two axes of the project is refused.
TEST(ProjectFiles, FilesOfTwoAxesAreAccepted) {
  auto files = descriptions_in<fs::directory_iterator>(root / "networks/axes");
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : descriptions_in<fs::directory_iterator>(root / "runtime/devices"))
    if (is_of_two_axes(read_file(file))) files.push_back(file);
  for (const fs::path& file : files) EXPECT_EQ(said_of_axes(read_file(file)), "") << file;
}

// If this fails, a network of the project is refused.
TEST(ProjectFiles, NetworksAreAccepted) {
  const auto files = descriptions_in<fs::recursive_directory_iterator>(root / "networks");
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    if (file.parent_path().filename() == "axes") continue;
    const NetworkRun run(read_file(file));
    EXPECT_TRUE(run.network) << file << "\n" << run.said();
    EXPECT_TRUE(run.network && run.network->name == file.stem()) << file;
  }
}

// If this fails, a device of the project is refused.
TEST(ProjectFiles, DevicesAreAccepted) {
  for (const fs::path& file : descriptions_in<fs::directory_iterator>(root / "runtime/devices")) {
    if (is_of_two_axes(read_file(file))) continue;
    const DeviceRun run(read_file(file));
    EXPECT_TRUE(run.device) << file << "\n" << run.said();
    EXPECT_TRUE(run.device && run.device->name == file.stem()) << file;
  }
}

// If this fails, an author who copies an example from the reference is told that it is wrong.
TEST(ProjectFiles, ExamplesOfTheReferencesAreBeyondReproach) {
  const std::vector<std::string> networks = examples_in(root / "networks/README.md");
  const std::vector<std::string> devices = examples_in(root / "runtime/devices/README.md");
  EXPECT_FALSE(networks.empty() || devices.empty());
  for (const std::string& text : networks)
    EXPECT_EQ(is_of_two_axes(text) ? said_of_axes(text) : NetworkRun(text).said(), "") << text;
  for (const std::string& text : devices)
    EXPECT_EQ(is_of_two_axes(text) ? said_of_axes(text) : DeviceRun(text).said(), "") << text;
}

}  // namespace
}  // namespace dashpot::compiler
