// What certificates have alike: elements, canonical forms and constants, as they write them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emit/emission.hpp"
#include "linear/normal_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

template <class Value>
nlohmann::ordered_json or_null(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

// Of what has an effect: names, nodes, values in SI.
nlohmann::ordered_json json_of_elements(const Network& network);

// In 50 digits.
nlohmann::ordered_json json_of_form(const LinearForm& form);

nlohmann::ordered_json json_of(const DeviceShare& share);

// All constants of an emitted header, by name.
nlohmann::ordered_json json_of_constants(const std::string& header);

}  // namespace dashpot::compiler
