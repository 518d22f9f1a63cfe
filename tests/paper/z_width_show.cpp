#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "chosen.hpp"
#include "claims.hpp"
#include "z_width.hpp"

namespace dashpot::paper {
namespace {

constexpr Interval shown_damping{0.03, 30}, near_walls{50, 1e5}, all_walls{5, 2e5};

// Of the lines of one plot, which are never more.
constexpr Style line_styles[] = {{"#c1440e", 1.6}, {"#2f8f5b", 1.6, "7 3"}, {"#8a4fa8", 1.6, "2 2"}, {"#e08e0b", 1.6}};

// Dotted, and marked where a single wall is all there is.
Style certified(Style style) {
  style.width = 1.1;
  style.dashes = "1 3";
  style.marker = Marker::cross;
  return style;
}

struct Selection {
  WallKind kind;
  double rate;
  std::string realisation;

  bool holds(const MapPlace& place) const {
    return place.kind == kind && place.rate == rate && place.realisation.name == realisation;
  }
};

// Where there is a stable, or certified, stiffness at all.
Curve boundary(const ZWidth& map, const Selection& which, const std::string& name, const Style& style,
               double MapPoint::*stiffness) {
  Curve curve{name, style, {}, {}};
  for (std::size_t i = 0; i < map.places.size(); ++i)
    if (which.holds(map.places[i]) && map.points[i].*stiffness > 0) {
      curve.x.push_back(map.places[i].damping);
      curve.y.push_back(map.points[i].*stiffness);
    }
  return curve;
}

// Points of a grid of walls, six a decade of K and of B, that are stable, and that are certified.
struct Count {
  int stable = 0, certified = 0, all = 0;
};

std::vector<double> counted_stiffnesses() {
  const std::vector<double> ends = chosen_list("map.stiffness");
  std::vector<double> all;
  for (double k = 0; ends.front() * std::pow(10, k / chosen("map.steps")) <= ends.back() * (1 + 1e-9); ++k)
    all.push_back(ends.front() * std::pow(10, k / chosen("map.steps")) * (1 - 1e-9));
  return all;
}

Count count(const ZWidth& map, const Selection& which) {
  const std::vector<double> stiffnesses = counted_stiffnesses();
  Count count;
  for (std::size_t i = 0; i < map.places.size(); ++i)
    for (const double stiffness : stiffnesses) {
      if (!which.holds(map.places[i])) break;
      count.stable += stiffness <= map.points[i].stable;
      count.certified += stiffness <= map.points[i].certified;
      ++count.all;
    }
  return count;
}

std::vector<std::string> realisations(const ZWidth& map, WallKind kind) {
  std::vector<std::string> names;
  for (const MapPlace& place : map.places)
    if (place.kind == kind && std::find(names.begin(), names.end(), place.realisation.name) == names.end())
      names.push_back(place.realisation.name);
  return names;
}

Panel panel(const std::string& title, std::vector<Curve> curves, const Interval& stiffness) {
  return {title,
          "damping B of the wall [N·s/m]",
          "stiffness K [N/m]",
          std::move(curves),
          shown_damping,
          stiffness,
          Scale::logarithmic,
          Scale::logarithmic,
          false};
}

Curve stable_below(const ZWidth& map, const Selection& which, const std::string& name, const Style& style) {
  Curve curve = boundary(map, which, name, style, &MapPoint::stable);
  curve.maker = Maker::evaluated;
  return curve;
}

Curve certified_below(const ZWidth& map, const Selection& which, const std::string& name, const Style& style) {
  Curve curve = boundary(map, which, name, certified(style), &MapPoint::certified);
  curve.maker = Maker::analysis;
  return curve;
}

std::string kilohertz(double rate) { return fmt::format("{:g} kHz", rate / 1e3); }

// What every plot of the map says beside what is its own.
std::vector<std::string> with_conditions(std::vector<std::string> own) {
  const device_description& plant = rig().description;
  own.push_back(
      fmt::format("Stable: a tool of {:.0f} g, flying in at {:g} mm/s, is at rest within {:g} s, on the rig "
                  "without jitter,",
                  1e3 * plant.mechanics.inertia / (plant.arm_radius * plant.arm_radius), 1e3 * chosen("map.speed"),
                  chosen("map.duration")));
  own.push_back(fmt::format("its brake {:g} % short and as quick as told. The map ends at {:g} N/m.",
                            100 * plant.brake.tolerance, chosen_list("map.stiffness").back()));
  return own;
}

std::string paper_filter(const ZWidth& map) { return realisations(map, WallKind::kelvin).at(1); }

Figure figure_by_rate(const ZWidth& map) {
  Figure figure{"Z-width: walls K beside B on the rig, single motor and dual channel", {}, {}};
  for (const double rate : chosen_list("map.rates")) {
    const Selection single{WallKind::kelvin, rate, paper_filter(map)}, dual{WallKind::kelvin, rate, "dual channel"};
    figure.panels.push_back(panel(kilohertz(rate),
                                  {stable_below(map, single, "single motor, stable", single_motor),
                                   certified_below(map, single, "single motor, certified", single_motor),
                                   stable_below(map, dual, "dual channel, stable", dual_channel),
                                   certified_below(map, dual, "dual channel, certified", dual_channel)},
                                  near_walls));
  }
  figure.caption =
      with_conditions({"Walls below a line are stable in simulation, or certified before anything runs. "
                       "Both through the",
                       "estimator of the paper, Butterworth, 4th order, 120 Hz."});
  return figure;
}

struct Group {
  const char* title;
  std::vector<std::size_t> estimators;  // as compared_estimators() lists them
};

// The dual channel, thick and grey, is the same in each.
Figure figure_of(const ZWidth& map, const Group& group) {
  Figure figure{fmt::format("Z-width: walls K beside B by the single motor, {}", group.title), {}, {}};
  const std::vector<std::string> names = realisations(map, WallKind::kelvin);
  const std::vector<double> rates = chosen_list("map.rates");
  for (const double rate : {rates.front(), rates.back()}) {
    std::vector<Curve> curves = {
        stable_below(map, {WallKind::kelvin, rate, "dual channel"}, "dual channel, Butterworth, 4th order", ideal)};
    for (std::size_t i = 0; i < group.estimators.size() && group.estimators[i] + 1 < names.size(); ++i) {
      const std::string& name = names[group.estimators[i]];
      curves.push_back(
          stable_below(map, {WallKind::kelvin, rate, name}, name, line_styles[i % std::size(line_styles)]));
    }
    figure.panels.push_back(panel(kilohertz(rate), curves, near_walls));
  }
  figure.caption =
      with_conditions({"Walls below a line are stable in simulation through that estimator of the velocity."});
  return figure;
}

Figure figure_by_decomposition(const ZWidth& map) {
  Figure figure{"Z-width: walls K behind B, by every decomposition", {}, {}};
  const std::vector<double> rates = chosen_list("map.rates");
  for (const std::string& name : realisations(map, WallKind::maxwell)) {
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const Style& style = line_styles[i % std::size(line_styles)];
      const Selection which{WallKind::maxwell, rates[i], name};
      curves.push_back(stable_below(map, which, fmt::format("stable at {}", kilohertz(rates[i])), style));
      curves.push_back(certified_below(map, which, fmt::format("certified at {}", kilohertz(rates[i])), style));
    }
    figure.panels.push_back(panel(name == "paper" ? "the paper’s rule" : name, curves, all_walls));
  }
  figure.caption =
      with_conditions({"Walls below a line are stable in simulation, or certified before anything runs, by "
                       "what the panel",
                       "names. Estimator: Butterworth, 4th order, 120 Hz."});
  return figure;
}

double stable_at(const ZWidth& map, const Selection& which, double damping) {
  for (std::size_t i = 0; i < map.places.size(); ++i)
    if (which.holds(map.places[i]) && map.places[i].damping == damping) return map.points[i].stable;
  return 0;
}

// How many times as stiff a wall the dual channel holds as the single motor with the same filter, at the highest rate,
// over the dampings that the brake reaches.
Range gain_within_reach(const ZWidth& map) {
  const device_description& plant = rig().description;
  const double rate = chosen_list("map.rates").back(),
               reach = plant.brake.max_damping / (plant.arm_radius * plant.arm_radius);
  std::vector<double> gains;
  for (const MapPlace& place : map.places)
    if (Selection{WallKind::kelvin, rate, "dual channel"}.holds(place) && place.damping <= reach)
      if (const double single = stable_at(map, {WallKind::kelvin, rate, paper_filter(map)}, place.damping); single > 0)
        gains.push_back(stable_at(map, {WallKind::kelvin, rate, "dual channel"}, place.damping) / single);
  return gains.empty() ? Range{} : range_of(gains, [](double gain) { return gain; });
}

// The stiffest wall that each holds at the highest rate; of the single motor through its best estimator.
struct Stiffest {
  double dual = 0, single = 0;
  std::string estimator;
};
Stiffest stiffest(const ZWidth& map) {
  Stiffest found;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const MapPlace& place = map.places[i];
    if (place.kind != WallKind::kelvin || place.rate != chosen_list("map.rates").back()) continue;
    const double stable = map.points[i].stable;
    if (place.realisation.name == "dual channel") found.dual = std::max(found.dual, stable);
    else if (stable > found.single) found.single = stable, found.estimator = place.realisation.name;
  }
  return found;
}

