// The reference firmware. Built with DASHPOT_BOARD_MODEL_HEADER and DASHPOT_BOARD_MODEL_CLASS it can run that emitted
// model itself, on the velocities that DASHPOT_BOARD_VELOCITY describes, and has as many axes as the model; built
// without them it serves the host only, with DASHPOT_BOARD_AXES axes.
#include "application.hpp"
#include "mps2_an386.hpp"
#include "plant_board.hpp"
#include "step_cost.hpp"

#ifdef DASHPOT_BOARD_MODEL_HEADER
#include DASHPOT_BOARD_MODEL_HEADER
#endif
#ifndef DASHPOT_BOARD_VELOCITY
#define DASHPOT_BOARD_VELOCITY dashpot::velocity_description()
#endif
#ifndef DASHPOT_BOARD_AXES
#define DASHPOT_BOARD_AXES 1
#endif

namespace {

using namespace dashpot::board;

constexpr dashpot::velocity_description velocity = DASHPOT_BOARD_VELOCITY;

template <unsigned Axes>
struct reference;

template <>
struct reference<1> {
  using plant = test_plant;
  static constexpr board_facts facts = {
      {plant::encoder_step, 50.0F, 30.0F, 100'000, 0, dashpot::motion::translation, "dashpot mps2"},
      5.0F,
      1.0F,
      velocity};
};

template <>
struct reference<dashpot::arm_axes> {
  using plant = test_arm;
  static constexpr arm_board_facts facts = {{{plant::encoder_step, plant::encoder_step},
                                             {0.5F, 0.5F},
                                             {0.05F, 0.05F},
                                             100'000,
                                             0,
                                             dashpot::motion::rotation,
                                             "dashpot mps2"},
                                            {0.005F, 0.005F},
                                            1.0F,
                                            {velocity, velocity}};
};

#ifdef DASHPOT_BOARD_MODEL_HEADER
using model = DASHPOT_BOARD_MODEL_CLASS;
constexpr unsigned axes = axes_of<model>;
static_assert(model::port_motion == reference<axes>::facts.description.motion,
              "the model's network and this board's joints move alike");
static_assert(is_certified_for<model>(velocity.estimator) && is_certified_for<model>(velocity.estimator, axes - 1),
              "the model was compiled for another velocity estimator");
static_assert(brakes_that_drive<model>() <= reference<axes>::plant::brakes,
              "the model commands more brakes than this board has");
model_cost cost_of_model() { return measure_steps<model>(10'000, mps2_an386::ticks); }
#else
using model = no_model;
constexpr unsigned axes = DASHPOT_BOARD_AXES;
model_cost cost_of_model() { return {}; }
#endif

}  // namespace

int main() {
  static plant_board<mps2_an386, reference<axes>::plant> hardware;
  static application<decltype(hardware), model> board(hardware, reference<axes>::facts, cost_of_model());
  std::uint8_t bytes[64];
  for (;;) {
    board.receive(bytes, hardware.receive(bytes, sizeof bytes));
    if (const unsigned periods = hardware.periods_passed()) board.pass_period(periods);
    hardware.transmit();
    hardware.sleep();
  }
}
