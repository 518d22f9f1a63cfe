#include "emit/c99_source.hpp"

namespace dashpot::compiler {

std::string c99_name(const Compilation& compilation) { return "law_" + compilation.network.name; }

std::optional<std::string> c99_source(const Compilation& compilation, const EmissionOptions& options,
                                      Diagnostics& diagnostics) {
  Compilation renamed = compilation;
  if (renamed.network.title.empty()) renamed.network.title = renamed.network.name;
  renamed.network.name = c99_name(compilation);
  const auto files = emit_c99(renamed, options, diagnostics);
  if (!files) return std::nullopt;
  return files->front().text;
}

std::vector<Fields> as_one_entry(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return {{{"line", std::move(text)}}};
}

}  // namespace dashpot::compiler
