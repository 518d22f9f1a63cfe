#include "source/render.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dashpot::compiler {
namespace {

// If this fails, the underline does not stand under what it speaks of.
TEST(RenderText, UnderlinesTheText) {
  const SourceFile file("n.json", "one\n\tµ: \"−5 N\"\n");
  Diagnostics diagnostics;
  const std::size_t begin = file.text().find('"');
  diagnostics.report<DiagnosticCode::unknown_unit>({&file, begin, begin + std::string("\"−5 N\"").size()}, "x");
  EXPECT_EQ(render_text(diagnostics),
            "n.json:2:6: error: unknown unit 'x' [unknown-unit]\n"
            "    2 |  µ: \"−5 N\"\n"
            "      |     ^~~~~~\n");
}

// If this fails, a place of several lines underlines beyond the first, or an empty place shows nothing.
TEST(RenderText, ShowsTheFirstLineOfALongPlace) {
  const SourceFile file("n.json", "{\n  \"a\":\n 1}");
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unknown_unit>({&file, 4, file.text().size()}, "x");
  diagnostics.report<DiagnosticCode::unknown_unit>({&file, 12, 12}, "y");
  EXPECT_EQ(render_text(diagnostics),
            "n.json:2:3: error: unknown unit 'x' [unknown-unit]\n"
            "    2 |   \"a\":\n"
            "      |   ^~~~\n"
            "n.json:3:4: error: unknown unit 'y' [unknown-unit]\n"
            "    3 |  1}\n"
            "      |    ^\n");
}

// If this fails, what is missing behind a long last line cannot be shown.
TEST(RenderText, ShowsTheEndOfALongLine) {
  const SourceFile file("n.json", std::string(200, 'x'));
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unknown_unit>({&file, 200, 200}, "y");
  const std::string text = render_text(diagnostics);
  EXPECT_TRUE(text.ends_with("x\n      | " + std::string(text.rfind('x') - text.find("…") - 1, ' ') + "^\n")) << text;
}

// If this fails, a name in a file can command the reader's terminal.
TEST(RenderText, ShowsNoControlCharacters) {
  const SourceFile file("n\x1b.json", "\x1b[31m\x7F\xFF\n");
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unknown_unit>({&file, 0, 1}, "\x1b[2J");
  EXPECT_EQ(render_text(diagnostics),
            "n .json:1:1: error: unknown unit ' [2J' [unknown-unit]\n"
            "    1 |  [31m ?\n"
            "      | ^\n");
}

Diagnostics two_files(const SourceFile& first, const SourceFile& second) {
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unknown_unit>({&first, 5, 6}, "late");
  diagnostics.report<DiagnosticCode::unknown_unit>({&second, 0, 1}, "other file");
  diagnostics.report<DiagnosticCode::unused_parameter>({&first, 1, 3}, "early");
  diagnostics.note<DiagnosticCode::given_here>({&first, 4, 6});
  diagnostics.note<DiagnosticCode::write_instead>({}, "this");
  diagnostics.report<DiagnosticCode::cannot_read_file>({}, "c.json", "gone");
  return diagnostics;
}

// If this fails, messages come in the order in which the compiler happened to find them.
TEST(RenderText, FollowsTheFiles) {
  const SourceFile first("a.json", "0123456789"), second("b.json", "x");
  EXPECT_EQ(render_text(two_files(first, second)),
            "error: cannot read 'c.json': gone [cannot-read-file]\n"
            "a.json:1:2: warning: parameter 'early' is not used [unused-parameter]\n"
            "    1 | 0123456789\n"
            "      |  ^~\n"
            "a.json:1:5: note: given here\n"
            "    1 | 0123456789\n"
            "      |     ^~\n"
            "note: write 'this'\n"
            "a.json:1:6: error: unknown unit 'late' [unknown-unit]\n"
            "    1 | 0123456789\n"
            "      |      ^\n"
            "b.json:1:1: error: unknown unit 'other file' [unknown-unit]\n"
            "    1 | x\n"
            "      | ^\n");
}

// If this fails, editors that read the diagnostics as data lose a field, a place or the order.
TEST(RenderJson, SaysTheSame) {
  const SourceFile first("a.json", "0123456789"), second("b.json", "x");
  const auto list = nlohmann::json::parse(render_json(two_files(first, second)));
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0], nlohmann::json::parse(R"({"file": null, "line": null, "column": null, "end_line": null,
      "end_column": null, "severity": "error", "code": "cannot-read-file",
      "message": "cannot read 'c.json': gone", "notes": []})"));
  EXPECT_EQ(list[1], nlohmann::json::parse(R"({"file": "a.json", "line": 1, "column": 2, "end_line": 1, "end_column": 4,
      "severity": "warning", "code": "unused-parameter", "message": "parameter 'early' is not used", "notes": [
        {"file": "a.json", "line": 1, "column": 5, "end_line": 1, "end_column": 7, "message": "given here"},
        {"file": null, "line": null, "column": null, "end_line": null, "end_column": null, "message": "write 'this'"}]})"));
  EXPECT_EQ(list[2]["message"], "unknown unit 'late'");
  EXPECT_EQ(list[3]["file"], "b.json");
}

// If this fails, a stray byte in a file makes the output no JSON, or ends the compiler.
TEST(RenderJson, SurvivesStrayBytes) {
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unknown_unit>({}, "\xFF\x1b");
  EXPECT_EQ(nlohmann::json::parse(render_json(diagnostics))[0]["message"], "unknown unit '\xEF\xBF\xBD\x1b'");
  EXPECT_EQ(nlohmann::json::parse(render_json(Diagnostics())), nlohmann::json::array());
}

// If this fails, success is reported for input that was refused, or failure for a warning.
TEST(Diagnostics, CountErrorsOnly) {
  Diagnostics diagnostics;
  diagnostics.report<DiagnosticCode::unused_parameter>({}, "K");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.report<DiagnosticCode::unknown_unit>({}, "x");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

}  // namespace
}  // namespace dashpot::compiler
