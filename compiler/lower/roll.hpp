// Vectors of many places become loops: how their sums are added up, and which guards take turns.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law, the registers of the machine that its loops are for, and whether every force is guarded against subnormals
// at every sample. Out: the law with vectors of nine places and more as loops, added up in partial sums. Unless every
// force is guarded at every sample, the guards of modes that decay slowly take turns: guarding all of them would take
// three of the eight operations of a mode.
UpdateLaw rolled(UpdateLaw law, VectorRegisters registers, bool guards_each_sample);

}  // namespace dashpot::compiler
