// Which slips count as sliding for the brake's command: once a slip holds again, it counts as sliding until the tool
// has moved 1.5 encoder steps to either side.
#pragma once

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// The constants 1 for a slip that gives way and 0 for one that holds.
inline ExpressionId slid(LawWriter& writer) { return writer.constant("slid", "1", "a slip that gives way", 1); }
inline ExpressionId held(LawWriter& writer) { return writer.constant("held", "1", "a slip that holds", 0); }

class SlideMemory {
 public:
  // `hysteresis`: above 0 [m]. `make(what, unit, meaning, role)` gives a variable. The writer must outlive this object.
  template <class Make>
  SlideMemory(LawWriter& writer, const Real& hysteresis, Make make)
      : writer_(writer),
        hysteresis_(hysteresis),
        slid_(make("slid", "1", "1 where the command takes the slip for sliding, else 0", Role::state)),
        at_(make("slid_at", writer.length(), "where the tool was when it last slid", Role::state)),
        slides_now_(make("slides_now", "1", "", Role::local)),
        at_now_(make("slides_at", writer.length(), "", Role::local)) {}

  // `slides`: above zero where the slip gives way. Returns the same as the command is to see it.
  ExpressionId write_output(ExpressionId slides, VariableId position);
  void write_update();

 private:
  LawWriter& writer_;
  Real hysteresis_;
  VariableId slid_, at_, slides_now_, at_now_;
};

}  // namespace dashpot::compiler
