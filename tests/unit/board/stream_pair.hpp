// Two ends of one stream inside this process.
#pragma once

#include <stdexcept>

#include <sys/socket.h>

#include <dashpot/board/transport.hpp>

namespace dashpot::board {

struct stream_pair {
  transport near;
  transport far;
};

inline stream_pair connected_pair() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error("socketpair");
  return {transport(ends[0], transport::kind::stream_socket), transport(ends[1], transport::kind::stream_socket)};
}

}  // namespace dashpot::board
