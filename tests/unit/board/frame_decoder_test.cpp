#include <dashpot/board/frame_decoder.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

using bytes = std::vector<std::uint8_t>;

struct arrived {
  message_type type;
  std::uint32_t sequence;
  bool operator==(const arrived&) const = default;
};

bytes of(const encoded_frame& frame) { return {frame.bytes, frame.bytes + frame.size}; }

void append(bytes& to, const bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

// Exactly as long as the bytes, so that the address sanitizer sees a read beyond them.
void feed(frame_decoder& decoder, const bytes& stream, std::vector<arrived>& found) {
  const auto exact = std::make_unique<std::uint8_t[]>(stream.size());
  std::copy(stream.begin(), stream.end(), exact.get());
  for_each_frame(decoder, exact.get(), stream.size(), [&](const frame& one) {
    found.push_back({one.type, one.sequence});
  });
}

std::vector<arrived> decode_all(const bytes& stream) {
  frame_decoder decoder;
  std::vector<arrived> found;
  feed(decoder, stream, found);
  return found;
}

bytes random_frame(std::mt19937& random, std::uint32_t sequence) {
  switch (random() % 6) {
    case 0: return of(encode(command_message{static_cast<float>(random()), 1}, sequence));
    case 1: return of(encode(sample_message{random(), random(), 7, 1, 2, 3, 4, board_state::running, {}}, sequence));
    case 2: return of(encode(hello_message{}, sequence));
    case 3: return of(encode(arm_command_message{{static_cast<float>(random()), 1}, {2, 3}}, sequence));
    case 4: return of(encode(arm_sample_message{random(), {random()}, {7, 8}}, sequence));
    default: return of(encode(statistics_message{static_cast<std::uint32_t>(random())}, sequence));
  }
}

// Long enough to complete whatever a false start makes the decoder wait for.
const bytes silence(max_frame_size, 0);

bytes command_frame(std::uint32_t sequence = 5) { return of(encode(command_message{1.5F, 2.5F}, sequence)); }

// After `damaged` an intact frame must come through, and nothing else.
void expect_rejected(const bytes& damaged) {
  bytes stream = damaged;
  append(stream, command_frame(77));
  append(stream, silence);
  ASSERT_EQ(decode_all(stream), (std::vector<arrived>{{message_type::command, 77}}));
}

void flip(bytes& in, std::size_t bit) { in[bit / 8] = static_cast<std::uint8_t>(in[bit / 8] ^ (1U << (bit % 8))); }

const std::vector<bytes> frames_of_all_lengths = {
    of(encode(hello_message{}, 0)),
    of(encode(reset_message{3}, 0)),
    of(encode(configured_message{}, 0)),
    of(encode(command_message{-0.25F, 7}, 5)),
    of(encode(configure_message{}, 0)),
    of(encode(sample_message{1, 2, 3, 4, 5, 6, 7, board_state::running, {}}, 9)),
    of(encode(description_message{}, 0)),
    of(encode(statistics_message{}, 0)),
    of(encode(arm_command_message{{-0.25F, 7}, {1, 2}}, 5)),
    of(encode(arm_sample_message{1, {2, 3}, {4, 5}}, 9))};

// How the stream is cut into reads must not matter: a serial port delivers what it likes.
TEST(FrameDecoder, FindsTheSameFramesInChunksOfAnySize) {
  std::mt19937 random(1);
  bytes stream;
  std::vector<arrived> sent;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const bytes one = random_frame(random, i);
    sent.push_back({static_cast<message_type>(one[3]), i});
    append(stream, one);
  }
  for (std::size_t longest = 1; longest < 400; longest += 7) {
    frame_decoder decoder;
    std::vector<arrived> found;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t count = std::min(stream.size() - at, 1 + random() % longest);
      feed(decoder,
           bytes(stream.begin() + static_cast<std::ptrdiff_t>(at),
                 stream.begin() + static_cast<std::ptrdiff_t>(at + count)),
           found);
      at += count;
    }
    ASSERT_EQ(found, sent) << "chunks of up to " << longest;
    EXPECT_EQ(decoder.statistics().discarded_bytes, 0U);
  }
}

// Garbage before and between frames must cost no frame, whatever it looks like; sync bytes are planted in it often. One
// false start in 65,536 has a CRC that fits; with these seeds there is none.
TEST(FrameDecoder, LosesNoIntactFrameToGarbage) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed + 1000);
    bytes stream;
    std::vector<arrived> sent;
    for (std::uint32_t i = 0; i < 40; ++i) {
      for (auto count = random() % 60; count > 0; --count) {
        const std::uint8_t choice[] = {'d', 'p', 1, 0x55, static_cast<std::uint8_t>(random())};
        stream.push_back(choice[random() % 5]);
      }
      const bytes one = random_frame(random, i);
      sent.push_back({static_cast<message_type>(one[3]), i});
      append(stream, one);
    }
    append(stream, silence);
    ASSERT_EQ(decode_all(stream), sent) << "seed " << seed;
  }
}

// Pure noise must not be taken for messages: with sync, version, type, length and CRC one in 2⁵⁶ bytes would be.
TEST(FrameDecoder, FindsNothingInNoise) {
  std::mt19937 random(3);
  bytes noise(1'000'000);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
  EXPECT_TRUE(decode_all(noise).empty());
}

