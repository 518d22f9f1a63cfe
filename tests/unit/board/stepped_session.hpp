// Servo loop, driver and firmware in one thread and in simulated time: every run is the same, and takes none. A test
// may change what passes between the two, byte by byte.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <dashpot/board/board_device.hpp>

#include "in_process_board.hpp"
#include "stream_pair.hpp"

namespace dashpot::board {

using byte_string = std::vector<std::uint8_t>;

// What happens to the bytes of one period on their way. Called even where there are none.
using mischief = std::function<byte_string(byte_string)>;

inline std::uint64_t stepped_time = 0;  // of the host [ns]
inline std::uint64_t stepped_now() noexcept { return stepped_time; }

// A device of the servo loop.
template <class Model, class Plant = test_plant>
class stepped_session {
  static constexpr unsigned axes = Plant::axes;
  using types = loop_types<axes>;

 public:
  static constexpr std::uint64_t period = 1'000'000;  // [ns]

  explicit stepped_session(const typename types::description& described, board_options options = {},
                           const basic_board_facts<axes>& facts = facts_of_board_with<Plant>(),
                           const board_age& age = {}, std::uint64_t host_time = 77 * period)
      : host_side_(connected_pair()),
        board_side_(connected_pair()),
        driver((options.now = stepped_now, std::move(host_side_.near)), described, options),
        board(std::move(board_side_.far), facts, age) {
    stepped_time = host_time;
  }

  bool start(std::string& error) {
    return board.while_serving([&] { return driver.start(error); }, [&] { carry_as_it_is(); });
  }

  device_status write(const typename types::actuation& command) noexcept {
    const device_status status = driver.write(command);
    carry(host_side_.far, board_side_.near, down);
    board.serve();
    return status;
  }
  device_status read(typename types::sample& sample) noexcept {
    if (stepping_) {
      board.pass_period();
      stepped_time += period;
    }
    stepping_ = true;
    ++periods;
    carry(board_side_.near, host_side_.far, up);
    return driver.read(sample);
  }
  device_status reset() noexcept { return driver.reset(); }
  const char* cause() const noexcept { return driver.cause(); }
  const typename types::description& description() const noexcept { return driver.description(); }

 private:
  stream_pair host_side_;
  stream_pair board_side_;
  bool stepping_ = false;

 public:
  mischief down;  // host → board
  mischief up;    // board → host
  basic_board_device<axes> driver;
  in_process_board<Model, Plant> board;
  std::uint64_t periods = 0;  // that the loop has read

 private:
  static void carry(transport& from, transport& to, const mischief& way) {
    byte_string bytes;
    std::uint8_t some[4096];
    while (const std::size_t count = from.read(some, sizeof some)) bytes.insert(bytes.end(), some, some + count);
    if (way) bytes = way(std::move(bytes));
    to.write(bytes.data(), bytes.size());
  }
  void carry_as_it_is() {
    carry(host_side_.far, board_side_.near, {});
    carry(board_side_.near, host_side_.far, {});
  }
};

// A spring that is relaxed where it was reset, so that its force does not depend on where the counter began.
template <class Scalar>
struct spring_from_start {
  using scalar = Scalar;
  static constexpr scalar sample_period = scalar(0.001);
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  using certified_for = generated::stand_in_model::certified_for;
  static constexpr scalar stiffness = 1000;  // [N/m]

  void reset(scalar position) noexcept { rest_ = position_ = position; }
  command<scalar> output(scalar position, scalar) noexcept {
    position_ = position;
    return {5, stiffness * (position - rest_)};
  }
  void update() noexcept {}
  command<scalar> step(scalar position, scalar velocity) noexcept { return output(position, velocity); }
  scalar stored_energy() const noexcept { return stiffness / 2 * (position_ - rest_) * (position_ - rest_); }

 private:
  scalar rest_ = 0;      // [m]
  scalar position_ = 0;  // [m]
};

}  // namespace dashpot::board
