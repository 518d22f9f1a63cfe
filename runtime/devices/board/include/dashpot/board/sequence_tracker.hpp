// Tells fresh, repeated and late frames apart by their sequence number, and counts the lost ones.
//
// A number that no outage explains, more than longest_gap ahead or too far behind, is wild: a damaged frame whose check
// sum happens to fit, a replay, or a peer that has begun to count anew. One alone is ignored, for all later numbers
// would seem old after it; a run of new_run consecutive ones, with no fresh number among them, is a new beginning.
#pragma once

#include <cstdint>

namespace dashpot::board {

enum class arrival : std::uint8_t {
  fresh,     // newer than all before
  repeated,  // has been here
  late,      // overtaken by a newer one, or wild
  anew,      // the peer has begun to count anew: fresh too, but nothing links it with what was before
};

// Wrapping around. A frame that comes late was counted as lost and is taken back.
struct sequence_statistics {
  std::uint32_t lost = 0;
  std::uint32_t repeated = 0;
  std::uint32_t late = 0;
};

// Remembers the last 32 numbers. Numbers wrap around.
class sequence_tracker {
 public:
  static constexpr std::uint32_t longest_gap = 1024;
  static constexpr std::uint32_t new_run = 4;

  // The first number after construction or restart() is fresh whatever it is.
  constexpr arrival note(std::uint32_t sequence) noexcept {
    if (known_ == 0) return begin_at(sequence);
    const std::uint32_t ahead = sequence - newest_;
    if (ahead != 0 && ahead <= longest_gap) return advance(ahead);
    if (0U - ahead < window) return look_back(0U - ahead);
    return suspect(sequence, ahead);
  }

  // Forgets the numbers, keeps the counts.
  constexpr void restart() noexcept { known_ = run_ = 0; }

  constexpr std::uint32_t newest() const noexcept { return newest_; }
  constexpr const sequence_statistics& statistics() const noexcept { return statistics_; }

 private:
  static constexpr std::uint32_t window = 32;

  constexpr arrival begin_at(std::uint32_t sequence) noexcept {
    newest_ = sequence;
    seen_ = 1;
    known_ = 1;
    run_ = 0;
    return arrival::fresh;
  }

  constexpr arrival advance(std::uint32_t by) noexcept {
    newest_ += by;
    seen_ = by < window ? (seen_ << by) | 1U : 1U;
    known_ = by < window - known_ ? known_ + by : window;
    statistics_.lost += by - 1;
    run_ = 0;
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

  // What lies between the old numbers and a new run ahead of them was lost; behind them it was not.
  constexpr arrival suspect(std::uint32_t sequence, std::uint32_t ahead) noexcept {
    run_ = run_ != 0 && sequence == run_newest_ + 1 ? run_ + 1 : 1;
    run_newest_ = sequence;
    if (run_ < new_run) {
      ++statistics_.late;
      return arrival::late;
    }
    if (ahead < 0x8000'0000U) statistics_.lost += ahead - new_run;
    begin_at(sequence);
    return arrival::anew;
  }

  std::uint32_t newest_ = 0;
  std::uint32_t seen_ = 0;        // bit i: newest_ − i was here
  std::uint32_t known_ = 0;       // how many bits of it count: none before the first number
  std::uint32_t run_ = 0;         // how many consecutive wild numbers have come
  std::uint32_t run_newest_ = 0;  // the newest of them
  sequence_statistics statistics_;
};

}  // namespace dashpot::board
