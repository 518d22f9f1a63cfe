#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/exchange.hpp"
#include "commands/explain.hpp"
#include "exchange/network_text.hpp"
#include "exchange/prony_format.hpp"
#include "insist.hpp"

namespace dashpot::compiler {

namespace {

// The linear part in another form, as a network file.
std::optional<std::string> network_as(const std::string& form, const Compilation& c, Diagnostics& diagnostics) {
  const NetworkHead head{c.network.name, c.network.source, c.network.port_motion};
  if (form == "prony") {
    if (!is_prony_series(c, diagnostics)) return std::nullopt;
    return prony_network(head, in_convention(prony_series(c.form.linear), PronyOf::instantaneous));
  }
  if (const char* const what = c.beyond_linear()) {
    diagnostics.report<DiagnosticCode::no_linear_form>(c.network.name_span, c.network.name, what);
    return std::nullopt;
  }
  return form == "kelvin" ? kelvin_network(head, kelvin_form(c.form.linear)) : maxwell_network(head, c.form.linear);
}

}  // namespace

ExitStatus run_explain(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* file = open_network(options.networks.front(), options, files, diagnostics);
  if (file == nullptr) return ExitStatus::input_refused;
  if (has_two_axes(*file)) {
    if (options.as) diagnostics.report<DiagnosticCode::option_on_two_axes>({}, "--as");
    const auto axes = options.as ? std::nullopt : compile_axes(*file, options, device, diagnostics);
    if (!axes || diagnostics.has_errors()) return ExitStatus::input_refused;
    if (axes->has_device && !axes->certificate.certified && diagnostics.wants_advice())
      diagnostics.report<DiagnosticCode::compile_says_what_would_do>({});
    return write_standard_output(explain_axes(*axes, options.json, options.legend), diagnostics);
  }
  if (!as_many_axes(*file, device, diagnostics)) return ExitStatus::input_refused;
  Choices choices = options.choices;
  if (!options.as) choices.compared = Compared::variations;
  std::optional<Compilation> compilation = compile(*file, choices, device.device, diagnostics);
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  if (options.as) {
    const std::optional<std::string> text = network_as(*options.as, *compilation, diagnostics);
    return text ? write_standard_output(*text, diagnostics) : ExitStatus::input_refused;
  }
  warn_of_felt_error(*compilation, choices, diagnostics);
  tell_what_is_proved_at_the_limit(*compilation, choices, diagnostics);
  if (compilation->device && !compilation->certificate.certified && diagnostics.wants_advice())
    diagnostics.report<DiagnosticCode::compile_says_what_would_do>({});
  weigh_all_candidates(*compilation, choices);
  return write_standard_output(options.json ? explain_json(*compilation) : explain_text(*compilation, options.legend),
                               diagnostics);
}

}  // namespace dashpot::compiler
