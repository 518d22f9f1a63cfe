// What `dashpot device --target` writes is the device that was read: every number, its name and its digest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/estimator_names.hpp>

#include "device_numbers.hpp"
#include "emit/emit_device.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

// No number has its default value, or that of a neighbour.
compiler::Device other_device(std::uint64_t seed) {
  Random random(seed);
  const auto some = [&] { return random.log_uniform(1e-7, 1e5); };
  const auto count = [&] { return unsigned(random.uniform(5, 1000)); };
  compiler::Device device;
  device.name = "2nd \"rig\"? \\ of the lab\t\xC3\xA4";
  device.digest = "0123456789abcdef";
  device_description& d = device.description;
  d.motion = seed % 2 == 0 ? motion::rotation : motion::translation;
  d.arm_radius = some();
  d.loop = {some(), some(), count(), some(), some(), some(), some(), some(), count()};
  d.encoder = {some(), quantiser::round, -some(), some(), some()};
  d.velocity = {
      all_estimators[seed % std::size(all_estimators)], count(), count(), some(), true, some(), some(), some(), some()};
  d.velocity.cutoff = random.uniform(0.1, 0.4) / d.loop.sample_period;
  d.motor = {some(), some(), some(), some(), some(), some()};
  d.brake = {seed % 2 == 0 ? brake_kind::eddy_current : brake_kind::shorted_motor,
             some(),
             some(),
             some(),
             some(),
             some(),
             some(),
             some(),
             some()};
  d.mechanics = {some(), some(), some(), {some(), some(), some()}, some()};
  return device;
}

void write(const compiler::Device& device, const fs::path& folder) {
  compiler::Diagnostics diagnostics;
  const auto cpp = emit_device(device, compiler::DeviceLanguage::cpp, diagnostics);
  const auto c = emit_device(device, compiler::DeviceLanguage::c99, diagnostics);
  ASSERT_TRUE(cpp && c) << render_text(diagnostics);
  write_text(folder / "device.hpp", *cpp);
  write_text(folder / "device.h", *c);
}

// `type` is what the device is called in code.
std::string printing_program(const std::string& type) {
  return fmt::format(R"(#include <cstdio>
#include "device.h"
#include "device.hpp"
#include "device_numbers.hpp"
int main() {{
  using told = dashpot::devices::{0};
  constexpr dashpot::device_description in_cpp = told::description();
  const dashpot_device in_c = dashpot_device_{0}();
  std::printf("%s\n%s\n%s\n%s\n%s\n", told::name, told::digest, in_c.name, in_c.digest, in_c.estimator);
  for (const double number : dashpot::testing::numbers_in_cpp(in_cpp)) std::printf("%a\n", number);
  for (const double number : dashpot::testing::numbers_in_c(in_c)) std::printf("%a\n", number);
}}
)",
                     type);
}

const std::string strict = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror";

class DeviceCode : public ::testing::TestWithParam<int> {};

// If this fails, a loop runs another device than the one that its law is certified for.
TEST_P(DeviceCode, SaysWhatTheFileSays) {
  const compiler::Device device = other_device(std::uint64_t(GetParam()));
  const std::vector<double> numbers = numbers_in_cpp(device.description);
  const std::vector<double> at_first = numbers_in_cpp(device_description());
  for (std::size_t i = 1; i < numbers.size(); ++i)  // 0 is the motion, which has two values
    ASSERT_NE(numbers[i], at_first[i]) << "number " << i << " would tell nothing";
  const TemporaryFolder folder;
  write(device, folder.path());
  write_text(folder.path() / "main.cpp", printing_program("n2nd_rig_of_the_lab"));
  std::string expected = fmt::format("{0}\n{1}\n{0}\n{1}\n{2}\n", device.name, device.digest,
                                     name_of(device.description.velocity.estimator));
  for (int language = 0; language < 2; ++language)
    for (const double number : numbers) {
      char text[64];
      std::snprintf(text, sizeof text, "%a\n", number);
      expected += text;
    }
  const std::string program = (folder.path() / "told").string();
  const Finished built =
      run_command(fmt::format("{} -std=c++17 {} -I{} -I{} {} -o {}", DASHPOT_GXX, strict, DASHPOT_RUNTIME_INCLUDE,
                              DASHPOT_DRIVER, (folder.path() / "main.cpp").string(), program));
  ASSERT_EQ(built.status, 0) << built.output;
  EXPECT_EQ(run_command(program).output, expected);
}

INSTANTIATE_TEST_SUITE_P(Both, DeviceCode, ::testing::Values(1, 2));

