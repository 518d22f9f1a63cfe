#include "fit/written_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "network/match.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;

class ElementList {
 public:
  ElementList(const Problem& problem, const Model& model) : problem_(problem), model_(model) {}

  std::vector<FittedElement> run() {
    for (std::size_t j = 0; j < model_.terms.size(); ++j)
      if (model_.weight(j) != 0) add_term(j);
    return std::move(elements_);
  }

 private:
  void add(const std::string& name, ElementKind kind, const ElementQuantity& quantity) {
    elements_.push_back({name, kind, quantity, value_of(model_, quantity), "", {}, {}, {}, {}});
  }

  void add_branch(const std::string& stiffness, const std::string& damping, const ElementQuantity& quantity) {
    add(stiffness, ElementKind::spring, quantity);
    ElementQuantity with_time = quantity;
    with_time.times_time = true;
    add(damping, ElementKind::damper, with_time);
  }

  void add_term(std::size_t j) {
    const Term& term = model_.terms[j];
    const ElementQuantity plain{j, false, false, problem_.form() == Form::compliance};
    switch (term.kind) {
      case TermKind::spring: return add("K0", ElementKind::spring, plain);
      case TermKind::damper: return add("B0", ElementKind::damper, plain);
      case TermKind::maxwell: ++branches_; return add_branch(name("K", branches_), name("B", branches_), plain);
      case TermKind::stop:
      case TermKind::sliding: return add_slip(term, plain);
      case TermKind::springpot: return add_springpot(term, plain);
      case TermKind::offset:
      case TermKind::initial: return;
    }
  }

  void add_slip(const Term& term, const ElementQuantity& quantity) {
    ++slips_;
    ElementQuantity yield = quantity, damping = quantity;
    yield.times_threshold = true;
    damping.times_time = true;
    add(name("S", slips_), ElementKind::spring, quantity);
    add(name("Y", slips_), ElementKind::slip, yield);
    if (term.kind == TermKind::sliding) add(name("D", slips_), ElementKind::damper, damping);
  }

  void add_springpot(const Term& term, const ElementQuantity& quantity) {
    constexpr double turn = 2 * std::numbers::pi, beyond = 2;
    add(name("P", ++springpots_), ElementKind::spring, quantity);
    const double low = 1 / (beyond * turn * problem_.duration()), high = beyond / (turn * problem_.shortest_step());
    elements_.back().springpot = fmt::format("\"exponent\": {:.5g}, \"band\": [\"{}\", \"{}\"], \"error\": \"0.1 %\"",
                                             term.exponent, quantity_text(low, "Hz", 3), quantity_text(high, "Hz", 3));
  }

  static std::string name(const char* letter, int number) { return fmt::format("{}{}", letter, number); }

  const Problem& problem_;
  const Model& model_;
  std::vector<FittedElement> elements_;
  int branches_ = 0, slips_ = 0, springpots_ = 0;
};

constexpr int curve_digits = 9;  // of displacements: the reach has three, and a table is cut in 16

// Rounding a value to D digits moves it by at most 0.5·10^(1−D) of itself.
int digits_for(const std::optional<Interval>& known, double value) {
  constexpr int least = 4, most = 15;
  if (!known) return least;
  const double half = (known->high - known->low) / (2 * std::abs(value));
  if (!(half > 0)) return most;
  return std::clamp(static_cast<int>(std::ceil(1 - std::log10(half / 5))), least, most);
}

std::string leaf_text(const FittedElement& element) {
  if (element.springpot)
    return fmt::format("{{ \"springpot\": \"{}\", {}, \"name\": \"{}\" }}", element.text, *element.springpot,
                       element.name);
  return fmt::format("{{ \"{}\": \"{}\", \"name\": \"{}\" }}", word_of(element.kind), element.text, element.name);
}

// Elements that belong together, by the number in their names: K3 with B3, Y1 with S1 and D1.
struct Branch {
  const FittedElement* spring = nullptr;
  const FittedElement* damper = nullptr;
  const FittedElement* slip = nullptr;
};

bool is_of_slip(const std::string& name) { return name[0] == 'S' || name[0] == 'Y' || name[0] == 'D'; }

std::string pair_text(const char* word, const std::string& first, const std::string& second) {
  return fmt::format("{{ \"{}\": [ {}, {} ] }}", word, first, second);
}

std::string branch_text(const Branch& branch, Form form) {
  if (branch.slip != nullptr) {
    const std::string slip = branch.damper == nullptr
                                 ? leaf_text(*branch.slip)
                                 : pair_text("parallel", leaf_text(*branch.slip), leaf_text(*branch.damper));
    return pair_text("series", slip, leaf_text(*branch.spring));
  }
  return form == Form::stiffness ? pair_text("series", leaf_text(*branch.damper), leaf_text(*branch.spring))
                                 : pair_text("parallel", leaf_text(*branch.spring), leaf_text(*branch.damper));
}

}  // namespace

