// A queue of bytes between an interrupt and the main loop, one on each side.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dashpot::board {

template <std::size_t Capacity>
class byte_ring {
  static_assert(Capacity != 0 && (Capacity & (Capacity - 1)) == 0, "indices wrap around at a power of two");

 public:
  // False where it is full: the byte is lost.
  bool push(std::uint8_t byte) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == Capacity) return false;
    bytes_[head % Capacity] = byte;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // False where it is empty.
  bool pop(std::uint8_t& byte) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    byte = bytes_[tail % Capacity];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  bool empty() const noexcept { return room() == Capacity; }
  std::size_t room() const noexcept {
    return Capacity - (head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_acquire));
  }

 private:
  std::uint8_t bytes_[Capacity] = {};
  std::atomic<std::size_t> head_{0};  // written by push only
  std::atomic<std::size_t> tail_{0};  // written by pop only
};

}  // namespace dashpot::board
