#include "syntax/json.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "source/render.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

std::string slice(const Span& span) { return span.file->text().substr(span.begin, span.end - span.begin); }

// Writes a random value, noting every token in the order in which it is written.
class RandomJson {
 public:
  explicit RandomJson(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    if (random_.chance(0.2)) out_ = "\xEF\xBB\xBF";
    value(4);
    blanks();
    return out_;
  }

  std::vector<std::string> scalars_and_keys() const { return tokens_; }

 private:
  void blanks() {
    while (random_.chance(0.3)) out_ += " \t\r\n"[random_.index(4)];
  }

  void token(const std::string& text) {
    blanks();
    out_ += text;
    tokens_.push_back(text);
  }

  void value(int depth) {
    const std::size_t choice = random_.index(depth > 0 ? 6 : 4);
    if (choice == 0) return token(random_.chance(0.5) ? "null" : random_.chance(0.5) ? "true" : "false");
    if (choice == 1) return token(number());
    if (choice <= 3) return token(string());
    if (choice == 4) return list(depth);
    object(depth);
  }

  std::string number() {
    static const char* const numbers[] = {"0",   "-0",   "12",      "-3.50",
                                          "1e5", "1E-7", "0.25e+2", "123456789012345678901234567890"};
    return numbers[random_.index(std::size(numbers))];
  }

  std::string string() {
    static const char* const pieces[] = {"a", "µ", "\\\"", "\\\\", "\\u00e9", "\\ud83d\\ude00", "[", "}",
                                         ",", ":", "\\n",  "/",    "😀"};
    std::string text = "\"";
    for (std::size_t length = random_.index(6); length > 0; --length) text += pieces[random_.index(std::size(pieces))];
    return text + "\"";
  }

  void list(int depth) {
    blanks();
    out_ += '[';
    for (std::size_t i = 0, count = random_.index(4); i < count; ++i) {
      if (i > 0) separator(',');
      value(depth - 1);
    }
    blanks();
    out_ += ']';
  }

  void object(int depth) {
    blanks();
    out_ += '{';
    for (std::size_t i = 0, count = random_.index(4); i < count; ++i) {
      if (i > 0) separator(',');
      token(fmt::format("\"k{}{}\"", i, random_.chance(0.5) ? "\\\"\\u0041" : ""));
      separator(':');
      value(depth - 1);
    }
    blanks();
    out_ += '}';
  }

  void separator(char byte) {
    blanks();
    out_ += byte;
  }

  testing::Random random_;
  std::string out_;
  std::vector<std::string> tokens_;
};

std::string decoded(const Span& span) { return nlohmann::json::parse(slice(span)).get<std::string>(); }

void expect_own_text(const JsonValue& value) {
  const std::string text = slice(value.span);
  switch (value.kind) {
    case Kind::null: EXPECT_EQ(text, "null"); break;
    case Kind::boolean:
    case Kind::number: EXPECT_EQ(text, value.text); break;
    case Kind::string: EXPECT_EQ(decoded(value.span), value.text); break;
    case Kind::array: EXPECT_EQ(std::string({text.front(), text.back()}), "[]"); break;
    case Kind::object: EXPECT_EQ(std::string({text.front(), text.back()}), "{}"); break;
  }
}

void collect(const JsonValue& value, std::vector<std::string>& tokens) {
  expect_own_text(value);
  if (value.kind != Kind::array && value.kind != Kind::object) tokens.push_back(slice(value.span));
  for (const JsonValue& item : value.items) collect(item, tokens);
  for (const JsonMember& member : value.members) {
    EXPECT_EQ(decoded(member.key_span), member.key);
    tokens.push_back(slice(member.key_span));
    collect(member.value, tokens);
  }
}

