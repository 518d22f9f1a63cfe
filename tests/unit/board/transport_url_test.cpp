#include <dashpot/board/transport_url.hpp>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

template <class Url>
Url parsed(const std::string& text) {
  std::string error;
  const auto url = parse_transport_url(text, error);
  EXPECT_TRUE(url && std::holds_alternative<Url>(*url)) << text << ": " << error;
  return url && std::holds_alternative<Url>(*url) ? std::get<Url>(*url) : Url();
}

void expect_refused(const std::string& text, const std::string& reason) {
  std::string error;
  EXPECT_FALSE(parse_transport_url(text, error)) << text;
  EXPECT_EQ(error, "'" + text + "': " + reason);
}

// The documented forms would stop working.
TEST(TransportUrl, ReadsEveryForm) {
  EXPECT_EQ(parsed<serial_url>("serial:/dev/ttyACM0").path, "/dev/ttyACM0");
  EXPECT_EQ(parsed<serial_url>("serial:/dev/ttyACM0").baud, 115200U);
  EXPECT_EQ(parsed<serial_url>("serial:/dev/ttyUSB1?baud=921600").path, "/dev/ttyUSB1");
  EXPECT_EQ(parsed<serial_url>("serial:/dev/ttyUSB1?baud=921600").baud, 921600U);
  EXPECT_EQ(parsed<unix_url>("unix:run/board.sock").path, "run/board.sock");
  EXPECT_EQ(parsed<udp_url>("udp:board.local:4010").host, "board.local");
  EXPECT_EQ(parsed<udp_url>("udp:board.local:4010").port, 4010);
  EXPECT_EQ(parsed<udp_url>("udp:[::1]:65535").host, "::1");
  parsed<pty_url>("pty:");
}

// A mistyped URL must be named with what was expected, not opened as something else.
TEST(TransportUrl, RefusesWithTheReason) {
  const std::string forms = "expected serial:path?baud=number, pty:, unix:path or udp:host:port";
  const std::string port = "a port is a number from 1 to 65535";
  const std::string baud = "behind the '?' comes baud= and a number";
  expect_refused("", forms);
  expect_refused("/dev/ttyACM0", forms);
  expect_refused("tcp:localhost:1", forms);
  expect_refused("serial", forms);
  expect_refused("pty:/dev/pts/1", forms);
  expect_refused("serial:", "a serial port needs a path, as in serial:/dev/ttyACM0");
  expect_refused("serial:?baud=9600", "a serial port needs a path, as in serial:/dev/ttyACM0");
  expect_refused("serial:/dev/x?", baud);
  expect_refused("serial:/dev/x?baud=", baud);
  expect_refused("serial:/dev/x?baud=9600x", baud);
  expect_refused("serial:/dev/x?baud=-9600", baud);
  expect_refused("serial:/dev/x?baud=99999999999", baud);
  expect_refused("serial:/dev/x?parity=even", baud);
  expect_refused("unix:", "a Unix socket needs a path, as in unix:/run/board.sock");
  expect_refused("udp:localhost", "expected udp:host:port");
  expect_refused("udp::4010", "expected udp:host:port");
  expect_refused("udp:localhost:", port);
  expect_refused("udp:localhost:0", port);
  expect_refused("udp:localhost:65536", port);
}

}  // namespace
}  // namespace dashpot::board
