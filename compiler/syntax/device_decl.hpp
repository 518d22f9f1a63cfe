// A device file as its author wrote it: shape checked, keys of the sections and values not yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

struct EntryDecl {
  Text key;
  std::vector<ValueDecl> values;  // one, or as many as stand in the list
  bool is_list = false;
  Span span;  // of the value
};

struct SectionDecl {
  Text name;  // "loop", "encoder", …
  std::vector<EntryDecl> entries;
  Span opening;  // bracket
};

struct DeviceDecl {
  std::optional<Text> name;
  std::optional<Text> source;
  std::optional<Text> motion;
  std::optional<ValueDecl> arm_radius;
  std::vector<SectionDecl> sections;
  std::vector<Text> assumed;
  Span opening;          // bracket of the whole file
  std::string digest;    // of the file's bytes
  bool complete = true;  // false: problems were reported, so only what is here can be checked further
};

}  // namespace dashpot::compiler
