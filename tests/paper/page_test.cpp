#include "page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include <laws.hpp>

#include "all_experiments.hpp"
#include "chosen.hpp"
#include "evaluated_law.hpp"
#include "limits.hpp"
#include "printed_needle.hpp"
#include "z_width.hpp"

namespace {

using namespace dashpot::paper;

// As many rows and samples as the measured ones have.
Limits some_limits() {
  Limits limits;
  const std::vector<double> cutoffs = chosen_list("limits.cutoffs");
  Limits::Row row;
  row.faults = {"mode, backlash and noise", 100, 0.1, 0.1, 0.1};
  row.raw = {7, 40}, row.filtered = {40, 40};
  row.cutoffs = cutoffs;
  row.by_cutoff.assign(cutoffs.size(), {10, 20});
  limits.rows.assign(5, row);
  for (const double inertia : chosen_list("limits.inertias"))
    for (const double mode : chosen_list("limits.modes")) {
      limits.modes.push_back(row);
      limits.modes.back().faults.mode = mode, limits.modes.back().faults.inertia = inertia;
    }
  Trace trace(std::size_t(chosen("limits.duration") * 1e4));
  for (std::size_t k = 0; k < trace.size(); ++k) trace[k].time = 1e-4 * double(k), trace[k].motor = k % 2 ? 2 : -2;
  for (const char* name : {"difference of one sample", "4th order, 120 Hz", "too much"})
    limits.runs.push_back({name, plain, trace});
  return limits;
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> sections = all_experiments(true);
    sections.push_back(show(some_limits()));
    sections.push_back(
        show(ZWidth{map_places(false), std::vector<MapPoint>(map_places(false).size(), {100, 10, 0, 6})}));
    return sections;
  }();
  return all;
}

// Fails if a figure shows a number that is none.
TEST(Page, DrawsNumbersOnly) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures) {
      const std::string svg = to_svg(figure);
      EXPECT_EQ(svg.find("nan"), std::string::npos) << figure.title;
      EXPECT_EQ(svg.find("inf "), std::string::npos) << figure.title;
    }
}

std::size_t letters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

// Fails if words run over the edge of the print: its 180 mm hold about 104 letters of a caption, forty of a panel's
// title.
TEST(Page, KeepsWordsWithinThePrint) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures) {
      EXPECT_LE(letters(figure.title), 75U) << figure.title;
      for (const std::string& line : figure.caption) EXPECT_LE(letters(line), 104U) << line;
      for (const Panel& panel : figure.panels) EXPECT_LE(letters(panel.title), 40U) << panel.title;
    }
}

// Fails if an axis has no unit.
TEST(Page, LabelsEveryAxisWithAUnit) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures)
      for (const Panel& panel : figure.panels)
        for (const std::string& label : {panel.x_label, panel.y_label})
          EXPECT_EQ(label.back(), ']') << figure.title << label;
}

// Fails if a table has a row that does not fit its headings.
TEST(Page, FillsItsTables) {
  for (const Section& section : sections())
    for (const Table& table : section.tables)
      for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.headings.size()) << table.title;
}

// Fails if the page does not name a figure that is written beside it.
TEST(Page, ShowsEveryFigure) {
  const std::string page = index_page(sections(), table_of_choices());
  for (const Section& section : sections())
    for (std::size_t i = 0; i < section.figures.size(); ++i)
      EXPECT_NE(page.find("src=\"" + file_of(section, i) + "\""), std::string::npos) << file_of(section, i);
}

// Fails if a figure is too large to be sent and opened with ease, however many samples it was made of.
TEST(Page, DrawsInLessThan200KB) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures) EXPECT_LT(to_svg(figure).size(), 200'000U) << figure.title;
}

// Fails if a curve that emitted code did not make is not said to be by another.
TEST(Page, LabelsWhatEmittedCodeDidNotMake) {
  const std::string page = index_page(sections(), {});
  std::size_t others = 0;
  for (const Section& section : sections())
    for (const Figure& figure : section.figures) {
      const std::string svg = to_svg(figure);
      for (const Panel& panel : figure.panels)
        for (const Curve& curve : panel.curves) {
          if (curve.maker == Maker::emitted || curve.name.empty()) continue;
          ++others;
          EXPECT_NE(svg.find(">" + curve.name + label_of(curve.maker) + "<"), std::string::npos) << curve.name;
          EXPECT_NE(page.find(std::string(label_of(curve.maker)).substr(1)), std::string::npos) << curve.name;
        }
    }
  EXPECT_GT(others, 20U);
}

