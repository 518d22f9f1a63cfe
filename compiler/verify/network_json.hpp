// Elements and canonical forms as certificates write them.
#pragma once

#include <nlohmann/json.hpp>

#include "emit/emission.hpp"
#include "linear/normal_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// Of what has an effect: names, nodes, values in SI.
nlohmann::ordered_json json_of_elements(const Network& network);

// In 50 digits.
nlohmann::ordered_json json_of_form(const LinearForm& form);

nlohmann::ordered_json json_of(const DeviceShare& share);

}  // namespace dashpot::compiler
