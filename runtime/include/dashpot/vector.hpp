// Several scalars at once, for the rolled loops of emitted laws: as many as a register of the machine holds that the
// code is compiled for, one where the compiler has no vectors. How many makes no difference to any bit: a law states in
// how many partial sums it adds up, and the same operations are done in the same order in registers of any width.
#pragma once

#include <dashpot/branch_free.hpp>
#include <dashpot/elementary.hpp>

// Before a loop over the registers of one round: they are few, and each has its own partial sum.
#if defined(__clang__)
#define DASHPOT_UNROLL _Pragma("clang loop unroll(full)")
#elif defined(__GNUC__)
#define DASHPOT_UNROLL _Pragma("GCC unroll 64")
#else
#define DASHPOT_UNROLL
#endif

namespace dashpot {

#if defined(__GNUC__) && defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__GNUC__) && defined(__AVX__)
inline constexpr int register_bytes = 32;
#elif defined(__GNUC__) && (defined(__SSE2__) || defined(__aarch64__))
inline constexpr int register_bytes = 16;
#else
inline constexpr int register_bytes = 0;
#endif

// Scalars in a register, in a law of `lanes` partial sums: two registers of them at least, so that one addition does
// not wait for the other.
template <class Scalar, int lanes>
inline constexpr int vector_width = register_bytes / static_cast<int>(sizeof(Scalar)) > lanes / 2
                                        ? (lanes > 1 ? lanes / 2 : 1)
                                        : (register_bytes > 0 ? register_bytes / static_cast<int>(sizeof(Scalar)) : 1);

#if defined(__GNUC__)
template <class Scalar, int count, unsigned alignment>
struct packed {
  typedef Scalar type __attribute__((vector_size(sizeof(Scalar) * static_cast<unsigned>(count))));
  typedef Scalar in_memory
      __attribute__((vector_size(sizeof(Scalar) * static_cast<unsigned>(count)), aligned(alignment), may_alias));
};
#else
template <class Scalar, int count, unsigned alignment>
struct packed;
#endif

template <class Scalar, unsigned alignment>
struct packed<Scalar, 1, alignment> {
  using type = Scalar;
  using in_memory = Scalar;
};

// `alignment`: of what at() and put() are given [bytes]; from 16 on, SSE2 reads memory within an operation.
template <class Scalar, int count, unsigned alignment = alignof(Scalar)>
class vector {
  using in_memory = typename packed<Scalar, count,
                                    (alignment < sizeof(Scalar) * static_cast<unsigned>(count)
                                         ? alignment
                                         : sizeof(Scalar) * static_cast<unsigned>(count))>::in_memory;

 public:
  using packed_type = typename packed<Scalar, count, alignof(Scalar)>::type;
  using scalar = Scalar;
  static constexpr int width = count;

  vector() noexcept : value_{} {}
  vector(Scalar all) noexcept : value_(all - packed_type{}) {}  // all − 0 is `all`, also for −0

  // The `width` values from place i on.
  template <class Index>
  static vector at(const Scalar* values, Index i) noexcept {
    return vector(packed_tag(), *reinterpret_cast<const in_memory*>(values + i));
  }
  template <class Index>
  static void put(Scalar* values, Index i, vector v) noexcept {
    *reinterpret_cast<in_memory*>(values + i) = v.value_;
  }

  // The same, read from memory once. With SSE2, where an operation can read memory itself but overwrites its other
  // operand, compilers read again for every use, and these reads limit a loop of many states.
  static vector in_register(vector v) noexcept {
#if defined(__GNUC__) && defined(__SSE2__) && !defined(__AVX__)
    __asm__("" : "+x"(v.value_));
#endif
    return v;
  }

  friend vector operator+(vector a, vector b) noexcept { return vector(packed_tag(), a.value_ + b.value_); }
  friend vector operator-(vector a, vector b) noexcept { return vector(packed_tag(), a.value_ - b.value_); }
  friend vector operator*(vector a, vector b) noexcept { return vector(packed_tag(), a.value_ * b.value_); }
  friend vector operator/(vector a, vector b) noexcept { return vector(packed_tag(), a.value_ / b.value_); }

  // `yes` where `condition` is above zero, else `no`.
  static vector where(vector condition, vector yes, vector no) noexcept {
    return vector(packed_tag(), condition.value_ > packed_type{} ? yes.value_ : no.value_);
  }

