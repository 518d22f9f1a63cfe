#include <dashpot/board/crc16.hpp>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

// Division by the polynomial, bit by bit, as the README words it.
std::uint16_t divide(std::uint16_t before, std::uint8_t byte) {
  auto rest = static_cast<unsigned>(before ^ byte);
  for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? (rest >> 1) ^ 0x8408U : rest >> 1;
  return static_cast<std::uint16_t>(rest);
}

// A wrong polynomial, start, reflection or final value would make the board deaf to every other implementation.
TEST(Crc16, GivesTheCatalogueValue) {
  const std::uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(digits, sizeof digits), 0x906E);
  EXPECT_EQ(crc16(digits, 0), 0);
}

// A slip in the folded shifts could show for some register values only.
TEST(Crc16, FoldsTheDivisionWithoutLoss) {
  for (unsigned rest = 0; rest < 0x10000; ++rest) {
    const auto start = static_cast<std::uint16_t>(rest);
    for (const std::uint8_t byte : {std::uint8_t{0x00}, std::uint8_t{0x01}, std::uint8_t{0x80}, std::uint8_t{0xFF}})
      ASSERT_EQ(crc16_extend(start, byte), divide(start, byte)) << rest << ' ' << int{byte};
  }
}

// Fails if this computer's way through a table is another division.
TEST(Crc16, DividesWholeMessages) {
  std::uint8_t bytes[256];
  for (unsigned i = 0; i < 256; ++i) bytes[i] = static_cast<std::uint8_t>(i * 167 + (i >> 3));
  std::uint16_t rest = crc16_start;
  for (std::size_t count = 0; count < sizeof bytes; rest = divide(rest, bytes[count++]))
    ASSERT_EQ(crc16(bytes, count), static_cast<std::uint16_t>(~unsigned{rest})) << count;
}

}  // namespace
}  // namespace dashpot::board
