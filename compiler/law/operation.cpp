#include "law/operation.hpp"

#include <stdexcept>
#include <string>

namespace dashpot::compiler {
namespace {

constexpr OperationForm infix(int tightness, const char* text) { return {tightness, text}; }
constexpr OperationForm call(const char* text) { return {3, text}; }
constexpr OperationForm none{};

constexpr OperationFacts all[] = {
#define OPERATION(name, operands, refers_to, additions, multiplications, selections, guards, ...) \
  {#name, operands, Referent::refers_to, additions, multiplications, selections, guards, {__VA_ARGS__}},
#include "law/operations.def"
};

}  // namespace

const OperationFacts& facts_of(Operation operation) { return all[static_cast<std::size_t>(operation)]; }

const OperationForm& form_of(Operation operation, Language language) {
  const OperationForm& form = facts_of(operation).forms[static_cast<std::size_t>(language)];
  if (form.text == nullptr)
    throw std::logic_error(std::string("printing a law: no '") + facts_of(operation).name + "' in this language");
  return form;
}

}  // namespace dashpot::compiler
