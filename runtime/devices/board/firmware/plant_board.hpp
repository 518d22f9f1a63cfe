// A board without motors, brakes and encoders, and a test plant in place of them. With real ones, a class of the same
// functions reads and drives those.
#pragma once

#include <cstdint>

#include "encoder_reading.hpp"
#include "test_arm.hpp"
#include "test_plant.hpp"

namespace dashpot::board {

template <class Board, class Plant>
class plant_board : public Board {
  static constexpr unsigned axes = Plant::axes;

 public:
  basic_encoder_reading<axes> read_encoder() noexcept {
    basic_encoder_reading<axes> reading;
    for (unsigned j = 0; j < axes; ++j) {
      nth(reading.counts, j) = plant_.counts(j);
      nth(reading.edge_time, j) = edge_time_[j];
    }
    reading.timestamp = Board::now();
    return reading;
  }

  void drive(const basic_outputs<axes>& wanted) noexcept { driven_ = wanted; }

  // The plant begins anew.
  void set_period(std::uint32_t nanoseconds) noexcept {
    period_ = static_cast<float>(nanoseconds) * 1e-9F;
    plant_ = Plant();
    Board::set_period(nanoseconds);
  }

  // Where periods have ended the plant makes one step.
  unsigned periods_passed() noexcept {
    const unsigned passed = Board::periods_passed();
    if (passed != 0) advance();
    return passed;
  }

 private:
  void advance() noexcept {
    std::int32_t before[axes];
    for (unsigned j = 0; j < axes; ++j) before[j] = plant_.counts(j);
    plant_.advance(driven_, period_);
    const std::uint64_t time = Board::now();
    for (unsigned j = 0; j < axes; ++j)
      if (plant_.counts(j) != before[j]) edge_time_[j] = time;
  }

  Plant plant_;
  basic_outputs<axes> driven_;
  float period_ = 0.001F;               // [s]
  std::uint64_t edge_time_[axes] = {};  // [ns]
};

}  // namespace dashpot::board
