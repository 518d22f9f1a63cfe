// Lists of two quantities in files of two axes: points, directions, ranges.
#pragma once

#include <optional>
#include <string_view>

#include "axes/pair.hpp"
#include "network/dimension.hpp"
#include "source/diagnostic.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {

// A number or a quantity of the dimension, in SI. `key` is what messages call it.
std::optional<double> read_single(std::string_view key, const JsonValue& value, const Dimension& due,
                                  Diagnostics& diagnostics);

// A list of two of them.
std::optional<axes::Pair<double>> read_pair(std::string_view key, const JsonValue& value, const Dimension& due,
                                            Diagnostics& diagnostics);

// Two plain numbers, not both zero.
std::optional<axes::Pair<double>> read_direction(std::string_view key, const JsonValue& value,
                                                 Diagnostics& diagnostics);

// Two, the second greater than the first.
std::optional<axes::Pair<double>> read_span(std::string_view key, const JsonValue& value, const Dimension& due,
                                            Diagnostics& diagnostics);

}  // namespace dashpot::compiler
