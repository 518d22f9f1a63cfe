#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "compile.hpp"
#include "emit/cpp_program.hpp"
#include "emit/template_text.hpp"
#include "emitted_headers.hpp"

namespace dashpot::compiler {
namespace {

std::string header_of(const std::string& network, const Choices& choices = {}) {
  const SourceFile file("test.json", network);
  Diagnostics diagnostics;
  const std::optional<Compilation> compilation = compile(file, choices, std::nullopt, diagnostics);
  if (!compilation) return "";
  const auto files = emit_cpp(*compilation, {}, diagnostics);
  return files ? files->front().text : "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

// Fails if a printed constant reads back as another number, in either scalar, or is no literal of that type.
TEST(CppLiteral, ReadsBackAsTheSameNumber) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = engine();
    double number;
    std::memcpy(&number, &bits, sizeof number);
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(std::strtod(cpp_literal(number, ScalarType::float64).c_str(), nullptr), number);
    const float small = std::ldexp(float(int(bits % 0x1000000)), int(bits >> 40) % 200 - 120);
    EXPECT_EQ(std::strtof(cpp_literal(double(small), ScalarType::float32).c_str(), nullptr), small);
  }
  EXPECT_EQ(cpp_literal(3, ScalarType::float64), "3.0");
  EXPECT_EQ(cpp_literal(3, ScalarType::float32), "3.0f");
}

// Fails if equal input does not give equal bytes.
TEST(EmitCpp, RepeatsItself) {
  const std::string network = testing::parallel_branches("many", 100);
  const std::string first = header_of(network);
  ASSERT_NE(first, "");
  EXPECT_EQ(header_of(network), first);
}

// Fails if a brake that changes is not what is returned, or not remembered for NaN or infinite samples.
TEST(EmitCpp, ReturnsABrakeThatChanges) {
  const SourceFile file("test.json", R"({ "dashpot": 1, "name": "pad", "network": { "spring": 50 } })");
  Diagnostics diagnostics;
  Compilation c = *compile(file, {}, std::nullopt, diagnostics);
  c.law.brake = c.law.variables.add({"damping", "N·s/m", "b", Role::local, 1, {}});
  c.law.last_brake = c.law.variables.add({"last_damping", "N·s/m", "b", Role::state, 1, {}, 2.5});
  const std::string text = emit_cpp(c, {}, diagnostics)->front().text;
  EXPECT_TRUE(contains(text, "if (!dashpot::all_finite(velocity, force)) return {last_damping_, 0};")) << text;
  EXPECT_TRUE(contains(text, "return {damping, force};")) << text;
  EXPECT_TRUE(contains(text, "    last_damping_ = 2.5;\n")) << text;
  EXPECT_TRUE(contains(text, "scalar last_damping_ = 2.5;")) << text;
  EXPECT_FALSE(contains(text, "constexpr scalar damping")) << text;
}

// Fails if the banner keeps back in what form modes are advanced in single precision, or how far that may be off.
TEST(EmitCpp, StatesFormAndErrorBoundOfFloat) {
  const std::string network =
      R"({ "dashpot": 1, "name": "pad", "network": { "series": [ { "spring": 50 }, { "damper": 5 } ] } })";
  Choices choices;
  choices.scalar = ScalarType::float32;
  // u/α + 4u with u = 2⁻²⁴ and α = 1 − e^(−10 h)
  EXPECT_TRUE(
      contains(header_of(network, choices), "in delta form the force of a mode is off by at most 6.2e-06 of its peak"));
  choices.rate = 1e6;
  EXPECT_TRUE(contains(header_of(network, choices),
                       "in compensated form the force of a mode is off by at most 3.6e-07 of its peak"));
}

// Fails if a banner promises exactness where a slip or a contact changes between two samples, or forgets it of linear
// networks; or if it takes the damping that the brake makes beside slips for all that it makes.
TEST(EmitCpp, SaysOfSlipsAndContactsWhereExactnessEnds) {
  const std::string exact = "a motion that is straight between two samples is answered exactly";
  const std::string but = exact + ", except";
  const auto banner = [](const std::string& more, const std::string& beside) {
    return header_of(R"({ "dashpot": 1, "name": "pad", )" + more + R"("network": { "parallel": [ { "spring": 50 }, )" +
                         beside + R"({ "damper": 5 } ] } })",
                     Choices());
  };
  const std::string linear = banner("", ""), contact = banner(R"("contact": { "at": 0 }, )", "");
  const std::string slip = banner("", R"({ "series": [ { "slip": 1 }, { "spring": 500 } ] }, )");
  EXPECT_TRUE(contains(linear, exact) && !contains(linear, but));
  EXPECT_TRUE(contains(contact, but));
  EXPECT_TRUE(contains(slip, but));
  EXPECT_TRUE(contains(linear, "brake: makes b = 5 N·s/m of damping, and the motor"));
  EXPECT_TRUE(contains(slip, "brake: makes b = 5 N·s/m of damping and, in the parts with slips,"));
}

// Fails if a NaN or infinite input can pass unseen, or if what the force shows of itself is looked at again.
TEST(EmitCpp, TestsInputsThatTheForceDoesNotShow) {
  const auto network = [](const char* structure) {
    return fmt::format(R"({{ "dashpot": 1, "name": "pad", "network": {} }})", structure);
  };
  const auto checked = [](const std::string& text, const std::string& numbers) {
    return contains(text, "all_finite(" + numbers + ")) return");
  };
  const char* const maxwell =
      R"({ "parallel": [ { "spring": 5 }, { "series": [ { "spring": 12 }, { "damper": 5 } ] } ] })";
  EXPECT_TRUE(checked(header_of(network(maxwell)), "force"));
  EXPECT_TRUE(checked(header_of(network(R"({ "spring": 5 })")), "velocity, force"));
  EXPECT_TRUE(
      checked(header_of(network(R"({ "series": [ { "spring": 5 }, { "slip": 1 } ] })")), "position, velocity, force"));
}

// Fails if a step goes through copies that only update() needs, or through two functions where one is enough.
TEST(EmitCpp, FusesAStep) {
  const std::string text = header_of(testing::parallel_branches("some", 3));
  const std::size_t start = text.find("step(scalar position"), end = text.find("unsigned set(", start);
  ASSERT_NE(end, text.npos);
  const std::string step = text.substr(start, end - start);
  EXPECT_FALSE(contains(step, "sampled_position")) << step;
  EXPECT_FALSE(contains(step, "update()")) << step;
  EXPECT_TRUE(contains(step, "last_position_ = position;")) << step;
}

// Fails if the emitted code does not read like the author's model.
TEST(EmitCpp, TakesItsNamesFromTheAuthor) {
  const std::string text = header_of(R"({ "dashpot": 1, "name": "pad", "source": "a paper", "title": "A pad",
    "network": { "series": [ { "spring": 50, "name": "skin" }, { "damper": 5, "name": "fat" } ] } })");
  EXPECT_TRUE(contains(text, "class pad {")) << text;
  EXPECT_TRUE(contains(text, "skin_fat_force_")) << text;
  EXPECT_TRUE(contains(text, "// source: a paper\n")) << text;
  EXPECT_EQ(text.rfind("// A pad\n", 0), 0u) << text;
}

