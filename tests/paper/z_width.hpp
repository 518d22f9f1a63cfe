// The Z-width (Colgate & Brown 1994): which walls of stiffness K and damping B the rig can render without oscillating,
// by each estimator and each decomposition, at four rates; and which of them are certified before anything runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compared_estimators.hpp"
#include "page.hpp"

namespace dashpot::paper {

enum class WallKind { kelvin, maxwell };  // K beside B, K behind B

// What renders the wall.
struct WallRealisation {
  std::string name;
  std::string decomposition;  // a name of theory, section 4
  NamedEstimator estimator;
};

// One place on the map: everything but the stiffness.
struct MapPlace {
  WallKind kind;
  double rate;  // [Hz]
  WallRealisation realisation;
  double damping;  // B [N·s/m]

  std::string key() const;  // of its line in the file
};

struct MapPoint {
  double stable = 0;         // the largest K that is stable in simulation [N/m]; 0: none
  double certified = 0;      // the largest K that is certified [N/m]; 0: none
  double lowest_energy = 0;  // that the display ever had taken in, over all simulations of certified walls [J]
  unsigned certified_runs = 0;
};

// `thinned`: two rates, three realisations, four dampings.
std::vector<MapPlace> map_places(bool thinned);

MapPoint measure(const MapPlace& place);

// The least energy that motor, brake and friction have taken in together while the tool bounces on that wall; below
// zero they have given more than they took [J].
double lowest_energy_of(const MapPlace& place, double stiffness);

struct ZWidth {
  std::vector<MapPlace> places;
  std::vector<MapPoint> points;  // as many
};

// All places on all cores. What is done is in `file`, a line each, as soon as it is done; a file of an interrupted run
// is read and continued, and one of other settings or of a finished run is begun anew. `progress` is told how many are
// done.
ZWidth measure_z_width(const std::vector<MapPlace>& places, const std::string& file,
                       const std::function<void(std::size_t done, std::size_t all)>& progress);

Section show(const ZWidth& map);

}  // namespace dashpot::paper
