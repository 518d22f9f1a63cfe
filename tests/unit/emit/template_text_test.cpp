#include "emit/template_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "source/render.hpp"
#include "support/shell_command.hpp"

namespace dashpot::compiler {
namespace {

struct Filled {
  std::optional<std::string> text;
  std::string messages;
};

Filled filled(const std::string& shape, const CodeModel& model) {
  const SourceFile file("shape.in", shape);
  Diagnostics diagnostics;
  std::optional<std::string> text = fill(file, model, diagnostics);
  return {std::move(text), render_text(diagnostics)};
}

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

// Fails if a field is not put where its name stands, as often as it stands there.
TEST(TemplateText, PutsFieldsInTheirPlaces) {
  EXPECT_EQ(filled("a {{x}} b {{x}}{{y}}\n", {{{"x", "1"}, {"y", "2"}}, {}}).text, "a 1 b 12\n");
}

// Fails if the lines of a list are not repeated for each entry, in order, or leave lines of their own behind.
TEST(TemplateText, RepeatsABlockForEveryEntry) {
  CodeModel model;
  model.fields["x"] = "file";
  model.lists["points"] = {{{"n", "1"}}, {{"n", "2"}}};
  EXPECT_EQ(filled("begin\n  {{#points}}\n  p{{n}} of {{x}}\n{{/points}}\nend\n", model).text,
            "begin\n  p1 of file\n  p2 of file\nend\n");
}

// Fails if an empty list leaves anything.
TEST(TemplateText, LeavesNothingOfAnEmptyList) {
  EXPECT_EQ(filled("a\n{{#none}}\n  {{n}}\n{{/none}}\nb\n", {{}, {{"none", {}}}}).text, "a\nb\n");
}

// Fails if the file's field shadows the entry's of the same name.
TEST(TemplateText, TakesAnEntrysFieldBeforeTheFiles) {
  EXPECT_EQ(filled("{{x}}\n{{#l}}\n{{x}}\n{{/l}}\n", {{{"x", "file"}}, {{"l", {{{"x", "entry"}}}}}}).text,
            "file\nentry\n");
}

// Fails if what a field holds is itself taken for a template: networks are the user's, and may hold braces.
TEST(TemplateText, DoesNotReadWhatItHasFilledIn) {
  EXPECT_EQ(filled("{{x}}\n", {{{"x", "{{y}} {{#l}}"}}, {}}).text, "{{y}} {{#l}}\n");
}

// Fails if a last line without an end is lost.
TEST(TemplateText, KeepsALastLineWithoutEnd) {
  EXPECT_EQ(filled("a\n{{x}}", {{{"x", "b"}}, {}}).text, "a\nb");
  EXPECT_EQ(filled("", {}).text, "");
}

// Fails if an empty field leaves blanks at the end of a line.
TEST(TemplateText, LeavesNoBlanksAtTheEndOfALine) {
  EXPECT_EQ(filled("a {{x}}\n  {{x}}\n\n  b\n", {{{"x", ""}}, {}}).text, "a\n\n\n  b\n");
}

// Fails if a misspelt placeholder is passed over, or not shown in its place.
TEST(TemplateText, RefusesAnUnknownPlaceholder) {
  const Filled result = filled("one\n  two {{wrong}}\n", {});
  EXPECT_FALSE(result.text);
  EXPECT_TRUE(has_part(result.messages, "shape.in:2:7: error: unknown placeholder 'wrong'")) << result.messages;
}

// Fails if a misspelt list, or one that is not closed, is passed over.
TEST(TemplateText, RefusesAnUnknownOrOpenList) {
  const Filled unknown = filled("{{#wrong}}\n{{/wrong}}\n", {});
  EXPECT_FALSE(unknown.text);
  EXPECT_TRUE(has_part(unknown.messages, "shape.in:1:1: error: unknown placeholder 'wrong'")) << unknown.messages;
  EXPECT_FALSE(filled("{{#l}}\nx\n", {{}, {{"l", {{}, {}}}}}).text);
}

// Fails if braces that never close swallow the rest of the file.
TEST(TemplateText, RefusesAnOpenPlaceholder) {
  const Filled result = filled("a {{x\nb }}\n", {{{"x", "1"}}, {}});
  EXPECT_FALSE(result.text);
  EXPECT_TRUE(has_part(result.messages, "shape.in:1:3: error: unknown placeholder")) << result.messages;
}

// Fails if a template that drops a field or a list is accepted: a banner without its facts, a class without its states.
TEST(TemplateText, RefusesToLeaveAFieldOrListOut) {
  const Filled result = filled("{{x}}\n", {{{"x", "1"}, {"digest", "2"}}, {{"states", {}}}});
  EXPECT_FALSE(result.text);
  EXPECT_TRUE(has_part(result.messages, "placeholder 'digest' is not used")) << result.messages;
  EXPECT_TRUE(has_part(result.messages, "placeholder 'states' is not used")) << result.messages;
}

// Fails if all that is wrong is not told at once.
TEST(TemplateText, TellsEverythingThatIsWrong) {
  const Filled result = filled("{{a}}\n{{b}}\n", {{{"c", ""}}, {}});
  for (const char* name : {"'a'", "'b'", "'c'"}) EXPECT_TRUE(has_part(result.messages, name)) << result.messages;
}

// Fails if the built-in templates are not those of the folder templates/, byte for byte.
TEST(Templates, AreBuiltIn) {
  for (const auto& entry : std::filesystem::directory_iterator(DASHPOT_TEMPLATES)) {
    if (entry.path().extension() != ".in") continue;
    Diagnostics diagnostics;
    const auto found = find_template(entry.path().filename().string(), std::nullopt, diagnostics);
    ASSERT_TRUE(found) << entry.path();
    EXPECT_EQ(found->text(), testing::text_of(entry.path()));
  }
}

// Fails if a folder of one's own is not taken in place of the built-in templates, or if its lack of one is not told.
TEST(Templates, MayComeFromAFolder) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder.path() / "network.hpp.in", "mine\n");
  Diagnostics diagnostics;
  EXPECT_EQ(find_template("network.hpp.in", folder.path().string(), diagnostics)->text(), "mine\n");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_FALSE(find_template("network_test.cpp.in", folder.path().string(), diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace dashpot::compiler
