// The last MaxWindow + 1 position samples, newest first.
#pragma once

namespace dashpot {

template <class Scalar, unsigned MaxWindow>
class position_window {
 public:
  static_assert(MaxWindow >= 1, "a velocity needs two samples");

  // The window a caller gets who asks for `samples`: the nearest of 1 … MaxWindow.
  static constexpr unsigned nearest(unsigned samples) noexcept {
    return samples < 1 ? 1 : samples > MaxWindow ? MaxWindow : samples;
  }

  // As if the tool had always been at `position`.
  void fill(Scalar position) noexcept {
    for (Scalar& sample : samples_) sample = position;
  }

  void push(Scalar position) noexcept {
    newest_ = (newest_ + 1) & mask;
    samples_[newest_] = position;
  }

  // The position `age` samples ago, 0 … MaxWindow.
  Scalar operator[](unsigned age) const noexcept { return samples_[(newest_ - age) & mask]; }

 private:
  // A power of two, so that an index wraps with one instruction and not with a division.
  static constexpr unsigned capacity() noexcept {
    unsigned size = 2;
    while (size <= MaxWindow) size *= 2;
    return size;
  }
  static constexpr unsigned mask = capacity() - 1;

  Scalar samples_[mask + 1] = {};
  unsigned newest_ = 0;
};

}  // namespace dashpot
