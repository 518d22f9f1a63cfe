// Network and device files of two axes as their author wrote them: what is the same as with one axis is kept as there,
// once for each port, joint and brake.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "syntax/device_decl.hpp"
#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

struct PortDecl {
  Text name;
  JsonValue map;        // an object
  NetworkDecl network;  // called like the port, with the parameters of the whole file
};

struct AxesNetworkDecl {
  std::optional<Text> name;
  std::optional<Text> title;
  std::optional<Text> source;
  std::vector<PortDecl> ports;
  std::optional<JsonValue> viscous;     // of the field
  std::optional<JsonValue> field_grid;  // of the field, an object: 'viscous' over knots
  std::optional<JsonValue> stiffness;   // of the field: refused
  std::vector<CommentDecl> comments;
  std::string digest;    // of the file's bytes
  bool complete = true;  // false: problems were reported, so only what is here can be checked further
};

struct BrakeDecl {
  std::optional<JsonValue> along;
  DeviceDecl device;  // with the loop and this brake
  Span span;
};

struct AxesDeviceDecl {
  std::optional<Text> name;
  std::optional<Text> source;
  std::optional<Text> motion;
  std::optional<JsonValue> kinematics;  // an object
  std::vector<DeviceDecl> joints;       // with the loop, and each its encoder, estimator and motor
  std::vector<BrakeDecl> brakes;
  Span brakes_span;
  std::optional<JsonValue> mechanics;  // an object
  std::vector<Text> assumed;
  std::vector<std::string> given;  // dotted keys of the file, "motors.max_torque"
  Span opening;                    // bracket of the whole file
  std::string digest;
  bool complete = true;
};

}  // namespace dashpot::compiler
