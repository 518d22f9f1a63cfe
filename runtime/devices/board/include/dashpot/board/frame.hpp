// One frame of the byte stream (README.md):
//
//     0 'd'  1 'p'  2 version  3 type  4 length  5 sequence (4)  9 payload (length)  9 + length CRC (2)
//
// The CRC covers everything from the version to the end of the payload. These places are the same in all versions.
#pragma once

#include <cstddef>
#include <cstdint>

#include <dashpot/board/crc16.hpp>
#include <dashpot/board/messages.hpp>
#include <dashpot/board/wire_scalars.hpp>

namespace dashpot::board {

inline constexpr std::uint8_t sync_bytes[2] = {'d', 'p'};
inline constexpr std::uint8_t protocol_version = 1;
inline constexpr std::size_t header_size = 9;
inline constexpr std::size_t max_payload_size = 64;
inline constexpr std::size_t max_frame_size = header_size + max_payload_size + 2;

// An intact frame of this version. The payload has the length that belongs to the type.
struct frame {
  message_type type = message_type::hello;
  std::uint32_t sequence = 0;
  const std::uint8_t* payload = nullptr;  // borrowed from the decoder
};

struct encoded_frame {
  std::uint8_t bytes[max_frame_size] = {};
  std::size_t size = 0;
};

template <class Message>
encoded_frame encode(const Message& message, std::uint32_t sequence) noexcept {
  constexpr std::size_t length = payload_size<Message>();
  static_assert(length <= max_payload_size);
  encoded_frame out;
  byte_writer header(out.bytes);
  header(sync_bytes[0], sync_bytes[1], protocol_version, Message::type, static_cast<std::uint8_t>(length), sequence);
  Message::fields(message, byte_writer(out.bytes + header_size));
  byte_writer(out.bytes + header_size + length)(crc16(out.bytes + 2, header_size - 2 + length));
  out.size = header_size + length + 2;
  return out;
}

// The message in a frame whose type is Message::type.
template <class Message>
Message decode(const frame& from) noexcept {
  Message message;
  Message::fields(message, byte_reader(from.payload));
  return message;
}

}  // namespace dashpot::board
