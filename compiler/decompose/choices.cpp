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

std::string_view name_of(VectorRegisters registers) {
  switch (registers) {
    case VectorRegisters::none: return "none";
    case VectorRegisters::sse2: return "sse2";
    case VectorRegisters::avx2: return "avx2";
    case VectorRegisters::avx512: return "avx512";
    case VectorRegisters::neon: return "neon";
  }
  return "";
}

std::size_t bytes_of(VectorRegisters registers) {
  switch (registers) {
    case VectorRegisters::none: return 0;
    case VectorRegisters::sse2:
    case VectorRegisters::neon: return 16;
    case VectorRegisters::avx2: return 32;
    case VectorRegisters::avx512: return 64;
  }
  return 0;
}

Choices with_names(Choices choices, bool prefers_faithful) {
  if (is_named(choices, "most-dissipative")) choices.decomposition = "paper";
  if (is_named(choices, "")) choices.decomposition = prefers_faithful ? "faithful" : "paper";
  return choices;
}

bool is_named(const Choices& choices, std::string_view name) {
  const auto* const chosen = std::get_if<std::string>(&choices.decomposition);
  return chosen != nullptr && *chosen == name;
}

}  // namespace dashpot::compiler
