#include "report/number_text.hpp"

#include <gtest/gtest.h>

namespace dashpot::compiler {
namespace {

// If this fails, a reader sees digits that are not there, or misses some.
TEST(NumberText, HasTheDigitsThatCount) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(12), "12");
  EXPECT_EQ(number_text(-0.5), "−0.5");
  EXPECT_EQ(number_text(1.66666667), "1.667");
  EXPECT_EQ(number_text(12345.6), "12346");
  EXPECT_EQ(number_text(99999.9), "10⁵");
  EXPECT_EQ(number_text(0.001), "0.001");
  EXPECT_EQ(number_text(1.5e-7), "1.5×10⁻⁷");
  EXPECT_EQ(number_text(-1e12), "−10¹²");
  EXPECT_EQ(number_text(0.123456789, 6), "0.123457");
}

// If this fails, MathML shows a power of ten as a product of letters.
TEST(NumberText, IsAPowerInMathML) {
  EXPECT_EQ(number_mathml(2.4), "<mn>2.4</mn>");
  EXPECT_EQ(number_mathml(2e-9),
            "<mrow><mn>2</mn><mo>×</mo><msup><mn>10</mn><mrow><mo>−</mo><mn>9</mn></mrow></msup></mrow>");
}

// If this fails, an element is labelled with another unit than its author's motion has.
TEST(NumberText, LabelsAnElement) {
  Element element{"B", Damper{0.0005}, tool, ground, {}, {}};
  EXPECT_EQ(value_text(element, motion::rotation), "5×10⁻⁴ N·m·s/rad");
  element.law = Slip{2};
  EXPECT_EQ(value_text(element, motion::translation), "2 N");
}

// Fails if a sentence keeps more digits than a reader wants, or if a whole number, a name or a file is taken for one.
TEST(NumberText, SentencesInFourDigits) {
  EXPECT_EQ(in_four_digits("needs 0.0139549 N s/m, most at 26.9358 Hz"), "needs 0.01395 N s/m, most at 26.94 Hz");
  EXPECT_EQ(in_four_digits("noise 8.11e-07 N where here it is 2.5E3"), "noise 8.11×10⁻⁷ N where here it is 2.5E3");
  EXPECT_EQ(in_four_digits("of 10000 Hz, §5.1 of 2009, K1.25 and v1.23456.txt"),
            "of 10000 Hz, §5.1 of 2009, K1.25 and v1.23456.txt");
  EXPECT_EQ(in_four_digits("6.68 % in the band."), "6.68 % in the band.");
  EXPECT_EQ(in_four_digits("b is 5. Then 1.00000 more"), "b is 5. Then 1 more");
  EXPECT_EQ(in_four_digits("-0.123456"), "-0.1235");
}

}  // namespace
}  // namespace dashpot::compiler
