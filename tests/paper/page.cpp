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
brakes</i>, 2009. A curve whose name has nothing in brackets behind it is made by code that dashpot emitted for a network file, on
a simulated device: the same plant for the single motor and for the dual channel. What other code made says so:</p>
<ul>
<li><b>[wall by hand]</b>: an emitted law that a wall written for this page, (9) of the paper, switches on and off;</li>
<li><b>[by hand]</b>: a law written for this page from the paper’s equation;</li>
<li><b>[evaluated]</b>: the compiler’s own evaluation of a law, which gives the emitted code’s bits;</li>
<li><b>[closed form]</b>: the solution of the network’s differential equation;</li>
<li><b>[offline]</b>: computed from a record, with filters that look into the future;</li>
<li><b>[analysis]</b>: the compiler’s analysis in frequency, or its certificate;</li>
<li><b>[device]</b>, <b>[runtime]</b>: the simulated device alone, an estimator of the runtime;</li>
<li><b>[mark]</b>: a value to compare with, printed in the paper or of the rig.</li>
</ul>
<p>A number that the paper does not print is chosen once; the list is at the end. Nothing is tuned to a figure. Whether a claim of
the paper comes out is decided by the program that writes this page, from the numbers that it draws. What begins with “Beyond the paper” is not in it: one axis that stiffens, and two axes.</p>
)";

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
