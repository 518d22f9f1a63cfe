// The files of templates/, built into the compiler by embed_templates.cmake.
#pragma once

#include <span>
#include <string_view>

namespace dashpot::compiler {

struct EmbeddedTemplate {
  std::string_view name;
  std::string_view text;
};

std::span<const EmbeddedTemplate> embedded_templates();

}  // namespace dashpot::compiler
