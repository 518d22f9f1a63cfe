// Compares the banner of an emitted header, and the code around its constants, with what is written for the same
// network.
#pragma once

#include <string>
#include <vector>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// In: every form in which the header may have been written. Reports the first difference from the form that the header
// follows furthest. The version of the dashpot that wrote it may be another one.
void compare_headers(const std::vector<std::string>& written, const SourceFile& header, Diagnostics& diagnostics);

// The header of another `compile` differs nearly everywhere: notes if the network that its class is called after, the
// device that it names, or its sample period [s], is not that of the certificate.
void tell_of_another_compile(const SourceFile& header, const std::string& network, const std::string& device,
                             double sample_period, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
