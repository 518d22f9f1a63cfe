#include "decompose/choices.hpp"

namespace dashpot::compiler {

std::string_view name_of(Scheme scheme) { return scheme == Scheme::exact ? "exact" : "backward-euler"; }

std::string_view name_of(StateInput input) {
  switch (input) {
    case StateInput::position: return "position";
    case StateInput::velocity: return "velocity";
    case StateInput::nodal: return "nodal";
  }
  return "";
}

std::string_view name_of(ScalarType scalar) { return scalar == ScalarType::float64 ? "double" : "float"; }

}  // namespace dashpot::compiler
