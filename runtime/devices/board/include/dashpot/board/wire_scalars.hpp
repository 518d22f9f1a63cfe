// Scalars as bytes: little-endian, IEEE 754, no padding, no alignment. Each class visits the fields of a message
// (messages.hpp) in their order: one list of fields is written, read and measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace dashpot::board {

template <std::size_t Bytes>
using unsigned_of_size = std::conditional_t<
    Bytes == 1, std::uint8_t,
    std::conditional_t<Bytes == 2, std::uint16_t, std::conditional_t<Bytes == 4, std::uint32_t, std::uint64_t>>>;

// The caller provides room for every field it shows.
class byte_writer {
 public:
  explicit byte_writer(std::uint8_t* out) noexcept : out_(out) {}

  template <class... Fields>
  void operator()(const Fields&... fields) noexcept {
    (put(fields), ...);
  }

 private:
  template <class Scalar>
  void put(const Scalar& value) noexcept {
    static_assert(std::is_arithmetic_v<Scalar> || std::is_enum_v<Scalar>);
    unsigned_of_size<sizeof value> bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (std::size_t i = 0; i < sizeof bits; ++i) *out_++ = static_cast<std::uint8_t>(bits >> (8 * i));
  }
  template <class Scalar, std::size_t Count>
  void put(const Scalar (&values)[Count]) noexcept {
    for (const Scalar& value : values) put(value);
  }

  std::uint8_t* out_;
};

// The caller has checked that the bytes of every field are there.
class byte_reader {
 public:
  explicit byte_reader(const std::uint8_t* in) noexcept : in_(in) {}

  template <class... Fields>
  void operator()(Fields&... fields) noexcept {
    (get(fields), ...);
  }

 private:
  template <class Scalar>
  void get(Scalar& value) noexcept {
    using word = unsigned_of_size<sizeof value>;
    word bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i)
      bits = static_cast<word>(bits | static_cast<word>(word{*in_++} << (8 * i)));
    std::memcpy(&value, &bits, sizeof bits);
  }
  template <class Scalar, std::size_t Count>
  void get(Scalar (&values)[Count]) noexcept {
    for (Scalar& value : values) get(value);
  }

  const std::uint8_t* in_;
};

class byte_counter {
 public:
  template <class... Fields>
  constexpr void operator()(const Fields&...) noexcept {
    count_ = (sizeof(Fields) + ... + count_);
  }
  constexpr std::size_t count() const noexcept { return count_; }

 private:
  std::size_t count_ = 0;
};

}  // namespace dashpot::board
