// Whether a section of the page says something.
#pragma once

#include <algorithm>

#include "page.hpp"

namespace dashpot::paper {

inline bool says(const Section& section, const std::string& words) {
  return std::any_of(section.words.begin(), section.words.end(),
                     [&](const std::string& paragraph) { return paragraph.find(words) != std::string::npos; });
}

}  // namespace dashpot::paper
