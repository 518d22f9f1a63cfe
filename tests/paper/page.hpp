// What an experiment shows: figures, tables, and what is to be said of them. index_page() puts all of them on one page.
#pragma once

#include <string>
#include <vector>

#include "figure.hpp"

namespace dashpot::paper {

struct Table {
  std::string title;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  // each as long as the headings
};

struct Section {
  std::string name;  // of its files: "fig6"
  std::string title;
  std::vector<std::string> words;  // paragraphs
  std::vector<Figure> figures;     // name.svg, name_2.svg, …
  std::vector<Table> tables;
};

// Name of the file of a section's figure.
std::string file_of(const Section& section, std::size_t figure);

// The whole page, with the figures beside it.
std::string index_page(const std::vector<Section>& sections, const Table& chosen);

}  // namespace dashpot::paper
