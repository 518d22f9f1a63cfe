// What pages of one axis and of two are made of alike.
#pragma once

#include <string>
#include <vector>

#include "emit/template_text.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// Of what a reader looks for first: `channel` is "brake", "motor" or nothing.
Fields fact(const std::string& label, const std::string& value, const std::string& unit, const char* channel = "");

// The text of a file of report/ that is built into the compiler; nothing, reported, where there is none.
std::string built_in(const char* name, Diagnostics& diagnostics);

// What the author remarks, with the name or the place in the file that it stands at.
void add_comments(const std::vector<Comment>& comments, CodeModel& model);

// A line of a certificate as a sentence below the heading.
std::string sentence(std::string line);

}  // namespace dashpot::compiler
