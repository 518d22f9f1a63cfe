// CRC-16/IBM-SDLC (X.25, HDLC): polynomial x¹⁶ + x¹² + x⁵ + 1 (0x1021), start 0xFFFF, least significant bit first in
// and out (so the shift register holds it as 0x8408), inverted at the end. The nine bytes "123456789" give 0x906E.
//
// Up to 32,751 bits it detects every error of one, two or three bits (Koopman & Chakravarty 2004, 0x8810 in their
// notation) and every burst within 16 bits. The burst is counted in the order of division, least significant bit first:
// a UART sends in that order, which is why this CRC and not one of its unreflected relatives.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dashpot::board {

inline constexpr std::uint16_t crc16_start = 0xFFFF;

// One byte more: the eight steps of polynomial division folded into shifts, so that no table takes flash.
constexpr std::uint16_t crc16_extend(std::uint16_t rest, std::uint8_t byte) noexcept {
  unsigned mixed = (unsigned{rest} ^ byte) & 0xFFU;
  mixed ^= (mixed << 4) & 0xFFU;
  return static_cast<std::uint16_t>((unsigned{rest} >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
}

// What the steps make of each byte alone. On a computer 512 bytes cost less than the shifts, on a board they do not.
inline constexpr bool crc16_has_table = sizeof(void*) > 4;

struct crc16_table {
  std::uint16_t rest[256] = {};

  constexpr crc16_table() noexcept {
    for (unsigned byte = 0; byte < 256; ++byte) rest[byte] = crc16_extend(0, static_cast<std::uint8_t>(byte));
  }
};

inline constexpr crc16_table crc16_of_byte;

constexpr std::uint16_t crc16(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint16_t rest = crc16_start;
  if constexpr (crc16_has_table) {
    for (std::size_t i = 0; i < count; ++i)
      rest =
          static_cast<std::uint16_t>((unsigned{rest} >> 8) ^ crc16_of_byte.rest[(unsigned{rest} ^ bytes[i]) & 0xFFU]);
  } else {
    for (std::size_t i = 0; i < count; ++i) rest = crc16_extend(rest, bytes[i]);
  }
  return static_cast<std::uint16_t>(~unsigned{rest});
}

}  // namespace dashpot::board
