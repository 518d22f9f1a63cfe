// An update law that an experiment runs, whatever class it is of.
#pragma once

#include <dashpot/command.hpp>

#include <functional>
#include <memory>

namespace dashpot::paper {

class Law {
 public:
  virtual ~Law() = default;
  virtual void reset(double position) = 0;                               // at rest there [m]
  virtual command<double> output(double position, double velocity) = 0;  // [m], [m/s]
  virtual void update() = 0;                                             // after the command has left
};

// A new law for every run.
using LawMaker = std::function<std::unique_ptr<Law>()>;

// A class that dashpot has emitted, or one written by hand in the same form.
template <class Emitted>
class LawOf final : public Law {
 public:
  explicit LawOf(Emitted law = {}) : law_(law) {}
  void reset(double position) override { law_.reset(position); }
  command<double> output(double position, double velocity) override { return law_.output(position, velocity); }
  void update() override { law_.update(); }

 private:
  Emitted law_;
};

template <class Emitted>
LawMaker law_of() {
  return [] { return std::make_unique<LawOf<Emitted>>(); };
}

// The wall of the literature (Rosenberg & Adelstein 1993; paper, 5.1): a law of the tissue alone, switched on while the
// tool is beyond the surface at 0, and off, its states at rest, elsewhere. It may pull.
template <class Emitted>
class WhileInside {
 public:
  void reset(double position) noexcept { law_.reset(position); }
  command<double> output(double position, double velocity) noexcept {
    inside_ = position > 0;
    if (inside_) return law_.output(position, velocity);
    law_.reset(0);
    return {0, 0};
  }
  void update() noexcept {
    if (inside_) law_.update();
  }

 private:
  Emitted law_;
  bool inside_ = false;
};

}  // namespace dashpot::paper
