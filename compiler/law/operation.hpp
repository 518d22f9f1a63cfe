// The operations of an update law, with the facts about each from its row of operations.def.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dashpot::compiler {

enum class Operation : std::uint8_t {
#define OPERATION(name, ...) name,
#include "law/operations.def"
};

// How an operation is written in a language. `tightness`: 0 to 3, how tightly it binds its operands.
struct OperationForm {
  int tightness = 3;
  const char* text = nullptr;  // nullptr where the language has none
};

enum class Language : std::uint8_t { text, cpp, constant_time, vectors, c99 };

enum class Referent : std::uint8_t { operands_only, variable, coefficient };

struct OperationFacts {
  const char* name;
  std::size_t operands;
  Referent refers_to;
  std::size_t additions, multiplications, selections, guards;
  OperationForm forms[5];  // by language
};

const OperationFacts& facts_of(Operation operation);
const OperationForm& form_of(Operation operation, Language language);

}  // namespace dashpot::compiler
