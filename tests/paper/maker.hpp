// By what a curve was made. The page is about emitted code: what another code made says so in the legend.
#pragma once

namespace dashpot::paper {

enum class Maker : unsigned char {
  emitted,      // a class that dashpot wrote, on the simulated device or under a given motion
  in_wall,      // such a class, switched on and off by a wall written here
  evaluated,    // the compiler's own evaluation of a law, which gives the emitted code's bits (tests/agreement)
  by_hand,      // a law written here from the paper's equations
  closed_form,  // the solution of the network's differential equation
  device,       // the simulated device alone: its motion, its encoder
  runtime,      // an estimator of the runtime
  offline,      // computed from a record, with filters that look into the future
  analysis,     // the compiler's analysis in frequency, or its certificate
  mark,         // nobody: a value to compare with
};

// Behind the name in a legend; "" for emitted code.
constexpr const char* label_of(Maker maker) {
  switch (maker) {
    case Maker::emitted: return "";
    case Maker::in_wall: return " [wall by hand]";
    case Maker::evaluated: return " [evaluated]";
    case Maker::by_hand: return " [by hand]";
    case Maker::closed_form: return " [closed form]";
    case Maker::device: return " [device]";
    case Maker::runtime: return " [runtime]";
    case Maker::offline: return " [offline]";
    case Maker::analysis: return " [analysis]";
    case Maker::mark: return " [mark]";
  }
  return "";
}

}  // namespace dashpot::paper
