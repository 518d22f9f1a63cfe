// The step of every network in networks/, proved by tools that know nothing of it: Frama-C's Eva that no operation
// overflows and no state leaves the box that an emitted header states, Gappa that rounding adds no more than is stated.
// Positions and velocities are any that the header names, and of a contact, whose header states no box, and for Gappa,
// any that the paper's device can measure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <regex>
#include <sstream>
#include <set>

#include "c_form.hpp"
#include "compile.hpp"
#include "emit/emission.hpp"
#include "law/evaluate.hpp"
#include "gappa_script.hpp"
#include "scalar_program.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/repetitions.hpp"
#include "support/shell_command.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

compiler::SourceFile read(const fs::path& path) {
  compiler::Diagnostics diagnostics;
  std::optional<compiler::SourceFile> file = compiler::read_source(path.string(), diagnostics);
  if (!file) throw std::runtime_error(compiler::render_text(diagnostics));
  return std::move(*file);
}

compiler::Device device_at(const fs::path& path) {
  const compiler::SourceFile file = read(path);
  compiler::Diagnostics diagnostics;
  const auto decl = compiler::parse_device(file, diagnostics);
  return compiler::build_device(decl.value(), diagnostics).value();
}

// ± 40 mm and 1.5 m/s at the arm of the paper's Pantograph.
compiler::Device pantograph() { return device_at(DASHPOT_SOURCE "/runtime/devices/pantograph_brake_2009.json"); }

compiler::InputRange device_range() {
  const device_description d = pantograph().description;
  return {d.encoder.range_high * d.arm_radius, d.encoder.max_speed * d.arm_radius};
}

struct Subject {
  fs::path file;
  compiler::ScalarType scalar = compiler::ScalarType::float64;
  compiler::Compilation compilation() const {
    const compiler::SourceFile source = read(file);
    compiler::Diagnostics diagnostics;
    compiler::Choices choices;
    choices.scalar = scalar;
    auto result = compiler::compile(source, choices, std::nullopt, diagnostics);
    // Behind slips (21) as printed, where there is one: of the steady law Eva does not see that the box holds.
    if (result && result->form.has_slips()) {
      compiler::Choices printed;
      printed.decomposition = "gated";
      compiler::Diagnostics no_such_law;
      if (auto gated = compiler::compile(source, printed, std::nullopt, no_such_law)) result = std::move(gated);
    }
    if (!result) throw std::runtime_error(compiler::render_text(diagnostics));
    return std::move(*result);
  }
  compiler::Network network() const {
    compiler::Diagnostics diagnostics;
    auto network = compiler::check(read(file), diagnostics, std::nullopt);
    if (!network) throw std::runtime_error(compiler::render_text(diagnostics));
    return std::move(*network);
  }
  std::string name() const { return file.stem().string(); }
};

std::vector<fs::path> all_networks() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(DASHPOT_SOURCE "/networks"))
    if (entry.path().extension() == ".json" && entry.path().filename() != "network.schema.json" &&
        entry.path().parent_path().filename() != "axes")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_linear(const compiler::Network& network) {
  return !network.contact &&
         std::none_of(network.elements.begin(), network.elements.end(),
                      [](const compiler::Element& e) { return std::holds_alternative<compiler::Slip>(e.law); });
}

// A surface comes back by what itself has gone, which magnitudes do not see: cases of it are told apart, and it may be
// a tenth beyond where the tool can push it.
ProvenBox box_of(const compiler::UpdateLaw& law) {
  ProvenBox box{compiler::input_range(compiler::PortDevice::ideal()), {}, {}};
  if (const auto states = law.surface_at ? std::nullopt : compiler::state_box(law, box.range)) {
    box.states = *states;
  } else {
    box.range = device_range();
    for (const compiler::Variable& v : law.variables)
      for (std::size_t place = 0; v.role == compiler::Role::state && place < v.size; ++place) {
        const bool is_brake = v.name.find("brake") != v.name.npos || v.name.find("damping") != v.name.npos;
        const double most = is_brake ? law.largest_damping : 1.1 * box.range.position;
        box.states[scalar_name(v, place)] = {-most, most};
      }
    box.slices["surface_"] = 64;
  }
  return box;
}

// The law in C99 as it is emitted, and the main program around it.
void write_c_form(const compiler::Compilation& compilation, const fs::path& folder) {
  compiler::Diagnostics diagnostics;
  const auto files = compiler::emit_c99(compilation, {}, diagnostics);
  if (!files) throw std::runtime_error(compiler::render_text(diagnostics));
  write_text(folder / files->front().name, files->front().text);
  write_text(folder / "step.c", c_form(compilation, box_of(compilation.law)));
}

