#include "emitted_headers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace dashpot::testing {
namespace fs = std::filesystem;

namespace {

bool is_linear(const fs::path& file) {
  const std::string text = text_of(file);
  return text.find("\"slip\"") == text.npos && text.find("\"contact\"") == text.npos;
}

}  // namespace

std::string parallel_branches(const std::string& name, int count) {
  std::string branches;
  for (int i = 1; i <= count; ++i)
    branches +=
        fmt::format(",\n  {{ \"series\": [ {{ \"damper\": {} }}, {{ \"spring\": {} }} ] }}", 100.0 / (i + 10), i);
  return fmt::format(
      "{{ \"dashpot\": 1, \"name\": \"{}\", \"network\": {{ \"parallel\": [ {{ \"spring\": 7 }}{} ] }} }}\n", name,
      branches);
}

std::vector<std::string> network_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const char* room : {DASHPOT_NETWORKS "/paper", DASHPOT_NETWORKS "/tissues", DASHPOT_CORNER_CASES})
    for (const auto& entry : fs::directory_iterator(room))
      if (entry.path().extension() == ".json" && is_linear(entry.path())) files.push_back(entry.path().string());
  for (const int count : {16, 17, 1000}) {
    const std::string name = fmt::format("branches_{}", count);
    write_text(folder / (name + ".json"), parallel_branches(name, count));
    files.push_back((folder / (name + ".json")).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

EmittedFolder emit_headers(const fs::path& folder, const std::vector<std::string>& files, const std::string& choices) {
  std::string line = fmt::format("'{}' compile {} -o '{}'", DASHPOT_EXECUTABLE, choices, folder.string());
  EmittedFolder emitted{folder, {}};
  for (const std::string& file : files) {
    line += fmt::format(" '{}'", file);
    emitted.classes.push_back(fs::path(file).stem().string());
  }
  const Finished finished = run_command(line);
  EXPECT_EQ(finished.status, 0) << finished.output;
  return emitted;
}

std::string caller_of(const EmittedFolder& emitted) {
  std::string text;
  for (const std::string& name : emitted.classes) text += fmt::format("#include \"{}.hpp\"\n", name);
  text +=
      "#define CALL(name)                                                                       \\\n"
      "  dashpot::generated::name name##_model;                                                 \\\n"
      "  using name##_number = dashpot::generated::name::scalar;                                \\\n"
      "  void name##_reset(name##_number p) { name##_model.reset(p); }                          \\\n"
      "  dashpot::command<name##_number> name##_output(name##_number p, name##_number v) {      \\\n"
      "    return name##_model.output(p, v);                                                    \\\n"
      "  }                                                                                      \\\n"
      "  void name##_update() { name##_model.update(); }                                        \\\n"
      "  dashpot::command<name##_number> name##_step(name##_number p, name##_number v) {        \\\n"
      "    return name##_model.step(p, v);                                                      \\\n"
      "  }                                                                                      \\\n"
      "  unsigned name##_set(const dashpot::generated::name::parameters& new_values) {          \\\n"
      "    return name##_model.set(new_values);                                                 \\\n"
      "  }                                                                                      \\\n"
      "  name##_number name##_energy() { return name##_model.stored_energy(); }\n";
  for (const std::string& name : emitted.classes) text += fmt::format("CALL({})\n", name);
  return text;
}

std::string runtime_include() { return "-I'" DASHPOT_RUNTIME_INCLUDE "'"; }

}  // namespace dashpot::testing
