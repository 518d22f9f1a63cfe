// What the board's encoders say at one instant.
#pragma once

#include <cstdint>

#include <dashpot/board/axes.hpp>

namespace dashpot::board {

template <unsigned Axes>
struct basic_encoder_reading {
  static constexpr unsigned axes = Axes;
  one_each<std::int32_t, Axes> counts = {};      // wraps around
  std::uint64_t timestamp = 0;                   // board clock [ns]
  one_each<std::uint64_t, Axes> edge_time = {};  // board clock at the newest edge [ns]; 0: not measured
};

using encoder_reading = basic_encoder_reading<1>;
using arm_reading = basic_encoder_reading<arm_axes>;

}  // namespace dashpot::board