void expect_proved_by_eva(const Subject& subject) {
  const compiler::Compilation compilation = subject.compilation();
  const TemporaryFolder folder;
  write_c_form(compilation, folder.path());
  const Finished done = run_command(fmt::format(
      "cd '{}' && timeout 120 frama-c -eva -eva-precision 2 -eva-slevel 100 -warn-special-float non-finite step.c",
      folder.path().string()));
  EXPECT_EQ(done.status, 0);
  EXPECT_NE(done.output.find("0 alarms generated by the analysis"), done.output.npos) << done.output;
  EXPECT_NE(done.output.find("100% of the logical properties reached have been proven"), done.output.npos)
      << done.output;
}

// Any calls in any order, with any numbers, also with those that are none.
std::string any_calls(const std::string& name) {
  std::string text =
      "#include \"{0}.h\"\n\nstatic volatile int any;\nstatic volatile double any_number;\n\nint main(void) {\n"
      "  static {0} law;\n  {0}_init(&law);\n  while (any) {\n    double values[32];\n"
      "    for (int i = 0; i < 32; ++i) values[i] = any_number;\n    if (any) {0}_set_values(&law, values);\n"
      "    if (any) {0}_reset(&law, any_number);\n    if (any) {0}_output(&law, any_number, any_number);\n"
      "    if (any) {0}_update(&law);\n    {0}_stored_energy(&law);\n    {0}_kept_share(&law);\n  }\n  return 0;\n}\n";
  for (std::size_t at = 0; (at = text.find("{0}", at)) != text.npos;) text.replace(at, 3, name);
  return text;
}

// What Eva says of every state that such calls lead to: whether a place beyond an array or one that nothing was written
// to is read, a whole number overflows, or a number is turned into a whole one that cannot hold it. What a sum of
// numbers comes to is looked at by the law itself, before the motor gets it.
std::string said_of_any_calls(const std::string& name, const std::string& header) {
  const TemporaryFolder folder;
  write_text(folder.path() / (name + ".h"), header);
  write_text(folder.path() / "any.c", any_calls(name));
  return run_command(fmt::format("cd '{}' && timeout 600 frama-c -eva -eva-precision 2 -warn-special-float none any.c",
                                 folder.path().string()))
      .output;
}

std::string header_of(const Subject& subject) {
  compiler::Diagnostics diagnostics;
  const auto files = compiler::emit_c99(subject.compilation(), {}, diagnostics);
  if (!files) throw std::runtime_error(compiler::render_text(diagnostics));
  return files->front().text;
}

void expect_safe_under_any_calls(const Subject& subject) {
  const std::string said = said_of_any_calls(subject.name(), header_of(subject));
  EXPECT_NE(said.find(" 0 alarms generated by the analysis"), said.npos) << said;
}

// What Eva would say of a law that writes beyond the ends of its slips.
void expect_unsafe_when_broken(const Subject& subject) {
  std::string header = header_of(subject);
  const std::size_t at = header.rfind("i < (n->nodes + 2);");
  ASSERT_NE(at, header.npos);
  header.replace(at + 2, 1, "<=");
  const std::string said = said_of_any_calls(subject.name(), header);
  EXPECT_NE(said.find("out of bounds"), said.npos) << said;
}

// Laws whose sums are compensated, in double and in float: errors and what is carried of them cancel, which Gappa does
// not see. What their banners say of rounding is derived alone.
const std::set<std::string> compensated = {"brain", "heel_fat_pad", "polymer", "soft_adhesive"},
                            compensated_in_float = {"brain", "polymer", "soft_adhesive"};

void expect_proved_by_gappa(const Subject& subject) {
  const compiler::Compilation compilation = subject.compilation();
  const auto& without = subject.scalar == compiler::ScalarType::float64 ? compensated : compensated_in_float;
  ASSERT_EQ(compilation.law.mode_form == compiler::ModeForm::compensated, without.count(subject.name()) > 0);
  if (without.count(subject.name()) > 0) return;
  const auto box = compiler::state_box(compilation.law, device_range());
  ASSERT_TRUE(box);
  const TemporaryFolder folder;
  for (const std::string& script : gappa_scripts(compilation, device_range(), *box)) {
    write_text(folder.path() / "step.gappa", script);
    const Finished done = run_command(fmt::format("timeout 60 gappa '{}/step.gappa'", folder.path().string()));
    EXPECT_EQ(done.status, 0) << done.output << script;
  }
}

