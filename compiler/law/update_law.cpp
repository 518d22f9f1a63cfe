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

std::string_view name_of(TunableCall call) {
  switch (call) {
    case TunableCall::set: return "set";
    case TunableCall::meshes: return "meshes";
    case TunableCall::viscosity: return "viscosity";
    case TunableCall::held: return "held";
    case TunableCall::reset: return "reset";
    case TunableCall::resting_brake: return "resting_brake";
    case TunableCall::slip: return "slip";
    case TunableCall::push: return "push";
    case TunableCall::slip_brake: return "slip_brake";
    case TunableCall::limit: return "limit";
    case TunableCall::follow: return "follow";
    case TunableCall::update: return "update";
    case TunableCall::stored_energy: return "stored_energy";
  }
  return "";
}

std::string_view name_of(TunableResult result) {
  switch (result) {
    case TunableResult::value: return "value";
    case TunableResult::stiffness: return "stiffness";
    case TunableResult::feedthrough: return "feedthrough";
    case TunableResult::damping: return "damping";
    case TunableResult::force: return "force";
    case TunableResult::change: return "change";
    case TunableResult::now: return "now";
    case TunableResult::wanted: return "wanted";
    case TunableResult::share: return "share";
  }
  return "";
}

}  // namespace dashpot::compiler
