// The reference firmware on an emulated MPS2+ AN386, its UART a Unix socket.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <dashpot/board/transport.hpp>

#include "child_process.hpp"
#include "support/temporary_folder.hpp"

namespace dashpot::board {

// A stream to the Unix socket that `server` is about to open. Throws when it ends before.
transport connect_to(const std::string& path, child_process& server);

class qemu_board {
 public:
  // Why there is none on this machine; empty where there is.
  static std::string missing();

  explicit qemu_board(const std::vector<std::string>& more_options = {}, const std::string& firmware = BOARD_FIRMWARE);
  transport connect() { return connect_to(socket(), process_); }

 private:
  std::string socket() const { return folder_.path() / "uart"; }
  std::vector<std::string> command(const std::vector<std::string>& more_options, const std::string& firmware) const;

  testing::TemporaryFolder folder_;
  child_process process_;
};

// Says so loudly, on the terminal as well as in the test's result.
void announce_skip(const std::string& reason);

}  // namespace dashpot::board

#define DASHPOT_SKIP_WITHOUT_QEMU()                                        \
  if (const std::string reason = qemu_board::missing(); !reason.empty()) { \
    announce_skip(reason);                                                 \
    GTEST_SKIP() << reason;                                                \
  }