std::string unit_of(ElementKind kind, const PortUnits& units) {
  switch (kind) {
    case ElementKind::spring: return units.stiffness;
    case ElementKind::damper: return units.damping;
    case ElementKind::slip: return units.force;
  }
  return "";
}

const char* word_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::spring: return "spring";
    case ElementKind::damper: return "damper";
    case ElementKind::slip: return "slip";
  }
  return "";
}

std::vector<FittedElement> elements_of(const Problem& problem, const Model& model) {
  return ElementList(problem, model).run();
}

std::string quantity_text(double value, const std::string& unit, int digits) {
  struct Prefix {
    const char* text;
    double factor;
  };
  static constexpr Prefix prefixes[] = {{"u", 1e-6}, {"m", 1e-3}, {"", 1}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}};
  const double size = std::abs(value);
  for (const Prefix& prefix : prefixes) {
    // Rounding must not carry a value to 1000 of a prefix.
    const double scaled = std::strtod(fmt::format("{:.{}e}", size / prefix.factor, digits - 1).c_str(), nullptr);
    if (scaled >= 1 && scaled < 1000)
      return fmt::format("{:.{}g} {}{}", value / prefix.factor, digits, prefix.text, unit);
  }
  return fmt::format("{:.{}g} {}", value, digits, unit);
}

double outwards(double value, double direction, int digits) {
  if (value == 0) return 0;
  const double step = std::pow(10, std::floor(std::log10(std::abs(value))) - (digits - 1));
  const double nearest = std::round(value / step);
  const bool holds = direction * (nearest * step - value) >= -1e-14 * std::abs(value);
  return (holds ? nearest : nearest + std::copysign(1, direction)) * step;
}

std::pair<std::string, std::string> interval_ends(const Interval& interval, const std::string& unit) {
  constexpr int least = 4, most = 15;
  const double width = interval.high - interval.low, size = std::max(std::abs(interval.low), std::abs(interval.high));
  const int digits =
      width > 0 ? std::clamp(static_cast<int>(std::ceil(std::log10(size / width))) + 2, least, most) : least;
  const auto text = [&](double end) {
    if (unit.empty()) return fmt::format("{:.{}g}", end, digits);
    return unit.starts_with("1/") ? fmt::format("{:.{}g} {}", end, digits, unit) : quantity_text(end, unit, digits);
  };
  return {text(outwards(interval.low, -1, digits)), text(outwards(interval.high, 1, digits))};
}

std::string interval_text(const Interval& interval, const std::string& unit) {
  const auto [low, high] = interval_ends(interval, unit);
  return low + " … " + high;
}

void round_values(std::vector<FittedElement>& elements, const Model& model, motion port_motion, int extra) {
  const PortUnits units = port_units(port_motion);
  for (FittedElement& element : elements) {
    const double exact = value_of(model, element.quantity);
    element.value = exact;
    const int digits = std::min(17, digits_for(element.interval, element.value) + extra);
    element.text = quantity_text(exact, unit_of(element.kind, units), digits);
  }
}

std::string unit_of(const CurveQuantity& quantity, const PortUnits& units) {
  switch (quantity.kind) {
    case CurveQuantity::Kind::power: return "";
    case CurveQuantity::Kind::rate: return "1/" + units.position;
    case CurveQuantity::Kind::force: break;
  }
  return units.force;
}

std::vector<FittedCurveValue> curve_values_of(const Model& model, motion port_motion) {
  std::vector<FittedCurveValue> values;
  if (!model.curve) return values;
  for (const CurveQuantity& quantity : curve_quantities(*model.curve)) {
    std::string name = quantity.kind == CurveQuantity::Kind::power  ? "power"
                       : quantity.kind == CurveQuantity::Kind::rate ? "rate"
                                                                    : "force";
    if (model.curve->kind() == CurveShape::Kind::table)
      name += " at " + quantity_text(quantity.displacement, port_units(port_motion).position, curve_digits);
    values.push_back({std::move(name), quantity, value_of(model, quantity), "", {}, {}, {}});
  }
  return values;
}

void round_values(std::vector<FittedCurveValue>& values, const Model& model, double stiffness, motion port_motion,
                  int extra) {
  const PortUnits units = port_units(port_motion);
  // A table's points have to rise after rounding too.
  const int more = model.curve && model.curve->kind() == CurveShape::Kind::table ? 2 + extra : extra;
  for (FittedCurveValue& value : values) {
    value.value = value_of(model, value.quantity);
    const int digits = std::min(17, digits_for(value.interval, value.value) + more);
    if (value.quantity.kind == CurveQuantity::Kind::force) value.value *= stiffness / curve_stiffness(model).value;
    const std::string unit = unit_of(value.quantity, units);
    value.text = unit == units.force ? quantity_text(value.value, unit, digits)
                 : unit.empty()      ? fmt::format("{:.{}g}", value.value, digits)
                                     : fmt::format("{:.{}g} {}", value.value, digits, unit);
  }
}

