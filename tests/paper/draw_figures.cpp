// draw_figures FOLDER [--without-map]: every experiment of the paper, its figures as SVG and an index page. The map of
// walls takes minutes and goes on where it was interrupted: what is done of it is in FOLDER/z_width.csv.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "all_experiments.hpp"
#include "limits.hpp"
#include "z_width.hpp"

namespace {

using namespace dashpot::paper;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  fmt::print("  {}\n", path.string());
}

void print_progress(std::size_t done, std::size_t all) {
  fmt::print(stderr, "\r  map of walls: {} of {}{}", done, all, done == all ? "\n" : "");
}

void draw(const std::filesystem::path& folder, bool with_map) {
  std::filesystem::create_directories(folder);
  std::vector<Section> sections = all_experiments();
  sections.push_back(show(measure_limits()));
  if (with_map)
    sections.push_back(show(measure_z_width(map_places(false), (folder / "z_width.csv").string(), print_progress)));
  for (const Section& section : sections)
    for (std::size_t i = 0; i < section.figures.size(); ++i)
      write(folder / file_of(section, i), to_svg(section.figures[i]));
  write(folder / "index.html", index_page(sections, table_of_choices()));
}

}  // namespace

int main(int count, char** arguments) {
  const bool without_map = count == 3 && std::string_view(arguments[2]) == "--without-map";
  if (count != 2 && !without_map) {
    fmt::print(stderr, "usage: draw_figures FOLDER [--without-map]\n");
    return 2;
  }
  draw(arguments[1], !without_map);
}
