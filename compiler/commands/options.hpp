// What the command line asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/fit_words.hpp"
#include "commands/targets.hpp"
#include "decompose/choices.hpp"
#include "emit/device_facts.hpp"
#include "emit/emission.hpp"
#include "exchange/prony_format.hpp"

namespace dashpot::compiler {

enum class ExitStatus { done = 0, input_refused = 1, command_line_wrong = 2, defect = 3 };

// A blade between the poles of a magnet, as the user writes its quantities.
struct BladeWords {
  std::string thickness;
  std::string pole_length;  // across the motion
  std::string pole_width;   // along the motion
  std::string field;
  std::string resistivity = "28.2 nohm m";  // aluminium at 20 °C
  std::optional<double> correction;         // α; empty: of the pole's shape
  std::optional<std::string> radius;        // of the blade's middle; empty: the device's arm radius
  std::optional<std::string> current;       // that makes the field
};

// Of import and export.
struct ExchangeWords {
  PronyFormat format = PronyFormat::generic;
  std::optional<std::string> material;   // in a file with several
  std::optional<PronyOf> of;             // what the weights of a generic table are shares of
  std::optional<std::string> stiffness;  // that shares are of, as "1.2 kN/m"
  std::optional<std::string> modulus;    // what one unit of an absolute modulus is as a stiffness, as "24 N/m"
  std::string time_unit = "s";
  std::optional<std::string> name;  // of the network; empty: after the file
};

struct Options {
  std::vector<std::string> networks;
  std::optional<std::string> device;
  Choices choices;
  std::optional<std::string> name;     // of the network, in place of its own
  std::vector<std::string> set;        // NAME=VALUE: of parameters and elements of the network
  std::optional<std::string> output;   // folder of compile, file of simulate, log of run
  std::string input;                   // simulate: the motion
  std::optional<std::string> print;    // compile: the stage to show instead of writing
  std::optional<std::string> timings;  // compile: "text" or "json"
  std::optional<std::string> depfile;
  std::optional<std::string> certificate;     // compile: to write; verify: to read
  std::optional<std::string> proof;           // compile: to write, for Coq
  std::string header;                         // verify
  const Target* target = &targets().front();  // compile
  EmissionOptions emission;
  bool uncertified = false;                       // compile: also what lacks damping on its device
  bool without_advice = false;                    // no search for what would help
  bool legend = false;                            // explain: what the columns mean
  bool allow_uncertified = false;                 // verify: also what is sound and not certified
  bool json = false;                              // explain, run --motion
  std::optional<double> duration;                 // run [s]; without end where empty
  std::optional<std::string> port;                // run: the board's; empty: the simulated device
  std::optional<std::string> hand;                // run: who holds the simulated device; empty: relaxed
  std::optional<std::uint64_t> seed;              // run: of the simulated device; empty: 0
  std::optional<std::string> motion;              // run: recorded, for the simulated device to be led along
  BladeWords blade;                               // device
  std::optional<DeviceLanguage> device_language;  // device: to write its description in; empty: print it
  FitWords fit;                                   // fit
  ExchangeWords exchange;                         // import, export
  std::optional<std::string> as;                  // explain: the form to print as a network file
  bool fast = false;                              // run: simulated time instead of real time
  bool json_diagnostics = false;
};

}  // namespace dashpot::compiler
