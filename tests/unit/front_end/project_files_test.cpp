// What the project itself ships in these formats: networks, devices, and the examples of the two references.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../../../examples/breast_palpation/device.hpp"
#include "../../../examples/knee_ligament/device.hpp"
#include "../../../examples/knob_on_board/device.hpp"
#include "../../../examples/needle_in_layers/device.hpp"
#include "../../../examples/surface/device.hpp"
#include "../../../examples/tunable_wall/device.hpp"
#include "front_end_run.hpp"

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

// If this fails, a network of the project is refused.
TEST(ProjectFiles, NetworksAreAccepted) {
  const auto files = descriptions_in<fs::recursive_directory_iterator>(root / "networks");
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const NetworkRun run(read_file(file));
    EXPECT_TRUE(run.network) << file << "\n" << run.said();
    EXPECT_TRUE(run.network && run.network->name == file.stem()) << file;
  }
}

// If this fails, a device of the project is refused.
TEST(ProjectFiles, DevicesAreAccepted) {
  for (const fs::path& file : descriptions_in<fs::directory_iterator>(root / "runtime/devices")) {
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
  for (const std::string& text : networks) EXPECT_EQ(NetworkRun(text).said(), "") << text;
  for (const std::string& text : devices) EXPECT_EQ(DeviceRun(text).said(), "") << text;
}

// Every number of a description; a new one that is not listed does not compile.
std::vector<double> numbers_of(const device_description& described) {
  const auto& [motion, arm, loop, encoder, velocity, motor, brake, mechanics] = described;
  const auto& [period, jitter, delay, band_low, band_high, reference, missed] = loop;
  const auto& [step, rounding, range_low, range_high, max_speed] = encoder;
  const auto& [estimator, window, order, cutoff, best, acceleration, factor, noise, bandwidth] = velocity;
  const auto& [torque_constant, torque, lag, slew, saturation, motor_noise] = motor;
  const auto& [kind, damping, per_current, residual, tolerance, coil, brake_slew, critical, safe] = brake;
  const auto& [inertia, own, friction, mode, backlash] = mechanics;
  const auto& [frequency, ratio, mass] = mode;
  return {double(motion),
          arm,
          period,
          jitter,
          double(delay),
          band_low,
          band_high,
          reference,
          double(missed),
          step,
          double(rounding),
          range_low,
          range_high,
          max_speed,
          double(estimator),
          double(window),
          double(order),
          cutoff,
          double(best),
          acceleration,
          factor,
          noise,
          bandwidth,
          torque_constant,
          torque,
          lag,
          slew,
          saturation,
          motor_noise,
          double(kind),
          damping,
          per_current,
          residual,
          tolerance,
          coil,
          brake_slew,
          critical,
          safe,
          inertia,
          own,
          friction,
          frequency,
          ratio,
          mass,
          backlash};
}

// If this fails, an example's loop runs another device than the one that its law was compiled for. Degrees are turned
// into radians by each in its own way, so that they may differ by rounding.
TEST(ProjectFiles, ExamplesDescribeTheirDevicesTwiceAlike) {
  const std::pair<const char*, device_description> examples[] = {
      {"breast_palpation", palpation_trainer()}, {"needle_in_layers", needle_trainer()}, {"knee_ligament", knee_rig()},
      {"knob_on_board", knob_board()},           {"tunable_wall", wall_trainer()},       {"surface", probe()}};
  for (const auto& [folder, described] : examples) {
    const DeviceRun run(read_file(root / "examples" / folder / "device.json"));
    ASSERT_TRUE(run.device) << folder << "\n" << run.said();
    const std::vector<double> file = numbers_of(run.device->description), loop = numbers_of(described);
    for (std::size_t i = 0; i < file.size(); ++i) EXPECT_DOUBLE_EQ(file[i], loop[i]) << folder << ", number " << i;
  }
}

}  // namespace
}  // namespace dashpot::compiler
