// A storage function written down for Coq: the theorem of compiler/certify/proof/ for one law on one device.
#pragma once

#include <optional>
#include <string>

#include "certify/storage_function.hpp"

namespace dashpot::compiler {

// A file that `coqc -R compiler/certify/proof Dashpot FILE` accepts, with the witnesses that its checker asks for.
// Empty where `proof` is none.
std::optional<std::string> coq_instance(const std::string& name, const dashpot_check::LoopForm& loop,
                                        const dashpot_check::Device& device, const StorageProof& proof);

// The same of a motor, from what is found for it.
std::optional<std::string> coq_instance(const std::string& name, const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
