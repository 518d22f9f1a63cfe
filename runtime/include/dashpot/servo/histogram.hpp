// Durations counted in fixed memory: exact below 64 ns, then 32 bins an octave, so that a percentile is never below the
// true one and at most 1/32 above it. Recording is a handful of instructions; nothing allocates.
#pragma once

#include <cstdint>

namespace dashpot {

class histogram {
 public:
  // Counts one duration [ns]; a negative one counts as 0, one above longest() only in the last bin.
  constexpr void record(std::int64_t duration) noexcept {
    const std::uint64_t value = duration > 0 ? static_cast<std::uint64_t>(duration) : 0;
    ++bins_[bin_of(value < longest() ? value : longest())];
    ++count_;
    sum_ += static_cast<double>(value);
    if (value > max_) max_ = value;
    if (value < min_) min_ = value;
  }

  constexpr std::uint64_t count() const noexcept { return count_; }
  constexpr std::uint64_t min() const noexcept { return count_ != 0 ? min_ : 0; }  // [ns], exact
  constexpr std::uint64_t max() const noexcept { return max_; }                    // [ns], exact
  constexpr double mean() const noexcept { return count_ != 0 ? sum_ / static_cast<double>(count_) : 0; }  // [ns]

  // Least duration [ns] that `percent` of all recorded ones do not exceed, rounded up to its bin; 0 without any.
  constexpr std::uint64_t percentile(double percent) const noexcept {
    const double wanted = percent / 100 * static_cast<double>(count_);
    std::uint64_t seen = 0;
    for (unsigned bin = 0; bin < bin_count; ++bin) {
      seen += bins_[bin];
      if (seen != 0 && static_cast<double>(seen) >= wanted) return top_of(bin) < max_ ? top_of(bin) : max_;
    }
    return max_;
  }

  static constexpr std::uint64_t longest() noexcept { return (std::uint64_t{1} << octaves) - 1; }  // [ns], 68.7 s

 private:
  static constexpr unsigned octaves = 36;
  static constexpr unsigned fine_bits = 5;  // 32 bins an octave
  static constexpr unsigned fine = 1u << fine_bits;
  static constexpr unsigned bin_count = (octaves - fine_bits + 1) * fine;

  // A value with its top bit at `fine_bits + shift` lies in octave `shift`, in the bin named by its fine_bits + 1 top
  // bits.
  static constexpr unsigned bin_of(std::uint64_t value) noexcept {
    const unsigned shift = shift_of(value);
    return shift * fine + static_cast<unsigned>(value >> shift);
  }
  static constexpr std::uint64_t top_of(unsigned bin) noexcept {
    const unsigned shift = bin < 2 * fine ? 0 : bin / fine - 1;
    return ((std::uint64_t{bin - shift * fine} + 1) << shift) - 1;
  }
  static constexpr unsigned shift_of(std::uint64_t value) noexcept {
    if (value < 2 * fine) return 0;
    return 63u - static_cast<unsigned>(__builtin_clzll(value)) - fine_bits;
  }

  std::uint64_t bins_[bin_count] = {};
  std::uint64_t count_ = 0;
  std::uint64_t min_ = ~std::uint64_t{0};  // [ns]
  std::uint64_t max_ = 0;                  // [ns]
  double sum_ = 0;                         // [ns]
};

}  // namespace dashpot
