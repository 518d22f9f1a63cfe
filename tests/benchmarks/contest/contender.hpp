// A way to compute a law, behind three function pointers: whoever measures them runs the same machine code for all.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dashpot/command.hpp>

namespace dashpot::contest {

using step_function = command<double> (*)(void* law, double position, double velocity);

struct contender {
  std::string network, name;
  std::shared_ptr<void> (*make)() = nullptr;
  step_function step = nullptr;         // a whole tick, fused where there is no update
  step_function output = nullptr;       // up to the command; the same as `step` where the law has no second phase
  void (*update)(void* law) = nullptr;  // what is left; nullptr: nothing
};

// Measured in the same way and taken off: hands its input through.
contender nothing();

std::vector<contender> all_contenders();

template <class Law>
command<double> step_of(void* law, double position, double velocity) {
  return static_cast<Law*>(law)->step(position, velocity);
}

template <class Law>
command<double> output_of(void* law, double position, double velocity) {
  return static_cast<Law*>(law)->output(position, velocity);
}

template <class Law>
void update_of(void* law) {
  static_cast<Law*>(law)->update();
}

template <class Law>
contender fused(std::string network, std::string name) {
  return {std::move(network), std::move(name), [] { return std::shared_ptr<void>(std::make_shared<Law>()); },
          step_of<Law>,       step_of<Law>,    nullptr};
}

// The command first, the states when it has left.
template <class Law>
contender split(std::string network, std::string name) {
  contender c = fused<Law>(std::move(network), std::move(name));
  c.output = output_of<Law>;
  c.update = update_of<Law>;
  return c;
}

}  // namespace dashpot::contest
