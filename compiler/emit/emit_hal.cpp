#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "emit/banner.hpp"
#include "emit/c99_source.hpp"
#include "emit/cpp_program.hpp"
#include "emit/emission.hpp"
#include "emit/template_text.hpp"
#include "emit/tunable_fields.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t longest_name = 47;                         // HAL_NAME_LEN of LinuxCNC 2.9
constexpr std::string_view longest_own_pin = ".0.safe-damping";  // the other names are no longer

// Components and drivers of LinuxCNC 2.9: one of these names installed would take the place of theirs.
constexpr std::string_view own_components =
    " abs abs_s32 and2 anglejog axistest bin2gray biquad bitslice bitwise bldc blend boss_plc carousel"
    " charge_pump clarke2 clarke3 clarkeinv classicladder_rt comp constant conv_bit_float conv_bit_s32"
    " conv_bit_u32 conv_float_s32 conv_float_u32 conv_s32_bit conv_s32_float conv_s32_u32 conv_u32_bit"
    " conv_u32_float conv_u32_s32 corexy_by_hal corexykins counter dbounce ddt deadzone debounce demux"
    " differential div2 edge encoder encoder_ratio eoffset_per_angle estop_latch feedcomp filter_kalman"
    " flipflop gantry gearchange genhexkins genserkins gray2bin hal_bb_gpio hal_gm hal_lib hal_parport"
    " hal_pi_gpio hal_ppmc hal_speaker histobins hm2_7i43 hm2_7i90 hm2_eth hm2_pci hm2_rpspi hm2_spi"
    " hm2_test homecomp homemod hostmot2 hypot ilowpass integ invert joyhandle knob2float latencybins lcd"
    " limit1 limit2 limit3 lincurve lineardeltakins logic lowpass lut5 maj3 match8 matrix_kb max31855"
    " maxkins mesa_7i65 mesa_pktgyro_test mesa_uart message millturn minmax modmath motmod moveoff mult2"
    " multiclick multiswitch mux16 mux2 mux4 mux8 mux_generic near not offset ohmic oneshot or2 orient"
    " pentakins pid plasmac pumakins pwmgen rosekins rotarydeltakins rotatekins sample_hold sampler scale"
    " scaled_s32_sums scarakins scope_rt select8 serport setsserial siggen sim_axis_hardware sim_encoder"
    " sim_home_switch sim_matrix_kb sim_parport sim_spindle simple_tp sphereprobe spindle spindle_monitor"
    " stepgen steptest streamer sum2 supply thc thcud threads threadtest time timedelay timedelta tof"
    " toggle toggle2nist ton tp tpmod tripodkins tristate_bit tristate_float trivkins updown userkins"
    " watchdog wcomp weighted_sum xhc_hb04_util xor2 xyzab_tdr_kins ";

const std::set<std::string> own_pins = {"position", "velocity",   "enable",       "damping",      "force", "fault",
                                        "output",   "fault-code", "out-of-range", "safe-damping", "update"};

// Variables that halcompile keeps for itself, and the word of C that none of the members it declares is called.
const std::set<std::string> names_of_halcompile = {"comp_id",        "extra_cleanup",  "extra_setup", "fperiod",
                                                   "rtapi_app_exit", "rtapi_app_main", "restrict"};

// As halcompile turns a name into that of a pin.
std::string hal_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  while (name.ends_with('-')) name.pop_back();
  return name.starts_with("hal-") ? name.substr(4) : name;
}

// What stands in a string of a .comp file, which is one of Python and becomes a line of a manual page. halcompile ends
// it at the next quote, whatever is before that.
std::string in_quotes(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') result += "\\\\\\\\";
    else if (c == '"') result += "\\x22";
    else result += c;
  }
  return result;
}

bool has_names_of_hal(const Compilation& c, Diagnostics& diagnostics) {
  const std::string& name = c.network.name;
  bool good = true;
  if (own_components.find(" " + name + " ") != own_components.npos) {
    diagnostics.report<DiagnosticCode::name_kept_by>(c.network.name_span, name, "a component of LinuxCNC");
    good = false;
  }
  std::set<std::string> pins;
  const auto check_length = [&](const Span& span, const std::string& owner, const std::string& pin) {
    if (pin.size() <= longest_name) return;
    diagnostics.report<DiagnosticCode::name_too_long_for>(span, owner, pin, pin.size(), "HAL", longest_name);
    good = false;
  };
  check_length(c.network.name_span, name, hal_name(name) + std::string(longest_own_pin));
  for (const Parameter& p : c.network.parameters) {
    if (!p.tunable) continue;
    if (own_pins.count(hal_name(p.name)) != 0 || !pins.insert(hal_name(p.name)).second) {
      diagnostics.report<DiagnosticCode::parameter_name_kept_by>(p.span, p.name, "another pin of the component");
      good = false;
    }
    if (names_of_halcompile.count(p.name) != 0) {
      diagnostics.report<DiagnosticCode::parameter_name_kept_by>(p.span, p.name, "halcompile");
      good = false;
    }
    check_length(p.span, p.name, hal_name(name) + ".0." + hal_name(p.name));
  }
  return good;
}

CodeModel component_model(const Compilation& c, std::string source) {
  CodeModel model;
  Fields& fields = model.fields;
  const PortUnits units = port_units(c.network.port_motion);
  Fields file;
  describe_file(c, file);
  describe_device(c, file);
  for (const char* field : {"name", "version", "digest", "scalar", "estimator", "position_unit", "velocity_unit"})
    fields[field] = file[field];
  fields["title"] = in_quotes(file["title"]);
  fields["hal_name"] = hal_name(c.network.name);
  fields["law"] = c99_name(c);
  fields["period"] = std::to_string(std::llround(1e9 / c.rate));
  fields["force_unit"] = fmt::format("[{}]", units.force);
  fields["damping_unit"] = fmt::format("[{}]", units.damping);
  fields["safe_damping"] = cpp_literal(c.device ? c.device->description.brake.safe_damping : 0, ScalarType::float64);
  std::string notes;
  for (const std::string& line : banner(c, c.law, Timing::any))
    notes += (notes.empty() ? "" : line.starts_with(' ') ? "\n" : "\n.br\n") + in_quotes(line);
  fields["notes"] = notes;
  model.lists["tunables"] = tunable_fields(c.law, ScalarType::float64);
  const std::size_t count = model.lists["tunables"].size();
  model.lists["any_tunable"];
  if (count > 0) model.lists["any_tunable"].push_back({{"count", std::to_string(count)}});
  model.lists["source"] = as_one_entry(std::move(source));
  return model;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_hal(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics) {
  if (!has_names_of_hal(compilation, diagnostics)) return std::nullopt;
  std::optional<std::string> source = c99_source(compilation, options, diagnostics);
  std::vector<OutputFile> files;
  if (!source || !append_filled("hal.comp.in", compilation.network.name + ".comp",
                                component_model(compilation, std::move(*source)), options, files, diagnostics))
    return std::nullopt;
  return files;
}

}  // namespace dashpot::compiler