std::string stable_throughout(const ZWidth& map) {
  std::string all, others;
  for (const std::string& name : realisations(map, WallKind::maxwell)) {
    double least = chosen_list("map.stiffness").back();
    for (std::size_t i = 0; i < map.places.size(); ++i)
      if (map.places[i].kind == WallKind::maxwell && map.places[i].realisation.name == name)
        least = std::min(least, map.points[i].stable);
    if (least == chosen_list("map.stiffness").back()) all += (all.empty() ? "`" : ", `") + name + "`";
    else others += fmt::format("{}`{}` to {:.0f} N/m", others.empty() ? "" : ", ", name, least);
  }
  return fmt::format("A wall K behind B is stable at every stiffness of the map by {}{}.", all.empty() ? "no law" : all,
                     others.empty() ? "" : "; where it holds least, by " + others);
}

std::string uncertified(const ZWidth& map) {
  std::string names;
  for (const std::string& name : realisations(map, WallKind::kelvin)) {
    int certified = 0;
    for (const double rate : chosen_list("map.rates"))
      certified += count(map, {WallKind::kelvin, rate, name}).certified;
    if (certified == 0) names += (names.empty() ? "" : "; ") + name;
  }
  return names.empty() ? "Every estimator has walls that are certified." : "Nothing is certified with: " + names + ".";
}

