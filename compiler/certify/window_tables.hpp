// The tables of windows/, built into the compiler by emit/embed_templates.cmake.
#pragma once

#include <span>
#include <string_view>

namespace dashpot::compiler {

struct WindowTable {
  std::string_view name;
  std::string_view text;
};

std::span<const WindowTable> window_tables();

}  // namespace dashpot::compiler