// Fails if a law's author is not told from its type: by hand, emitted, emitted inside a wall by hand, evaluated.
TEST(Page, KnowsWhoWroteALaw) {
  EXPECT_EQ(law_of<laws::needle_own>().maker, Maker::emitted);
  EXPECT_EQ(law_of<WhileInside<laws::kelvin_dual>>().maker, Maker::in_wall);
  EXPECT_EQ(law_with(PrintedNeedle(1, 1, 1, 1, PrintedNeedle::Dampers::in_brake)).maker, Maker::by_hand);
  EXPECT_EQ(law_of(compiled(kelvin_element(1, 1), {})).maker, Maker::evaluated);
}

// Fails if a plot of the map cannot be read by itself: more lines than one can tell apart, or a line that its own
// legend does not name, or no word of what stable means.
TEST(Page, MakesEachPlotOfWallsReadableByItself) {
  for (const Figure& figure : sections().back().figures) {
    EXPECT_GE(figure.caption.size(), 3U) << figure.title;
    EXPECT_TRUE(std::any_of(figure.caption.begin(), figure.caption.end(), [](const std::string& line) {
      return line.find("Stable: a tool of") != std::string::npos;
    })) << figure.title;
    for (const Panel& panel : figure.panels) {
      EXPECT_LE(panel.curves.size(), 8U) << figure.title;
      for (const Curve& curve : panel.curves) EXPECT_FALSE(curve.name.empty()) << figure.title;
    }
  }
}

std::string sources_of_this_room() {
  std::stringstream all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(DASHPOT_PAPER_ROOM))
    if (const auto extension = entry.path().extension(); extension == ".cpp" || extension == ".in")
      all << std::ifstream(entry.path()).rdbuf();
  return all.str();
}

// Fails if a number is chosen that nothing uses, or one has no reason.
TEST(Chosen, HoldsWhatIsUsedWithItsReason) {
  const std::string sources = sources_of_this_room();
  const auto file = nlohmann::json::parse(std::ifstream(DASHPOT_PAPER_ROOM "/chosen.json"));
  for (const auto& [name, choice] : file.items()) {
    EXPECT_GT(choice.at("reason").get<std::string>().size(), 10U) << name;
    if (choice.contains("device")) continue;  // of the device file, which the plant is made of
    const bool is_used =
        sources.find('"' + name + '"') != std::string::npos || sources.find('@' + name + '@') != std::string::npos;
    EXPECT_TRUE(is_used) << name;
  }
}

// Fails if the device file assumes a value that the page does not list.
TEST(Chosen, ListsEveryAssumedValueOfTheRig) {
  const auto file = nlohmann::json::parse(std::ifstream(DASHPOT_PAPER_ROOM "/chosen.json"));
  for (const std::string& key : rig().assumed)
    EXPECT_TRUE(std::any_of(file.begin(), file.end(), [&](const auto& choice) {
      return choice.contains("device") && choice.at("device") == key;
    })) << key;
}

// Fails if an experiment has a number of its own: what is not from the paper's print stands in chosen.json.
TEST(Chosen, LeavesNoNumberToTheExperiments) {
  const std::regex constant("^constexpr (double|int|unsigned|std::size_t) [a-zA-Z_]+ = .*");
  for (const auto& entry : std::filesystem::directory_iterator(DASHPOT_PAPER_ROOM)) {
    const std::string name = entry.path().filename().string();
    const bool is_experiment =
        std::regex_match(name, std::regex("(fig[0-9]+|pareto|limits|z_width.*|hertz|ball|isotropic|curl)\\.cpp"));
    if (!is_experiment || name == "fig5.cpp") continue;  // a program of its own, held by Fig5.HasTheChosenRate
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const bool is_known = line.find("print") != std::string::npos || line.find(" pi ") != std::string::npos;
      EXPECT_TRUE(is_known || !std::regex_match(line, constant)) << name << ": " << line;
    }
  }
}

}  // namespace
