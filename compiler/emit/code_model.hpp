// The strings that a template fills in: decisions are made before, the template gives the shape.
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
