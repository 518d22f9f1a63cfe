#include "exchange/network_text.hpp"

#include <fmt/format.h>

#include <vector>

#include "network/law.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {
namespace {

std::string file_text(const NetworkHead& head, const std::string& network) {
  const char* turns = head.port_motion == motion::rotation ? "  \"motion\": \"rotation\",\n" : "";
  return fmt::format("{{\n  \"dashpot\": 1,\n  \"name\": {},\n  \"source\": {},\n{}  \"network\": {}\n}}\n",
                     json_string(head.name), json_string(head.source), turns, network);
}

std::string stiffness_unit(motion m) { return unit_of(dimension_of(Spring{}, m)); }

std::string spring(const Real& stiffness, motion m) {
  return fmt::format("{{ \"spring\": \"{} {}\" }}", to_double(stiffness), stiffness_unit(m));
}

std::string damper(const Real& damping, motion m) {
  return fmt::format("{{ \"damper\": \"{} {}\" }}", to_double(damping), unit_of(dimension_of(Damper{}, m)));
}

std::string group(const char* kind, const std::vector<std::string>& parts) {
  if (parts.size() == 1) return parts.front();
  std::string text = fmt::format("{{ \"{}\": [", kind);
  for (std::size_t i = 0; i < parts.size(); ++i) text += fmt::format("{}\n      {}", i > 0 ? "," : "", parts[i]);
  return text + " ] }";
}

std::string pair(const char* kind, const std::string& first, const std::string& second) {
  return fmt::format("{{ \"{}\": [ {}, {} ] }}", kind, first, second);
}

}  // namespace

std::string prony_network(const NetworkHead& head, const PronySeries& series) {
  const std::string unit = stiffness_unit(head.port_motion);
  const std::string_view of = name_of(series.of);
  std::string terms;
  for (const PronyTerm& term : series.terms) {
    const std::string weight =
        series.of == PronyOf::absolute ? fmt::format("\"{} {}\"", term.weight, unit) : fmt::format("{}", term.weight);
    terms +=
        fmt::format("{}\n      {{ \"weight\": {}, \"time\": \"{} s\" }}", terms.empty() ? "" : ",", weight, term.time);
  }
  return file_text(head, fmt::format("{{ \"prony\": \"{} {}\", \"of\": \"{}\", \"terms\": [{} ] }}", series.stiffness,
                                     unit, of, terms));
}

std::string maxwell_network(const NetworkHead& head, const LinearForm& form) {
  const motion m = head.port_motion;
  std::vector<std::string> parts;
  if (form.static_stiffness > 0) parts.push_back(spring(form.static_stiffness, m));
  if (form.feedthrough_damping > 0) parts.push_back(damper(form.feedthrough_damping, m));
  for (const Mode& mode : form.modes)
    parts.push_back(pair("series", spring(mode.stiffness, m), damper(mode.damping(), m)));
  return file_text(head, group("parallel", parts));
}

std::string kelvin_network(const NetworkHead& head, const KelvinForm& form) {
  const motion m = head.port_motion;
  std::vector<std::string> parts;
  if (form.glass_compliance > 0) parts.push_back(spring(1 / form.glass_compliance, m));
  if (form.fluidity > 0) parts.push_back(damper(1 / form.fluidity, m));
  for (const KelvinElement& e : form.elements)
    parts.push_back(pair("parallel", spring(e.stiffness, m), damper(e.damping, m)));
  return file_text(head, group("series", parts));
}

PronySeries prony_series(const LinearForm& form) {
  PronySeries series{PronyOf::absolute, to_double(form.static_stiffness), {}};
  for (const Mode& mode : form.modes)
    series.terms.push_back({to_double(mode.stiffness), to_double(1 / mode.relaxation_rate)});
  return series;
}

}  // namespace dashpot::compiler