std::vector<std::string> words_of(const ZWidth& map) {
  unsigned runs = 0;
  double lowest = 0;
  for (const MapPoint& point : map.points) runs += point.certified_runs, lowest = std::min(lowest, point.lowest_energy);
  constexpr double rounding = 1e-12;  // of the ledger [J]
  const double highest_rate = chosen_list("map.rates").back();
  const Count single = count(map, {WallKind::kelvin, highest_rate, paper_filter(map)}),
              dual = count(map, {WallKind::kelvin, highest_rate, "dual channel"});
  const Range gain = gain_within_reach(map);
  const Stiffest most = stiffest(map);
  return {fmt::format(
              "A tool flies into a wall that holds it on both sides. Jitter is left out, and the coil’s switching on: "
              "both are beyond the certificate that is drawn. Certified walls {}: {} simulations at the certified "
              "limit and a tenth of it, with no hand, a relaxed one and a stiff grasp; the least that a display had "
              "taken in at any instant is {:.1g} J.",
              lowest >= -rounding ? "never gave energy" : "gave energy", runs, lowest),
          fmt::format(
              "Of {} walls, {:g} a decade of K and of B, at {} the single motor holds {} and is certified for {}, the "
              "dual channel {} and {}. The virtual damper is certified as far as the arm’s own 0.028 N·s/m of damping "
              "pays for it, since a certificate counts neither friction nor hand; what else comes to rest in "
              "simulation does so by the arm’s friction of 20 mN.",
              single.all, chosen("map.steps"), kilohertz(highest_rate), single.stable, single.certified, dual.stable,
              dual.certified),
          fmt::format(
              "Where the brake reaches, the dual channel holds walls {:.2f} to {:.2f} times as stiff as the single "
              "motor with the same filter. The stiffest wall of all is {:.0f} N/m by the dual channel and {:.0f} by a "
              "single motor ({}): stability alone {} the brake. {} What the brake buys is the proof.",
              gain.low, gain.high, most.dual, most.single, most.estimator,
              most.dual > most.single ? "is won by" : "is not won by", stable_throughout(map)),
          uncertified(map)};
}

Table table_of(const ZWidth& map, WallKind kind, const char* title) {
  Table table{fmt::format("{}: walls stable / certified, of {}", title,
                          count(map, {kind, chosen_list("map.rates").back(), realisations(map, kind).at(0)}).all),
              {"realisation"},
              {}};
  for (const double rate : chosen_list("map.rates")) table.headings.push_back(kilohertz(rate));
  for (const std::string& name : realisations(map, kind)) {
    std::vector<std::string> row = {name};
    for (const double rate : chosen_list("map.rates")) {
      const Count counted = count(map, {kind, rate, name});
      row.push_back(fmt::format("{} / {}", counted.stable, counted.certified));
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

Section show(const ZWidth& map) {
  const Group groups[] = {
      {"through linear filters", {0, 1, 2, 8}}, {"over windows", {3, 4, 5, 6}}, {"nonlinear estimators", {7, 9, 10}}};
  Section section{"z_width", "Z-width: which walls can be rendered", words_of(map), {figure_by_rate(map)}, {}};
  for (const Group& group : groups) section.figures.push_back(figure_of(map, group));
  section.tables = {table_of(map, WallKind::kelvin, "K beside B")};
  if (realisations(map, WallKind::maxwell).empty()) return section;  // of a thinned map
  section.figures.push_back(figure_by_decomposition(map));
  section.tables.push_back(table_of(map, WallKind::maxwell, "K behind B"));
  return section;
}

}  // namespace dashpot::paper
