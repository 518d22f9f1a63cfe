#include <dashpot/board/frame.hpp>

#include <bit>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

constexpr message_type all_types[] = {message_type::hello,      message_type::configure,      message_type::reset,
                                      message_type::command,    message_type::ask_statistics, message_type::description,
                                      message_type::configured, message_type::sample,         message_type::statistics};

template <class Message>
void expect_any_payload_to_survive() {
  std::mt19937 random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<std::uint8_t> payload(payload_size<Message>());
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    const auto message = decode<Message>({Message::type, 0, payload.data()});
    const encoded_frame frame = encode(message, 0);
    ASSERT_EQ(frame.size, header_size + payload.size() + 2);
    ASSERT_EQ(std::vector<std::uint8_t>(frame.bytes + header_size, frame.bytes + frame.size - 2), payload);
  }
}

// A field that is missing, doubled or of the wrong width would not come back; signalling NaNs must not be quieted
// either.
TEST(Frame, carries_every_bit_of_every_message) {
  expect_any_payload_to_survive<configure_message>();
  expect_any_payload_to_survive<reset_message>();
  expect_any_payload_to_survive<command_message>();
  expect_any_payload_to_survive<description_message>();
  expect_any_payload_to_survive<configured_message>();
  expect_any_payload_to_survive<sample_message>();
  expect_any_payload_to_survive<statistics_message>();
}

// A type byte that a short error turns into another would let a frame be read with the wrong length.
TEST(Frame, types_differ_in_four_bits_or_more) {
  for (const auto one : all_types) {
    for (const auto other : all_types) {
      const auto differing = static_cast<unsigned>(one) ^ static_cast<unsigned>(other);
      EXPECT_TRUE(one == other || std::popcount(differing) >= 4) << int(one) << ' ' << int(other);
    }
  }
}

// The decoder would throw away a message whose length it does not know, or that is longer than its buffer.
TEST(Frame, every_type_has_a_length_and_no_other_byte_has) {
  int known = 0;
  for (unsigned type = 0; type < 256; ++type) {
    const std::size_t size = payload_size(static_cast<std::uint8_t>(type));
    if (size == no_such_message) continue;
    ++known;
    EXPECT_LE(size, max_payload_size);
  }
  EXPECT_EQ(known, static_cast<int>(std::size(all_types)));
}

}  // namespace
}  // namespace dashpot::board
