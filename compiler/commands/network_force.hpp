// The force of a network of one port itself along a motion, as no device makes it.
#pragma once

#include <dashpot/simulated/trajectory.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "commands/value_columns.hpp"
#include "decompose/choices.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// A motion from time 0, of pieces that are straight, or so short that they are as good as that; at rest before and
// after.
class Path {
 public:
  virtual ~Path() = default;

  virtual double at(std::size_t piece) const = 0;  // where it begins [s]
  // The last piece that has begun at a time, which is a sum of periods: what is as good as at a beginning is at it, so
  // that the velocity there is that of the piece that begins.
  virtual std::size_t piece(double time) const = 0;
  virtual simulated::motion_point point(double time) const = 0;
};

// A column of a recording, straight between its rows.
class RecordedPath : public Path {
 public:
  RecordedPath(const Motion& clock, const std::vector<double>& position);

  double end() const { return at(position_.size() - 1); }
  double at(std::size_t row) const override { return double(row) / rate_; }
  std::size_t piece(double time) const override;
  simulated::motion_point point(double time) const override;
  simulated::motion_point beginning(std::size_t row) const;     // of the piece behind it; at rest in the last
  std::optional<std::size_t> first_beyond(double speed) const;  // the first row behind which it is not within that

 private:
  const std::vector<double>& position_;
  double rate_;  // that the times mean, as far as their rounding leaves it open [Hz]
};

class NetworkForce {
 public:
  virtual ~NetworkForce() = default;

  virtual double force_at(double time) = 0;  // opposing the motion; times must not fall
};

// A linear network's force is its closed form; another's that of its own steps on an ideal device 32 times as often,
// all of it made by the motor. Refuses: what does not compile. What is given has to outlive the answer, but `values`.
class ReferenceForce {
 public:
  // Nothing, reported, where it is refused.
  static std::optional<ReferenceForce> of(const Compilation& compilation, const Choices& choices,
                                          Diagnostics& diagnostics);

  std::unique_ptr<NetworkForce> along(const Path& path, const ValueColumns& values) const;
  static double finest_period(const Compilation& compilation);  // of steps of its own [s]

 private:
  const Compilation* compilation_ = nullptr;
  std::shared_ptr<const Compilation> fine_;  // nothing where there is a closed form
};

}  // namespace dashpot::compiler
