// The law as an object-oriented haptics library has it: a list of elements behind a virtual function, each with its
// constants worked out beforehand and its own state.
#pragma once

#include <memory>
#include <vector>

#include "guards.hpp"
#include "maxwell_networks.hpp"
#include "small_networks.hpp"

namespace dashpot::contest {

struct element {
  virtual ~element() = default;
  virtual void add(double position, double velocity, command<double>& sum) noexcept = 0;
};

struct spring_element : element {
  double stiffness;  // [N/m]
  explicit spring_element(double k) : stiffness(k) {}
  void add(double position, double, command<double>& sum) noexcept override { sum.force += stiffness * position; }
};

// (17) and (19) of one branch.
struct maxwell_element : element {
  double damping, decay, gain;  // B [N·s/m], a, a h [s]
  double x = 0;                 // [m]
  maxwell_element(double k, double b) : damping(b), decay(1 / (1 + k * period / b)), gain(decay * period) {}
  void add(double, double velocity, command<double>& sum) noexcept override {
    const double before = x;
    x = decay * awake(before) + gain * velocity;
    sum.force -= damping * (1 / period) * (x - before);
    sum.damping += damping;
  }
};

// (10) and (11).
struct kelvin_pair_element : element {
  static constexpr double rate = (two_kelvins::damping[0] + two_kelvins::damping[1]) / period;
  static constexpr double scale = 1 / (two_kelvins::stiffness[0] + two_kelvins::stiffness[1] + rate);
  double x = 0;  // [m]
  void add(double position, double velocity, command<double>& sum) noexcept override {
    const double before = x;
    x = (two_kelvins::stiffness[0] * position + two_kelvins::damping[0] * velocity + rate * awake(before)) * scale;
    sum.force += two_kelvins::stiffness[0] * (position - x) - two_kelvins::damping[0] * (1 / period) * (x - before);
    sum.damping += two_kelvins::damping[0];
  }
};

struct damper_element : element {
  void add(double, double, command<double>& sum) noexcept override { sum.damping += needle::damping[0]; }
};

// Spring, then slip beside damper: (21).
struct slip_element : element {
  static constexpr double reach = needle::yield_force / needle::stiffness;  // [m]
  double x = 0;                                                             // [m]
  void add(double position, double, command<double>& sum) noexcept override {
    double held = position - x;
    if (__builtin_fabs(held) > reach) {
      held = __builtin_copysign(reach, held);
      x = awake(position - held);
      sum.damping += needle::damping[1];
    }
    sum.force += needle::stiffness * held;
  }
};

using elements = std::vector<std::unique_ptr<element>>;

template <class Network>
elements elements_of() {
  elements all;
  all.push_back(std::make_unique<spring_element>(Network::static_stiffness));
  for (int i = 0; i < Network::size; ++i)
    all.push_back(std::make_unique<maxwell_element>(Network::stiffness(i), Network::damping(i)));
  return all;
}

template <>
inline elements elements_of<two_kelvins>() {
  elements all;
  all.push_back(std::make_unique<kelvin_pair_element>());
  return all;
}

template <>
inline elements elements_of<needle>() {
  elements all;
  all.push_back(std::make_unique<damper_element>());
  all.push_back(std::make_unique<slip_element>());
  return all;
}

template <class Network>
struct element_list {
  elements list = elements_of<Network>();

  command<double> step(double position, double velocity) noexcept {
    command<double> sum{0, 0};
    if (!is_finite(position) || !is_finite(velocity)) return sum;
    for (const auto& each : list) each->add(position, velocity, sum);
    return sum;
  }
};

}  // namespace dashpot::contest
