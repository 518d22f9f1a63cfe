// Whatever the compiler writes `verify` has to accept: headers and certificates of random laws with slips, through
// both.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "check/check.hpp"
#include "commands/verify_texts.hpp"
#include "compile.hpp"
#include "emit/emission.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/repetitions.hpp"
#include "support/tunable_run.hpp"
#include "verify/certificate_file.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

std::string text_of(const std::string& path) {
  std::ifstream file(DASHPOT_SOURCE_DIR + ("/" + path));
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// What dashpot-check ends with: it knows linear laws with a statement that it can check, of which some lack damping,
// and of the hold certificate that without an amplifier's lag.
int status_of(const Compilation& compiled) {
  const Certificate& certificate = compiled.certificate;
  const PassivityBound& bound = certificate.bound;
  const bool is_of_many = bound.any_regime || bound.any_value || compiled.law.tunable.has_value();
  const bool is_linear = !is_of_many && certificate.loop.motor_slew == 0;
  const bool is_by_hold = bound.proof == Proof::hold;
  if (!is_linear || (is_by_hold && certificate.loop.amplifier_lag > 0)) return 3;
  if (!is_by_hold && !bound.storage) return 1;
  return certificate.certified ? 0 : 4;
}

// What `verify` says against them, or dashpot-check, which knows of linear laws alone; empty where they say nothing, or
// where nothing was written.
std::string faults(const std::string& network_text, const std::optional<std::string>& device_text,
                   const Choices& choices, int& written) {
  const SourceFile network("network.json", network_text);
  Diagnostics diagnostics;
  SourceFiles files;
  std::optional<Device> device;
  if (device_text) device = read_device(files.keep("device.json", *device_text), diagnostics);
  const std::optional<Compilation> compiled = compile(network, choices, device, diagnostics);
  if (!compiled) return "";
  const auto emitted = emit_cpp(*compiled, {}, diagnostics);
  if (!emitted) return "";
  ++written;
  const std::string& header = emitted->front().text;
  const SourceFile certificate("certificate.json",
                               certificate_text(*compiled, choices, network_text, device_text, header)),
      file("header.hpp", header);
  const auto [status, words] = dashpot_check::verdict(header, std::string(certificate.text()));
  if (status != status_of(*compiled)) return words;
  Diagnostics found;
  if (verify_texts(certificate, file, true, files, found)) return "";
  return render_text(found);
}

std::string with_elements(const std::string& elements) {
  return R"({"dashpot": 1, "name": "known", "motion": "translation", )" + elements + "}";
}

// If this failed, sound headers would be refused: yield forces summed in another order, a brake that has all the
// dampers of a cut, a relaxation that is over within a sample beside a slow one, two springs whose sum is halfway
// between two numbers, a motor behind a lag that has nothing to make, or whose bound is a sum sample by sample, slips
// that are no tree in one of several ports.
TEST(VerifiedHeaders, OfLawsThatWereRefused) {
  const std::string networks[] = {
      R"("network": {"series": [{"spring": 100}, {"parallel": [{"slip": 0.1}, {"slip": 0.2}, {"slip": 0.3}]}]})",
      R"("network": {"parallel": [{"spring": 3}, {"series": [{"spring": 100}, {"parallel": [{"slip": 0.1}, {"slip": 0.2},
         {"slip": 0.3}, {"series": [{"spring": 7}, {"slip": 0.7}]}]}]}]})",
      R"("elements": [{"spring": 40, "nodes": ["tool", "p"]}, {"spring": 30, "nodes": ["tool", "q"]},
         {"spring": 20, "nodes": ["p", "q"]}, {"slip": 0.1, "nodes": ["p", "ground"]}, {"slip": 0.2, "nodes": ["p", "ground"]},
         {"slip": 0.3, "nodes": ["p", "ground"]}, {"slip": 1, "nodes": ["q", "ground"]}])",
      R"("elements": [{"damper": 1, "nodes": ["n0", "ground"]}, {"damper": 2, "nodes": ["tool", "n0"]},
         {"slip": 1, "nodes": ["n1", "tool"]}, {"spring": 1, "nodes": ["ground", "n1"]}, {"spring": 1, "nodes": ["n1", "n0"]}])",
      R"("network": {"series": [{"parallel": [{"damper": 1}, {"spring": 1}]},
         {"series": [{"slip": 1}, {"spring": 1287}, {"damper": 0.02}]}]})",
      R"("elements": [{"spring": 189.7903, "nodes": ["tool", "n"]}, {"spring": 407.4717, "nodes": ["tool", "n"]},
         {"slip": 0.35, "nodes": ["n", "ground"]}, {"damper": 3.6442, "nodes": ["n", "ground"]}])",
      R"("ports": [{"name": "left", "elements": [{"spring": 115, "nodes": ["tool", "ground"]}]},
         {"name": "right", "elements": [{"damper": 100, "nodes": ["n3", "n1"]},
         {"spring": 0.1, "nodes": ["n3", "ground"]},
         {"damper": 0.1, "nodes": ["ground", "n1"]}, {"spring": 24, "nodes": ["tool", "n1"]},
         {"slip": 2, "nodes": ["tool", "n3"]}]}])"};
  int written = 0;
  for (const std::string& network : networks)
    for (const char* decomposition : {"most-dissipative", "velocity-free", "virtual"})
      for (const ScalarType scalar : {ScalarType::float64, ScalarType::float32}) {
        Choices choices;
        choices.decomposition = decomposition;
        choices.scalar = scalar;
        EXPECT_EQ(faults(with_elements(network), std::nullopt, choices, written), "") << network << decomposition;
      }
  EXPECT_GE(written, 24);
  Choices choices;
  choices.decomposition = "paper";
  const std::string damper = R"("elements": [{"damper": 0.0016, "nodes": ["tool", "ground"]}])";
  const std::string lags = text_of("runtime/devices/pantograph_brake_2009.json");
  EXPECT_EQ(faults(with_elements(damper), lags, choices, written), "");
  Choices by_sample;
  by_sample.scheme = Scheme::backward_euler;
  const std::string slow =
      R"("elements": [{"spring": 1746.5, "nodes": ["tool", "ground"]}, {"spring": 0.000444, "nodes": ["ground", "n"]},
     {"damper": 3236, "nodes": ["n", "tool"]}])";
  EXPECT_EQ(faults(with_elements(slow), lags, by_sample, written), "");
}

