// An open byte stream to a board or to a peer in its place. Reading and writing neither block nor allocate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace dashpot::board {

class transport {
 public:
  enum class kind : unsigned char { terminal, stream_socket, datagram_socket };

  // Takes over the descriptor, which must not block.
  transport(int descriptor, kind what, std::string far_end = {}) noexcept;
  transport(transport&& other) noexcept;
  transport& operator=(transport&& other) noexcept;
  ~transport();

  // How many bytes came or left: 0 where none can at the moment or the stream is closed. A datagram leaves whole or not
  // at all, and needs room for all of it when it is read (max_datagram).
  std::size_t read(std::uint8_t* into, std::size_t room) noexcept;
  std::size_t write(const std::uint8_t* bytes, std::size_t count) noexcept;

  // The other end hung up, or the device was pulled out. Datagram sockets never notice.
  bool closed() const noexcept { return closed_; }

  // Blocks until something can be read or the time is over. Not for the loop.
  void wait_readable(int milliseconds) const noexcept;

  int descriptor() const noexcept { return descriptor_; }  // stays ours; for poll() beside others

  // The path that a peer opens as "serial:" to be the other end of a "pty:"; empty for the others.
  const std::string& far_end() const noexcept { return far_end_; }

  static constexpr std::size_t max_datagram = 2048;  // [bytes]

 private:
  std::size_t moved(std::ptrdiff_t result, bool zero_is_the_end) noexcept;
  void close() noexcept;

  int descriptor_;
  kind kind_;
  bool closed_ = false;
  std::string far_end_;
};

// Opens what transport_url.hpp describes. Empty where that fails; `error` then says why, naming the URL.
std::optional<transport> open_transport(const std::string& url, std::string& error);

}  // namespace dashpot::board
