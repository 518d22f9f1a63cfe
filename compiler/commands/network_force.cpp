#include "commands/network_force.hpp"

#include <algorithm>
#include <cmath>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "network/rate_limits.hpp"
#include "source/errors_alone.hpp"

namespace dashpot::compiler {
namespace {

constexpr double finer_steps = 32;  // of a reference that has no closed form, in a period of the loop

// k0 u + b∞ u̇ + Σ F_i of a linear network under the motion, exactly: F_i decays, and along a straight piece it gains
// B_i u̇ (1 − e^(−λ t)) (theory, section 3).
class ClosedForm : public NetworkForce {
 public:
  ClosedForm(const LinearForm& form, const Path& path)
      : path_(path),
        static_stiffness_(to_double(form.static_stiffness)),
        feedthrough_(to_double(form.feedthrough_damping)) {
    for (const Mode& mode : form.modes)
      modes_.push_back({to_double(mode.relaxation_rate), to_double(mode.damping()), 0});
  }

  double force_at(double time) override {
    while (next_piece_ < path_.piece(time) + 1) go_to(path_.at(next_piece_++));
    go_to(time);
    const simulated::motion_point here = path_.point(time);
    double force = static_stiffness_ * here.position + feedthrough_ * here.velocity;
    for (const Relaxation& mode : modes_) force += mode.force;
    return force;
  }

 private:
  struct Relaxation {
    double rate, damping, force;
  };

  void go_to(double time) {
    const double duration = time - time_;
    if (!(duration > 0)) return;
    const double velocity = path_.point(time_ + duration / 2).velocity;
    for (Relaxation& mode : modes_) {
      const double lost = -std::expm1(-mode.rate * duration);
      mode.force += (mode.damping * velocity - mode.force) * lost;
    }
    time_ = time;
  }

  const Path& path_;
  double static_stiffness_, feedthrough_;
  std::vector<Relaxation> modes_;
  double time_ = 0;
  std::size_t next_piece_ = 1;
};

// The force of a network with slips, a contact, a static curve or tunables, by its own steps in quick succession, all
// of it made by the motor: no brake and no estimate take part. Between two steps it is straight.
class OwnSteps : public NetworkForce {
 public:
  OwnSteps(const Compilation& fine, const ValueColumns& values, const Path& path)
      : path_(path), law_(fine.law), values_(values), period_(1 / fine.rate) {
    law_.reset(path.point(0).position);
    last_ = force_ = step();
  }

  double force_at(double time) override {
    while (double(steps_) * period_ < time) {
      last_ = force_;
      ++steps_;
      force_ = step();
    }
    const double behind = std::clamp(double(steps_) - time / period_, 0.0, 1.0);
    return force_ + (last_ - force_) * behind;
  }

 private:
  double step() {
    const double time = double(steps_) * period_;
    values_.set(law_, path_.piece(time));
    const double position = path_.point(time).position;
    const double velocity = steps_ == 0 ? 0 : (position - position_) / period_;
    position_ = position;
    const command<double> now = law_.step(position, velocity);
    return now.damping * velocity + now.force;
  }

  const Path& path_;
  Evaluation<double> law_;
  const ValueColumns values_;
  double period_, position_ = 0, last_ = 0, force_ = 0;
  std::uint64_t steps_ = 0;
};

std::optional<Compilation> compiled_finely(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  Choices fine = choices;
  fine.decomposition = "virtual";
  fine.state_input.reset();
  fine.scheme = Scheme::exact;
  fine.scalar = ScalarType::float64;
  fine.rate = std::min(c.rate * finer_steps, highest_rate);
  StageTimes unseen;
  return with_errors_alone(diagnostics,
                           [&](Diagnostics& own) { return compile(c.network, fine, std::nullopt, own, unseen); });
}

}  // namespace

RecordedPath::RecordedPath(const Motion& clock, const std::vector<double>& position) : position_(position), rate_(1) {
  if (!clock.period) return;
  const double meant = rate_meant(clock);
  rate_ = std::abs(1 / meant - *clock.period) <= clock.period_error ? meant : 1 / *clock.period;
}

std::size_t RecordedPath::piece(double time) const {
  return std::size_t(std::clamp(std::floor(time * rate_ + 1e-6), 0.0, double(position_.size() - 1)));
}

simulated::motion_point RecordedPath::beginning(std::size_t row) const {
  if (row + 1 == position_.size()) return {position_[row], 0};
  return {position_[row], (position_[row + 1] - position_[row]) * rate_};
}

simulated::motion_point RecordedPath::point(double time) const {
  const std::size_t row = piece(time);
  const simulated::motion_point begun = beginning(row);
  if (time < 0 || row + 1 == position_.size()) return {begun.position, 0};
  return {begun.position + begun.velocity * (time - at(row)), begun.velocity};
}

std::optional<std::size_t> RecordedPath::first_beyond(double speed) const {
  for (std::size_t row = 0; row < position_.size(); ++row)
    if (!(std::abs(beginning(row).velocity) <= speed)) return row;
  return std::nullopt;
}

std::optional<ReferenceForce> ReferenceForce::of(const Compilation& c, const Choices& choices,
                                                 Diagnostics& diagnostics) {
  ReferenceForce reference;
  reference.compilation_ = &c;
  if (!c.beyond_linear()) return reference;
  std::optional<Compilation> fine = compiled_finely(c, choices, diagnostics);
  if (!fine) return std::nullopt;
  reference.fine_ = std::make_shared<const Compilation>(std::move(*fine));
  return reference;
}

std::unique_ptr<NetworkForce> ReferenceForce::along(const Path& path, const ValueColumns& values) const {
  if (fine_) return std::make_unique<OwnSteps>(*fine_, values, path);
  return std::make_unique<ClosedForm>(compilation_->form.linear, path);
}

double ReferenceForce::finest_period(const Compilation& c) { return 1 / std::min(c.rate * finer_steps, highest_rate); }

}  // namespace dashpot::compiler
