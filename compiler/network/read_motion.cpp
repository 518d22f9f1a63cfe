#include "network/read_motion.hpp"

#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {

motion read_motion(const std::optional<Text>& text, Diagnostics& diagnostics) {
  if (!text || text->text == "translation") return motion::translation;
  if (text->text == "rotation") return motion::rotation;
  diagnostics.report<DiagnosticCode::unknown_motion>(text->span, excerpt(text->text));
  const auto nearest = nearest_name(text->text, {"translation", "rotation"});
  if (nearest) diagnostics.note<DiagnosticCode::nearest_name>({}, *nearest);
  return nearest == "rotation" ? motion::rotation : motion::translation;
}

}  // namespace dashpot::compiler
