// Where a byte stream is, as a string:
//
//     serial:/dev/ttyACM0?baud=921600   a terminal, raw, 8 data bits, no parity; 115200 baud where nothing is said
//     pty:                              the near end of a new pseudo-terminal; transport::far_end() is the other's path
//     unix:/run/board.sock              a stream socket that something listens on
//     udp:192.168.7.2:4010              datagrams, each holding whole frames; udp:[::1]:4010 for IPv6
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace dashpot::board {

struct serial_url {
  std::string path;
  unsigned baud = 115200;  // [1/s]
};
struct pty_url {};
struct unix_url {
  std::string path;
};
struct udp_url {
  std::string host;
  std::uint16_t port = 0;
};

using transport_url = std::variant<serial_url, pty_url, unix_url, udp_url>;

// Empty where `text` is none of the above; `error` then says what was seen and what is expected.
std::optional<transport_url> parse_transport_url(const std::string& text, std::string& error);

}  // namespace dashpot::board
