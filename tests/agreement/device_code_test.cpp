// What `dashpot device --target` writes is the device that was read: every number, its name and its digest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <dashpot/estimators/estimator_names.hpp>

#include "device_numbers.hpp"
#include "emit/emit_device.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

// No number is one that a description begins with, nor one of its neighbours.
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
  d.loop = {some(), some(), count(), some(), some(), some(), count()};
  d.encoder = {some(), quantiser::round, -some(), some(), some()};
  d.velocity = {
      all_estimators[seed % std::size(all_estimators)], count(), count(), some(), true, some(), some(), some(), some()};
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

// If this fails, a device whose name is no name in code, or one of its own header's, does not compile.
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