  // `yes` where the mask is ones, else `no`.
  static vector chosen(branch_free::mask<Scalar> which, vector yes, vector no) noexcept {
    if constexpr (count > 1) {
      using bits = decltype(yes.value_ > yes.value_);
      const bits all = static_cast<decltype(all_bits())>(which) - bits{};
      return vector(packed_tag(), reinterpret_cast<packed_type>((reinterpret_cast<bits>(yes.value_) & all) |
                                                                (reinterpret_cast<bits>(no.value_) & ~all)));
    } else {
      return branch_free::chosen(which, yes.value_, no.value_);
    }
  }

  // 1 where all three are finite, else 0.
  static vector all_finite(vector a, vector b, vector c) noexcept {
    const packed_type nothing = (a.value_ - a.value_) + (b.value_ - b.value_) + (c.value_ - c.value_);
    return vector(packed_tag(), nothing == packed_type{} ? vector(Scalar(1)).value_ : packed_type{});
  }

  // Looks up a table: at every place, the value whose index is in `v` there.
  static vector pick(const Scalar* table, vector v) noexcept {
    if constexpr (count > 1) {
      packed_type picked{};
      DASHPOT_UNROLL
      for (int i = 0; i < count; ++i) picked[i] = table[static_cast<int>(v.value_[i])];
      return vector(packed_tag(), picked);
    } else {
      return vector(packed_tag(), table[static_cast<int>(v.value_)]);
    }
  }

  // As the function of this name, place by place: processors that have no more than one root at a time do the same.
  static vector square_root(vector v) noexcept {
    if constexpr (count > 1) {
      packed_type roots{};
      DASHPOT_UNROLL
      for (int i = 0; i < count; ++i) roots[i] = dashpot::square_root(v.value_[i]);
      return vector(packed_tag(), roots);
    } else {
      return dashpot::square_root(v.value_);
    }
  }

  // As the functions of these names in command.hpp.
  static vector flush_below(vector threshold, vector v) noexcept {
    return vector(packed_tag(), magnitude(v.value_) > threshold.value_ ? v.value_ : packed_type{});
  }
  static vector clamp_to(vector limit, vector v) noexcept {
    const packed_type below = v.value_ < limit.value_ ? v.value_ : limit.value_;
    return vector(packed_tag(), below > -limit.value_ ? below : -limit.value_);
  }

  Scalar operator[](int i) const noexcept {
    if constexpr (count > 1) return value_[i];
    else return value_;
  }

  // Another value at place i.
  void put(int i, Scalar value) noexcept {
    if constexpr (count > 1) value_[i] = value;
    else value_ = value;
  }

 private:
  struct packed_tag {};
  vector(packed_tag, packed_type value) noexcept : value_(value) {}

  static auto all_bits() noexcept {
    using bits = decltype(packed_type{} > packed_type{});
    return bits{}[0];
  }

  // One comparison for either sign: where several are computed at once nothing is predicted.
  static packed_type magnitude(packed_type value) noexcept {
    if constexpr (count > 1) {
      using bits = decltype(value > value);
      return reinterpret_cast<packed_type>(reinterpret_cast<bits>(value) & ~reinterpret_cast<bits>(-packed_type{}));
    } else {
      return value < 0 ? -value : value;
    }
  }

  packed_type value_;
};

// A sum in `lanes` partial ones: place i goes to lane i mod `lanes`; at last the second half of the lanes is added to
// the first until one is left.
template <class part, int lanes>
class partial_sums {
 public:
  using scalar = typename part::scalar;

  // The lanes from `first` on.
  void add(int first, part values) noexcept { parts_[first / part::width] = parts_[first / part::width] + values; }

  scalar total() noexcept {
    DASHPOT_UNROLL
    for (int half = lanes / part::width / 2; half > 0; half /= 2) DASHPOT_UNROLL
    for (int i = 0; i < half; ++i) parts_[i] = parts_[i] + parts_[i + half];
    scalar last[part::width];
    DASHPOT_UNROLL
    for (int i = 0; i < part::width; ++i) last[i] = parts_[0][i];
    DASHPOT_UNROLL
    for (int half = part::width / 2; half > 0; half /= 2) DASHPOT_UNROLL
    for (int i = 0; i < half; ++i) last[i] = last[i] + last[i + half];
    return last[0];
  }

 private:
  part parts_[lanes / part::width];
};

}  // namespace dashpot
