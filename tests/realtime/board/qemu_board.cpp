#include "qemu_board.hpp"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace dashpot::board {

transport connect_to(const std::string& path, child_process& server) {
  std::string error;
  while (!server.has_ended()) {
    if (auto opened = open_transport("unix:" + path, error)) return std::move(*opened);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("the peer has ended; " + error);
}

std::string qemu_board::missing() {
  if (std::string(QEMU).empty()) return "qemu-system-arm is not installed (package qemu-system-arm)";
  if (std::string(BOARD_FIRMWARE).empty())
    return "arm-none-eabi-g++ is not installed (packages gcc-arm-none-eabi, libstdc++-arm-none-eabi-newlib)";
  return {};
}

qemu_board::qemu_board(const std::vector<std::string>& more_options, const std::string& firmware)
    : process_(command(more_options, firmware)) {}

std::vector<std::string> qemu_board::command(const std::vector<std::string>& more_options,
                                             const std::string& firmware) const {
  std::vector<std::string> words = {QEMU,       "-M",    "mps2-an386", "-nographic",
                                    "-monitor", "none",  "-serial",    "unix:" + socket() + ",server=on,wait=off",
                                    "-kernel",  firmware};
  words.insert(words.end(), more_options.begin(), more_options.end());
  return words;
}

void announce_skip(const std::string& reason) {
  std::cerr << "\n**********************************************************************\n"
            << "NOT TESTED: " << reason << "\n"
            << "**********************************************************************\n\n";
}

}  // namespace dashpot::board
