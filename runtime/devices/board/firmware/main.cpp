// The reference firmware. Built with DASHPOT_BOARD_MODEL_HEADER and DASHPOT_BOARD_MODEL_CLASS it can run that emitted
// model itself, on the velocity that DASHPOT_BOARD_VELOCITY describes; built without them it serves the host only.
#include "application.hpp"
#include "mps2_an386.hpp"
#include "step_cost.hpp"

#ifdef DASHPOT_BOARD_MODEL_HEADER
#include DASHPOT_BOARD_MODEL_HEADER
#endif
#ifndef DASHPOT_BOARD_VELOCITY
#define DASHPOT_BOARD_VELOCITY dashpot::velocity_description()
#endif

namespace {

using namespace dashpot::board;

constexpr board_facts facts = {
    {test_plant::encoder_step, 50.0F, 30.0F, 100'000, 0, dashpot::motion::translation, "dashpot mps2"},
    5.0F,
    1.0F,
    DASHPOT_BOARD_VELOCITY};

#ifdef DASHPOT_BOARD_MODEL_HEADER
using model = DASHPOT_BOARD_MODEL_CLASS;
static_assert(model::port_motion == facts.description.motion, "the model's network and this board's joint move alike");
static_assert(is_certified_for<model>(facts.velocity.estimator),
              "the model was compiled for another velocity estimator");
model_cost cost_of_model() { return measure_steps<model>(10'000, mps2_an386::ticks); }
#else
using model = no_model;
model_cost cost_of_model() { return {}; }
#endif

}  // namespace

int main() {
  static mps2_an386 hardware;
  static application<mps2_an386, model> board(hardware, facts, cost_of_model());
  std::uint8_t bytes[64];
  for (;;) {
    board.receive(bytes, hardware.receive(bytes, sizeof bytes));
    if (const unsigned periods = hardware.periods_passed()) board.pass_period(periods);
    hardware.transmit();
    hardware.sleep();
  }
}
