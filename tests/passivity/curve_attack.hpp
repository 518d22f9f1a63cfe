// Laws behind static curves against motions within the range and the speed that a device states: the brake and the
// mechanics take what a constant damping takes at a constant speed over a hold.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "support/random.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::testing {

struct Loop {
  double period, jitter, speed, travel, brake;  // [s], [s], [m/s], [m] to either side, [N·s/m]
  unsigned delay;
  double force = 1e6;  // of the motor [N]
};

inline compiler::Device device_of(const Loop& loop, double damping) {
  const std::string text = fmt::format(
      R"({{ "dashpot_device": 1, "name": "rig", "motion": "translation",
           "loop": {{ "rate": "{:.17g} Hz", "jitter": {:.17g}, "delay_samples": {}, "band": ["0.1 Hz", "20 Hz"] }},
           "encoder": {{ "resolution": "1 um", "range": [{:.17g}, {:.17g}], "max_speed": {:.17g} }},
           "velocity": {{ "estimator": "backward_difference", "window": 4 }},
           "motor": {{ "max_torque": "{:.17g} N" }}{},
           "mechanics": {{ "inertia": "0.1 kg", "damping": {:.17g} }} }})",
      1 / loop.period, loop.jitter, loop.delay, -loop.travel, loop.travel, loop.speed, loop.force,
      loop.brake > 0
          ? fmt::format(R"(, "brake": {{ "kind": "eddy_current", "max_damping": {:.17g}, "tolerance": "10 %" }})",
                        loop.brake)
          : "",
      damping);
  compiler::Diagnostics diagnostics;
  const compiler::SourceFile file("rig.json", text);
  const std::optional<compiler::DeviceDecl> decl = compiler::parse_device(file, diagnostics);
  std::optional<compiler::Device> device = decl ? compiler::build_device(*decl, diagnostics) : std::nullopt;
  EXPECT_TRUE(device) << text;
  return *device;
}

struct Case {
  std::string network;
  Loop loop;
  bool in_contact;
};

// Of a power, an exponential or a table, that reaches its force at `at`.
inline std::string curve_of(std::uint64_t seed, Random& random, double at, double force) {
  switch (seed % 3) {
    case 0:
      return fmt::format(R"({{ "power": {:.6g}, "force": {:.9g}, "at": {:.9g} }})", random.uniform(1, 3), force, at);
    case 1:
      return fmt::format(R"({{ "exponential": {:.9g}, "force": {:.9g}, "at": {:.9g} }})", random.uniform(0.3, 5) / at,
                         force, at);
    default: {
      const double first = random.uniform(0.05, 0.4) * force, second = random.uniform(0.45, 0.8) * force;
      return fmt::format(R"({{ "table": [[0, 0], [{:.9g}, {:.9g}], [{:.9g}, {:.9g}], [{:.9g}, {:.9g}]] }})", 0.3 * at,
                         first, 0.7 * at, second, at, force);
    }
  }
}

inline compiler::Compilation on(const Case& one, double damping,
                                const decltype(compiler::Choices::decomposition)& without_brake = 0.0) {
  compiler::Diagnostics diagnostics;
  const compiler::SourceFile file("curved.json", one.network);
  compiler::Choices choices;
  if (one.loop.brake == 0) choices.decomposition = without_brake;
  std::optional<compiler::Compilation> c = compiler::compile(file, choices, device_of(one.loop, damping), diagnostics);
  EXPECT_TRUE(c) << one.network;
  return std::move(*c);
}

// The least of the energy that has gone in, with that stored at the beginning, and if nothing is late less what is
// stored now; and the largest amount that was exchanged in a period.
struct Balance {
  double least = 0, largest = 0;
};

constexpr int trembles = 400;

class Attack {
 public:
  Attack(const compiler::Compilation& c, const Loop& loop, double damping, double place = 0)
      : law_(c.law), loop_(loop), damping_(damping) {
    rest_at(place);
    for (unsigned i = 0; i < loop.delay; ++i) late_.push_back({0, 0});
  }

  // The tool goes there within one hold, as far as its speed lets it. `share`: what of its command the brake makes.
  void go(double wanted, double share = 1) {
    sample();
    move(wanted, share);
  }

  // Counts from the next sample on.
  void count_anew() { begins_ = true; }

  // To and fro from a place, by a part of what the speed lets it go in a hold.
  void tremble(double place, double part = 1) {
    const double most = part * loop_.speed * (loop_.period + loop_.jitter);
    for (int k = 0; k < trembles; ++k) go(place + (k % 2 == 0 ? most : 0));
  }

  // The tool goes where it takes most out of the command that is held, or a part of the way.
  void take(double part, double share = 1) {
    sample();
    const double hold = loop_.period + loop_.jitter, damping = damping_ + share * held_.damping;
    move(damping > 0 ? place_ - part * held_.force * hold / (2 * damping) : place_, share);
  }

  void rest_at(double place) {
    law_.reset(place_ = place);
    energy_ = law_.stored_energy();
  }

  // The certificate speaks of a brake that is on: with a delay the first command is late, and the tool waits for it.
  void wait() {
    for (unsigned i = 0; i < loop_.delay; ++i) go(place_);
  }

  // Between two samples.
  void set(const std::vector<double>& values) { law_.set(values); }

  double place() const { return place_; }
  const Balance& balance() const { return balance_; }

 private:
  void sample() {
    late_.push_back(law_.step(place_, 0));
    if (begins_) energy_ = law_.stored_energy(), balance_ = {}, begins_ = false;
    if (loop_.delay == 0) balance_.least = std::min(balance_.least, energy_ - law_.stored_energy());
    held_ = late_.front();
    late_.pop_front();
  }

  void move(double wanted, double share) {
    const double hold = loop_.period + loop_.jitter, most = loop_.speed * hold;
    const double next = std::clamp(std::clamp(wanted, place_ - most, place_ + most), -loop_.travel, loop_.travel);
    const double way = next - place_;
    const double given = held_.force * way, taken = (damping_ + share * held_.damping) * way * way / hold;
    energy_ += given + taken;
    balance_.least = std::min(balance_.least, energy_);
    balance_.largest = std::max({balance_.largest, std::abs(given), taken});
    place_ = next;
  }

  compiler::Evaluation<double> law_;
  Loop loop_;
  double damping_;
  std::deque<command<double>> late_;
  command<double> held_ = {};
  double place_ = 0, energy_ = 0;
  bool begins_ = false;
  Balance balance_;
};

// Begins at rest at a place, and trembles there.
inline Balance after_trembling(const compiler::Compilation& c, const Loop& loop, double damping, double place,
                               double part = 1) {
  Attack attack(c, loop, damping, place);
  attack.wait();
  attack.tremble(place, part);
  return attack.balance();
}

// Comes to a place from so far, by which slips give way, and trembles there: what goes in from then on.
inline Balance after_coming(const compiler::Compilation& c, const Loop& loop, double damping, double place, double from,
                            double part = 1) {
  place = std::clamp(place, -loop.travel, loop.travel);
  Attack attack(c, loop, damping, std::clamp(place + from, -loop.travel, loop.travel));
  attack.wait();
  while (attack.place() != place) attack.go(place);
  attack.tremble(place, part);
  attack.count_anew();
  attack.tremble(place, part);
  return attack.balance();
}

}  // namespace dashpot::testing
