#include <dashpot/board/transport.hpp>

#include <cstdlib>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "stream_pair.hpp"
#include "support/temporary_folder.hpp"

namespace dashpot::board {
namespace {

transport opened(const std::string& url) {
  std::string error;
  auto stream = open_transport(url, error);
  if (!stream) throw std::runtime_error(error);
  return std::move(*stream);
}

std::string reason(const std::string& url) {
  std::string error;
  EXPECT_FALSE(open_transport(url, error)) << url;
  return error;
}

// All 256 byte values, both ways: a terminal that is not raw would translate, echo or swallow some.
void expect_transparent(transport& near, transport& far) {
  std::vector<std::uint8_t> all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  for (auto [from, to] : {std::pair(&near, &far), std::pair(&far, &near)}) {
    ASSERT_EQ(from->write(all.data(), all.size()), all.size());
    std::vector<std::uint8_t> got;
    std::uint8_t bytes[64];
    while (got.size() < all.size()) {
      to->wait_readable(1000);
      const std::size_t count = to->read(bytes, sizeof bytes);
      ASSERT_NE(count, 0U) << "after " << got.size() << " bytes";
      got.insert(got.end(), bytes, bytes + count);
    }
    EXPECT_EQ(got, all);
  }
  std::uint8_t more = 0;
  EXPECT_EQ(near.read(&more, 1), 0U);
  EXPECT_FALSE(near.closed());
}

// Serial ports and pseudo-terminals go through the same line discipline.
TEST(Transport, SerialAndPtyAreTransparent) {
  transport near = opened("pty:");
  std::uint8_t none = 0;
  EXPECT_EQ(near.read(&none, 1), 0U);
  EXPECT_FALSE(near.closed()) << "nobody has opened the far end yet";
  transport far = opened("serial:" + near.far_end() + "?baud=921600");
  expect_transparent(near, far);
}

// The path that QEMU and the second peer are reached on.
TEST(Transport, UnixSocketIsTransparent) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.path() / "s";
  const int listening = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(listening, 1), 0);
  transport near = opened("unix:" + path);
  transport far(::accept4(listening, nullptr, nullptr, SOCK_NONBLOCK), transport::kind::stream_socket);
  ::close(listening);
  expect_transparent(near, far);
}

// A board on Ethernet; a port that nobody listens on yet must not end the session.
TEST(Transport, UdpIsTransparentAndOutlivesRefusal) {
  const int bound = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  sockaddr_in here = {};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  ASSERT_EQ(::bind(bound, reinterpret_cast<const sockaddr*>(&here), size), 0);
  ASSERT_EQ(::getsockname(bound, reinterpret_cast<sockaddr*>(&here), &size), 0);

  transport near = opened("udp:127.0.0.1:" + std::to_string(ntohs(here.sin_port)));
  const std::uint8_t one = 1;
  ASSERT_EQ(near.write(&one, 1), 1U);
  sockaddr_in peer = {};
  socklen_t peer_size = sizeof peer;
  std::uint8_t got = 0;
  ASSERT_EQ(::recvfrom(bound, &got, 1, 0, reinterpret_cast<sockaddr*>(&peer), &peer_size), 1);
  ASSERT_EQ(::connect(bound, reinterpret_cast<const sockaddr*>(&peer), peer_size), 0);
  {
    transport far(bound, transport::kind::datagram_socket);
    std::uint8_t datagram[256] = {9, 8, 7};
    EXPECT_EQ(near.write(datagram, 3), 3U);
    EXPECT_EQ(far.read(datagram, sizeof datagram), 3U);
    EXPECT_EQ(far.write(datagram, 2), 2U);
    EXPECT_EQ(near.read(datagram, sizeof datagram), 2U);
  }
  for (int i = 0; i < 3; ++i) {
    near.write(&one, 1);
    near.read(&got, 1);
  }
  EXPECT_FALSE(near.closed());
}

// The loop learns from closed() that the board is gone; SIGPIPE would end the process instead.
TEST(Transport, NoticesThatTheOtherEndHungUp) {
  stream_pair reading = connected_pair();
  { const transport gone = std::move(reading.far); }
  std::uint8_t byte = 0;
  EXPECT_EQ(reading.near.read(&byte, 1), 0U);
  EXPECT_TRUE(reading.near.closed());

  stream_pair writing = connected_pair();
  { const transport gone = std::move(writing.far); }
  EXPECT_EQ(writing.near.write(&byte, 1), 0U);
  EXPECT_TRUE(writing.near.closed());

  transport near = opened("pty:");
  { const transport far = opened("serial:" + near.far_end()); }
  EXPECT_EQ(near.read(&byte, 1), 0U);
  EXPECT_TRUE(near.closed());
}

// A full stream takes what it can and says so; waiting would stop the loop.
TEST(Transport, DoesNotWaitForAFullStream) {
  stream_pair ends = connected_pair();
  const std::vector<std::uint8_t> much(1 << 20);
  std::size_t taken = 0;
  while (const std::size_t count = ends.near.write(much.data(), much.size())) taken += count;
  EXPECT_GT(taken, 0U);
  EXPECT_FALSE(ends.near.closed());
}

// A user who gets the path or the rate wrong must read which, and why.
TEST(Transport, SaysWhyItDoesNotOpen) {
  EXPECT_EQ(reason("serial:/nowhere/tty"), "'serial:/nowhere/tty': No such file or directory");
  EXPECT_EQ(reason("serial:/dev/null"), "'serial:/dev/null': Inappropriate ioctl for device");
  EXPECT_EQ(
      reason("serial:/dev/null?baud=12345"),
      "'serial:/dev/null?baud=12345': 12345 baud is none of the rates that a terminal knows, such as 115200 or 921600");
  EXPECT_EQ(reason("unix:/nowhere/s"), "'unix:/nowhere/s': No such file or directory");
  const std::string too_long = "unix:/" + std::string(200, 'x');
  EXPECT_EQ(reason(too_long), "'" + too_long + "': a Unix socket's path has at most 107 characters");
  EXPECT_EQ(reason("nonsense").substr(0, 21), "'nonsense': expected ");
}

// Moving must hand the descriptor over, neither leak nor close it twice.
TEST(Transport, Moves) {
  stream_pair ends = connected_pair();
  transport moved = std::move(ends.near);
  const std::uint8_t one = 1;
  EXPECT_EQ(moved.write(&one, 1), 1U);
  stream_pair others = connected_pair();
  const int old = others.near.descriptor();
  others.near = std::move(moved);
  EXPECT_EQ(others.near.write(&one, 1), 1U);
  EXPECT_NE(others.near.descriptor(), old);
  std::uint8_t got[4];
  EXPECT_EQ(ends.far.read(got, sizeof got), 2U);
}

// An empty datagram is legal, and says nothing about those behind it: taken for the end, each would cost a period's
// sample.
TEST(Transport, ReadsOnBehindEmptyDatagrams) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends), 0);
  transport near(ends[0], transport::kind::datagram_socket), far(ends[1], transport::kind::datagram_socket);
  const std::uint8_t said[] = {1, 2, 3};
  for (int i = 0; i < 5; ++i) ASSERT_EQ(::send(far.descriptor(), said, 0, 0), 0);
  far.write(said, sizeof said);
  std::uint8_t bytes[transport::max_datagram];
  EXPECT_EQ(near.read(bytes, sizeof bytes), sizeof said);
  EXPECT_EQ(near.read(bytes, sizeof bytes), 0U);
  EXPECT_FALSE(near.closed());
}

}  // namespace
}  // namespace dashpot::board
