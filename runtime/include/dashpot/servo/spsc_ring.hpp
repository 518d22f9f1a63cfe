// A bounded queue between exactly one producing and one consuming thread. Wait-free on both sides: no call locks,
// retries or allocates; a push into a full ring is dropped and counted. Memory is taken once, on construction.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace dashpot {

template <class Record>
class spsc_ring {
  static_assert(std::is_trivially_copyable_v<Record>, "records are copied as bytes between threads");

 public:
  // Holds `least_capacity` records or more (the next power of two).
  explicit spsc_ring(std::size_t least_capacity) : slots_(power_of_two(least_capacity)), mask_(slots_.size() - 1) {}

  // Producer. Whether the next push would be dropped, as far as the consumer has come.
  bool is_full() noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_seen_ == slots_.size()) tail_seen_ = tail_.load(std::memory_order_acquire);
    return head - tail_seen_ == slots_.size();
  }

  // Producer. False: the ring was full, the record is lost and counted.
  bool push(const Record& record) noexcept {
    if (is_full()) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    const std::size_t head = head_.load(std::memory_order_relaxed);
    slots_[head & mask_] = record;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // Consumer. False: nothing is waiting, `record` is untouched.
  bool pop(Record& record) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_seen_) head_seen_ = head_.load(std::memory_order_acquire);
    if (tail == head_seen_) return false;
    record = slots_[tail & mask_];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }  // any thread
  std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  static std::size_t power_of_two(std::size_t least) noexcept {
    std::size_t capacity = 1;
    while (capacity < least) capacity *= 2;
    return capacity;
  }

  std::vector<Record> slots_;
  std::size_t mask_;
  // Each side's index and its stale copy of the other's live on a cache line of their own.
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t head_seen_ = 0;
};

}  // namespace dashpot