// If this fails, messages underline something else than what they speak of.
TEST(Json, EveryPlaceGivesBackItsToken) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomJson json(seed);
    const SourceFile file("random.json", json.text());
    Diagnostics diagnostics;
    const auto root = parse_json(file, diagnostics);
    ASSERT_TRUE(root) << "seed " << seed << "\n" << file.text() << render_text(diagnostics);
    std::vector<std::string> tokens;
    collect(*root, tokens);
    EXPECT_EQ(tokens, json.scalars_and_keys()) << "seed " << seed << "\n" << file.text();
  }
}

std::string mutated(std::string text, testing::Random& random) {
  constexpr std::string_view bytes = "{}[],:\"\\ue0-+. \n\t/'\x80\xC3";
  for (std::size_t count = random.between(1, 3); count > 0 && !text.empty(); --count) {
    const std::size_t at = random.index(text.size());
    if (random.chance(0.4)) text.erase(at, random.between(1, 4));
    else if (random.chance(0.5)) text[at] = bytes[random.index(bytes.size())];
    else text.insert(at, 1, bytes[random.index(bytes.size())]);
  }
  return text;
}

bool lies_inside(const Span& span, const SourceFile& file) {
  return span.file == &file && span.begin <= span.end && span.end <= file.text().size();
}

// Equal keys are faults of the file, not of its form.
std::vector<Diagnostic> faults_of_json(const Diagnostics& diagnostics) {
  std::vector<Diagnostic> faults = diagnostics.in_file_order();
  std::erase_if(faults, [](const Diagnostic& fault) { return fault.code == DiagnosticCode::duplicate_key; });
  return faults;
}

// If this fails, a broken text is accepted, a good one refused, or a refusal comes without an explanation in place.
TEST(Json, IsRefusedExactlyWhereItIsNotJson) {
  testing::Random random(11);
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    const SourceFile file("mutated.json", mutated(RandomJson(seed % 500).text(), random));
    Diagnostics diagnostics;
    const auto root = parse_json(file, diagnostics);
    ASSERT_EQ(root.has_value(), nlohmann::json::accept(file.text())) << file.text() << render_text(diagnostics);
    if (root) continue;
    const std::vector<Diagnostic> faults = faults_of_json(diagnostics);
    ASSERT_EQ(faults.size(), 1u) << file.text() << render_text(diagnostics);
    ASSERT_TRUE(lies_inside(faults.front().span, file)) << file.text();
  }
}

// If this fails, the second of two equal keys wins in silence.
TEST(Json, OfEqualKeysTheFirstStays) {
  const SourceFile file("a.json", R"({"a": 1, "b": 2, "\u0061": 3})");
  Diagnostics diagnostics;
  const auto root = parse_json(file, diagnostics);
  ASSERT_TRUE(root);
  ASSERT_EQ(root->members.size(), 2u);
  EXPECT_EQ(root->members[0].value.text, "1");
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

// If this fails, what stands behind a repeated key is lost or taken for another.
TEST(Json, OfManyEqualKeysTheFirstStays) {
  const SourceFile file("a.json",
                        R"({"a": 1, "bb": 2, "a": 3, "ccc": 4, "bb": 5, "dddd": 6, "a": 7, "ccc": 8, "e": 9})");
  Diagnostics diagnostics;
  const auto root = parse_json(file, diagnostics);
  ASSERT_TRUE(root);
  std::string found;
  for (const JsonMember& member : root->members) found += member.key + member.value.text + " ";
  EXPECT_EQ(found, "a1 bb2 ccc4 dddd6 e9 ");
  EXPECT_EQ(diagnostics.error_count(), 4u);
}

// If this fails, a nested file can exhaust the stack, or an honest one is refused.
TEST(Json, IsReadToAHundredLevels) {
  for (const std::size_t levels : {100u, 101u, 1000000u}) {
    const SourceFile file("deep.json", std::string(levels, '[') + std::string(levels, ']'));
    Diagnostics diagnostics;
    EXPECT_EQ(parse_json(file, diagnostics).has_value(), levels == 100) << levels;
  }
}

}  // namespace
}  // namespace dashpot::compiler
