// A Hertz contact whose tissue relaxes, by a law with a static curve, against its closed form: at rest F (u/d)^p, after
// a step that times the network's relaxation, and a brake that follows √u.
#pragma once

#include <vector>

#include "page.hpp"

namespace dashpot::paper {

struct Hertz {
  struct Rest {
    double depth, force, closed_form;  // [m], [N]
    double damping, damping_expected;  // of the brake [N·s/m]
  };
  struct Step {
    double depth;                                  // [m]
    std::vector<double> time, force, closed_form;  // [s], [N]
  };
  std::vector<Rest> rest;   // by ascending depth
  std::vector<Step> steps;  // within one sample, then held

  double largest_force() const { return rest.back().closed_form; }
  double static_error() const;   // largest, of the largest force [1]
  double damping_error() const;  // largest, of the largest damping [1]
  double step_error() const;     // largest of all steps, of the force at the law's own curve at rest [1]
};

Hertz measure_hertz();
Section show(const Hertz& hertz);

}  // namespace dashpot::paper
