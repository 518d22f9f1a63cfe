#include "page.hpp"

#include <fmt/format.h>

namespace dashpot::paper {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>dashpot: the paper's experiments</title>
<style>
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #1a1a1a; max-width: 54em; margin: 2em auto; padding: 0 1em; }
h2 { margin-top: 2.5em; border-bottom: 1px solid #ccc; }
img { width: 100%; margin: 1em 0; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; }
caption { text-align: left; font-weight: bold; padding-bottom: .3em; }
th, td { border-bottom: 1px solid #ddd; padding: .2em .9em .2em 0; text-align: left; vertical-align: top; }
</style>
</head>
<body>
<h1>The paper’s experiments, by emitted code</h1>
<p>Gosline &amp; Hayward, <i>Dual-channel haptic synthesis of viscoelastic tissue properties using programmable eddy current
brakes</i>, 2009. Every curve is made by code that dashpot emitted for a network file, on a simulated device: the same plant
for the single motor and for the dual channel. A number that the paper does not print is chosen once; the list is at the end.
Nothing is tuned to a figure. Where a claim of the paper does not come out, the text below the figure says so.</p>
)";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

std::string row(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return html + "</tr>\n";
}

std::string html_of(const Table& table) {
  std::string html = fmt::format("<table>\n<caption>{}</caption>\n{}", escaped(table.title), row(table.headings, "th"));
  for (const auto& cells : table.rows) html += row(cells, "td");
  return html + "</table>\n";
}

std::string html_of(const Section& section) {
  std::string html = fmt::format("<h2 id=\"{}\">{}</h2>\n", section.name, escaped(section.title));
  for (std::size_t i = 0; i < section.figures.size(); ++i)
    html += fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>\n", file_of(section, i),
                        escaped(section.figures[i].title));
  for (const std::string& paragraph : section.words) html += fmt::format("<p>{}</p>\n", escaped(paragraph));
  for (const Table& table : section.tables) html += html_of(table);
  return html;
}

}  // namespace

std::string file_of(const Section& section, std::size_t figure) {
  return figure == 0 ? section.name + ".svg" : fmt::format("{}_{}.svg", section.name, figure + 1);
}

std::string index_page(const std::vector<Section>& sections, const Table& chosen) {
  std::string html = head;
  html += "<ul>\n";
  for (const Section& section : sections)
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.name, escaped(section.title));
  html += "<li><a href=\"#chosen\">What the paper does not print</a></li>\n</ul>\n";
  for (const Section& section : sections) html += html_of(section);
  return html + "<h2 id=\"chosen\">What the paper does not print</h2>\n" + html_of(chosen) + "</body>\n</html>\n";
}

}  // namespace dashpot::paper
