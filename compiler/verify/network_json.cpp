#include "verify/network_json.hpp"

#include "network/law.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {

using Json = nlohmann::ordered_json;

namespace {

Json digits(const Real& value) { return value.str(50, std::ios_base::scientific); }

}  // namespace

Json json_of_elements(const Network& network) {
  Json elements = Json::array();
  for (const Element& e : network.elements) {
    if (!e.has_effect) continue;
    Json element = {{"name", e.name}, {"nodes", {network.nodes[e.a], network.nodes[e.b]}}};
    element[std::string(kind_of(e.law))] = value_of(e.law);
    elements.push_back(std::move(element));
  }
  return elements;
}

Json json_of(const DeviceShare& share) {
  return {{"brake", share.brake}, {"own_damping", share.own_damping}, {"motor", share.motor}};
}

Json json_of_constants(const std::string& header) {
  Json constants = Json::object();
  if (const auto found = header_constants(header))
    for (const HeaderConstant& constant : found->all) constants[constant.name] = constant.values;
  return constants;
}

Json json_of_form(const LinearForm& form) {
  Json modes = Json::array();
  for (const Mode& mode : form.modes)
    modes.push_back({{"stiffness", digits(mode.stiffness)},
                     {"relaxation_rate", digits(mode.relaxation_rate)},
                     {"spring_share", digits(mode.spring_share)}});
  return {{"static_stiffness", digits(form.static_stiffness)},
          {"feedthrough_damping", digits(form.feedthrough_damping)},
          {"modes", modes}};
}

}  // namespace dashpot::compiler