// If this failed, sound headers would be refused: an element called as `verify` calls numbers without a name, a port
// whose name begins one of the law's own constants, two ports whose constants or tables would be called alike, an
// element called as the constant by which a limited slew is known.
TEST(VerifiedHeaders, OfNamesThatWereMistaken) {
  const std::string networks[] = {
      R"("parameters": {"K": {"value": 12, "tunable": true, "min": 0, "max": 100}},
         "network": {"series": [{"spring": "K"}, {"damper": 0.353, "name": "literals"}, {"slip": 0.07}]})",
      R"("ports": [{"name": "sample", "network": {"parallel": [{"spring": 5},
         {"series": [{"slip": 2}, {"spring": 11}]}]}}, {"name": "q", "network": {"spring": 7}}])",
      R"("ports": [{"name": "a", "network": {"series": [{"slip": 1, "name": "b_S"}, {"spring": 4}]}},
         {"name": "a_b", "network": {"series": [{"slip": 2, "name": "S"}, {"spring": 5}]}}])",
      R"("ports": [{"name": "a", "network": {"series": [{"slip": 1, "name": "b_S"},
         {"parallel": [{"spring": 4}, {"series": [{"spring": 4}, {"damper": 4}]}]}]}},
         {"name": "a_b", "network": {"series": [{"slip": 2, "name": "S"},
         {"parallel": [{"spring": 4}, {"series": [{"spring": 7}, {"damper": 4}]}]}]}}])",
      R"("ports": [{"name": "p_network", "elements": [{"spring": 30, "nodes": ["tool", "a"]},
         {"slip": 0.9, "nodes": ["a", "b"], "name": "between"}, {"spring": 60, "nodes": ["b", "ground"]},
         {"spring": 40, "nodes": ["tool", "b"]}, {"slip": 0.7, "nodes": ["a", "ground"]}]},
         {"name": "p", "elements": [{"spring": 50, "nodes": ["tool", "a"]},
         {"slip": 0.5, "nodes": ["a", "b"], "name": "network"}, {"spring": 52, "nodes": ["b", "ground"]},
         {"spring": 71, "nodes": ["tool", "b"]}, {"slip": 0.4, "nodes": ["a", "ground"]}]}])",
      R"("network": {"series": [{"spring": 100}, {"damper": 5, "name": "motor_step"}]})"};
  int written = 0;
  for (const std::string& network : networks)
    EXPECT_EQ(faults(with_elements(network), std::nullopt, Choices(), written), "") << network;
  EXPECT_EQ(written, 6);
}