std::string static_text(const std::vector<FittedCurveValue>& values, const Model& model, motion port_motion) {
  const std::string unit = port_units(port_motion).position;
  const std::string is = curve_stiffness(model).is_instantaneous ? ", \"is\": \"instantaneous\"" : "";
  if (model.curve->kind() != CurveShape::Kind::table)
    return fmt::format("{{ \"{}\": {}, \"force\": \"{}\", \"at\": \"{}\"{} }}", word_of(model.curve->kind()),
                       model.curve->kind() == CurveShape::Kind::power ? values[0].text : "\"" + values[0].text + "\"",
                       values[1].text, quantity_text(model.curve->reach(), unit, curve_digits), is);
  std::string rows = fmt::format("[\"0 {}\", \"0 {}\"]", unit, port_units(port_motion).force);
  for (const FittedCurveValue& value : values)
    rows +=
        fmt::format(", [\"{}\", \"{}\"]", quantity_text(value.quantity.displacement, unit, curve_digits), value.text);
  return fmt::format("{{ \"table\": [{}]{} }}", rows, is);
}

std::string tree_text(const std::vector<FittedElement>& elements, Form form) {
  std::vector<std::string> parts;
  std::vector<std::pair<std::string, Branch>> branches;
  for (const FittedElement& element : elements) {
    if (element.name == "K0" || element.name == "B0" || element.springpot) {
      parts.push_back(leaf_text(element));
      continue;
    }
    const std::string key = (is_of_slip(element.name) ? "slip" : "branch") + element.name.substr(1);
    if (branches.empty() || branches.back().first != key) branches.emplace_back(key, Branch{});
    Branch& branch = branches.back().second;
    (element.kind == ElementKind::spring   ? branch.spring
     : element.kind == ElementKind::damper ? branch.damper
                                           : branch.slip) = &element;
  }
  for (const auto& [key, branch] : branches) parts.push_back(branch_text(branch, form));
  if (parts.size() == 1) return parts.front();
  std::string text = form == Form::stiffness ? "{ \"parallel\": [\n" : "{ \"series\": [\n";
  for (const std::string& part : parts) text += "      " + part + (&part == &parts.back() ? " ] }" : ",\n");
  return text;
}

namespace {

// K3 and B3, or the parts P1_spring_2 and P1_damper_2 that a springpot became.
struct BranchKey {
  bool has_slip;
  int springpot, number;

  friend auto operator<=>(const BranchKey&, const BranchKey&) = default;
};

BranchKey key_of(const std::string& name) {
  const int number = std::atoi(name.c_str() + 1);
  if (name[0] != 'P') return {is_of_slip(name), 0, number};
  return {false, number, std::atoi(name.c_str() + name.rfind('_') + 1)};
}

}  // namespace

Model model_of(const Network& network, Form form) {
  struct Values {
    double spring = 0, damper = 0, slip = 0;
  };
  std::map<BranchKey, Values> branches;
  for (const Element& element : network.elements) {
    Values& values = branches[key_of(element.name)];
    match(
        element.law, [&](const Spring& spring) { values.spring = spring.stiffness; },
        [&](const Damper& damper) { values.damper = damper.damping; },
        [&](const Slip& slip) { values.slip = slip.yield_force; });
  }
  Model model;
  std::vector<double> weights;
  const auto add = [&](Term term, double weight) {
    model.terms.push_back(term);
    weights.push_back(form == Form::compliance ? 1 / weight : weight);
  };
  for (const auto& [key, values] : branches) {
    if (key.has_slip) {
      const TermKind kind = values.damper > 0 ? TermKind::sliding : TermKind::stop;
      add({kind, values.damper / values.spring, values.slip / values.spring, 0, 0}, values.spring);
    } else if (key.number > 0) {
      add({TermKind::maxwell, values.damper / values.spring, 0, 0, 0}, values.spring);
    } else {
      if (values.spring > 0) add({TermKind::spring, 0, 0, 0, 0}, values.spring);
      if (values.damper > 0) add({TermKind::damper, 0, 0, 0, 0}, values.damper);
    }
  }
  model.weights = Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Index>(weights.size()));
  if (network.static_curve) model.curve = CurveShape::of(*network.static_curve, curve_stiffness(model).value);
  return model;
}

}  // namespace dashpot::compiler::fitting
