// Tells fresh, repeated and late frames apart by their sequence number, and counts the lost ones.
#pragma once

#include <cstdint>

namespace dashpot::board {

enum class arrival : std::uint8_t {
  fresh,     // newer than all before
  repeated,  // has been here
  late,      // overtaken by a newer one
};

// Wrapping around. A frame that comes late was counted as lost and is taken back.
struct sequence_statistics {
  std::uint32_t lost = 0;
  std::uint32_t repeated = 0;
  std::uint32_t late = 0;
};

// Remembers the last 32 numbers; older ones count as late. Numbers wrap around.
class sequence_tracker {
 public:
  // The first number after construction or restart() is fresh whatever it is.
  constexpr arrival note(std::uint32_t sequence) noexcept {
    if (known_ == 0) return begin_at(sequence);
    const std::uint32_t ahead = sequence - newest_;
    return ahead != 0 && ahead < 0x8000'0000U ? advance(ahead) : look_back(0U - ahead);
  }

  // Forgets the numbers, keeps the counts.
  constexpr void restart() noexcept { known_ = 0; }

  constexpr std::uint32_t newest() const noexcept { return newest_; }
  constexpr const sequence_statistics& statistics() const noexcept { return statistics_; }

 private:
  static constexpr std::uint32_t window = 32;

  constexpr arrival begin_at(std::uint32_t sequence) noexcept {
    newest_ = sequence;
    seen_ = 1;
    known_ = 1;
    return arrival::fresh;
  }

  constexpr arrival advance(std::uint32_t by) noexcept {
    newest_ += by;
    seen_ = by < window ? (seen_ << by) | 1U : 1U;
    known_ = by < window - known_ ? known_ + by : window;
    statistics_.lost += by - 1;
    return arrival::fresh;
  }

  constexpr arrival look_back(std::uint32_t by) noexcept {
    const std::uint32_t mark = by < known_ ? 1U << by : 0U;
    if ((seen_ & mark) != 0) {
      ++statistics_.repeated;
      return arrival::repeated;
    }
    ++statistics_.late;
    if (mark != 0) --statistics_.lost;
    seen_ |= mark;
    return arrival::late;
  }

  std::uint32_t newest_ = 0;
  std::uint32_t seen_ = 0;   // bit i: newest_ − i was here
  std::uint32_t known_ = 0;  // how many bits of it count: none before the first number
  sequence_statistics statistics_;
};

}  // namespace dashpot::board
