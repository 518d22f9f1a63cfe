// What the user may choose about the update law.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace dashpot::compiler {

enum class Scheme { exact, backward_euler };
enum class StateInput { position, velocity, nodal };
enum class ScalarType { float64, float32 };
// What the choice is compared with in reports: nothing if it is only a trial; other candidates; or also the choices on
// devices with the assumed values varied, which takes as long as everything else.
enum class Compared { nothing, candidates, variations };
// Vector registers of the machine that rolled loops are laid out for.
enum class VectorRegisters { none, sse2, avx2, avx512, neon };

std::string_view name_of(Scheme scheme);              // "exact", "backward-euler"
std::string_view name_of(StateInput input);           // "position", "velocity", "nodal"
std::string_view name_of(ScalarType scalar);          // "double", "float"
std::string_view name_of(VectorRegisters registers);  // "none", "sse2", "avx2", "avx512", "neon"

std::size_t bytes_of(VectorRegisters registers);  // in a register; 0 for none

struct Choices {
  std::optional<double> rate;  // [Hz]; the device's, or 1000 Hz
  Scheme scheme = Scheme::exact;
  std::optional<StateInput> state_input;  // empty: auto
  // A name of theory, section 4, or a damping [SI]; empty: `faithful` on a device and with slips, else `paper`.
  std::variant<std::string, double> decomposition = "";
  double tolerance = 0.05;  // error of what is felt that `faithful` may allow [1]
  Compared compared = Compared::candidates;
  ScalarType scalar = ScalarType::float64;
  VectorRegisters registers = VectorRegisters::sse2;  // sixteen bytes: what every x86-64 and every AArch64 has
  bool guards_each_sample = false;  // tests every force at every sample for subnormals, as batches of many points do
};

inline constexpr double default_rate = 1000;  // [Hz]

// The choices with the decomposition's current name: "most-dissipative" is the old name of "paper"; if none is given,
// the default, which is `faithful` if `prefers_faithful`.
Choices with_names(Choices choices, bool prefers_faithful);

// Whether the decomposition is called so.
bool is_named(const Choices& choices, std::string_view name);

}  // namespace dashpot::compiler
