// Every cases/<what_is_bad>.json is compiled as far as the front end goes, and what is said about it is compared with
// <what_is_bad>.txt beside it; cases/devices/ holds device files. `diagnostics_test --update` records the texts anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "network/axes_device.hpp"
#include "network/axes_network.hpp"
#include "network/device.hpp"
#include "network/network.hpp"
#include "source/code_name.hpp"
#include "source/render.hpp"
#include "syntax/parse_axes.hpp"
#include "syntax/parse_device.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

bool update = false;

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(DASHPOT_DIAGNOSTIC_CASES))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_device_case(const fs::path& file) { return file.parent_path().filename() == "devices"; }

void compile_network(const SourceFile& source, Diagnostics& diagnostics) {
  if (axes_of(source) > 1) {
    if (const auto decl = parse_axes_network(source, diagnostics)) build_axes_network(*decl, diagnostics);
    return;
  }
  if (const auto decl = parse_network(source, diagnostics)) build_network(*decl, diagnostics);
}

void compile_device(const SourceFile& source, Diagnostics& diagnostics) {
  if (axes_of(source) > 1) {
    if (const auto decl = parse_axes_device(source, diagnostics)) build_axes_device(*decl, diagnostics);
    return;
  }
  if (const auto decl = parse_device(source, diagnostics)) build_device(*decl, diagnostics);
}

std::string rendering_of(const fs::path& file) {
  const SourceFile source(file.filename().string(), read_file(file));
  Diagnostics diagnostics;
  is_device_case(file) ? compile_device(source, diagnostics) : compile_network(source, diagnostics);
  return render_text(diagnostics);
}

fs::path expectation_of(fs::path file) { return file.replace_extension(".txt"); }

class DiagnosticCase : public testing::Test {
 public:
  explicit DiagnosticCase(fs::path file) : file_(std::move(file)) {}

  // If this fails, an author's mistake is reported in other words, at another place, or not at all.
  void TestBody() override {
    const std::string rendering = rendering_of(file_);
    if (update) std::ofstream(expectation_of(file_), std::ios::binary) << rendering;
    EXPECT_FALSE(rendering.empty()) << "nothing is wrong with this file";
    EXPECT_EQ(rendering, read_file(expectation_of(file_)));
  }

 private:
  fs::path file_;
};

std::string all_expectations() {
  std::string text;
  for (const fs::path& file : case_files()) text += read_file(expectation_of(file));
  return text;
}

// The parts of a message between its placeholders, with the braces that stand for themselves.
std::vector<std::string> fixed_parts(std::string_view text) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool doubled = i + 1 < text.size() && text[i] == text[i + 1] && (text[i] == '{' || text[i] == '}');
    if (text[i] == '{' && !doubled) {
      i = text.find('}', i);
      parts.emplace_back();
    } else {
      parts.back() += text[i];
      i += doubled ? 1 : 0;
    }
  }
  return parts;
}

bool is_made_from(std::string_view line, const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    at = line.find(part, at);
    if (at == std::string_view::npos) return false;
    at += part.size();
  }
  return true;
}

// Errors and warnings end with their code; of a note there is nothing but its text.
bool is_provoked(std::size_t code, const std::vector<std::string>& lines) {
  const std::string end = " [" + code_name(static_cast<DiagnosticCode>(code)) + "]";
  const std::vector<std::string> parts = fixed_parts(message_templates[code].text);
  const bool is_note = message_templates[code].severity == Severity::note;
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return is_note ? line.find("note: ") != std::string::npos && is_made_from(line, parts) : line.ends_with(end);
  });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char byte : text)
    if (byte == '\n') lines.emplace_back();
    else lines.back() += byte;
  return lines;
}

// If this fails, a message of the front end has no case that provokes it, and nobody has read it in place. The messages
// about whole files and limits of size are provoked by the unit tests, those of commands that take one axis alone by
// the tests of the command line.
TEST(Diagnostics, EveryMessageOfTheFrontEndHasACase) {
  const std::set<DiagnosticCode> provoked_elsewhere = {DiagnosticCode::too_many_values,
                                                       DiagnosticCode::too_many_elements, DiagnosticCode::several_axes,
                                                       DiagnosticCode::device_of_several_axes};
  const std::vector<std::string> lines = lines_of(all_expectations());
  const auto first = static_cast<std::size_t>(DiagnosticCode::unexpected_token);
  const auto last = static_cast<std::size_t>(DiagnosticCode::assumed_not_given);
  for (std::size_t i = first; i <= last; ++i) {
    if (provoked_elsewhere.count(static_cast<DiagnosticCode>(i)) > 0) continue;
    EXPECT_TRUE(is_provoked(i, lines)) << message_templates[i].name;
  }
}

// If this fails, an expectation has lost its case, and reads as if the compiler still said it.
TEST(Diagnostics, EveryExpectationHasACase) {
  for (const auto& entry : fs::recursive_directory_iterator(DASHPOT_DIAGNOSTIC_CASES)) {
    fs::path file = entry.path();
    if (file.extension() != ".txt") continue;
    EXPECT_TRUE(fs::exists(file.replace_extension(".json"))) << entry.path();
  }
}

void register_cases() {
  for (const fs::path& file : case_files()) {
    const std::string suite = is_device_case(file) ? "DeviceCase" : "NetworkCase";
    testing::RegisterTest(suite.c_str(), file.stem().c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [file]() -> DiagnosticCase* { return new DiagnosticCase(file); });
  }
}

}  // namespace
}  // namespace dashpot::compiler

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  dashpot::compiler::update = count > 1 && std::string_view(arguments[1]) == "--update";
  dashpot::compiler::register_cases();
  return RUN_ALL_TESTS();
}
