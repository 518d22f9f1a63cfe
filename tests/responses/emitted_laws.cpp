#include "emitted_laws.hpp"

#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>

#include "compile.hpp"

namespace dashpot::responses {

std::vector<EmittedLaw> gather_laws();

const std::vector<EmittedLaw>& all_laws() {
  static const std::vector<EmittedLaw> laws = gather_laws();
  return laws;
}

std::vector<EmittedLaw> laws_of_variant(const std::string& variant) {
  std::vector<EmittedLaw> chosen;
  for (const EmittedLaw& law : all_laws())
    if (law.variant == variant) chosen.push_back(law);
  if (chosen.empty()) throw std::invalid_argument("no variant " + variant);
  return chosen;
}

const EmittedLaw& law_of(const std::string& variant, const std::string& network) {
  for (const EmittedLaw& law : all_laws())
    if (law.variant == variant && law.network == network) return law;
  throw std::invalid_argument("no law " + variant + "/" + network);
}

const compiler::Compilation& EmittedLaw::compilation() const {
  static std::map<std::string, compiler::Compilation> known;
  if (const auto found = known.find(title()); found != known.end()) return found->second;
  compiler::Diagnostics diagnostics;
  const std::optional<compiler::SourceFile> file = compiler::read_source(network_file, diagnostics);
  std::optional<compiler::Compilation> result =
      file ? compiler::compile(*file, choices, std::nullopt, diagnostics) : std::nullopt;
  if (!result) throw std::runtime_error("cannot compile " + network_file);
  return known.emplace(title(), std::move(*result)).first->second;
}

compiler::StateInput EmittedLaw::state_input() const { return compilation().law.state_input; }

compiler::Choices parse_choices(const std::string& text) {
  compiler::Choices choices;
  std::istringstream words(text);
  for (std::string option, value; words >> option >> value;) {
    if (option == "--rate") choices.rate = std::stod(value);
    else if (option == "--scheme" && value == "backward-euler") choices.scheme = compiler::Scheme::backward_euler;
    else if (option == "--scalar" && value == "float") choices.scalar = compiler::ScalarType::float32;
    else if (option == "--state-input" && value == "position") choices.state_input = compiler::StateInput::position;
    else if (option == "--state-input" && value == "velocity") choices.state_input = compiler::StateInput::velocity;
    else if (option == "--state-input" && value == "nodal") choices.state_input = compiler::StateInput::nodal;
    else if (option == "--decomposition" && std::isdigit(static_cast<unsigned char>(value[0])))
      choices.decomposition = std::stod(value);
    else if (option == "--decomposition") choices.decomposition = value;
    else if (value != "exact" && value != "double") throw std::invalid_argument(option + " " + value);
  }
  return choices;
}

}  // namespace dashpot::responses
