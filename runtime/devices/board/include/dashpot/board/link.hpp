// Frames over a transport, both ways, for either end. No call blocks or allocates.
#pragma once

#include <cstdint>
#include <utility>

#include <dashpot/board/frame_decoder.hpp>
#include <dashpot/board/transport.hpp>

namespace dashpot::board {

class link {
 public:
  explicit link(transport over) noexcept : transport_(std::move(over)) {}

  // Shows every frame that has come to `handle(const frame&)`. At most 16 reads, so that a flood cannot hold the
  // caller; true where it took them all, and more may wait.
  template <class Handle>
  bool receive(Handle&& handle) noexcept {
    flush();
    std::uint8_t bytes[transport::max_datagram];
    for (int reads = 0; reads < 16; ++reads) {
      const std::size_t count = transport_.read(bytes, sizeof bytes);
      if (count == 0) return false;
      for_each_frame(decoder_, bytes, count, handle);
    }
    return true;
  }

  // False where the stream is full: the frame is dropped and counted, since the next one will be worth more. What left
  // only in part is completed first.
  template <class Message>
  bool send(const Message& message, std::uint32_t sequence = 0) noexcept {
    flush();
    if (left_ < leaving_.size) {
      ++dropped_;
      return false;
    }
    leaving_ = encode(message, sequence);
    left_ = 0;
    flush();
    if (left_ == 0) return drop();
    return true;
  }

  transport& stream() noexcept { return transport_; }
  bool closed() const noexcept { return transport_.closed(); }
  const decoder_statistics& statistics() const noexcept { return decoder_.statistics(); }
  std::uint32_t dropped() const noexcept { return dropped_; }

 private:
  void flush() noexcept {
    if (left_ < leaving_.size) left_ += transport_.write(leaving_.bytes + left_, leaving_.size - left_);
  }

  // Nothing of it has left yet: forget it rather than send it late.
  bool drop() noexcept {
    leaving_.size = 0;
    ++dropped_;
    return false;
  }

  transport transport_;
  frame_decoder decoder_;
  encoded_frame leaving_;
  std::size_t left_ = 0;  // bytes of leaving_ that the stream has taken
  std::uint32_t dropped_ = 0;
};

}  // namespace dashpot::board
