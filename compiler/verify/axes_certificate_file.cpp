#include "verify/axes_certificate_file.hpp"

#include <cmath>

#include "network/port_units.hpp"
#include "syntax/parse_axes.hpp"
#include "verify/network_json.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_ports(const AxesCompilation& c) {
  Json ports = Json::array();
  for (std::size_t i = 0; i < c.ports.size(); ++i)
    ports.push_back({{"name", c.network.ports[i].name},
                     {"map", c.network.ports[i].map_kind},
                     {"contact", c.network.ports[i].network.contact.has_value()},
                     {"damping", c.ports[i].decomposition.choice().damping},
                     {"elements", json_of_elements(c.ports[i].network)},
                     {"canonical_form", json_of_form(c.ports[i].form.linear)}});
  return ports;
}

// The facts of the device that the bounds depend on.
Json json_of_loop(const AxesDevice& device) {
  Json joints = Json::array(), brakes = Json::array();
  for (const device_description& joint : device.joints)
    joints.push_back({{"max_speed", joint.encoder.max_speed}, {"amplifier_lag", joint.motor.amplifier_lag}});
  for (const AlongBrake& brake : device.brakes)
    brakes.push_back({{"along", brake.along},
                      {"max_damping", brake.brake.max_damping},
                      {"residual_damping", brake.brake.residual_damping},
                      {"tolerance", brake.brake.tolerance}});
  return {{"sample_period", device.loop().sample_period},
          {"jitter", device.loop().jitter},
          {"delay_samples", device.loop().delay_samples},
          {"write_earliest", device.loop().write_earliest},
          {"write_latest", device.loop().write_latest},
          {"kinematics", axes::name_of(device.arm.kind)},
          {"workspace",
           {{"x", {device.workspace[0].low, device.workspace[0].high}},
            {"y", {device.workspace[1].low, device.workspace[1].high}}}},
          {"joint_damping", device.mechanics.damping},
          {"joints", joints},
          {"brakes", brakes}};
}

// null if no damping is enough.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const AxesCertificate& c, const AxesDevice& device) {
  return {{"proved", c.is_proved},
          {"needed_damping", finite_or_null(c.needed)},
          {"for_estimates", finite_or_null(c.for_estimates)},
          {"for_lag", finite_or_null(c.for_lag)},
          {"missing_damping", finite_or_null(c.missing)},
          {"weight", c.weight},
          {"worst", c.worst},
          {"added_damping", c.added},
          {"added_at_tip", c.added_at_tip},
          {"certified", c.certified},
          {"reason", c.certified ? "" : why_not_certified(c, device)}};
}

}  // namespace

std::string axes_certificate_text(const AxesCompilation& c, const std::string& network_text,
                                  const std::optional<std::string>& device_text, const std::string& header) {
  const Json all = {{"dashpot_certificate", 1},
                    {"axes", most_axes},
                    {"version", DASHPOT_VERSION},
                    {"name", c.network.name},
                    {"motion", name_of(c.device.joint_motion())},
                    {"law",
                     {{"rate", c.rate},
                      {"scheme", name_of(c.law.scheme)},
                      {"scalar", name_of(c.law.scalar)},
                      {"decomposition", c.decomposition}}},
                    {"ports", json_of_ports(c)},
                    {"constants", json_of_constants(header)},
                    {"loop", json_of_loop(c.device)},
                    {"passivity", json_of(c.certificate, c.device)},
                    {"network_file", network_text},
                    {"device_file", or_null(device_text)}};
  return all.dump(2) + "\n";
}

}  // namespace dashpot::compiler
