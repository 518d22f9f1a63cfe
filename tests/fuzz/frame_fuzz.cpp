// Any bytes on the wire, with whole frames among them: the same frames are found whether they come at once or in
// pieces.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <dashpot/board/frame_decoder.hpp>

namespace {

using namespace dashpot::board;

struct Seen {
  message_type type;
  std::uint32_t sequence;
  bool operator==(const Seen&) const = default;
};

encoded_frame frame_of(std::uint8_t choice) {
  const std::uint32_t sequence = choice * 0x01010101u;
  switch (choice % 6) {
    case 0: return encode(hello_message{}, sequence);
    case 1: return encode(command_message{}, sequence);
    case 2: return encode(sample_message{}, sequence);
    case 3: return encode(arm_command_message{}, sequence);
    case 4: return encode(arm_sample_message{}, sequence);
    default: return encode(statistics_message{}, sequence);
  }
}

// 0xFE and a choice stand for a frame, which chance would not find: its CRC is right. All else stands for itself.
std::vector<std::uint8_t> wire_of(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> wire;
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] != 0xFE || i + 1 == size) {
      wire.push_back(data[i]);
      continue;
    }
    const encoded_frame whole = frame_of(data[++i]);
    wire.insert(wire.end(), whole.bytes, whole.bytes + whole.size);
  }
  return wire;
}

// Takes the wire in pieces of 1 to `largest` bytes, or at once where `largest` exceeds it.
std::vector<Seen> frames_in(const std::vector<std::uint8_t>& wire, std::size_t largest,
                            decoder_statistics& statistics) {
  const std::size_t size = wire.size();
  frame_decoder decoder;
  std::vector<Seen> seen;
  std::size_t piece = largest;
  for (std::size_t at = 0; at < size;) {
    const std::size_t wanted = piece < size - at ? piece : size - at;
    at += decoder.accept(wire.data() + at, wanted);
    for (frame found; decoder.next(found);) seen.push_back({found.type, found.sequence});
    if (largest < size) piece = piece % largest + 1;
  }
  statistics = decoder.statistics();
  return seen;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> wire = wire_of(data, size);
  decoder_statistics whole, pieces;
  if (frames_in(wire, wire.size() + 1, whole) != frames_in(wire, 7, pieces)) std::abort();
  if (whole.received != pieces.received || whole.corrupted != pieces.corrupted ||
      whole.discarded_bytes != pieces.discarded_bytes || whole.discarded_bytes > wire.size())
    std::abort();
  return 0;
}
