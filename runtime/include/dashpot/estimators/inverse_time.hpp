// Velocity from the times of encoder edges:
//     v̂ = n Δ / (t_last − t_first)
// n counts after the newest edge of the sample before (t_first), n signed, at the newest edge of this one (t_last).
// A sample without a new edge keeps the estimate, as far as |v̂| ≤ Δ/(t − t_last) allows: a faster tool would have
// crossed the next edge. The sign is wrong from a reversal to the first edge after it (paper, section 2.1), and at
// rest the estimate decays as Δ/(t − t_last) and is never exactly 0.
// Not linear. Delay: the spacing of the edges, or half of it plus T/2 where edges come faster than samples.
#pragma once

#include <cstdint>

#include <dashpot/estimators/signs.hpp>

namespace dashpot {

template <class Scalar>
class inverse_time {
 public:
  // `step` Δ of the encoder [m] or [rad] > 0; `sample_period` T [s] > 0.
  constexpr inverse_time(double step, double sample_period) noexcept
      : step_(static_cast<Scalar>(step)), encoder_step_(step), sample_period_(sample_period) {}

  // At rest there; the edge before the next sample is taken as the first one.
  void reset(Scalar position) noexcept {
    edge_position_ = position;
    velocity_ = 0;
    started_ = false;
  }

  // Finite position [m] or [rad], device clock at the newest edge (0: not measured, the sample's own time stands in)
  // and at the sample [ns] → velocity [m/s] or [rad/s]. An edge time that runs backwards is no new edge.
  Scalar update(Scalar position, std::uint64_t edge_time_ns, std::uint64_t timestamp_ns) noexcept {
    const std::uint64_t newest_edge_ns = newest_edge(position, edge_time_ns, timestamp_ns);
    if (!started_) start(position, newest_edge_ns);
    else if (is_after(newest_edge_ns, edge_time_ns_)) cross(position, newest_edge_ns);
    else if (is_after(timestamp_ns, edge_time_ns_))
      velocity_ = clamp_magnitude(velocity_, step_ / seconds(timestamp_ns - edge_time_ns_));
    return velocity_;
  }

  // Mean delay at a steady `speed` [m/s] or [rad/s], and at the speed of one count a sample [s].
  constexpr double delay_at(double speed) const noexcept {
    const double spacing = encoder_step_ / magnitude(speed);
    return spacing > sample_period_ ? spacing : (sample_period_ + spacing) / 2;
  }
  constexpr double delay() const noexcept { return sample_period_; }

 private:
  // Also where the clock has wrapped around in between.
  static bool is_after(std::uint64_t time_ns, std::uint64_t other_ns) noexcept {
    return static_cast<std::int64_t>(time_ns - other_ns) > 0;
  }

  static Scalar seconds(std::uint64_t nanoseconds) noexcept {
    return static_cast<Scalar>(nanoseconds) * static_cast<Scalar>(1e-9);
  }

  std::uint64_t newest_edge(Scalar position, std::uint64_t edge_time_ns, std::uint64_t timestamp_ns) const noexcept {
    if (edge_time_ns != 0) return edge_time_ns;
    return started_ && position == edge_position_ ? edge_time_ns_ : timestamp_ns;
  }

  void start(Scalar position, std::uint64_t newest_edge_ns) noexcept {
    edge_position_ = position;
    edge_time_ns_ = newest_edge_ns;
    started_ = true;
  }

  void cross(Scalar position, std::uint64_t newest_edge_ns) noexcept {
    velocity_ = (position - edge_position_) / seconds(newest_edge_ns - edge_time_ns_);
    edge_position_ = position;
    edge_time_ns_ = newest_edge_ns;
  }

  Scalar step_;                     // Δ [m] or [rad]
  double encoder_step_;             // Δ [m] or [rad]
  double sample_period_;            // T [s]
  std::uint64_t edge_time_ns_ = 0;  // t_last on the device clock [ns]
  Scalar edge_position_ = 0;        // [m] or [rad]
  Scalar velocity_ = 0;             // [m/s] or [rad/s]
  bool started_ = false;
};

}  // namespace dashpot
