#include "emit/slip_tables.hpp"

#include <fmt/format.h>

#include <tuple>

#include "emit/cpp_lines.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

const char* part_name(slip_part kind) {
  switch (kind) {
    case slip_part::block: return "block";
    case slip_part::slip: return "slip";
    case slip_part::series: return "series";
    case slip_part::parallel: return "parallel";
  }
  return "";
}

}  // namespace

bool is_tuned(const Coupling& coupling) { return !coupling.tuned.empty(); }
bool is_tuned(const SlipNetwork& network) { return network.tuned.has_value(); }

std::string held_forces(const SolvedSlips& slips, const std::string& zero,
                        const std::function<std::string(VariableId)>& read) {
  std::string forces;
  for (VariableId id : slips.held) forces += (forces.empty() ? "" : ", ") + (id == no_variable ? zero : read(id));
  return forces;
}

void each_result_text(const SolvedSlips& slips, const char* moved,
                      const std::function<std::string(const std::string& sign)>& as_scalar,
                      const std::function<void(VariableId target, const std::string& value)>& visit) {
  each_result(slips, [&](VariableId target, SlipResult what, std::size_t i) {
    switch (what) {
      case SlipResult::surface: return visit(target, slips.name + "_change");
      case SlipResult::moved: return visit(target, fmt::format("{}_{}[{}]", slips.name, moved, i));
      case SlipResult::sign: return visit(target, as_scalar(fmt::format("{}_sign[{}]", slips.name, i)));
    }
  });
}

void append_tables(const Coupling& coupling, const TableWords& words, std::vector<std::string>& lines) {
  lines.push_back("// kind, children, slips, place, first corner, stiffness, compliance, yield force");
  lines.push_back(
      fmt::format("{}{} {}[{}] = {{", words.storage, words.node, words.name(coupling.name), coupling.nodes.size()));
  for (std::size_t k = 0; k < coupling.nodes.size(); ++k) {
    const slip_node<double>& node = coupling.nodes[k];
    const TunedNode tuned = is_tuned(coupling) ? coupling.tuned[k] : TunedNode{};
    append(lines, fmt::format("    {{{}{}, {}, {}, {}, {}, {}, {}, {}, {}}},", words.part, part_name(node.kind),
                              node.first_child, node.child_count, node.slips, node.place, node.first_corner,
                              words.number(node.stiffness, tuned.stiffness),
                              words.number(node.compliance, tuned.compliance), words.number(node.yield, tuned.yield)));
  }
  lines.push_back("};");
}

void append_tables(const SlipNetwork& network, const TableWords& words, std::vector<std::string>& lines) {
  const TunedNetwork tuned = network.tuned.value_or(TunedNetwork{});
  const auto at = [](const std::vector<VariableId>& all, std::size_t i) { return all.empty() ? no_variable : all[i]; };
  lines.push_back("// ends, lowest and highest force of each slip; inner ends come first, then tool and ground");
  lines.push_back(fmt::format("{}{} {}[{}] = {{", words.storage, words.link, words.name(network.name + "_links"),
                              network.slip_count()));
  for (std::size_t k = 0; k < network.links.size(); ++k) {
    const slip_link<double>& link = network.links[k];
    const VariableId yield = at(tuned.yields, k);
    const std::string highest = words.number(link.highest, yield);
    const std::string lowest = yield == no_variable ? words.number(link.lowest, yield) : "-" + highest;
    lines.push_back(fmt::format("    {{{}, {}, {}, {}}},", link.a, link.b, lowest, highest));
  }
  lines.push_back("};");
  lines.push_back("// stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]");
  for (const auto& [what, values, variables] : {std::tuple("_between", &network.between, &tuned.between),
                                                std::tuple("_to_tool", &network.to_tool, &tuned.to_tool),
                                                std::tuple("_to_ground", &network.to_ground, &tuned.to_ground)}) {
    std::string table =
        fmt::format("{}{} {}[{}] = {{", words.storage, words.scalar, words.name(network.name + what), values->size());
    for (std::size_t i = 0; i < values->size(); ++i)
      table += (i == 0 ? "" : ", ") + words.number((*values)[i], at(*variables, i));
    append(lines, table + "};");
  }
}

}  // namespace dashpot::compiler
