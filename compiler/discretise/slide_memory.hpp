// Which slips the brake's command takes for sliding: for it a slide ends where the tool has gone 1.5 steps of the
// encoder, to either side, and the slip not with it.
#pragma once

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

class SlideMemory {
 public:
  // `hysteresis`: above 0 [m]. `make(what, unit, meaning, role)` gives a variable. The writer outlives this.
  template <class Make>
  SlideMemory(LawWriter& writer, const Real& hysteresis, Make make)
      : writer_(writer),
        hysteresis_(hysteresis),
        slid_(make("slid", "1", "1 where the command takes the slip for sliding, else 0", Role::state)),
        at_(make("slid_at", writer.length(), "where the tool was when it last slid", Role::state)),
        slides_now_(make("slides_now", "1", "", Role::local)),
        at_now_(make("slides_at", writer.length(), "", Role::local)) {}

  // `slides`: above zero where the slip gives way. Returns the same for the command.
  ExpressionId write_output(ExpressionId slides, VariableId position);
  void write_update();

 private:
  LawWriter& writer_;
  Real hysteresis_;
  VariableId slid_, at_, slides_now_, at_now_;
};

}  // namespace dashpot::compiler
