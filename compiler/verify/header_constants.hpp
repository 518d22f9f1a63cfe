// Every constant of an emitted header, read from its text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "decompose/choices.hpp"

namespace dashpot::compiler {

struct HeaderConstant {
  std::string name;
  std::vector<double> values;
};

struct HeaderConstants {
  ScalarType scalar = ScalarType::float64;
  std::vector<HeaderConstant> all;  // in the order of the text
};

// Empty where a constant's value is no finite number, or the scalar is neither double nor float.
std::optional<HeaderConstants> header_constants(std::string_view header);

// The header without what is not code: the banner before "#pragma once", and the digests.
std::string without_banner_and_digest(std::string_view header);

}  // namespace dashpot::compiler
