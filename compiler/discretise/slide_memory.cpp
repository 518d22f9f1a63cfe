#include "discretise/slide_memory.hpp"

namespace dashpot::compiler {

ExpressionId SlideMemory::write_output(ExpressionId slides, VariableId position) {
  std::vector<Statement>& output = writer_.law().output;
  const ExpressionId one = slid(writer_), none = held(writer_);
  const ExpressionId area = writer_.constant("hysteresis_squared", writer_.length() + "²",
                                             "(1.5 steps of the encoder)²", hysteresis_ * hysteresis_);
  const ExpressionId gone = writer_.subtract(writer_.read(position), writer_.read(at_));
  const ExpressionId still = writer_.subtract(area, writer_.multiply(gone, gone));
  writer_.assign(output, slides_now_, writer_.where(slides, one, writer_.where(still, writer_.read(slid_), none)),
                 "the command counts the slip as sliding until the tool has moved 1.5 encoder steps");
  writer_.assign(output, at_now_, writer_.where(slides, writer_.read(position), writer_.read(at_)), "");
  return writer_.read(slides_now_);
}

void SlideMemory::write_update() {
  std::vector<Statement>& update = writer_.law().update;
  writer_.assign(update, slid_, writer_.read(writer_.kept(slides_now_)), "");
  writer_.assign(update, at_, writer_.read(writer_.kept(at_now_)), "");
}

}  // namespace dashpot::compiler
