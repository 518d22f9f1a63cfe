// One reader a format. Each returns every series of the file, with the material that it belongs to.
#pragma once

#include <string>
#include <vector>

#include "exchange/prony_format.hpp"

namespace dashpot::compiler {

struct MaterialSeries {
  std::string material;  // its name or number; may be empty
  PronySeries series;
  Span span;  // where it begins
};

// What cannot be read is reported and left out.
std::vector<MaterialSeries> read_abaqus(const SourceFile& file, Diagnostics& diagnostics);
std::vector<MaterialSeries> read_ansys(const SourceFile& file, Diagnostics& diagnostics);
std::vector<MaterialSeries> read_febio(const SourceFile& file, Diagnostics& diagnostics);
std::vector<MaterialSeries> read_ls_dyna(const SourceFile& file, Diagnostics& diagnostics);
std::vector<MaterialSeries> read_table(const SourceFile& file, PronyOf of, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