// If this fails, a loop in C does not compile, or needs a file of dashpot's beside it.
TEST(DeviceCodeInC, IsStrictAndAlone) {
  const TemporaryFolder folder;
  write(other_device(4), folder.path());
  write_text(folder.path() / "main.c",
             "#include \"device.h\"\nint main(void) { const dashpot_device d = dashpot_device_n2nd_rig_of_the_lab(); "
             "return d.motion == dashpot_motion_rotation ? 0 : 1; }\n");
  const std::string program = (folder.path() / "told").string();
  for (const char* compiler : {DASHPOT_GCC, DASHPOT_CLANG}) {
    const Finished built = run_command(
        fmt::format("{} -std=c99 {} {} -o {}", compiler, strict, (folder.path() / "main.c").string(), program));
    ASSERT_EQ(built.status, 0) << built.output;
    EXPECT_EQ(run_command(program).status, 0);
  }
}

struct Moment {
  double position, velocity;
  std::uint64_t edge_time_ns, timestamp_ns;
};

constexpr double encoder_step = 1e-5;

// At an encoder and beside it, with rests, reversals, leaps and a clock that wraps around; edges with and without a
// time.
std::vector<Moment> moments() {
  Random random(23);
  std::vector<Moment> all;
  double place = 0.3, velocity = 0;
  std::uint64_t now = std::uint64_t(0) - 300'000'000;
  for (int k = 0; k < 3000; ++k) {
    now += std::uint64_t(random.uniform(0.9e6, 1.1e6));
    if (k % 100 == 0) velocity = random.chance(0.2) ? 0 : random.uniform(-1, 1) * random.log_uniform(1e-3, 1);
    velocity += random.uniform(-1, 1) * 1e-3;
    if (k % 100 > 80) velocity = 0;
    place += k % 701 == 700 ? 0.1 : velocity * 1e-3;
    const bool is_ideal = k % 1000 >= 800;
    const double position = is_ideal ? place : encoder_step * std::floor(place / encoder_step);
    const bool is_timed = k % 400 < 250 && !random.chance(0.02);
    all.push_back({position, velocity, is_timed ? now - std::uint64_t(random.uniform(0, 2e6)) : 0, now});
  }
  return all;
}

std::vector<compiler::Device> devices_with_every_estimator() {
  std::vector<compiler::Device> all;
  const auto add = [&](estimator_kind kind, auto... more) {
    compiler::Device device;
    device.name = fmt::format("estimator_{}", all.size());
    device.description.loop.sample_period = all.size() % 2 == 0 ? 1e-3 : 1 / 3000.0;
    device.description.encoder.step = encoder_step;
    device.description.velocity.estimator = kind;
    (more(device.description.velocity), ...);
    all.push_back(device);
  };
  using asked = velocity_description;
  for (const unsigned window : {1u, 2u, 7u, 64u, 256u}) {
    const auto samples = [=](asked& v) { v.window = window; };
    add(estimator_kind::backward_difference, samples);
    add(estimator_kind::least_squares, samples);
    add(estimator_kind::foaw, samples);
    add(estimator_kind::foaw, samples, [](asked& v) { v.best_fit = true; });
  }
  for (const double cutoff : {0.5, 20.0, 120.0, 499.0})
    for (const unsigned order : {2u, 4u})
      add(estimator_kind::butterworth, [=](asked& v) { v.order = order, v.cutoff = cutoff; });
  for (const double acceleration : {1e-3, 1.0, 30.0, 1e4}) {
    const auto bound = [=](asked& v) { v.acceleration = acceleration; };
    add(estimator_kind::kalman, bound);
    add(estimator_kind::super_twisting, bound);
    for (const double factor : {1.0, 5.5})
      add(estimator_kind::tracking_differentiator, bound, [=](asked& v) { v.filter_factor = factor; });
  }
  add(estimator_kind::inverse_time);
  add(estimator_kind::sensor, [](asked& v) { v.bandwidth = 200; });
  return all;
}

// Every estimator over the motion that is read, begun anew in the middle.
std::string estimating_program(const std::vector<compiler::Device>& devices) {
  std::string text = "#include <stdio.h>\n";
  for (const compiler::Device& device : devices) text += fmt::format("#include \"{}.h\"\n", device.name);
  text +=
      "static double position[5000], velocity[5000];\nstatic unsigned long long edge[5000], now[5000];\n"
      "int main(void) {\n  int rows = 0;\n"
      "  while (scanf(\"%la %la %llu %llu\", &position[rows], &velocity[rows], &edge[rows], &now[rows]) == 4) "
      "++rows;\n";
  for (const compiler::Device& device : devices) {
    const estimator_kind kind = device.description.velocity.estimator;
    const char* sample = kind == estimator_kind::sensor         ? "velocity[n]"
                         : kind == estimator_kind::inverse_time ? "position[n], edge[n], now[n]"
                                                                : "position[n]";
    text += fmt::format(
        "  {{\n    dashpot_estimator_{0} estimator;\n"
        "    dashpot_estimator_{0}_reset(&estimator, position[0]);\n    for (int n = 0; n < rows; ++n) {{\n"
        "      if (n == 1500) dashpot_estimator_{0}_reset(&estimator, position[n]);\n"
        "      printf(\"%a\\n\", dashpot_estimator_{0}_update(&estimator, {1}));\n    }}\n  }}\n",
        device.name, sample);
  }
  return text + "  return 0;\n}\n";
}

