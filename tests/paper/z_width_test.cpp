#include "z_width.hpp"

#include <gtest/gtest.h>

#include "says.hpp"
#include <atomic>
#include <filesystem>
#include <fstream>

#include "support/temporary_folder.hpp"

namespace {

using namespace dashpot::paper;

const ZWidth& thinned_map() {
  static const dashpot::testing::TemporaryFolder folder;
  static const ZWidth map =
      measure_z_width(map_places(true), folder.path() / "z_width.csv", [](std::size_t, std::size_t) {});
  return map;
}

// Fails if a certified wall ever gives more energy than it took, with any hand, at any instant.
TEST(ZWidth, NeverGainsEnergyWhereItIsCertified) {
  constexpr double rounding = 1e-12;  // of the ledger, whose entries are millijoules
  unsigned runs = 0;
  for (std::size_t i = 0; i < thinned_map().points.size(); ++i) {
    EXPECT_GE(thinned_map().points[i].lowest_energy, -rounding) << thinned_map().places[i].key();
    runs += thinned_map().points[i].certified_runs;
  }
  EXPECT_GT(runs, 50U);
}

// Fails if energy that is gained went unseen: well above the stable boundary it is, where stiffness is what breaks it.
TEST(ZWidth, SeesEnergyThatIsGained) {
  for (std::size_t i = 0; i < thinned_map().points.size(); ++i) {
    const MapPoint& point = thinned_map().points[i];
    if (point.stable > 0 && thinned_map().places[i].damping < 5) {
      EXPECT_LT(lowest_energy_of(thinned_map().places[i], 4 * point.stable), -1e-5) << thinned_map().places[i].key();
    }
  }
}

// Fails if the certificate promises more than the simulation holds.
TEST(ZWidth, CertifiesNoWallThatIsUnstable) {
  for (std::size_t i = 0; i < thinned_map().points.size(); ++i)
    EXPECT_LE(thinned_map().points[i].certified, thinned_map().points[i].stable) << thinned_map().places[i].key();
}

// Fails if the dual channel's brake widens neither what is stable nor what is certified against the same estimator
// without it.
TEST(ZWidth, IsWiderByTheDualChannel) {
  const std::size_t dampings = 4, single = 2 * dampings, dual = 4 * dampings;  // of two rates each
  for (std::size_t i = 0; i < 2 * dampings; ++i) {
    const MapPoint &without = thinned_map().points[single + i], &with = thinned_map().points[dual + i];
    EXPECT_GE(with.stable, 0.98 * without.stable) << thinned_map().places[dual + i].key();
    EXPECT_GE(with.certified, without.certified) << thinned_map().places[dual + i].key();
  }
}

// Fails if an interrupted map is begun anew, or a line that was cut off is believed.
TEST(ZWidth, GoesOnWhereItWasInterrupted) {
  const dashpot::testing::TemporaryFolder folder;
  const std::string file = folder.path() / "z_width.csv";
  std::vector<MapPlace> places = map_places(true);
  places.resize(3);
  measure_z_width(places, file, [](std::size_t, std::size_t) {});
  std::ifstream finished(file);
  std::string heading, line;
  std::getline(finished, heading);
  std::ofstream(file) << heading << "\n"
                      << places[0].key() << ",123,45,0,7,end\n"  // as if measured
                      << places[1].key() << ",123,45";           // cut off
  const ZWidth map = measure_z_width(places, file, [](std::size_t, std::size_t) {});
  EXPECT_EQ(map.points[0].stable, 123);
  EXPECT_EQ(map.points[1].stable, thinned_map().points[1].stable);
}

// Fails if a finished map is taken for an interrupted one, or one of other places is believed.
TEST(ZWidth, BeginsAnewAfterAFinishedMap) {
  const dashpot::testing::TemporaryFolder folder;
  const std::string file = folder.path() / "z_width.csv";
  std::vector<MapPlace> places = map_places(true);
  places.resize(1);
  std::ofstream(file) << "settings,of another map\n" << places[0].key() << ",123,45,0,7,end\n";
  EXPECT_EQ(measure_z_width(places, file, [](std::size_t, std::size_t) {}).points[0].stable,
            thinned_map().points[0].stable);
}

// Fails if the words stay when the numbers change sides.
TEST(ZWidth, SaysWhatTheNumbersSay) {
  ZWidth map = thinned_map();
  EXPECT_TRUE(says(show(map), "Certified walls never gave energy"));
  map.points[0].lowest_energy = -1;
  EXPECT_TRUE(says(show(map), "Certified walls gave energy"));
  for (std::size_t i = 0; i < map.points.size(); ++i)
    map.points[i].stable = map.places[i].realisation.name == "dual channel";
  EXPECT_TRUE(says(show(map), "is won by the brake"));
  for (MapPoint& point : map.points) point.stable = 1;
  EXPECT_TRUE(says(show(map), "is not won by the brake"));
}

}  // namespace
