// From an update law to the text of files, per target.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certify/certificate.hpp"
#include "decompose/decomposition.hpp"
#include "decompose/port_device.hpp"
#include "law/update_law.hpp"
#include "linear/normal_form.hpp"
#include "network/device.hpp"

namespace dashpot::compiler {

// Of a device, what one of several ports may count on [1].
struct DeviceShare {
  double brake = 1;        // of the brake's greatest damping
  double own_damping = 1;  // of the damping that the device has of its own, and of its friction
  double motor = 1;        // of the motor's greatest force, and of how fast that changes
};

// Everything that the stages before found out about one network. Of one with several ports, `form` is empty, and the
// choice is the sum of theirs.
struct Compilation {
  Network network;
  Network present;  // the same at the default values of its parameters (network/effect.hpp)
  NormalForm form;
  Decomposition decomposition;
  UpdateLaw law;
  Certificate certificate;
  double rate = 0;                                    // [Hz]
  VectorRegisters registers = VectorRegisters::none;  // that loops are laid out for
  std::optional<Device> device;
  PortDevice port = PortDevice::ideal();  // the device as the network sees it
  std::vector<Compilation> ports = {};    // that act side by side, each on its share of the device
  DeviceShare share = {};                 // of one that is such a port

  // All of it lies behind slips: b is 0 whatever the rule, and what the brake makes is told of each slip.
  bool is_told_slip_by_slip() const {
    return form.is_all_behind_slips() && decomposition.choice().damping == 0 && !decomposition.slips.all().empty();
  }

  const char* beyond_linear() const { return compiler::beyond_linear(network); }
};

struct EmissionOptions {
  bool constant_time = false;  // no value decides how long output() and update() take
  bool batch = false;          // also a class for many points of the same network
  bool with_test = false;
  bool with_library = false;             // a source that makes the class loadable at run time
  bool with_live = false;                // a source for WebAssembly, the same behind the functions that a page calls
  std::optional<std::string> templates;  // folder in place of the built-in ones
  std::string explanation;               // what explain --json says of the network, for targets that carry it
};

struct OutputFile {
  std::string name;  // relative to the output folder
  std::string text;
};

// <name>.hpp, and <name>_batch.hpp, <name>_test.cpp, <name>_library.cpp and <name>_live.cpp where asked for. Refuses:
// templates that do not fit; constant time where slips are coupled, with each other or with a contact.
std::optional<std::vector<OutputFile>> emit_cpp(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics);

// <name>.h, and <name>_test.c where asked for. Refuses: templates that do not fit, and names that C keeps for itself.
// Other options have no meaning here.
std::optional<std::vector<OutputFile>> emit_c99(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics);

// <name>.comp, a component of LinuxCNC. Refuses: what emit_c99() refuses, but no name that C keeps; names that LinuxCNC
// keeps or that are too long for it.
std::optional<std::vector<OutputFile>> emit_hal(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace dashpot::compiler
