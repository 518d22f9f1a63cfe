#include "law/update_law.hpp"

namespace dashpot::compiler {

std::string_view name_of(ModeForm form) {
  switch (form) {
    case ModeForm::product: return "product";
    case ModeForm::delta: return "delta";
    case ModeForm::compensated: return "compensated";
  }
  return "";
}

}  // namespace dashpot::compiler
