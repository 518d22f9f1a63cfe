// What a template needs, as strings: decisions are made before, shapes come after.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace dashpot::compiler {

using Fields = std::map<std::string, std::string>;

struct CodeModel {
  Fields fields;
  std::map<std::string, std::vector<Fields>> lists;
};

}  // namespace dashpot::compiler
