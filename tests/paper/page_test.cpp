#include "page.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "all_experiments.hpp"
#include "z_width.hpp"

namespace {

using namespace dashpot::paper;

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> sections = all_experiments();
    sections.push_back(show(ZWidth{map_places(true), std::vector<MapPoint>(map_places(true).size(), {100, 10, 0, 6})}));
    return sections;
  }();
  return all;
}

// Fails if a figure shows a number that is none.
TEST(Page, draws_numbers_only) {
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
TEST(Page, keeps_words_within_the_print) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures) {
      EXPECT_LE(letters(figure.title), 75U) << figure.title;
      for (const std::string& line : figure.caption) EXPECT_LE(letters(line), 104U) << line;
      for (const Panel& panel : figure.panels) EXPECT_LE(letters(panel.title), 40U) << panel.title;
    }
}

// Fails if an axis has no unit.
TEST(Page, labels_every_axis_with_a_unit) {
  for (const Section& section : sections())
    for (const Figure& figure : section.figures)
      for (const Panel& panel : figure.panels)
        for (const std::string& label : {panel.x_label, panel.y_label})
          EXPECT_EQ(label.back(), ']') << figure.title << label;
}

// Fails if a table has a row that does not fit its headings.
TEST(Page, fills_its_tables) {
  for (const Section& section : sections())
    for (const Table& table : section.tables)
      for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.headings.size()) << table.title;
}

// Fails if the page does not name a figure that is written beside it.
TEST(Page, shows_every_figure) {
  const std::string page = index_page(sections(), table_of_choices());
  for (const Section& section : sections())
    for (std::size_t i = 0; i < section.figures.size(); ++i)
      EXPECT_NE(page.find("src=\"" + file_of(section, i) + "\""), std::string::npos) << file_of(section, i);
}

std::string sources_of_this_room() {
  std::stringstream all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(DASHPOT_PAPER_ROOM))
    if (const auto extension = entry.path().extension(); extension == ".cpp" || extension == ".in")
      all << std::ifstream(entry.path()).rdbuf();
  return all.str();
}

// Fails if a number is chosen that nothing uses, or one has no reason.
TEST(Chosen, holds_what_is_used_with_its_reason) {
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

}  // namespace
