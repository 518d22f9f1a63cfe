#include "support/tunable_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "linear/normal_form.hpp"
#include "network/law.hpp"
#include "source/render.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {
namespace {

compiler::Network branches(Random& random) {
  compiler::Network network;
  network.nodes = {"ground", "tool"};
  const auto add = [&](const compiler::Law& law, compiler::NodeIndex a, compiler::NodeIndex b) {
    network.elements.push_back({fmt::format("e{}", network.elements.size()), law, a, b, {}, {}});
  };
  const std::size_t count = random.between(1, 5);
  for (std::size_t i = 0; i < count; ++i) {
    network.nodes.push_back(fmt::format("n{}", i));
    add(compiler::Spring{random.log_uniform(1, 1e3)}, compiler::tool, i + 2);
    add(compiler::Damper{random.log_uniform(1e-2, 1e2)}, i + 2, compiler::ground);
  }
  if (random.chance(0.7)) add(compiler::Spring{random.log_uniform(1, 1e3)}, compiler::tool, compiler::ground);
  if (random.chance(0.4)) add(compiler::Damper{random.log_uniform(1e-2, 1e2)}, compiler::tool, compiler::ground);
  return network;
}

bool is_graph(Kind kind) { return kind == Kind::slips_in_graph || kind == Kind::touched_slips_in_graph; }
bool has_slips(Kind kind) { return kind == Kind::slips || kind == Kind::touched_slips || is_graph(kind); }
bool is_touched(Kind kind) {
  return kind == Kind::touched || kind == Kind::touched_slips || kind == Kind::touched_slips_in_graph;
}

compiler::Network network_of(std::uint64_t seed, Kind kind, Random& random) {
  if (kind == Kind::parallel_branches || kind == Kind::touched) return branches(random);
  NetworkRecipe recipe;
  recipe.topology = kind == Kind::graph || is_graph(kind) ? Topology::graph : Topology::tree;
  recipe.most_nodes = 8;
  recipe.smallest_value = 1e-2;
  recipe.largest_value = 1e3;
  recipe.most_slips = has_slips(kind) ? 5 : 0;
  compiler::Network network = random_network(seed, recipe);
  for (std::uint64_t i = 1; is_graph(kind) && compiler::normal_form(network).networks.empty(); ++i)
    network = random_network(1000000 * i + seed, recipe);
  return network;
}

}  // namespace

TunableLaw::TunableLaw(const std::string& text, const compiler::Choices& choices)
    : source_(std::make_unique<compiler::SourceFile>("tunable.json", text)) {
  compiler::Diagnostics diagnostics;
  compilation_ = compiler::compile(*source_, choices, std::nullopt, diagnostics);
  if (!compilation_) throw std::runtime_error(compiler::render_text(diagnostics) + text);
}

std::vector<double> TunableLaw::defaults() const {
  std::vector<double> values;
  for (const compiler::Tunable& t : tunables()) values.push_back(t.range.value);
  return values;
}

std::string tunable_network(std::uint64_t seed, Kind kind) {
  Random random(seed);
  const compiler::Network network = network_of(seed, kind, random);
  std::string parameters, elements;
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    const compiler::Element& e = network.elements[i];
    const double value = compiler::value_of(e.law);
    const bool is_tunable = random.chance(0.5) || (parameters.empty() && i + 1 == network.elements.size());
    if (is_tunable) {
      const double start = random.chance(0.05) && !has_slips(kind) ? 0 : value,
                   least = start == 0 || random.chance(0.5) ? 0 : value / 10;
      parameters += fmt::format("{}\n  \"p{}\": {{ \"value\": {}, \"tunable\": true, \"min\": {}, \"max\": {} }}",
                                parameters.empty() ? "" : ",", i, start, least, value * 10);
    }
    elements += fmt::format("{}\n  {{ \"{}\": {}, \"nodes\": [\"{}\", \"{}\"] }}", i == 0 ? "" : ",",
                            compiler::kind_of(e.law), is_tunable ? fmt::format("\"p{}\"", i) : fmt::format("{}", value),
                            network.nodes[e.a], network.nodes[e.b]);
  }
  const char* const contact = is_touched(kind) ? "\"contact\": { \"at\": 0 }, " : "";
  return fmt::format(
      "{{ \"dashpot\": 1, \"name\": \"tunable_{}\", {}\"parameters\": {{{} }},\n\"elements\": [{} ] }}\n", seed,
      contact, parameters, elements);
}

std::vector<double> next_values(const std::vector<compiler::Tunable>& tunables, const std::vector<double>& present,
                                Random& random) {
  std::vector<double> values = present;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const tunable_range<double>& range = tunables[i].range;
    if (random.chance(0.5)) continue;
    values[i] =
        random.chance(0.2) ? (random.chance(0.5) ? range.min : range.max) : random.uniform(range.min, range.max);
  }
  return values;
}

std::vector<double> random_walk(Random& random, std::size_t samples) {
  std::vector<double> motion;
  double here = 0, pace = 1e-4;
  for (std::size_t i = 0; i < samples; ++i) {
    if (random.chance(0.1)) pace = random.log_uniform(1e-7, 1e-2);
    if (random.chance(0.2)) pace = -pace;
    if (random.chance(0.02)) here = 0;
    if (random.chance(0.7)) here += pace * random.uniform();
    motion.push_back(here);
  }
  return motion;
}

}  // namespace dashpot::testing
