#include "emit/fmi_functions.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

namespace dashpot::compiler {
namespace {

struct Signature {
  std::string_view function;
  std::string_view parameters;  // after the instance
};

constexpr std::string_view which3 = "const fmi3ValueReference which[], size_t count";
constexpr std::string_view which2 = "const fmi2ValueReference which[], size_t count";

// FMI 3.0, sections 2.2 to 5: names and parameters as in fmi3FunctionTypes.h.
constexpr std::array refused3 = std::to_array<Signature>({
    {"fmi3EnterEventMode", ""},
    {"fmi3EnterStepMode", ""},
    {"fmi3EnterConfigurationMode", ""},
    {"fmi3ExitConfigurationMode", ""},
    {"fmi3EvaluateDiscreteStates", ""},
    {"fmi3EnterContinuousTimeMode", ""},
    {"fmi3UpdateDiscreteStates",
     "fmi3Boolean *again, fmi3Boolean *terminates, fmi3Boolean *nominals, fmi3Boolean *values, fmi3Boolean *has_next, "
     "double *next"},
    {"fmi3GetNumberOfVariableDependencies", "fmi3ValueReference which, size_t *count"},
    {"fmi3GetVariableDependencies",
     "fmi3ValueReference which, size_t elements[], fmi3ValueReference others[], size_t other_elements[], "
     "fmi3DependencyKind kinds[], size_t count"},
    {"fmi3GetAdjointDerivative",
     "const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[], size_t "
     "known_count, const double seed[], size_t seed_count, double sensitivity[], size_t sensitivity_count"},
    {"fmi3CompletedIntegratorStep", "fmi3Boolean no_way_back, fmi3Boolean *enters, fmi3Boolean *terminates"},
    {"fmi3SetTime", "double now"},
    {"fmi3SetContinuousStates", "const double values[], size_t room"},
    {"fmi3GetContinuousStateDerivatives", "double values[], size_t room"},
    {"fmi3GetEventIndicators", "double values[], size_t room"},
    {"fmi3GetContinuousStates", "double values[], size_t room"},
    {"fmi3GetNominalsOfContinuousStates", "double values[], size_t room"},
    {"fmi3GetNumberOfEventIndicators", "size_t *count"},
    {"fmi3GetNumberOfContinuousStates", "size_t *count"},
    {"fmi3ActivateModelPartition", "fmi3ValueReference clock, double now"},
});

constexpr std::array types3 = std::to_array<Signature>({{"Float32", "float"},
                                                        {"Int8", "int8_t"},
                                                        {"UInt8", "uint8_t"},
                                                        {"Int16", "int16_t"},
                                                        {"UInt16", "uint16_t"},
                                                        {"Int32", "int32_t"},
                                                        {"UInt32", "uint32_t"},
                                                        {"Int64", "int64_t"},
                                                        {"UInt64", "uint64_t"},
                                                        {"Boolean", "fmi3Boolean"},
                                                        {"String", "fmi3String"}});

// After `which` and `count`.
constexpr std::array without3 = std::to_array<Signature>({
    {"fmi3GetBinary", "size_t sizes[], fmi3Binary values[], size_t room"},
    {"fmi3SetBinary", "const size_t sizes[], const fmi3Binary values[], size_t room"},
    {"fmi3GetClock", "fmi3Clock values[]"},
    {"fmi3SetClock", "const fmi3Clock values[]"},
    {"fmi3GetIntervalDecimal", "double intervals[], fmi3IntervalQualifier qualifiers[]"},
    {"fmi3GetIntervalFraction", "uint64_t counters[], uint64_t resolutions[], fmi3IntervalQualifier qualifiers[]"},
    {"fmi3GetShiftDecimal", "double shifts[]"},
    {"fmi3GetShiftFraction", "uint64_t counters[], uint64_t resolutions[]"},
    {"fmi3SetIntervalDecimal", "const double intervals[]"},
    {"fmi3SetIntervalFraction", "const uint64_t counters[], const uint64_t resolutions[]"},
    {"fmi3SetShiftDecimal", "const double shifts[]"},
    {"fmi3SetShiftFraction", "const uint64_t counters[], const uint64_t resolutions[]"},
    {"fmi3GetOutputDerivatives", "const int32_t orders[], double values[], size_t room"},
});

constexpr std::array no_instance3 = std::to_array<Signature>({
    {"fmi3InstantiateModelExchange",
     "fmi3String name, fmi3String its_token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, "
     "fmi3InstanceEnvironment told, fmi3LogMessageCallback say"},
    {"fmi3InstantiateScheduledExecution",
     "fmi3String name, fmi3String its_token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, "
     "fmi3InstanceEnvironment told, fmi3LogMessageCallback say, fmi3ClockUpdateCallback clock, "
     "fmi3CallbackWithoutResult lock, fmi3CallbackWithoutResult unlock"},
});

// FMI 2.0, sections 2 to 4: as in fmi2FunctionTypes.h.
constexpr std::array refused2 = std::to_array<Signature>({
    {"fmi2EnterEventMode", ""},
    {"fmi2NewDiscreteStates", "fmi2EventInfo *info"},
    {"fmi2EnterContinuousTimeMode", ""},
    {"fmi2CompletedIntegratorStep", "fmi2Boolean no_way_back, fmi2Boolean *enters, fmi2Boolean *terminates"},
    {"fmi2SetTime", "fmi2Real now"},
    {"fmi2SetContinuousStates", "const fmi2Real values[], size_t room"},
    {"fmi2GetDerivatives", "fmi2Real values[], size_t room"},
    {"fmi2GetEventIndicators", "fmi2Real values[], size_t room"},
    {"fmi2GetContinuousStates", "fmi2Real values[], size_t room"},
    {"fmi2GetNominalsOfContinuousStates", "fmi2Real values[], size_t room"},
    {"fmi2CancelStep", ""},
    {"fmi2GetStatus", "const fmi2StatusKind kind, fmi2Status *value"},
    {"fmi2GetIntegerStatus", "const fmi2StatusKind kind, fmi2Integer *value"},
    {"fmi2GetStringStatus", "const fmi2StatusKind kind, fmi2String *value"},
});

constexpr std::array types2 =
    std::to_array<Signature>({{"Integer", "fmi2Integer"}, {"Boolean", "fmi2Boolean"}, {"String", "fmi2String"}});

constexpr std::array without2 = std::to_array<Signature>({
    {"fmi2SetRealInputDerivatives", "const fmi2Integer orders[], const fmi2Real values[]"},
    {"fmi2GetRealOutputDerivatives", "const fmi2Integer orders[], fmi2Real values[]"},
});

// "(void)a, (void)b;" of "int a, double b[]".
std::string reading_all(std::string_view parameters) {
  std::string text;
  for (std::size_t begin = 0; begin < parameters.size();) {
    const std::size_t end = std::min(parameters.find(',', begin), parameters.size());
    std::string_view parameter = parameters.substr(begin, end - begin);
    while (parameter.ends_with("[]")) parameter.remove_suffix(2);
    const std::string_view name = parameter.substr(parameter.find_last_of(" *") + 1);
    text += fmt::format("{}(void){}", text.empty() ? "" : ", ", name);
    begin = end + 1;
  }
  return text.empty() ? text : text + ";";
}

Fields entry(std::string_view function, const std::string& parameters, bool after_another) {
  return {{"function", std::string(function)},
          {"parameters", after_another && !parameters.empty() ? ", " + parameters : parameters},
          {"unused", reading_all(parameters)}};
}

}  // namespace

FmiFunctions unused_functions(FmiVersion version) {
  FmiFunctions all;
  const bool is_three = version == FmiVersion::three;
  const auto types = is_three ? std::span<const Signature>(types3) : std::span<const Signature>(types2);
  const auto without = is_three ? std::span<const Signature>(without3) : std::span<const Signature>(without2);
  const auto refused = is_three ? std::span<const Signature>(refused3) : std::span<const Signature>(refused2);
  const std::string which(is_three ? which3 : which2);
  for (const Signature& type : types)
    for (const bool gets : {true, false})
      all.without.push_back(entry(fmt::format("fmi{}{}{}", int(version), gets ? "Get" : "Set", type.function),
                                  fmt::format("{}, {}{} values[]{}", which, gets ? "" : "const ", type.parameters,
                                              is_three ? ", size_t room" : ""),
                                  false));
  for (const Signature& one : without)
    all.without.push_back(entry(one.function, which + ", " + std::string(one.parameters), false));
  for (const Signature& one : refused) all.refused.push_back(entry(one.function, std::string(one.parameters), true));
  if (is_three)
    for (const Signature& one : no_instance3)
      all.no_instance.push_back(entry(one.function, std::string(one.parameters), false));
  return all;
}

}  // namespace dashpot::compiler
