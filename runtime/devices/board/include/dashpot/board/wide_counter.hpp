// A counter of 32 bits that wraps around, followed over its ends: right as long as it moves by less than half its range
// from one reading to the next.
#pragma once

#include <cstdint>

namespace dashpot::board {

class wide_counter {
 public:
  // The counter stands at `counts` now. Returns by how much it has moved; 0 for the first reading.
  constexpr std::int32_t follow(std::int32_t counts) noexcept {
    const auto moved =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) - static_cast<std::uint32_t>(last_));
    last_ = counts;
    if (!begun_) {
      begun_ = true;
      value_ = counts;
      return 0;
    }
    value_ += moved;
    return moved;
  }

  // The next reading is the first again.
  constexpr void restart() noexcept { begun_ = false; }

  constexpr std::int64_t value() const noexcept { return value_; }  // as if it had never wrapped around

 private:
  std::int64_t value_ = 0;
  std::int32_t last_ = 0;
  bool begun_ = false;
};

}  // namespace dashpot::board
