#include <algorithm>

#include "exchange/prony_format.hpp"
#include "exchange/read_formats.hpp"
#include "network/name_rules.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

std::vector<MaterialSeries> read_all(const SourceFile& file, const PronyQuestion& question, Diagnostics& diagnostics) {
  switch (question.format) {
    case PronyFormat::abaqus: return read_abaqus(file, diagnostics);
    case PronyFormat::ansys: return read_ansys(file, diagnostics);
    case PronyFormat::febio: return read_febio(file, diagnostics);
    case PronyFormat::ls_dyna: return read_ls_dyna(file, diagnostics);
    case PronyFormat::generic: return read_table(file, question.of.value_or(PronyOf::instantaneous), diagnostics);
  }
  return {};
}

std::string names_of(const std::vector<MaterialSeries>& all) {
  std::string names;
  for (const MaterialSeries& one : all) names += (names.empty() ? "'" : ", '") + excerpt(one.material) + "'";
  return names;
}

const MaterialSeries* chosen(const std::vector<MaterialSeries>& all, const SourceFile& file,
                             const PronyQuestion& question, Diagnostics& diagnostics) {
  if (all.empty()) {
    diagnostics.report<DiagnosticCode::prony_not_found>({}, file.path(), name_of(question.format));
    return nullptr;
  }
  if (!question.material) {
    if (all.size() == 1) return &all.front();
    diagnostics.report<DiagnosticCode::prony_several>({}, file.path(), all.size(), names_of(all));
    return nullptr;
  }
  const auto is_it = [&](const MaterialSeries& one) { return one.material == *question.material; };
  const auto is_alike = [&](const MaterialSeries& one) { return folded(one.material) == folded(*question.material); };
  auto found = std::find_if(all.begin(), all.end(), is_it);
  if (found == all.end() && std::count_if(all.begin(), all.end(), is_alike) == 1)  // Abaqus ignores capitals
    found = std::find_if(all.begin(), all.end(), is_alike);
  if (found != all.end()) return &*found;
  diagnostics.report<DiagnosticCode::prony_material_unknown>({}, file.path(), *question.material, names_of(all));
  return nullptr;
}

bool is_sound(const MaterialSeries& found, Diagnostics& diagnostics) {
  if (found.series.terms.empty()) {
    diagnostics.report<DiagnosticCode::prony_without_terms>(found.span);
    return false;
  }
  for (const PronyTerm& term : found.series.terms)
    if (!(term.time > 0)) {
      diagnostics.report<DiagnosticCode::not_above_zero>(found.span, "the time of a Prony term", term.time);
      return false;
    }
  return true;
}

}  // namespace

std::string_view name_of(PronyFormat format) {
  switch (format) {
    case PronyFormat::abaqus: return "abaqus";
    case PronyFormat::febio: return "febio";
    case PronyFormat::ansys: return "ansys";
    case PronyFormat::ls_dyna: return "ls-dyna";
    case PronyFormat::generic: return "generic";
  }
  return "";
}

std::string_view convention_of(PronyFormat format) {
  switch (format) {
    case PronyFormat::abaqus: return "the shear weights of *Viscoelastic are shares of the instantaneous stiffness";
    case PronyFormat::febio: return "<g0>, <g1>, … are shares of the elastic material's stiffness";
    case PronyFormat::ansys: return "the shear weights of TB,PRONY are shares of the instantaneous stiffness";
    case PronyFormat::ls_dyna: return "the moduli are absolute, in the units of the input deck";
    case PronyFormat::generic: return "the weights are what --of says";
  }
  return "";
}

std::optional<PronySeries> read_prony(const SourceFile& file, const PronyQuestion& question, Diagnostics& diagnostics) {
  if (question.format == PronyFormat::generic && !question.of) {
    diagnostics.report<DiagnosticCode::prony_convention_missing>({}, file.path());
    return std::nullopt;
  }
  const std::size_t errors_before = diagnostics.error_count();
  const std::vector<MaterialSeries> all = read_all(file, question, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  const MaterialSeries* found = chosen(all, file, question, diagnostics);
  if (found == nullptr || !is_sound(*found, diagnostics)) return std::nullopt;
  return found->series;
}

}  // namespace dashpot::compiler
