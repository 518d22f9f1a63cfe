// A storage function written down for Coq: the theorem of compiler/certify/proof/ for one law on one device.
#pragma once

#include <optional>
#include <string>

#include "certify/proved_bound.hpp"

namespace dashpot::compiler {

// A file that `coqc -R compiler/certify/proof Dashpot FILE` accepts, with the witnesses that its checker asks for: of
// the storage function that proves the bound, or behind a hold certificate of one that asks for hardly more. Empty
// where there is none. Short holds are joined to fewer parts, where that has witnesses: `coqc` takes less long, and may
// accept a little less damping than dashpot-check, which asks the inequality of each part.
std::optional<std::string> coq_instance(const std::string& name, const PassivityBound& bound,
                                        const std::optional<MotorConstants>& motor, SampledLoop loop,
                                        bool joins_holds = true);

}  // namespace dashpot::compiler
