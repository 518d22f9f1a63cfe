// Finds the intact frames in a byte stream that may hold anything, in chunks of any size, without heap.
//
// After damage it looks for the next frame from the byte behind the false start, so that an intact frame is never lost
// to garbage before it; a false start can hold it back until at most max_frame_size further bytes have come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <dashpot/board/frame.hpp>

namespace dashpot::board {

// Wrapping around.
struct decoder_statistics {
  std::uint32_t received = 0;         // intact frames of this version
  std::uint32_t corrupted = 0;        // frames with a plausible header whose CRC was wrong
  std::uint32_t discarded_bytes = 0;  // bytes that belonged to no intact frame
  std::uint32_t foreign_version = 0;  // intact frames of another version
  std::uint8_t other_version = 0;     // the last one seen
};

class frame_decoder {
 public:
  // Takes as many of the bytes as it has room for, at least one once next() has returned false. Returns how many.
  std::size_t accept(const std::uint8_t* bytes, std::size_t count) noexcept {
    drop_delivered();
    const std::size_t room = sizeof buffer_ - size_;
    const std::size_t taken = count < room ? count : room;
    if (taken != 0) std::memcpy(buffer_ + size_, bytes, taken);
    size_ += taken;
    return taken;
  }

  // The next intact frame, valid until the next call; false where more bytes are needed.
  bool next(frame& out) noexcept {
    drop_delivered();
    for (;;) {
      const finding found = examine();
      if (found == finding::incomplete) return false;
      if (found == finding::foreign) skip_foreign();
      if (found == finding::damaged) discard_false_start();
      if (found == finding::intact) return deliver(out);
    }
  }

  const decoder_statistics& statistics() const noexcept { return statistics_; }

 private:
  enum class finding : std::uint8_t { incomplete, damaged, foreign, intact };

  // What begins at buffer_[0].
  finding examine() noexcept {
    if (!may_be_header()) return finding::damaged;
    if (size_ < header_size || size_ < frame_size()) return finding::incomplete;
    if (!crc_is_right()) {
      ++statistics_.corrupted;
      return finding::damaged;
    }
    return buffer_[2] == protocol_version ? finding::intact : finding::foreign;
  }

  // As far as it has come. The length is checked against the type, in foreign versions against the longest frame only.
  bool may_be_header() const noexcept {
    if (size_ > 0 && buffer_[0] != sync_bytes[0]) return false;
    if (size_ > 1 && buffer_[1] != sync_bytes[1]) return false;
    if (size_ <= 4) return true;
    if (buffer_[2] == protocol_version) return buffer_[4] == payload_size(buffer_[3]);
    return buffer_[4] <= max_payload_size;
  }

  std::size_t frame_size() const noexcept { return header_size + buffer_[4] + 2; }

  bool crc_is_right() const noexcept {
    const std::size_t end = header_size + buffer_[4];
    std::uint16_t sent = 0;
    byte_reader(buffer_ + end)(sent);
    return crc16(buffer_ + 2, end - 2) == sent;
  }

  bool deliver(frame& out) noexcept {
    out.type = static_cast<message_type>(buffer_[3]);
    byte_reader(buffer_ + 5)(out.sequence);
    out.payload = buffer_ + header_size;
    delivered_ = frame_size();
    ++statistics_.received;
    return true;
  }

  void skip_foreign() noexcept {
    ++statistics_.foreign_version;
    statistics_.other_version = buffer_[2];
    drop(frame_size());
  }

  // Up to the next byte that may begin a frame.
  void discard_false_start() noexcept {
    std::size_t count = 1;
    while (count < size_ && buffer_[count] != sync_bytes[0]) ++count;
    statistics_.discarded_bytes += static_cast<std::uint32_t>(count);
    drop(count);
  }

  void drop_delivered() noexcept {
    if (delivered_ != 0) drop(delivered_);
    delivered_ = 0;
  }

  void drop(std::size_t count) noexcept {
    size_ -= count;
    std::memmove(buffer_, buffer_ + count, size_);
  }

  std::uint8_t buffer_[2 * max_frame_size] = {};
  std::size_t size_ = 0;       // bytes waiting in buffer_
  std::size_t delivered_ = 0;  // of them, in the frame last handed out
  decoder_statistics statistics_;
};

// Shows every intact frame that the bytes complete to `handle(const frame&)`, in order.
template <class Handle>
void for_each_frame(frame_decoder& decoder, const std::uint8_t* bytes, std::size_t count, Handle&& handle) noexcept {
  frame found;
  while (count != 0) {
    const std::size_t taken = decoder.accept(bytes, count);
    bytes += taken;
    count -= taken;
    while (decoder.next(found)) handle(found);
  }
}

}  // namespace dashpot::board