// Fails if the part of a regime's dampers that a weak brake can take is refused, in a tree or in none.
TEST(VerifiedHeaders, OfBrakesThatReachOnlyAPartOfTheDampers) {
  const std::string weak_brake = text_of("runtime/devices/pantograph_brake_2009.json");
  Choices choices;
  choices.decomposition = "velocity-free";
  const std::string tree =
      R"("network": {"series": [{"damper": 8}, {"parallel": [{"slip": 1},
         {"series": [{"spring": 300}, {"slip": 0.5}]}]}]})";
  const std::string graph =
      R"("elements": [{"damper": 40, "nodes": ["tool", "p"]}, {"damper": 30, "nodes": ["tool", "q"]},
         {"spring": 20, "nodes": ["p", "q"]}, {"slip": 0.1, "nodes": ["p", "ground"]},
         {"slip": 1, "nodes": ["q", "ground"]}])";
  int written = 0;
  EXPECT_EQ(faults(with_elements(tree), weak_brake, choices, written), "");
  EXPECT_EQ(faults(with_elements(graph), weak_brake, choices, written), "");
  EXPECT_EQ(written, 2);
}

// Fails if verify does not end, or refuses, where a component has more slips than a word has bits.
TEST(VerifiedHeaders, OfMoreSlipsThanBits) {
  std::string slips;
  for (int i = 1; i <= 70; ++i) slips += R"({"parallel": [{"slip": )" + std::to_string(i) + R"(}, {"damper": 2}]}, )";
  Choices choices;
  choices.decomposition = "velocity-free";
  int written = 0;
  EXPECT_EQ(faults(with_elements(R"("network": {"series": [)" + slips + R"({"damper": 3}]})"), std::nullopt, choices,
                   written),
            "");
  EXPECT_EQ(written, 1);
}

// The same of networks that nobody chose.
TEST(VerifiedHeaders, OfRandomNetworksWithSlips) {
  const std::uint64_t cases = repetitions(10, 2700);
  const std::string devices[] = {"", text_of("runtime/devices/board_mps2.json"),
                                 text_of("runtime/devices/pantograph_brake_2009.json")};
  const char* laws[] = {"faithful", "paper", "velocity-free", "gated", "steady", "ramped", "virtual"};
  int written = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    Random random(seed + 90000);
    NetworkRecipe recipe;
    recipe.topology = random.chance(0.6) ? Topology::tree : Topology::graph;
    recipe.most_nodes = 7;
    recipe.most_slips = recipe.topology == Topology::tree ? 6 : 4;
    if (random.chance(0.5)) recipe.smallest_value = 1e-1, recipe.largest_value = 1e3;
    std::string network = json_text(random_network(seed + 90000, recipe));
    if (random.chance(0.15)) network.insert(1, R"("contact": {"at": 0.002},)");
    Choices choices;
    choices.scheme = random.chance(0.75) ? Scheme::exact : Scheme::backward_euler;
    choices.scalar = random.chance(0.8) ? ScalarType::float64 : ScalarType::float32;
    choices.decomposition = laws[random.chance(0.5) ? 0 : random.index(7)];
    const std::string& device = devices[random.index(3)];
    if (device.empty() && random.chance(0.5)) choices.rate = random.log_uniform(100, 20000);
    SCOPED_TRACE(seed);
    EXPECT_EQ(faults(network, device.empty() ? std::nullopt : std::optional(device), choices, written), "") << network;
  }
  EXPECT_GE(written, int(cases * 8 / 10));
}

TEST(VerifiedHeaders, OfRandomNetworksWithTunables) {
  const std::uint64_t cases = repetitions(10, 1600);
  int written = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    Random random(seed + 91000);
    Choices choices;
    choices.scheme = random.chance(0.75) ? Scheme::exact : Scheme::backward_euler;
    choices.scalar = random.chance(0.8) ? ScalarType::float64 : ScalarType::float32;
    const std::string network = tunable_network(seed + 91000, Kind(seed % kinds));
    SCOPED_TRACE(seed);
    EXPECT_EQ(faults(network, std::nullopt, choices, written), "") << network;
  }
  EXPECT_GE(written, int(cases * 8 / 10));
}

}  // namespace
}  // namespace dashpot::testing
