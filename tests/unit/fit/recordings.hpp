// The committed recordings, read as a user would read them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fit/read_recording.hpp"
#include "source/render.hpp"

namespace dashpot::compiler::fitting {

// Those of the networks in networks/tissues/measured/, and beside them those that only tests fit to.
inline std::string recording_path(const std::string& name) {
  const std::filesystem::path measured = std::filesystem::path(DASHPOT_MEASURED) / name;
  return (exists(measured) ? measured : std::filesystem::path(DASHPOT_FIT_RECORDINGS) / name).string();
}

// With the words of --columns and --geometry.
struct Spoken {
  std::string columns = {}, geometry = {};
  bool has_header = true, is_relaxation = false;
};

inline std::vector<Recording> recordings(const std::vector<std::string>& names, const Spoken& spoken = {}) {
  Diagnostics diagnostics;
  ReadChoices choices;
  if (!spoken.columns.empty()) choices.columns.requests = parse_columns(spoken.columns, diagnostics).value();
  if (!spoken.geometry.empty()) choices.geometry = parse_geometry(spoken.geometry, diagnostics);
  choices.has_header = spoken.has_header;
  choices.columns.is_relaxation = spoken.is_relaxation;
  std::vector<Recording> list;
  for (const std::string& name : names) {
    LineReader lines(recording_path(name), ReadProgress());
    EXPECT_TRUE(lines.open(diagnostics)) << render_text(diagnostics);
    const auto read = read_recording(lines, choices, diagnostics);
    EXPECT_TRUE(read) << render_text(diagnostics);
    if (read) list.push_back(read->recording);
  }
  return list;
}

// Of the specimen itself: 1 mm² and 1 mm make kPa to mN and strain to mm.
inline std::vector<Recording> titin() {
  return recordings({"skeletal_muscle/AvgRelaxed_0.1s.csv", "skeletal_muscle/AvgRelaxed_1s.csv",
                     "skeletal_muscle/AvgRelaxed_10s.csv", "skeletal_muscle/AvgRelaxed_100s.csv"},
                    {"time=Time:s,strain=L-0.95,stress=F:kPa", "column:area=1mm^2,length=1mm"});
}

inline std::vector<Recording> adhesive() {
  return recordings({"soft_adhesive/shear_relaxation_1.csv", "soft_adhesive/shear_relaxation_2.csv",
                     "soft_adhesive/shear_relaxation_5.csv"});
}

}  // namespace dashpot::compiler::fitting