// Fails if words of the author's can leave the comment that they stand in: by an end of line, or by a backslash before
// one, which would take the next line into the comment or out of it.
TEST(EmitCpp, KeepsTheAuthorsWordsInsideComments) {
  const std::string words[] = {R"(ends with a backslash \\)",
                               R"(two\nlines)",
                               R"(carriage\rreturn)",
                               R"(line separator \u2028 x)",
                               R"(bell \u0007)",
                               R"(nul \u0000 inside)",
                               R"(*/ #error out /*)",
                               R"({{name}} {{#x}})",
                               R"(what ??/)",
                               R"(turned \u202e round \u2066 and round)"};
  const testing::TemporaryFolder folder;
  for (const std::string& text : words) {
    const std::string header = header_of(fmt::format(
        R"({{ "dashpot": 1, "name": "words", "title": "{0}", "source": "{0}", "network": {{ "damper": 5 }} }})", text));
    if (header.empty()) continue;
    testing::write_text(folder.path() / "words.hpp", header);
    for (const char* compiler : {DASHPOT_GXX, DASHPOT_CLANGXX}) {
      const testing::Finished finished = testing::run_command(fmt::format(
          "echo '#include \"words.hpp\"\nint main() {{ return sizeof(dashpot::generated::words) == 0; }}' | "
          "'{}' -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only {} -I'{}' -x c++ -",
          compiler, testing::runtime_include(), folder.path().string()));
      EXPECT_EQ(finished.status, 0) << text << "\n" << finished.output;
    }
  }
}

