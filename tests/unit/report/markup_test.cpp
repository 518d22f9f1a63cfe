#include "report/markup.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "report/base64.hpp"

namespace dashpot::compiler {
namespace {

// If this fails, an author's title can close a tag, open one, or end an attribute.
TEST(Markup, LeavesNothingThatMarkupReads) {
  EXPECT_EQ(escaped("</title><b a=\"x\" c='y'>&amp;"),
            "&lt;/title&gt;&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt;&amp;amp;");
  EXPECT_EQ(escaped("Fig. 2e – µ"), "Fig. 2e – µ");
  EXPECT_EQ(escaped(std::string("a\0b\x1f\x7f", 5)), "a b  ");
}

// If this fails, a text of several lines loses its lines, or its last one.
TEST(Markup, KeepsLines) {
  EXPECT_EQ(escaped_lines("a<\nb\n"), "a&lt;\nb\n");
  EXPECT_EQ(escaped_lines("a\n\nb"), "a\n\nb\n");
}

// If this fails, a name can end the script that its data stands in, or a number is none of JSON.
TEST(Markup, LeavesNothingThatEndsAScript) {
  EXPECT_EQ(json_literal("</script><!--\"\n"), "\"\\u003c/script>\\u003c!--\\\"\\n\"");
  EXPECT_EQ(json_literal(0.1), "0.1");
  EXPECT_EQ(json_literal(std::numeric_limits<double>::quiet_NaN()), "null");
}

// If this fails, the module of a page is other bytes than those that were compiled: the examples of RFC 4648.
TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

}  // namespace
}  // namespace dashpot::compiler
