// The newest value that one thread has put, for one other thread: neither ever waits, no lock, no heap. What was put
// before and not taken is lost, as it should be of a slider. A value is taken whole: never half of one and half of the
// next.
//
// Three places: the writer owns one, the reader another, and the third is handed over by exchanging numbers of places.
#pragma once

#include <atomic>

template <class Value>
class newest {
 public:
  // The writer's side.
  void put(const Value& value) noexcept {
    places_[writing_] = value;
    writing_ = between_.exchange(writing_ | fresh, std::memory_order_acq_rel) & ~fresh;
  }

  // The reader's side: false, and `value` as it was, where nothing new has come.
  bool take(Value& value) noexcept {
    if (!(between_.load(std::memory_order_relaxed) & fresh)) return false;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & ~fresh;
    value = places_[reading_];
    return true;
  }

 private:
  static constexpr unsigned fresh = 4;
  static_assert(std::atomic<unsigned>::is_always_lock_free, "the servo thread must not wait for another");

  Value places_[3];
  std::atomic<unsigned> between_{0};  // place, and whether it was put since it was taken
  unsigned writing_ = 1, reading_ = 2;
};
