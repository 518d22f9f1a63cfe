// What the board's encoder says at one instant.
#pragma once

#include <cstdint>

namespace dashpot::board {

struct encoder_reading {
  std::int32_t counts = 0;      // wraps around
  std::uint64_t timestamp = 0;  // board clock [ns]
  std::uint64_t edge_time = 0;  // board clock at the newest edge [ns]; 0: not measured
};

}  // namespace dashpot::board
