#include <dashpot/board/transport.hpp>

#include <cerrno>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace dashpot::board {

transport::transport(int descriptor, kind what, std::string far_end) noexcept
    : descriptor_(descriptor), kind_(what), far_end_(std::move(far_end)) {}

transport::transport(transport&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      kind_(other.kind_),
      closed_(other.closed_),
      far_end_(std::move(other.far_end_)) {}

transport& transport::operator=(transport&& other) noexcept {
  if (this == &other) return *this;
  close();
  descriptor_ = std::exchange(other.descriptor_, -1);
  kind_ = other.kind_;
  closed_ = other.closed_;
  far_end_ = std::move(other.far_end_);
  return *this;
}

transport::~transport() { close(); }

std::size_t transport::read(std::uint8_t* into, std::size_t room) noexcept {
  if (closed_ || room == 0) return 0;
  std::ptrdiff_t result = ::read(descriptor_, into, room);
  // An empty datagram does not mean that nothing waits behind it. The tries are bounded: somebody may send nothing
  // else.
  for (int more = 15; more > 0 && result == 0 && kind_ == kind::datagram_socket; --more)
    result = ::read(descriptor_, into, room);
  return moved(result, kind_ != kind::datagram_socket);
}

// A socket whose other end is gone must not raise SIGPIPE.
std::size_t transport::write(const std::uint8_t* bytes, std::size_t count) noexcept {
  if (closed_ || count == 0) return 0;
  if (kind_ == kind::terminal) return moved(::write(descriptor_, bytes, count), false);
  return moved(::send(descriptor_, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT), false);
}

void transport::wait_readable(int milliseconds) const noexcept {
  pollfd watched = {descriptor_, POLLIN, 0};
  ::poll(&watched, 1, milliseconds);
}

// A refused datagram says that nobody listens yet, not that nobody ever will.
std::size_t transport::moved(std::ptrdiff_t result, bool zero_is_the_end) noexcept {
  if (result > 0) return static_cast<std::size_t>(result);
  if (result == 0) {
    closed_ = zero_is_the_end;
    return 0;
  }
  const bool passing = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ENOBUFS;
  closed_ = !passing && !(kind_ == kind::datagram_socket && errno == ECONNREFUSED);
  return 0;
}

void transport::close() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace dashpot::board
