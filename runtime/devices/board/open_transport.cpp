#include <dashpot/board/transport.hpp>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <netdb.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <dashpot/board/transport_url.hpp>

namespace dashpot::board {
namespace {

using result = std::optional<transport>;

// What went wrong in the last system call.
result refuse(std::string& error) {
  error = std::strerror(errno);
  return std::nullopt;
}

struct rate {
  unsigned baud;
  speed_t constant;
};

constexpr rate rates[] = {{9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},
                          {115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
                          {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
                          {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000},
                          {3500000, B3500000}, {4000000, B4000000}};

std::optional<speed_t> constant_of(unsigned baud) {
  for (const rate& known : rates) {
    if (known.baud == baud) return known.constant;
  }
  return std::nullopt;
}

// Raw: no echo, no translation, no flow control. One byte is enough for a read, so that "none yet" and "hung up"
// differ.
bool make_raw(int descriptor, speed_t speed) {
  termios settings = {};
  if (::tcgetattr(descriptor, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  return ::cfsetspeed(&settings, speed) == 0 && ::tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

// Owned from the start, so that every early return closes the descriptor. What waits from earlier sessions is dropped.
result open_one(const serial_url& url, std::string& error) {
  const auto speed = constant_of(url.baud);
  if (!speed) {
    error = std::to_string(url.baud) + " baud is none of the rates that a terminal knows, such as 115200 or 921600";
    return std::nullopt;
  }
  transport opened(::open(url.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), transport::kind::terminal);
  if (opened.descriptor() < 0 || !make_raw(opened.descriptor(), *speed)) return refuse(error);
  ::ioctl(opened.descriptor(), TIOCEXCL);
  ::tcflush(opened.descriptor(), TCIOFLUSH);
  return opened;
}

// Empty where there is none.
std::string far_end_of(int near_end) {
  char name[64] = {};
  const bool ready = near_end >= 0 && ::grantpt(near_end) == 0 && ::unlockpt(near_end) == 0;
  return ready && ::ptsname_r(near_end, name, sizeof name) == 0 ? name : std::string();
}

result open_one(const pty_url&, std::string& error) {
  const int descriptor = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  transport opened(descriptor, transport::kind::terminal, far_end_of(descriptor));
  if (opened.far_end().empty() || !make_raw(descriptor, B115200)) return refuse(error);
  return opened;
}

result open_one(const unix_url& url, std::string& error) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (url.path.size() >= sizeof address.sun_path) {
    error = "a Unix socket's path has at most " + std::to_string(sizeof address.sun_path - 1) + " characters";
    return std::nullopt;
  }
  std::memcpy(address.sun_path, url.path.data(), url.path.size());
  transport opened(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), transport::kind::stream_socket);
  const auto* where = reinterpret_cast<const sockaddr*>(&address);
  if (opened.descriptor() < 0 || ::connect(opened.descriptor(), where, sizeof address) != 0) return refuse(error);
  return opened;
}

struct free_addresses {
  void operator()(addrinfo* list) const noexcept { ::freeaddrinfo(list); }
};

result open_one(const udp_url& url, std::string& error) {
  addrinfo wanted = {};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int problem = ::getaddrinfo(url.host.c_str(), std::to_string(url.port).c_str(), &wanted, &found);
  if (problem != 0) {
    error = ::gai_strerror(problem);
    return std::nullopt;
  }
  const std::unique_ptr<addrinfo, free_addresses> addresses(found);
  const int type = SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC;
  transport opened(::socket(found->ai_family, type, found->ai_protocol), transport::kind::datagram_socket);
  const bool connected =
      opened.descriptor() >= 0 && ::connect(opened.descriptor(), found->ai_addr, found->ai_addrlen) == 0;
  return connected ? result(std::move(opened)) : refuse(error);
}

}  // namespace

std::optional<transport> open_transport(const std::string& url, std::string& error) {
  const auto parsed = parse_transport_url(url, error);
  if (!parsed) return std::nullopt;
  result opened = std::visit([&error](const auto& one) { return open_one(one, error); }, *parsed);
  if (!opened) error = "'" + url + "': " + error;
  return opened;
}

}  // namespace dashpot::board
