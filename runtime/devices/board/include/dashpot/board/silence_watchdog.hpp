// Counts the periods since the last sign of life.
#pragma once

#include <cstdint>

namespace dashpot::board {

class silence_watchdog {
 public:
  // Starts to wait anew: `periods` may pass in silence; 0: any number.
  constexpr void arm(std::uint16_t periods) noexcept { left_ = periods; }

  // True when this period is the last that was allowed to pass. Then it waits no longer.
  constexpr bool pass_period() noexcept { return left_ != 0 && --left_ == 0; }

 private:
  std::uint16_t left_ = 0;
};

}  // namespace dashpot::board
