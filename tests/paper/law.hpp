// An update law that an experiment runs, whatever class it is of.
#pragma once

#include <dashpot/command.hpp>

#include <functional>
#include <memory>
#include <utility>

#include "maker.hpp"

namespace dashpot::paper {

class Law {
 public:
  virtual ~Law() = default;
  virtual void reset(double position) = 0;                               // at rest there [m]
  virtual command<double> output(double position, double velocity) = 0;  // [m], [m/s]
  virtual void update() = 0;                                             // after the command has left
};

// A new law for every run, and who wrote it.
struct LawMaker {
  Maker maker = Maker::by_hand;
  std::function<std::unique_ptr<Law>()> make;

  std::unique_ptr<Law> operator()() const { return make(); }
};

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

// Only dashpot writes for which device a class is certified.
template <class Type>
concept WrittenByDashpot = requires {
  typename Type::certified_for;
};

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

template <class Type>
inline constexpr Maker maker_of = WrittenByDashpot<Type> ? Maker::emitted : Maker::by_hand;
template <class Emitted>
inline constexpr Maker maker_of<WhileInside<Emitted>> = Maker::in_wall;

template <class Type>
LawMaker law_of() {
  return {maker_of<Type>, [] { return std::make_unique<LawOf<Type>>(); }};
}

// Of one that is made with values.
template <class Type>
LawMaker law_with(Type law) {
  return {maker_of<Type>, [law] { return std::make_unique<LawOf<Type>>(law); }};
}

}  // namespace dashpot::paper
