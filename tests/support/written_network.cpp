#include "support/written_network.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "compile.hpp"
#include "source/render.hpp"

namespace dashpot::testing {

compiler::Network written_network(const std::string& structure) {
  const char* key = structure.front() == '[' ? "elements" : "network";
  const std::string text = fmt::format("{{ \"dashpot\": 1, \"name\": \"written\", \"{}\": {} }}", key, structure);
  const compiler::SourceFile file("written.json", text);
  compiler::Diagnostics diagnostics;
  std::optional<compiler::Network> network = compiler::check(file, diagnostics);
  if (!network) throw std::invalid_argument(compiler::render_text(diagnostics));
  // The text is gone when the network is used.
  for (compiler::Element& element : network->elements) element.span = {};
  network->name_span = {};
  return *std::move(network);
}

}  // namespace dashpot::testing