// One undetected flip, anywhere, would put a wrong number on the motor.
TEST(FrameDecoder, RejectsEverySingleAndDoubleBitError) {
  for (const bytes& intact : frames_of_all_lengths) {
    for (std::size_t first = 0; first < intact.size() * 8; ++first) {
      for (std::size_t second = first; second < intact.size() * 8; ++second) {
        bytes damaged = intact;
        flip(damaged, first);
        if (second != first) flip(damaged, second);
        expect_rejected(damaged);
        if (HasFatalFailure()) FAIL() << "bits " << first << ' ' << second << " of a frame of " << intact.size();
      }
    }
  }
}

// Three flips are what the CRC and the spacing of types and lengths promise together.
TEST(FrameDecoder, RejectsEveryTripleBitErrorInACommand) {
  const bytes intact = command_frame();
  const std::size_t bits = intact.size() * 8;
  for (std::size_t first = 0; first < bits; ++first) {
    for (std::size_t second = first + 1; second < bits; ++second) {
      for (std::size_t third = second + 1; third < bits; ++third) {
        bytes damaged = intact;
        for (const std::size_t bit : {first, second, third}) flip(damaged, bit);
        frame_decoder decoder;
        for_each_frame(decoder, damaged.data(), damaged.size(),
                       [&](const frame&) { FAIL() << first << ' ' << second << ' ' << third; });
      }
    }
  }
}

// Bursts are what a disturbed cable makes.
TEST(FrameDecoder, RejectsEveryBurstOfSixteenBitsInACommand) {
  const bytes intact = command_frame();
  for (std::size_t start = 0; start + 16 <= intact.size() * 8; ++start) {
    for (unsigned pattern = 1; pattern < 0x10000; pattern += 2) {
      bytes damaged = intact;
      for (unsigned bit = 0; bit < 16; ++bit) {
        if ((pattern >> bit & 1U) != 0) flip(damaged, start + bit);
      }
      frame_decoder decoder;
      for_each_frame(decoder, damaged.data(), damaged.size(), [&](const frame&) { FAIL() << start << ' ' << pattern; });
    }
  }
}

// A frame cut off by a reconnect must neither be acted on nor swallow the next one.
TEST(FrameDecoder, SurvivesTruncationAtEveryByte) {
  for (const bytes& intact : frames_of_all_lengths) {
    for (std::size_t length = 0; length < intact.size(); ++length)
      expect_rejected(bytes(intact.begin(), intact.begin() + static_cast<std::ptrdiff_t>(length)));
  }
}

// A CRC that is right does not make a frame right: one shorter than its type would be read beyond its end.
TEST(FrameDecoder, RejectsFramesWhoseLengthIsNotTheirTypes) {
  for (const std::size_t length : {0U, 7U, 9U, 64U}) {
    bytes wrong = {'d', 'p', protocol_version, static_cast<std::uint8_t>(message_type::command)};
    wrong.push_back(static_cast<std::uint8_t>(length));
    wrong.resize(header_size + length);
    const std::uint16_t crc = crc16(wrong.data() + 2, wrong.size() - 2);
    append(wrong, {static_cast<std::uint8_t>(crc & 0xFF), static_cast<std::uint8_t>(crc >> 8)});
    expect_rejected(wrong);
  }
}

// An intact frame inside what looks like a longer one must be found once the longer one proves false.
TEST(FrameDecoder, FindsFramesInsideAFalseFrame) {
  bytes stream = {'d', 'p', protocol_version, static_cast<std::uint8_t>(message_type::statistics), 44, 0, 0, 0, 0};
  append(stream, of(encode(hello_message{}, 1)));
  append(stream, command_frame(2));
  append(stream, silence);
  EXPECT_EQ(decode_all(stream), (std::vector<arrived>{{message_type::hello, 1}, {message_type::command, 2}}));
}

// The counts are what a user has to find a bad cable with.
TEST(FrameDecoder, CountsWhatItThrewAway) {
  bytes damaged = command_frame();
  flip(damaged, header_size * 8);
  bytes stream = {1, 2, 3};
  append(stream, damaged);
  append(stream, command_frame());
  frame_decoder decoder;
  std::vector<arrived> found;
  feed(decoder, stream, found);
  EXPECT_EQ(decoder.statistics().received, 1U);
  EXPECT_EQ(decoder.statistics().corrupted, 1U);
  EXPECT_EQ(decoder.statistics().discarded_bytes, 3U + damaged.size());
}

// A newer board must be recognised as such, not reported as a bad cable, and must not be obeyed.
TEST(FrameDecoder, RecognisesOtherVersions) {
  bytes newer = {'d', 'p', 9, 0x12, 3, 0, 0, 0, 0, 'a', 'b', 'c'};
  const std::uint16_t crc = crc16(newer.data() + 2, newer.size() - 2);
  append(newer, {static_cast<std::uint8_t>(crc & 0xFF), static_cast<std::uint8_t>(crc >> 8)});
  frame_decoder decoder;
  std::vector<arrived> found;
  feed(decoder, newer, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(decoder.statistics().foreign_version, 1U);
  EXPECT_EQ(decoder.statistics().other_version, 9);
  EXPECT_EQ(decoder.statistics().discarded_bytes, 0U);
}

}  // namespace
}  // namespace dashpot::board
