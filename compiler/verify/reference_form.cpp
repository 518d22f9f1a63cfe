#include "verify/reference_form.hpp"

#include <algorithm>
#include <map>

#include "network/disjoint_sets.hpp"
#include "network/match.hpp"
#include "verify/reference_pencil.hpp"

namespace dashpot::compiler {
namespace {

using Row = ReferenceVector;
using Square = ReferenceMatrix;

// Inner nodes that are joined without passing tool or ground.
std::vector<std::vector<NodeIndex>> components(const Network& network) {
  DisjointSets joined(network.nodes.size());
  for (const Element& e : network.elements)
    if (e.has_effect && e.a > tool && e.b > tool) joined.unite_by_least(e.a, e.b);
  std::map<NodeIndex, std::vector<NodeIndex>> groups;
  std::vector<bool> touched(network.nodes.size(), false);
  for (const Element& e : network.elements)
    if (e.has_effect) touched[e.a] = touched[e.b] = true;
  for (NodeIndex i = tool + 1; i < touched.size(); ++i)
    if (touched[i]) groups[joined.find(i)].push_back(i);
  std::vector<std::vector<NodeIndex>> list;
  for (auto& [least, nodes] : groups) list.push_back(std::move(nodes));
  return list;
}

// One kind of element, K or B: among the inner nodes, from them to the tool, and at the tool itself.
struct Laplacian {
  Square inner;
  Row to_tool;
  Reference at_tool = 0;
};

void stamp(Laplacian& matrix, const std::vector<int>& row, const Element& e, double value) {
  const NodeIndex ends[2] = {e.a, e.b};
  for (int end = 0; end < 2; ++end) {
    const int i = row[ends[end]], j = row[ends[1 - end]];
    if (ends[end] == tool) matrix.at_tool += value;
    if (i < 0) continue;
    const auto here = static_cast<std::size_t>(i);
    matrix.inner[here][here] += value;
    if (j >= 0) matrix.inner[here][static_cast<std::size_t>(j)] -= value;
    if (ends[1 - end] == tool) matrix.to_tool[here] -= value;
  }
}

// −(p + s q)²/(m + s d), with m = μ, d = (1 − μ)/ω0 (theory, section 2).
void add_mode(ReferenceForm& form, const Reference& mu, const Reference& shift, const Reference& p,
              const Reference& q) {
  const Reference nothing("1e-60");
  const Reference d = (1 - mu) / shift;
  if (mu < nothing) {
    form.feedthrough_damping -= q * q / d;
  } else if (1 - mu < nothing) {
    form.static_stiffness -= p * p / mu;
  } else {
    const Reference rate = mu / d, drive = p - q * rate, c = drive * drive / d;
    form.feedthrough_damping -= q * q / d;
    form.static_stiffness -= (2 * p * q - q * q * rate) / d + c / rate;
    if (c > 0) form.modes.push_back({c / rate, rate, p / drive});
  }
}

void add_component(ReferenceForm& form, Laplacian springs, Laplacian dampers) {
  std::vector<Row> drives = {std::move(springs.to_tool), std::move(dampers.to_tool)};
  const ReferencePencil pencil = reference_pencil(springs.inner, dampers.inner, drives);
  for (std::size_t i = 0; i < pencil.mu.size(); ++i)
    add_mode(form, pencil.mu[i], pencil.shift, drives[0][i], drives[1][i]);
}

void merge_equal_rates(std::vector<ReferenceMode>& modes) {
  std::stable_sort(modes.begin(), modes.end(),
                   [](const auto& x, const auto& y) { return x.relaxation_rate < y.relaxation_rate; });
  std::vector<ReferenceMode> distinct;
  for (const ReferenceMode& mode : modes) {
    const Reference equal("1e-12");
    if (distinct.empty() || mode.relaxation_rate - distinct.back().relaxation_rate > equal * mode.relaxation_rate) {
      distinct.push_back(mode);
      continue;
    }
    ReferenceMode& both = distinct.back();
    const Reference stiffness = both.stiffness + mode.stiffness;
    const Reference damping = both.stiffness / both.relaxation_rate + mode.stiffness / mode.relaxation_rate;
    both.spring_share = (both.stiffness * both.spring_share + mode.stiffness * mode.spring_share) / stiffness;
    both.stiffness = stiffness;
    both.relaxation_rate = stiffness / damping;
  }
  modes = std::move(distinct);
}

// Re D + Im D at ω.
Reference weight_at(const ReferenceForm& form, const Reference& w) {
  Reference sum = form.static_stiffness + form.feedthrough_damping * w;
  for (const ReferenceMode& mode : form.modes)
    sum += mode.stiffness * w * (w + mode.relaxation_rate) / (w * w + mode.relaxation_rate * mode.relaxation_rate);
  return sum;
}

// Cancellation to nothing leaves some 1e-95 of the whole; what is there is never below 1e-30 of it.
void drop_leftovers(ReferenceForm& form) {
  Reference glass = abs(form.static_stiffness), viscosity = abs(form.feedthrough_damping);
  for (const ReferenceMode& mode : form.modes)
    glass += mode.stiffness, viscosity += mode.stiffness / mode.relaxation_rate;
  const Reference leftover("1e-60"), negligible("1e-30");
  if (abs(form.static_stiffness) < leftover * glass) form.static_stiffness = 0;
  if (abs(form.feedthrough_damping) < leftover * viscosity) form.feedthrough_damping = 0;
  const ReferenceForm whole = form;
  std::erase_if(form.modes, [&](const ReferenceMode& mode) {
    const Reference most = 2 * glass + whole.feedthrough_damping * mode.relaxation_rate;
    return mode.stiffness <= negligible * most && mode.stiffness <= negligible * weight_at(whole, mode.relaxation_rate);
  });
}

}  // namespace

ReferenceForm reference_form(const Network& network) {
  ReferenceForm form;
  std::vector<std::vector<NodeIndex>> parts = components(network);
  parts.push_back({});  // the elements between tool and ground
  std::vector<std::size_t> part_of(network.nodes.size(), parts.size() - 1);
  std::vector<int> row(network.nodes.size(), -1);
  std::vector<Laplacian> springs, dampers;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::size_t n = parts[part].size();
    springs.push_back({Square(n, Row(n, 0)), Row(n, 0), 0});
    dampers.push_back(springs.back());
    for (std::size_t i = 0; i < n; ++i) part_of[parts[part][i]] = part, row[parts[part][i]] = int(i);
  }
  for (const Element& e : network.elements) {
    if (!e.has_effect) continue;
    const std::size_t part = part_of[e.a > tool ? e.a : e.b];
    match(
        e.law, [&](const Spring& spring) { stamp(springs[part], row, e, spring.stiffness); },
        [&](const Damper& damper) { stamp(dampers[part], row, e, damper.damping); }, [](const Slip&) {});
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    form.static_stiffness += springs[part].at_tool;
    form.feedthrough_damping += dampers[part].at_tool;
    if (!parts[part].empty()) add_component(form, springs[part], dampers[part]);
  }
  drop_leftovers(form);
  merge_equal_rates(form.modes);
  return form;
}

}  // namespace dashpot::compiler
