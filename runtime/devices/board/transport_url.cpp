#include <dashpot/board/transport_url.hpp>

#include <charconv>
#include <limits>
#include <string_view>

namespace dashpot::board {
namespace {

using parsed = std::optional<transport_url>;

// All of `digits` as a number from 1 to `most`.
std::optional<unsigned> whole_number(std::string_view digits, unsigned most) {
  unsigned value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool all_read = problem == std::errc() && end == digits.data() + digits.size();
  return all_read && value >= 1 && value <= most ? std::optional(value) : std::nullopt;
}

parsed refuse(std::string_view seen, const char* expected, std::string& error) {
  error = "'" + std::string(seen) + "': " + expected;
  return std::nullopt;
}

parsed parse_serial(std::string_view text, std::string_view rest, std::string& error) {
  const auto mark = rest.find('?');
  serial_url url;
  url.path = rest.substr(0, mark);
  if (url.path.empty()) return refuse(text, "a serial port needs a path, as in serial:/dev/ttyACM0", error);
  if (mark == std::string_view::npos) return url;
  const std::string_view option = rest.substr(mark + 1);
  const auto baud =
      option.substr(0, 5) == "baud=" ? whole_number(option.substr(5), std::numeric_limits<int>::max()) : std::nullopt;
  if (!baud) return refuse(text, "behind the '?' comes baud= and a number", error);
  url.baud = *baud;
  return url;
}

parsed parse_unix(std::string_view text, std::string_view rest, std::string& error) {
  if (rest.empty()) return refuse(text, "a Unix socket needs a path, as in unix:/run/board.sock", error);
  return unix_url{std::string(rest)};
}

// "[::1]" without its brackets, other hosts as they are.
std::string_view bare_host(std::string_view host) {
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return bracketed ? host.substr(1, host.size() - 2) : host;
}

parsed parse_udp(std::string_view text, std::string_view rest, std::string& error) {
  const auto colon = rest.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return refuse(text, "expected udp:host:port", error);
  const auto port = whole_number(rest.substr(colon + 1), 65535);
  if (!port) return refuse(text, "a port is a number from 1 to 65535", error);
  return udp_url{std::string(bare_host(rest.substr(0, colon))), static_cast<std::uint16_t>(*port)};
}

}  // namespace

std::optional<transport_url> parse_transport_url(const std::string& text, std::string& error) {
  const std::string_view all = text;
  const auto colon = all.find(':');
  const std::string_view scheme = all.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view() : all.substr(colon + 1);
  if (colon != std::string_view::npos) {
    if (scheme == "serial") return parse_serial(all, rest, error);
    if (scheme == "unix") return parse_unix(all, rest, error);
    if (scheme == "udp") return parse_udp(all, rest, error);
    if (scheme == "pty" && rest.empty()) return pty_url{};
  }
  return refuse(all, "expected serial:path?baud=number, pty:, unix:path or udp:host:port", error);
}

}  // namespace dashpot::board
