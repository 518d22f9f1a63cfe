#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "z_width.hpp"

namespace dashpot::paper {
namespace {

constexpr double rates[] = {1e3, 2e3, 5e3, 1e4};
constexpr Interval shown_damping{0.03, 30}, shown_stiffness{1, 2e5};

constexpr Style styles[] = {{"#7f7f7f", 1.2, "2 2"}, single_motor,     {"#e08e0b", 1.4},        {"#8a6d3b", 1.4},
                            {"#8a6d3b", 1.4, "6 3"}, {"#2f8f5b", 1.4}, {"#2f8f5b", 1.4, "6 3"}, {"#6a3d9a", 1.6},
                            {"#d1478c", 1.4},        {"#1a1a1a", 1.4}, {"#1a1a1a", 1.4, "6 3"}, {"#0b5fa5", 2.2}};

Style dotted(Style style) {
  style.width = 1.2;
  style.dashes = "1 3";
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
  int stable = 0, certified = 0;
};

Count count(const ZWidth& map, const Selection& which) {
  Count count;
  for (std::size_t i = 0; i < map.places.size(); ++i)
    for (int k = 0; k <= 30 && which.holds(map.places[i]); ++k) {
      const double stiffness = std::pow(10, k / 6.0) * (1 - 1e-9);
      count.stable += stiffness <= map.points[i].stable;
      count.certified += stiffness <= map.points[i].certified;
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

Panel panel(const std::string& title, std::vector<Curve> curves, bool wide = false) {
  return {title,
          "damping B of the wall [N·s/m]",
          "stiffness K [N/m]",
          std::move(curves),
          shown_damping,
          shown_stiffness,
          Scale::logarithmic,
          Scale::logarithmic,
          wide};
}

void add_pair(std::vector<Curve>& curves, const ZWidth& map, const Selection& which, const std::string& name,
              const Style& style) {
  curves.push_back(boundary(map, which, name + ", stable", style, &MapPoint::stable));
  curves.push_back(boundary(map, which, name + ", certified", dotted(style), &MapPoint::certified));
}

Figure figure_by_rate(const ZWidth& map) {
  Figure figure{"Z-width: walls K beside B on the rig, single motor and dual channel", {}, {}};
  const std::string paper = realisations(map, WallKind::kelvin).at(1);
  for (const double rate : rates) {
    std::vector<Curve> curves;
    add_pair(curves, map, {WallKind::kelvin, rate, paper}, "single motor", single_motor);
    add_pair(curves, map, {WallKind::kelvin, rate, "dual channel"}, "dual channel", dual_channel);
    figure.panels.push_back(panel(fmt::format("{} kHz", rate / 1e3), curves));
  }
  const Count single = count(map, {WallKind::kelvin, 1e4, paper}),
              dual = count(map, {WallKind::kelvin, 1e4, "dual channel"});
  figure.caption = {"Below a line walls are stable in simulation, or certified. Estimator: 4th order, 120 Hz.",
                    fmt::format("Of 589 walls, six a decade, at 10 kHz: single motor {} stable, {} certified;",
                                single.stable, single.certified),
                    fmt::format("dual channel {} stable, {} certified.", dual.stable, dual.certified)};
  return figure;
}

Figure figure_by_estimator(const ZWidth& map) {
  Figure figure{"Z-width: walls K beside B by the single motor, through every estimator", {}, {}};
  const std::vector<std::string> names = realisations(map, WallKind::kelvin);
  for (const double rate : {1e3, 1e4}) {
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < names.size(); ++i)
      curves.push_back(boundary(map, {WallKind::kelvin, rate, names[i]}, names[i], styles[i % std::size(styles)],
                                &MapPoint::stable));
    figure.panels.push_back(panel(fmt::format("{} kHz", rate / 1e3), curves, true));
  }
  return figure;
}

Figure figure_by_decomposition(const ZWidth& map) {
  Figure figure{"Z-width: walls K behind B, by every decomposition",
                {"Thick: stable in simulation; 100,000 N/m is as far as the map goes. Dotted: certified."},
                {}};
  const std::vector<std::string> names = realisations(map, WallKind::maxwell);
  const Style of_each[] = {{"#c1440e", 5}, {"#0b5fa5", 3}, {"#2f8f5b", 1.8}, {"#1a1a1a", 1.2, "5 4"}};
  for (const double rate : rates) {
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Selection which{WallKind::maxwell, rate, names[i]};
      curves.push_back(boundary(map, which, names[i], of_each[i % 4], &MapPoint::stable));
      curves.push_back(boundary(map, which, "", dotted(of_each[i % 4]), &MapPoint::certified));
    }
    figure.panels.push_back(panel(fmt::format("{} kHz", rate / 1e3), curves));
  }
  return figure;
}

Table table_of(const ZWidth& map, WallKind kind, const char* title) {
  Table table{title, {"realisation", "1 kHz", "2 kHz", "5 kHz", "10 kHz"}, {}};
  for (const std::string& name : realisations(map, kind)) {
    std::vector<std::string> row = {name};
    for (const double rate : rates) {
      const Count counted = count(map, {kind, rate, name});
      row.push_back(fmt::format("{} / {}", counted.stable, counted.certified));
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

Section show(const ZWidth& map) {
  unsigned runs = 0;
  double lowest = 0;
  for (const MapPoint& point : map.points) runs += point.certified_runs, lowest = std::min(lowest, point.lowest_energy);
  return {"z_width",
          "Z-width: which walls can be rendered",
          {"A tool of 40 g flies at 100 mm/s into a wall that holds it on both sides; the wall is stable if the tool "
           "comes to rest within "
           "a second. Jitter is left out, and the coil’s switching on: both are beyond the certificate that is drawn. "
           "The brake makes "
           "5 % less than it is told.",
           fmt::format("Certified walls never gave energy: {} simulations at the certified limit and a tenth of it, "
                       "with no hand, a relaxed "
                       "one and a stiff grasp; the least that a display had taken in at any instant is {:.1g} J.",
                       runs, lowest),
           "The virtual damper of a single motor is certified almost nowhere: only as far as the arm’s own 0.028 N·s/m "
           "of damping pays "
           "for it, since a certificate counts neither friction nor hand. That many more walls come to rest in "
           "simulation is the "
           "arm’s friction of 20 mN.",
           "Stability alone has no winner. Where the brake reaches, up to 2.8 N·s/m, the dual channel holds walls "
           "about twice as stiff "
           "as the single motor with the same filter at 10 kHz; beyond, a single motor with a quicker estimate holds "
           "stiffer ones. A wall K behind B "
           "is stable by any position driven law at every stiffness of the map, with or without a brake; its "
           "`quietest-passive` law is "
           "driven by the late velocity, and the brake’s end at 2.8 N·s/m breaks it. What the brake buys in every case "
           "is the proof.",
           "FOAW, inverse time, super-twisting and tracking differentiator are not linear: for them nothing is "
           "certified here."},
          {figure_by_rate(map), figure_by_estimator(map), figure_by_decomposition(map)},
          {table_of(map, WallKind::kelvin, "K beside B: walls stable / certified, of 589"),
           table_of(map, WallKind::maxwell, "K behind B: walls stable / certified, of 589")}};
}

}  // namespace dashpot::paper
