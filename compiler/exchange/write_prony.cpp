#include <fmt/format.h>

#include "exchange/prony_format.hpp"

namespace dashpot::compiler {
namespace {

std::string abaqus(const PronySeries& series, const std::string& name, const std::string& unit) {
  std::string text = fmt::format(
      "** stiffness: {:#} {}\n** at once; the weights are shares of it\n*Material, name={}\n"
      "*Viscoelastic, time=PRONY\n",
      series.stiffness, unit, name);
  for (const PronyTerm& term : series.terms) text += fmt::format("{:#}, 0., {:#}\n", term.weight, term.time);
  return text;
}

std::string ansys(const PronySeries& series, const std::string& name, const std::string& unit) {
  std::string text =
      fmt::format("! {}\n! stiffness: {:#} {}\n! at once; the weights are shares of it\nTB,PRONY,1,1,{},SHEAR\n", name,
                  series.stiffness, unit, series.terms.size());
  for (std::size_t i = 0; i < series.terms.size(); ++i)
    text += fmt::format("TBDATA,{},{:#},{:#}\n", 2 * i + 1, series.terms[i].weight, series.terms[i].time);
  return text;
}

std::string febio(const PronySeries& series, const std::string& name, const std::string& unit) {
  std::string text = fmt::format(
      "<!-- stiffness: {:#} {} -->\n<!-- the elastic material's, at once -->\n"
      "<material id=\"1\" name=\"{}\" type=\"uncoupled viscoelastic\">\n  <g0>{:#}</g0>\n",
      series.stiffness, unit, name, 1 - series.sum_of_weights());
  for (std::size_t i = 0; i < series.terms.size(); ++i)
    text += fmt::format("  <g{0}>{1:#}</g{0}>\n  <t{0}>{2:#}</t{0}>\n", i + 1, series.terms[i].weight,
                        series.terms[i].time);
  return text + "</material>\n";
}

std::string ls_dyna(const PronySeries& series, const std::string& name, const std::string& unit) {
  std::string text = fmt::format(
      "$ modulus: 1 {}\n*MAT_GENERAL_VISCOELASTIC_TITLE\n{}\n$ mid, ro, bulk\n1, , \n$ lcid\n,\n$ G, beta\n", unit,
      name);
  if (series.stiffness > 0) text += fmt::format("{:#}, 0.\n", series.stiffness);
  for (const PronyTerm& term : series.terms) text += fmt::format("{:#}, {:#}\n", term.weight, 1 / term.time);
  return text;
}

std::string table(const PronySeries& series, const std::string& unit) {
  std::string text = fmt::format("# of: instantaneous\n# stiffness: {:#} {}\nweight,time\n", series.stiffness, unit);
  for (const PronyTerm& term : series.terms) text += fmt::format("{:#},{:#}\n", term.weight, term.time);
  return text;
}

}  // namespace

PronySeries in_convention(const PronySeries& series, PronyOf of) {
  if (series.of == of) return series;
  PronySeries result{of, series.long_term_stiffness(), {}};
  double sum = 0;
  for (const PronyTerm& term : series.terms) sum += series.stiffness_of(term);
  if (of == PronyOf::instantaneous) result.stiffness += sum;
  for (const PronyTerm& term : series.terms) {
    const double stiffness = series.stiffness_of(term);
    result.terms.push_back({of == PronyOf::absolute ? stiffness : stiffness / result.stiffness, term.time});
  }
  return result;
}

// The FEBio material's arrays have six places; LS-DYNA reads 18 cards, of which one is of the long-term stiffness where
// there is any.
std::optional<std::size_t> most_terms_of(PronyFormat format, const PronySeries& series) {
  switch (format) {
    case PronyFormat::febio: return 6;
    case PronyFormat::ls_dyna: return series.long_term_stiffness() > 0 ? 17 : 18;
    default: return std::nullopt;
  }
}

std::string write_prony(const PronySeries& series, PronyFormat format, const std::string& name,
                        const std::string& unit) {
  const bool is_absolute = format == PronyFormat::ls_dyna;
  const PronySeries own = in_convention(series, is_absolute ? PronyOf::absolute : PronyOf::instantaneous);
  switch (format) {
    case PronyFormat::abaqus: return abaqus(own, name, unit);
    case PronyFormat::ansys: return ansys(own, name, unit);
    case PronyFormat::febio: return febio(own, name, unit);
    case PronyFormat::ls_dyna: return ls_dyna(own, name, unit);
    case PronyFormat::generic: return table(own, unit);
  }
  return "";
}

}  // namespace dashpot::compiler
