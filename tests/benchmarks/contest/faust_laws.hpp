// Faust's C++ of the networks in faust/: as it is made by default, for blocks, here of one sample, and as it is made
// for one sample at a time (-os). Faust has no way to refuse a sample, so that its inputs are looked at beforehand.
#pragma once

#ifdef DASHPOT_FAUST
#include <algorithm>
#include <cmath>
#include <type_traits>

// What Faust's classes expect around them, and no more of it than they use here.
#define FAUSTFLOAT double
struct Meta {
  void declare(const char*, const char*) {}
};
struct UI {
  void openVerticalBox(const char*) {}
  void closeBox() {}
};
struct one_sample_dsp {
  one_sample_dsp() = default;
  one_sample_dsp(int*, double*) {}
  virtual ~one_sample_dsp() = default;
  virtual void instanceInit(int) = 0;
};

struct dsp {
  virtual ~dsp() = default;
  virtual void instanceInit(int) = 0;
};

#include "faust_blocks_branches_512.hpp"
#include "faust_blocks_branches_64.hpp"
#include "faust_blocks_branches_8.hpp"
#include "faust_blocks_fig_5.hpp"
#include "faust_blocks_needle.hpp"
#include "faust_blocks_two_kelvins.hpp"
#include "faust_branches_512.hpp"
#include "faust_branches_64.hpp"
#include "faust_branches_8.hpp"
#include "faust_fig_5.hpp"
#include "faust_needle.hpp"
#include "faust_two_kelvins.hpp"
#include "guards.hpp"

namespace dashpot::contest {

// Where `Process` has two outputs, the first is the brake.
template <class Process>
struct faust_law {
  Process process;
  double brake;  // [N·s/m]

  explicit faust_law(double constant_brake) : brake(constant_brake) { process.init(1000); }

  command<double> step(double position, double velocity) noexcept {
    if (!is_finite(position) || !is_finite(velocity)) return {brake, 0};
    double inputs[2] = {position, velocity}, outputs[2] = {0, 0};
    if constexpr (std::is_base_of_v<one_sample_dsp, Process>) {
      process.compute(inputs, outputs, nullptr, nullptr);
    } else {
      double *input_blocks[2] = {&inputs[0], &inputs[1]}, *output_blocks[2] = {&outputs[0], &outputs[1]};
      process.compute(1, input_blocks, output_blocks);
    }
    return process.getNumOutputs() == 2 ? command<double>{outputs[0], outputs[1]} : command<double>{brake, outputs[0]};
  }
};

}  // namespace dashpot::contest
#endif
