#include <cmath>
#include <filesystem>

#include "commands/commands.hpp"
#include "commands/exchange.hpp"
#include "compile.hpp"
#include "exchange/network_text.hpp"
#include "exchange/prony_format.hpp"
#include "network/law.hpp"
#include "network/name_rules.hpp"
#include "network/port_units.hpp"
#include "network/read_value.hpp"

namespace dashpot::compiler {
namespace {

// A word of the command line as a quantity above zero.
std::optional<double> positive(const std::string& word, const Expectation& due, SourceFiles& files,
                               Diagnostics& diagnostics) {
  const SourceFile& source = files.keep(due.taker, word);
  const ValueDecl decl{ValueDecl::Form::text, word, {&source, 0, word.size()}};
  const auto value = read_quantity_as(decl, due, diagnostics);
  if (!value || *value > 0) return value;
  diagnostics.report<DiagnosticCode::not_above_zero>(decl.span, due.taker, word);
  return std::nullopt;
}

// A C++ name made of the file's: "liver-2.inp" becomes liver_2.
std::string name_from(const std::string& path) {
  std::string name;
  for (const char byte : std::filesystem::path(path).stem().string()) {
    const bool fits = (byte >= '0' && byte <= '9') || ((byte | 0x20) >= 'a' && (byte | 0x20) <= 'z');
    if (fits) name += byte;
    else if (!name.empty() && name.back() != '_') name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  return name.empty() || (name.front() >= '0' && name.front() <= '9') ? "imported_" + name : name;
}

// FEBio's shares as the convention that they are in, if it is one.
PronySeries named_convention(const PronySeries& series) {
  const double at_once = series.stiffness + series.sum_of_weights();
  PronySeries named = series;
  if (std::abs(series.stiffness - 1) <= 1e-12) named.of = PronyOf::long_term;
  else if (std::abs(at_once - 1) <= 1e-12) named.of = PronyOf::instantaneous;
  if (named.of != PronyOf::absolute) named.stiffness = 1;
  return named;
}

struct Scale {
  double stiffness;  // [N/m] or [N m/rad]
  motion port_motion;
};

// A stiffness for a rotation makes a network that rotates; anything else is to be one for a translation.
motion motion_of(const std::string& word) {
  const auto quantity = quantity_in({ValueDecl::Form::text, word, {}});
  return quantity && quantity->dimension == dimension_of(Spring{}, motion::rotation) ? motion::rotation
                                                                                     : motion::translation;
}

// What one of the file's units of stiffness is in the network.
std::optional<Scale> scale_of(const ExchangeWords& words, PronyFormat format, bool is_absolute, SourceFiles& files,
                              Diagnostics& diagnostics) {
  const bool is_modulus = is_absolute && format != PronyFormat::febio;
  const std::optional<std::string>& word = is_modulus ? words.modulus : words.stiffness;
  const char* option = is_modulus ? "--modulus" : "--stiffness";
  if (!word) {
    diagnostics.report<DiagnosticCode::prony_scale_missing>({}, convention_of(format), option);
    if (is_modulus) diagnostics.note<DiagnosticCode::prony_modulus_example>({});
    else diagnostics.note<DiagnosticCode::prony_stiffness_example>({});
    return std::nullopt;
  }
  const motion m = motion_of(*word);
  const auto stiffness = positive(*word, {option, dimension_of(Spring{}, m), m}, files, diagnostics);
  return stiffness ? std::optional(Scale{*stiffness, m}) : std::nullopt;
}

PronySeries scaled(PronySeries series, double stiffness, double time) {
  series.stiffness *= stiffness;
  for (PronyTerm& term : series.terms) {
    term.time *= time;
    if (series.of == PronyOf::absolute) term.weight *= stiffness;
  }
  return series;
}

// What the command line leaves open, the file may say.
ExchangeWords words_for(const SourceFile& file, ExchangeWords words) {
  const PronyRemarks remarks = remarks_of(file);
  const bool is_generic = words.format == PronyFormat::generic;
  if (!words.of && is_generic) words.of = remarks.of;
  if (!words.stiffness && (!is_generic || words.of == remarks.of)) words.stiffness = remarks.stiffness;
  if (!words.modulus) words.modulus = remarks.modulus;
  return words;
}

// What the weights are of, as the network's file tells it.
std::string convention_in(PronyFormat format, PronyOf of) {
  if (format != PronyFormat::generic) return std::string(convention_of(format));
  return of == PronyOf::absolute ? "the weights are stiffnesses"
                                 : fmt::format("the weights are shares of the {} stiffness", name_of(of));
}

}  // namespace

bool is_prony_series(const Compilation& c, Diagnostics& diagnostics) {
  const Span place = c.network.name_span;
  if (const char* const what = c.beyond_linear())
    diagnostics.report<DiagnosticCode::not_exported>(place, c.network.name, what);
  else if (c.form.linear.feedthrough_damping > 0) {
    diagnostics.report<DiagnosticCode::not_exported>(place, c.network.name, "damping that reaches the tool at once");
    diagnostics.note<DiagnosticCode::stiffen_damper>({});
  } else if (c.form.linear.modes.empty()) {
    diagnostics.report<DiagnosticCode::not_exported>(place, c.network.name, "nothing that relaxes");
  } else {
    return true;
  }
  return false;
}

ExitStatus run_import(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const SourceFile* file = files.open(options.input, diagnostics);
  if (file == nullptr) return ExitStatus::input_refused;
  const ExchangeWords words = words_for(*file, options.exchange);
  const PronyFormat format = words.format;
  auto series = read_prony(*file, {format, words.material, words.of}, diagnostics);
  if (!series) return ExitStatus::input_refused;
  if (format == PronyFormat::febio) series = named_convention(*series);
  const Expectation time_due{"--time-unit", dimensions::time, motion::translation};
  const auto time = positive("1 " + words.time_unit, time_due, files, diagnostics);
  const auto scale = scale_of(words, format, series->of == PronyOf::absolute, files, diagnostics);
  if (!time || !scale) return ExitStatus::command_line_wrong;
  const std::string file_name = std::filesystem::path(options.input).filename().string();
  const std::string source = fmt::format("imported from {} ({}: {}; times in {})", file_name, name_of(format),
                                         convention_in(format, series->of), words.time_unit);
  const std::string text = prony_network({words.name.value_or(name_from(options.input)), source, scale->port_motion},
                                         scaled(*series, scale->stiffness, *time));
  // A series that creates energy is refused here, with the nearest one that does not.
  if (!check(files.keep("the imported network", text), diagnostics)) return ExitStatus::input_refused;
  return write_output(options, text, diagnostics);
}

ExitStatus run_export(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const SourceFile* file = files.open(options.networks.front(), diagnostics);
  if (file == nullptr) return ExitStatus::input_refused;
  const auto c = compile(*file, options.choices, std::nullopt, diagnostics);
  if (!c) return ExitStatus::input_refused;
  if (!is_prony_series(*c, diagnostics)) return ExitStatus::input_refused;
  const PronySeries series = prony_series(c->form.linear);
  const PronyFormat format = options.exchange.format;
  if (const auto most = most_terms_of(format, series); most && series.terms.size() > *most) {
    diagnostics.report<DiagnosticCode::prony_too_many_terms>(c->network.name_span, c->network.name, series.terms.size(),
                                                             name_of(format), *most);
    diagnostics.note<DiagnosticCode::prony_fewer_terms>({});
    return ExitStatus::input_refused;
  }
  const std::string text = write_prony(series, format, c->network.name, port_units(c->network.port_motion).stiffness);
  return write_output(options, text, diagnostics);
}

}  // namespace dashpot::compiler
