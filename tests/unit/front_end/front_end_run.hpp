// A text taken through the front end, with all that was said about it.
#pragma once

#include <optional>
#include <string>

#include "network/device.hpp"
#include "network/network.hpp"
#include "source/render.hpp"
#include "syntax/parse_device.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler {

struct NetworkRun {
  explicit NetworkRun(std::string text) : source("network.json", std::move(text)) {
    if (const auto decl = parse_network(source, diagnostics)) network = build_network(*decl, diagnostics);
  }
  NetworkRun(const NetworkRun&) = delete;  // spans point into `source`
  NetworkRun& operator=(const NetworkRun&) = delete;

  std::string said() const { return render_text(diagnostics); }

  SourceFile source;
  Diagnostics diagnostics;
  std::optional<Network> network;
};

struct DeviceRun {
  explicit DeviceRun(std::string text) : source("device.json", std::move(text)) {
    if (const auto decl = parse_device(source, diagnostics)) device = build_device(*decl, diagnostics);
  }
  DeviceRun(const DeviceRun&) = delete;
  DeviceRun& operator=(const DeviceRun&) = delete;

  std::string said() const { return render_text(diagnostics); }

  SourceFile source;
  Diagnostics diagnostics;
  std::optional<Device> device;
};

}  // namespace dashpot::compiler