// Fails if a device's name ends the string that it stands in, or comes out as another name.
TEST(EmitCpp, KeepsTheDevicesNameInsideItsString) {
  const std::string name = "a\nb\"; evil(); // \\ ?\?/ é";
  const SourceFile file("test.json", R"({ "dashpot": 1, "name": "words", "network": { "damper": 5 } })");
  Device device;
  device.name = name;
  device.description.loop.sample_period = 0.001;
  Diagnostics diagnostics;
  const std::optional<Compilation> compilation = compile(file, {}, device, diagnostics);
  ASSERT_TRUE(compilation);
  const testing::TemporaryFolder folder;
  testing::write_text(folder.path() / "words.hpp", emit_cpp(*compilation, {}, diagnostics)->front().text);
  const testing::Finished finished = testing::run_command(
      fmt::format("cd '{}' && printf '#include \"words.hpp\"\n#include <cstdio>\n"
                  "int main() {{ std::fputs(dashpot::generated::words::certified_for::device, stdout); }}' > m.cpp && "
                  "'{}' -std=c++17 -trigraphs {} m.cpp -o m && ./m",
                  folder.path().string(), DASHPOT_GXX, testing::runtime_include()));
  EXPECT_EQ(finished.output, name);
}

// Fails if a word longer than a line, or blanks without end, are cut, run for ever, or are taken for a defect.
TEST(EmitCpp, KeepsLongWordsWhole) {
  const std::string link(300, 'x');
  for (const std::string& source : {link, "see " + link, "see " + link + " and " + link + " and more",
                                    link + std::string(200, ' '), std::string(300, ' ')}) {
    const std::string text = header_of(
        fmt::format(R"({{ "dashpot": 1, "name": "words", "source": "{}", "network": {{ "damper": 5 }} }})", source));
    ASSERT_NE(text, "");
    if (source[0] != ' ') {
      EXPECT_TRUE(contains(text, link)) << text;
    }
  }
}

// Fails if an element may bear a name that clashes with another of the emitted class.
TEST(EmitCpp, FindsRoomForAwkwardNames) {
  const testing::TemporaryFolder folder;
  for (const char* name :
       {"force", "damping", "threshold", "relaxed", "position", "velocity", "stored", "total", "lane", "scalar",
        "last_position", "step_stiffness", "static_stiffness", "i", "j", "now", "double", "x_"}) {
    const std::string header = header_of(fmt::format(
        R"({{ "dashpot": 1, "name": "names", "network": {{ "parallel": [ {{ "spring": 3 }},
           {{ "series": [ {{ "spring": 50, "name": "{}" }}, {{ "damper": 5, "name": "B" }} ] }} ] }} }})",
        name));
    if (header.empty()) continue;  // refused by the front end
    testing::write_text(folder.path() / "names.hpp", header);
    const testing::Finished finished =
        testing::run_command(fmt::format("echo '#include \"names.hpp\"' | '{}' -std=c++17 -Wall -Wextra -Wshadow "
                                         "-Werror -fsyntax-only {} -I'{}' -x c++ -",
                                         DASHPOT_GXX, testing::runtime_include(), folder.path().string()));
    EXPECT_EQ(finished.status, 0) << name << "\n" << finished.output;
  }
}

}  // namespace
}  // namespace dashpot::compiler
