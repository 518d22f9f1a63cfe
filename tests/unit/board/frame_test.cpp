#include <dashpot/board/frame.hpp>

#include <bit>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frame_text.hpp"

namespace dashpot::board {
namespace {

constexpr message_type all_types[] = {
    message_type::hello,          message_type::configure,       message_type::reset,         message_type::command,
    message_type::ask_statistics, message_type::description,     message_type::configured,    message_type::sample,
    message_type::statistics,     message_type::arm_description, message_type::arm_configure, message_type::arm_command,
    message_type::arm_sample};

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
TEST(Frame, CarriesEveryBitOfEveryMessage) {
  expect_any_payload_to_survive<configure_message>();
  expect_any_payload_to_survive<reset_message>();
  expect_any_payload_to_survive<command_message>();
  expect_any_payload_to_survive<description_message>();
  expect_any_payload_to_survive<configured_message>();
  expect_any_payload_to_survive<sample_message>();
  expect_any_payload_to_survive<statistics_message>();
  expect_any_payload_to_survive<arm_description_message>();
  expect_any_payload_to_survive<arm_configure_message>();
  expect_any_payload_to_survive<arm_command_message>();
  expect_any_payload_to_survive<arm_sample_message>();
}

template <class Message>
std::string bytes_of(const Message& message, std::uint32_t sequence = 0) {
  const encoded_frame frame = encode(message, sequence);
  return in_hex(frame);
}

// Boards that are out there speak these bytes, whatever is added for others.
TEST(Frame, OfOneAxisKeepsItsBytes) {
  EXPECT_EQ(bytes_of(hello_message()), "64 70 01 0f 00 00 00 00 00 2c 2e");
  EXPECT_EQ(
      bytes_of(description_message{1e-5, 50, 30, 100'000, 1'000'000, motion::rotation, "dashpot"}),
      "64 70 01 96 29 00 00 00 00 f1 68 e3 88 b5 f8 e4 3e 00 00 48 42 00 00 f0 41 a0 86 01 00 40 42 0f 00 01 64 61 "
      "73 68 70 6f 74 00 00 00 00 00 00 00 00 00 46 fa");
  EXPECT_EQ(bytes_of(configure_message{1'000'000, 4, 2.5F, 10, sampling::free_running, controller::own_model}),
            "64 70 01 33 10 00 00 00 00 40 42 0f 00 00 00 80 40 00 00 20 40 0a 00 01 01 e7 10");
  EXPECT_EQ(bytes_of(configured_message{verdict::no_model, 7}), "64 70 01 99 03 00 00 00 00 04 07 00 92 e2");
  EXPECT_EQ(bytes_of(reset_message{1}), "64 70 01 3c 02 00 00 00 00 01 00 93 04");
  EXPECT_EQ(bytes_of(command_message{-0.5F, 3}, 258), "64 70 01 55 08 02 01 00 00 00 00 00 bf 00 00 40 40 14 26");
  EXPECT_EQ(
      bytes_of(sample_message{2'000'000'000, 1'999'500'000, -1234, -0.5F, 3, 258, 1, board_state::running, {}}, 772),
      "64 70 01 a5 24 04 03 00 00 00 94 35 77 00 00 00 00 e0 f2 2d 77 00 00 00 00 2e fb ff ff 00 00 00 bf 00 00 40 "
      "40 02 01 00 00 01 00 01 00 58 4e");
  EXPECT_EQ(bytes_of(ask_statistics_message()), "64 70 01 5a 00 00 00 00 00 ca 7a");
  EXPECT_EQ(
      bytes_of(statistics_message{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}),
      "64 70 01 c3 2c 00 00 00 00 01 00 00 00 02 00 00 00 03 00 00 00 04 00 00 00 05 00 00 00 06 00 00 00 07 00 00 "
      "00 08 00 00 00 09 00 00 00 0a 00 00 00 0b 00 00 00 96 17");
}

// A type byte that a short error turns into another would let a frame be read with the wrong length.
TEST(Frame, TypesDifferInFourBitsOrMore) {
  for (const auto one : all_types) {
    for (const auto other : all_types) {
      const auto differing = static_cast<unsigned>(one) ^ static_cast<unsigned>(other);
      EXPECT_TRUE(one == other || std::popcount(differing) >= 4) << int(one) << ' ' << int(other);
    }
  }
}

// The decoder would throw away a message whose length it does not know, or that is longer than its buffer.
TEST(Frame, EveryTypeHasALengthAndNoOtherByteHas) {
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
