// `verify` against a compiler that gets two constants of one kind mixed up: what it wrote a second time would be wrong
// in the same way, so that only the equations can tell.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compile.hpp"
#include "emit/emission.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/repetitions.hpp"
#include "support/tunable_run.hpp"
#include "verify/certificate_file.hpp"
#include "verify/law_constants.hpp"
#include "verify/read_certificate.hpp"
#include "verify/verify_header.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

// One number of the law that follows from the network, and which others it may be mistaken for.
struct Number {
  std::string kind;
  double* value;
};

// Of tables that parameters change the header has no constants: a new law begins with them.
void add_tables(UpdateLaw& law, std::vector<Number>& all) {
  for (Coupling& coupling : law.couplings)
    for (slip_node<double>& node : coupling.nodes) {
      if (!coupling.tuned.empty()) break;
      if (node.kind == slip_part::block && node.stiffness > 0)
        all.push_back({"block of " + coupling.name, &node.stiffness});
      if (node.kind == slip_part::slip && node.yield > 0) all.push_back({"yield of " + coupling.name, &node.yield});
    }
  for (SlipNetwork& network : law.networks) {
    if (network.tuned) continue;
    for (std::vector<double>* table : {&network.to_tool, &network.to_ground})
      for (double& value : *table) all.push_back({"tie of " + network.name, &value});
  }
}

std::vector<Number> numbers_of(UpdateLaw& law) {
  std::vector<Number> all;
  for (Coefficient& constant : law.coefficients)
    for (double& value : constant.values)
      if (!is_chosen(constant.role)) all.push_back({fmt::format("role {}", int(constant.role)), &value});
  add_tables(law, all);
  return all;
}

class Mixed {
 public:
  Mixed(std::string text, Choices choices)
      : text_(std::move(text)), source_("network.json", text_), choices_(std::move(choices)) {
    Diagnostics diagnostics;
    compiled_ = compile(source_, choices_, std::nullopt, diagnostics);
  }

  bool compiles() const { return compiled_.has_value(); }
  UpdateLaw& law() { return compiled_->law; }

  // Of the law as it is now.
  std::string header() const {
    Diagnostics diagnostics;
    const auto emitted = emit_cpp(*compiled_, {}, diagnostics);
    if (!emitted) throw std::runtime_error("no header");
    return emitted->front().text;
  }

  // Whether something is said against the law's header and certificate as they are now.
  bool is_refused() const {
    Diagnostics diagnostics;
    const std::string header = this->header();
    const SourceFile file("certificate.json", certificate_text(*compiled_, choices_, text_, std::nullopt, header));
    const auto certificate = read_certificate(file, diagnostics);
    const auto constants = header_constants(header);
    if (!certificate || !constants) throw std::runtime_error("no certificate");
    verify_constants(*certificate, PortDevice::ideal(), *constants, *compiled_, diagnostics);
    return diagnostics.has_errors();
  }

 private:
  std::string text_;
  SourceFile source_;
  Choices choices_;
  std::optional<Compilation> compiled_;
};

// Some of a law's numbers, each swapped with another of its kind. How many were.
int swaps_found(Mixed& law, Random& random, int most, const std::string& text) {
  EXPECT_FALSE(law.is_refused()) << text;
  std::vector<Number> all = numbers_of(law.law());
  const std::string header = law.header();
  int found = 0;
  for (int attempt = 0; attempt < 40 * most && found < most && all.size() > 1; ++attempt) {
    const Number &one = all[random.index(all.size())], &other = all[random.index(all.size())];
    // The other sign of a mode's weights is the same mode.
    if (one.kind != other.kind || std::abs(*one.value) == std::abs(*other.value)) continue;
    std::swap(*one.value, *other.value);
    if (law.header() != header) {  // neither is left out of the code
      EXPECT_TRUE(law.is_refused()) << one.kind << ": " << *one.value << " and " << *other.value << " in " << text;
      ++found;
    }
    std::swap(*one.value, *other.value);
  }
  return found;
}

Choices drawn_choices(Random& random) {
  Choices choices;
  choices.scheme = random.chance(0.75) ? Scheme::exact : Scheme::backward_euler;
  choices.scalar = random.chance(0.8) ? ScalarType::float64 : ScalarType::float32;
  return choices;
}

TEST(SwappedConstants, AreFoundInLawsWithSlips) {
  const std::uint64_t cases = repetitions(18, 2000);
  int swapped = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    Random random(seed + 70000);
    NetworkRecipe recipe;
    recipe.topology = random.chance(0.6) ? Topology::tree : Topology::graph;
    recipe.most_nodes = 8;
    recipe.most_slips = recipe.topology == Topology::tree ? 6 : 4;
    recipe.smallest_value = 1e-1, recipe.largest_value = 1e3;
    std::string network = json_text(random_network(seed + 70000, recipe));
    if (random.chance(0.3)) network.insert(1, R"("contact": {"at": 0.002},)");
    Choices choices = drawn_choices(random);
    choices.decomposition = random.chance(0.5) ? "velocity-free" : "virtual";
    Mixed law(network, choices);
    if (!law.compiles() || !beyond_linear(random_network(seed + 70000, recipe))) continue;
    swapped += swaps_found(law, random, 4, network);
  }
  EXPECT_GE(swapped, int(cases * 3 / 2));
}

TEST(SwappedConstants, AreFoundInLawsWithTunables) {
  const std::uint64_t cases = repetitions(20, 2000);
  int swapped = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    Random random(seed + 71000);
    const std::string network = tunable_network(seed + 71000, Kind(seed % kinds));
    Mixed law(network, drawn_choices(random));
    if (law.compiles()) swapped += swaps_found(law, random, 4, network);
  }
  EXPECT_GE(swapped, int(cases));
}

}  // namespace
}  // namespace dashpot::testing
