// A frame as the protocol's page writes it.
#pragma once

#include <cstdio>
#include <string>

#include <dashpot/board/frame.hpp>

namespace dashpot::board {

inline std::string in_hex(const encoded_frame& frame) {
  std::string text;
  for (std::size_t i = 0; i < frame.size; ++i) {
    char digits[4];
    std::snprintf(digits, sizeof digits, i == 0 ? "%02x" : " %02x", unsigned{frame.bytes[i]});
    text += digits;
  }
  return text;
}

}  // namespace dashpot::board