void expect_c_form_is_evaluate(const Subject& subject) {
  const compiler::Compilation compilation = subject.compilation();
  const TemporaryFolder folder;
  write_c_form(compilation, folder.path());
  Random random(7);
  std::string input, expected;
  compiler::Evaluation<double> run(compilation.law);
  run.reset(0);
  double position = 0;
  for (int k = 0; k < 2000; ++k) {
    if (k % 40 < 30)
      position = std::clamp(position + random.uniform(-1, 1) * random.log_uniform(1e-8, 1e-3), -0.04, 0.04);
    const double velocity = random.uniform(-1, 1);
    const auto [damping, force] = run.step(position, velocity);
    input += fmt::format("{:a} {:a}\n", position, velocity);
    char line[80];
    std::snprintf(line, sizeof line, "%a %a\n", damping, force);
    expected += line;
  }
  write_text(folder.path() / "input", input);
  const Finished done =
      run_command(fmt::format("cd '{}' && {} -std=c99 -O1 -ffp-contract=off -I'{}' step.c -o step && ./step < input",
                              folder.path().string(), DASHPOT_CC, DASHPOT_SOURCE "/runtime/include"));
  ASSERT_EQ(done.status, 0) << done.output;
  EXPECT_EQ(done.output, expected);
}

class Proof : public ::testing::Test {
 public:
  Proof(Subject subject, void (*expect)(const Subject&), const char* tool)
      : subject_(std::move(subject)), expect_(expect), tool_(tool) {}
  void TestBody() override {
    if (run_command(fmt::format("command -v {}", tool_)).status != 0)
      GTEST_SKIP() << tool_ << " IS NOT INSTALLED: NOTHING IS PROVED";
    expect_(subject_);
  }

 private:
  Subject subject_;
  void (*expect_)(const Subject&);
  const char* tool_;
};

void add(const char* suite, const Subject& subject, void (*expect)(const Subject&), const char* tool) {
  ::testing::RegisterTest(suite, subject.name().c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [=]() -> Proof* { return new Proof(subject, expect, tool); });
}

// Steps that are loops over tables. Of these AnyCalls is proved.
const std::set<std::string> tables_of_the_runtime = {"friction_tunable",  "layers_tunable",
                                                     "needle_in_liver",   "second_order_maxwell_tunable",
                                                     "springpot_tunable", "standard_solid_tunable"};
// Proved with --long alone: linear, as standard_solid_tunable is, and larger.
const std::set<std::string> larger_linear_ones = {"second_order_maxwell_tunable", "springpot_tunable"};
// Eva sees what a single number loses, and not what a number and the one that it is taken away from lose together:
// compensated sums, and four states around one slip. Of these the box is tried alone.
const std::set<std::string> beyond_eva = {
    "brain", "heel_fat_pad", "polymer", "soft_adhesive", "soft_adhesive_with_slips", "visco_elasto_plastic_organ"};

// AnyCalls: a law in C would leave its memory, or do what C leaves open. Eva: an operation would overflow, a command
// would not be finite, or states would grow without end. CForm: what is proved would not be what is emitted. Gappa: the
// banner and the certificate would state less than rounding adds. The networks are only read here, not compiled: CTest
// starts this program once for each test.
void register_proofs() {
  for (const fs::path& file : all_networks()) {
    const Subject subject{file};
    const compiler::Network network = subject.network();
    if (tables_of_the_runtime.count(subject.name()) > 0) {
      if (!is_thorough() && larger_linear_ones.count(subject.name()) > 0) continue;
      add("AnyCalls", subject, expect_safe_under_any_calls, "frama-c");
      if (subject.name() == "layers_tunable")
        add("AnyCallsOfABrokenOne", subject, expect_unsafe_when_broken, "frama-c");
      continue;
    }
    add("CForm", subject, expect_c_form_is_evaluate, "true");
    // Behind a static curve |w| stays below w'|u|, which intervals do not show.
    if (network.static_curve || !network.ports.empty()) continue;
    if (is_linear(network)) {
      add("Gappa", subject, expect_proved_by_gappa, "gappa");
      add("GappaFloat", {file, compiler::ScalarType::float32}, expect_proved_by_gappa, "gappa");
    }
    if (beyond_eva.count(subject.name()) == 0) add("Eva", subject, expect_proved_by_eva, "frama-c");
  }
  // In float that would be twenty propositions of some ten seconds each.
  add("Gappa", {DASHPOT_SOURCE "/tests/responses/networks/twenty_branches.json"}, expect_proved_by_gappa, "gappa");
}

