// draw_figures FOLDER: every experiment of the paper, its figures as SVG and an index page.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "chosen.hpp"
#include "fig12.hpp"
#include "fig13.hpp"
#include "fig5_section.hpp"
#include "fig6.hpp"
#include "fig7.hpp"
#include "fig8.hpp"
#include "fig9.hpp"
#include "page.hpp"
#include "z_width.hpp"

namespace {

using namespace dashpot::paper;

Table table_of_choices() {
  Table table{"Every number that is not printed, and why it is what it is", {"name", "value", "reason"}, {}};
  for (const Choice& choice : all_choices()) table.rows.push_back({choice.name, choice.value, choice.reason});
  return table;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  fmt::print("  {}\n", path.string());
}

void print_progress(std::size_t done, std::size_t all) {
  fmt::print(stderr, "\r  map of walls: {} of {}{}", done, all, done == all ? "\n" : "");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: draw_figures FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  std::vector<Section> sections;
  const auto add = [&](Section section) {
    for (std::size_t i = 0; i < section.figures.size(); ++i) write(folder / file_of(section, i), to_svg(section.figures[i]));
    sections.push_back(std::move(section));
  };
  add(show(measure_fig5()));
  add(show(measure_fig6()));
  add(show(measure_fig7()));
  add(show(measure_fig8()));
  add(show(measure_fig9()));
  add(show(measure_fig12()));
  add(show(measure_fig13()));
  add(show(measure_z_width(map_places(false), (folder / "z_width.csv").string(), print_progress)));
  write(folder / "index.html", index_page(sections, table_of_choices()));
}