std::string estimates(const compiler::Device& device, const std::vector<Moment>& motion) {
  const device_description& d = device.description;
  any_estimator<double> estimator(d.velocity, d.loop.sample_period, d.encoder.step);
  std::string text;
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const Moment& now = motion[n];
    if (n == 0 || n == 1500) estimator.reset(now.position);
    device_sample sample;
    sample.position = now.position;
    sample.velocity = now.velocity;
    sample.edge_time_ns = now.edge_time_ns;
    sample.timestamp_ns = now.timestamp_ns;
    char line[40];
    std::snprintf(line, sizeof line, "%a\n", estimator.update(sample));
    text += line;
  }
  return text;
}

// If this fails, a loop in C feels another velocity than the one that its law is certified with.
TEST(DeviceCodeInC, EstimatesAsTheRuntimeDoes) {
  const TemporaryFolder folder;
  const std::vector<compiler::Device> devices = devices_with_every_estimator();
  const std::vector<Moment> motion = moments();
  std::string input, expected;
  for (const Moment& now : motion)
    input += fmt::format("{:a} {:a} {} {}\n", now.position, now.velocity, now.edge_time_ns, now.timestamp_ns);
  for (const compiler::Device& device : devices) {
    compiler::Diagnostics diagnostics;
    const auto header = emit_device(device, compiler::DeviceLanguage::c99, diagnostics);
    ASSERT_TRUE(header) << render_text(diagnostics);
    EXPECT_EQ(header->find("#include"), header->npos) << device.name;
    write_text(folder.path() / (device.name + ".h"), *header);
    expected += estimates(device, motion);
  }
  write_text(folder.path() / "main.c", estimating_program(devices));
  write_text(folder.path() / "input", input);
  for (const char* compiler : {DASHPOT_GCC " -std=c99", DASHPOT_CLANG " -std=c99", DASHPOT_GXX " -x c++ -std=c++17"}) {
    const Finished done =
        run_command(fmt::format("cd '{}' && {} {} -O1 -ffp-contract=off main.c -o main && ./main < input",
                                folder.path().string(), compiler, strict));
    ASSERT_EQ(done.status, 0) << compiler << "\n" << done.output.substr(0, 4000);
    const auto [at, there] = std::mismatch(done.output.begin(), done.output.end(), expected.begin(), expected.end());
    const auto line = std::size_t(std::count(done.output.begin(), at, '\n'));
    EXPECT_TRUE(at == done.output.end() && there == expected.end())
        << compiler << ": sample " << line % motion.size() << " of device " << line / motion.size();
  }
}

// If this fails, a device's header lacks an estimator that a loop in C would look for in it.
TEST(DeviceCodeInC, SaysWhichEstimatorIsMissing) {
  const std::vector<compiler::Device> known = devices_with_every_estimator();
  for (const estimator_kind kind : all_estimators) {
    compiler::Device device = known.front();
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const compiler::Device& one) {
      return one.description.velocity.estimator == kind;
    });
    device.description.velocity.estimator = kind;
    device.description.velocity.acceleration = 1;
    device.description.velocity.cutoff = 100;
    compiler::Diagnostics diagnostics;
    const auto header = emit_device(device, compiler::DeviceLanguage::c99, diagnostics);
    ASSERT_TRUE(header) << render_text(diagnostics);
    EXPECT_EQ(header->find("_update(") != header->npos, is_known) << name_of(kind);
    EXPECT_EQ(header->find("is not written in C") != header->npos, !is_known) << name_of(kind);
  }
}

// If this fails, a device does not compile whose name cannot be one in code, or is one that its header uses itself.
TEST(DeviceCodeInCpp, TakesAnyName) {
  const TemporaryFolder folder;
  compiler::Device device = other_device(6);
  for (const auto& [name, type] :
       std::initializer_list<std::pair<const char*, const char*>>{{"name", "name_1"},
                                                                  {"digest", "digest_1"},
                                                                  {"description", "description_1"},
                                                                  {"double", "double_1"},
                                                                  {"\xE8\x85\x95", "unnamed"},
                                                                  {"motion", "motion_1"},
                                                                  {"dashpot", "dashpot_1"},
                                                                  {"ends in \\", "ends_in"},
                                                                  {"trigraph ?\?/", "trigraph"}}) {
    device.name = name;
    write(device, folder.path());
    write_text(folder.path() / "main.cpp", printing_program(type));
    const Finished built =
        run_command(fmt::format("{} -std=c++17 -fsyntax-only {} -I{} -I{} {}", DASHPOT_GXX, strict,
                                DASHPOT_RUNTIME_INCLUDE, DASHPOT_DRIVER, (folder.path() / "main.cpp").string()));
    EXPECT_EQ(built.status, 0) << name << "\n" << built.output;
  }
}

}  // namespace
}  // namespace dashpot::testing