// The farthest and fastest of what goes in, slowly, every other sample and at random, and twenty times as much: what a
// header's box says of each. Then any states of the box, most of them at its corners, and one step from there, and the
// same of a box half as large.
constexpr const char* box_program = R"(#include <stdio.h>
#include "law.h"

static unsigned chance = 1;
static double drawn(void) { return ((chance = 1664525u * chance + 1013904223u) >> 8) / 16777216.0; }
static double among(double low, double high) {
  const double part = 3 * drawn();
  return part < 1 ? low : part < 2 ? high : low + (part - 2) * (high - low);
}

static void place(@NAME@ *self, double size) {
@PLACE@}
static int holds(const @NAME@ *self, double size) {
  return 1@HOLDS@;
}

static int runs_within(double times) {
  @NAME@ law;
  int within = 0;
  @NAME@_init(&law);
  for (int n = 0; n < 12000; ++n) {
    const double way = (n < 4000 ? n / 500 : n) % 2 == 0 ? times : -times, part = n < 8000 ? 1 : drawn();
    @NAME@_step(&law, way * @POSITION@ * part, way * @VELOCITY@);
    within += @NAME@_is_within(&law);
  }
  return within == 12000;
}

static int stays(double size) {
  for (int n = 0; n < 300000; ++n) {
    @NAME@ law;
    @NAME@_init(&law);
    place(&law, size);
    if (!holds(&law, size)) continue;
    @NAME@_step(&law, among(-@POSITION@, @POSITION@), among(-@VELOCITY@, @VELOCITY@));
    if (!holds(&law, size)) return 0;
  }
  return 1;
}

int main(void) {
  printf("%s %s ", runs_within(1) ? "within" : "beyond", runs_within(20) ? "within" : "beyond");
  printf("%s %s\n", stays(1) ? "stays" : "leaves", stays(0.5) ? "stays" : "leaves");
  return 0;
}
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) text.replace(at, what.size(), by);
  return text;
}

// The bounds as the header writes them, one a line.
std::string box_program_of(const std::string& network, const std::string& header, const compiler::InputRange& range) {
  static const std::regex plain(R"re(.*\(self->(\S+) >= (\S+)\) && \(self->\S+ <= (\S+)\);?)re");
  static const std::regex carried(
      R"re(.*\(\(self->(\S+) - (\S+)\) \+ self->(\S+) >= 0\) && \(\(self->\S+ - (\S+)\) \+ \S+ <= 0\);?)re");
  // Of what states differ by, each of its ends in a line.
  static const std::regex differing(R"re(.*\(\(double\)self->(\S+) - \((.*)\) (.)= (\S+)\);?)re");
  std::string place, holds, least, line;
  std::istringstream lines(header.substr(header.find("_is_within")));
  std::getline(lines, line);
  for (std::smatch match; std::getline(lines, line) && line != "}";) {
    if (std::regex_match(line, match, plain)) {
      holds += fmt::format(" && self->{0} >= size * {1} && self->{0} <= size * {2}", match.str(1), match.str(2),
                           match.str(3));
      place += fmt::format("  self->{0} = among(size * {1}, size * {2});\n", match.str(1), match.str(2), match.str(3));
    } else if (std::regex_match(line, match, carried)) {
      holds += fmt::format(" && (self->{0} - size * {1}) + self->{3} >= 0 && (self->{0} - size * {2}) + self->{3} <= 0",
                           match.str(1), match.str(2), match.str(4), match.str(3));
      place += fmt::format("  self->{0} = among(size * {1}, size * {2});\n", match.str(1), match.str(2), match.str(4));
    } else if (std::regex_match(line, match, differing)) {
      const std::string taken = match.str(2);
      holds += fmt::format(" && self->{} - ({}) {}= size * {}", match.str(1), taken, match.str(3), match.str(4));
      if (match.str(3) == ">") least = match.str(4);
      else
        place +=
            fmt::format("  self->{} = {} + among(size * {}, size * {});\n", match.str(1), taken, least, match.str(4));
    }
  }
  std::string program = replaced(replaced(box_program, "@PLACE@", place), "@HOLDS@", holds);
  program = replaced(replaced(program, "@NAME@", network), "@POSITION@", fmt::format("{:#}", range.position));
  return replaced(program, "@VELOCITY@", fmt::format("{:#}", range.velocity));
}

std::string said_of_box(const compiler::Compilation& compilation) {
  const std::string& name = compilation.network.name;
  compiler::Diagnostics diagnostics;
  const std::string header = compiler::emit_c99(compilation, {}, diagnostics)->front().text;
  if (header.find("_is_within") == header.npos) return "no box\n";
  const TemporaryFolder folder;
  write_text(folder.path() / "law.h", header);
  write_text(folder.path() / "box.c", box_program_of(name, header, compiler::input_range(compilation.port)));
  return run_command(fmt::format("cd '{}' && {} -std=c99 -O1 -ffp-contract=off box.c -o box && ./box",
                                 folder.path().string(), DASHPOT_CC))
      .output;
}

std::optional<compiler::Compilation> compiled(const fs::path& file, const std::string& decomposition,
                                              const std::optional<compiler::Device>& device) {
  const compiler::SourceFile source = read(file);
  compiler::Choices choices;
  choices.decomposition = decomposition;
  compiler::Diagnostics diagnostics;
  return compiler::compile(source, choices, device, diagnostics);
}

// Laws without a box, and why.
const std::map<std::string, const char*> without_box = {
    {"friction_tunable", "what changes of parameters set free adds up without end"},
    {"layers_tunable", "the same"},
    {"second_order_maxwell_tunable", "the same"},
    {"springpot_tunable", "the same"},
    {"standard_solid_tunable", "the same"},
    {"polymer on board_mps2", "shedding rounds by more than its slowest forces lose in a sample"},
    {"polymer on pantograph_brake_2009", "the same"},
    {"polymer on phantom_shorted_motor", "the same"},
    {"visco_elasto_plastic_organ on board_mps2", "its share of all forces and its slip hang together"},
    {"finger_pad", "of several maps nothing says there how far each goes"},
    {"sphere_on_gel on phantom_shorted_motor", "its contact and its motor's limit have more cases than are tried"},
};

// Fails if a header in C states no box of its states, or one that the farthest and fastest motions within the stated
// range leave, or a single step from anywhere in it, or one that is no tighter than it need be: without a device, and
// on one of those that dashpot brings along, if it can be driven with the network. With --long on all of them.
class Boxes : public ::testing::TestWithParam<fs::path> {};

TEST_P(Boxes, HoldTheirStates) {
  const std::set<std::string> other_files = {"device.schema.json", "pantograph_2dof.json", "arm_board_mps2.json"};
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(DASHPOT_SOURCE "/runtime/devices"))
    if (entry.path().extension() == ".json" && other_files.count(entry.path().filename().string()) == 0)
      all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  std::vector<std::optional<fs::path>> devices = {std::nullopt};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_thorough() || i == GetParam().stem().string().size() % all.size()) devices.push_back(all[i]);
  for (const std::optional<fs::path>& device : devices) {
    const auto described = device ? std::optional(device_at(*device)) : std::nullopt;
    auto law = compiled(GetParam(), "", described);
    if (!law) law = compiled(GetParam(), "paper", described);
    if (!law) continue;
    const std::string name = GetParam().stem().string(),
                      where = device ? name + " on " + device->stem().string() : name;
    const bool has_box = without_box.count(name) == 0 && without_box.count(where) == 0;
    EXPECT_EQ(said_of_box(*law), has_box ? "within beyond stays leaves\n" : "no box\n") << where;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Boxes, ::testing::ValuesIn(all_networks()),
                         [](const auto& of) { return of.param.stem().string(); });

// Fails if the box of a law that the motor cannot limit, or of the paper's own brake, is not kept.
TEST(Box, OfAHeaderHoldsItsStates) {
  for (const char* network :
       {"generalised_kelvin_two", "second_order_maxwell", "bridge", "visco_elasto_plastic", "maxwell_slip_ten"}) {
    const fs::path file = fs::path(DASHPOT_SOURCE "/networks/paper") / (std::string(network) + ".json");
    EXPECT_EQ(said_of_box(*compiled(file, "paper", pantograph())), "within beyond stays leaves\n") << network;
  }
  compiler::Device strong = pantograph();
  strong.description.motor.max_torque = 0;
  const fs::path file = DASHPOT_SOURCE "/networks/paper/second_order_maxwell.json";
  EXPECT_EQ(said_of_box(*compiled(file, "paper", strong)), "within beyond stays leaves\n");
}

// Fails if a network is left out of the proofs in silence.
TEST(Proofs, LeaveOutWhatIsNamedAlone) {
  std::set<std::string> left_out;
  for (const fs::path& file : all_networks())
    if (!is_straight(Subject{file}.compilation().law)) left_out.insert(file.stem().string());
  EXPECT_EQ(left_out, tables_of_the_runtime);
}

}  // namespace
}  // namespace dashpot::testing

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  dashpot::testing::register_proofs();
  return RUN_ALL_TESTS();
}
