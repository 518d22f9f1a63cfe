#include "verify/read_certificate.hpp"

#include <fmt/ranges.h>

#include <array>
#include <limits>

#include "discretise/rounding.hpp"
#include "network/rate_limits.hpp"
#include "source/excerpt.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const double largest = largest_finite(ScalarType::float64);

// One object of the certificate. Every key that is read has to be there; where one is not what is due, that is
// reported, and something harmless read in its place.
class Section {
 public:
  Section(const JsonValue& object, const char* name, Diagnostics& faults)
      : keys_(object, name, faults), faults_(faults) {}

  const JsonValue* of_kind(const char* key, Kind kind, std::string_view expected) const {
    const JsonMember* member = keys_.require(key);
    if (member == nullptr || member->value.kind == kind) return member == nullptr ? nullptr : &member->value;
    report_wrong_type(key, member->value, expected, faults_);
    return nullptr;
  }

  std::string text(const char* key) const {
    const JsonValue* value = of_kind(key, Kind::string, "a string");
    return value == nullptr ? "" : value->text;
  }

  bool flag(const char* key) const {
    const JsonValue* value = of_kind(key, Kind::boolean, "true or false");
    return value != nullptr && value->text == "true";
  }

  double number(const char* key, double low = -largest, double high = largest) const {
    const JsonValue* value = of_kind(key, Kind::number, "a number");
    if (value == nullptr) return 0;
    const double number = number_in(*value);
    if (!(number >= low && number <= high))
      faults_.report<DiagnosticCode::device_limit>(
          value->span, key, value->text,
          high == largest ? fmt::format("{} or more", low) : fmt::format("{} to {}", low, high));
    return number;
  }

  // The value with that name.
  template <class Value, std::size_t count>
  Value named(const char* key, const Value (&values)[count]) const {
    const JsonValue* told = of_kind(key, Kind::string, "a string");
    std::array<std::string_view, count> names;
    for (std::size_t i = 0; i < count; ++i) {
      names[i] = name_of(values[i]);
      if (told != nullptr && names[i] == told->text) return values[i];
    }
    if (told != nullptr)
      faults_.report<DiagnosticCode::unknown_word>(told->span, fmt::format("'{}'", key), excerpt(told->text),
                                                   fmt::format("{}", fmt::join(names, ", ")));
    return values[0];
  }

  bool has(const char* key) const { return keys_.find(key) != nullptr; }
  bool is_of(const char* key, Kind kind) const { return has(key) && keys_.find(key)->value.kind == kind; }

  // The object, or an empty one if it is none.
  JsonValue object(const char* key) const {
    if (const JsonValue* value = of_kind(key, Kind::object, "an object")) return *value;
    return {Kind::object, has(key) ? keys_.find(key)->value.span : keys_.opening(), "", {}, {}};
  }

 private:
  ObjectReader keys_;
  Diagnostics& faults_;
};

// The choices that laws of one axis and of two have in common.
Choices sampling_of(const Section& law) {
  Choices choices;
  choices.rate = law.number("rate", lowest_rate, highest_rate);
  choices.scheme = law.named("scheme", {Scheme::exact, Scheme::backward_euler});
  choices.scalar = law.named("scalar", {ScalarType::float64, ScalarType::float32});
  return choices;
}

Choices choices_of(const Section& law) {
  Choices choices = sampling_of(law);
  if (law.has("vector"))
    choices.registers = law.named("vector", {VectorRegisters::none, VectorRegisters::sse2, VectorRegisters::avx2,
                                             VectorRegisters::avx512, VectorRegisters::neon});
  choices.guards_each_sample = law.has("guards_each_sample") && law.flag("guards_each_sample");
  choices.state_input = law.named("state_input", {StateInput::position, StateInput::velocity, StateInput::nodal});
  if (law.is_of("decomposition", Kind::number)) choices.decomposition = law.number("decomposition", 0, largest);
  else choices.decomposition = law.text("decomposition");
  if (law.has("tolerance")) choices.tolerance = law.number("tolerance", 0, 1);
  return choices;
}

std::vector<double> numbers_of(const std::string& name, const JsonValue& list, Diagnostics& faults) {
  std::vector<double> numbers;
  if (list.kind != Kind::array) report_wrong_type(name, list, "a list", faults);
  for (const JsonValue& item : list.items) {
    if (item.kind != Kind::number) report_wrong_type(name, item, "a number", faults);
    numbers.push_back(number_in(item));
  }
  return numbers;
}

// What both kinds of certificates have.
template <class File>
File with_subject(const Section& all, Diagnostics& faults) {
  File file;
  if (const JsonValue* format = all.of_kind("dashpot_certificate", Kind::number, "a number");
      format && number_in(*format) != 1)
    faults.report<DiagnosticCode::unknown_format>(format->span, format->text);
  file.network_text = all.text("network_file");
  if (!all.is_of("device_file", Kind::null)) file.device_text = all.text("device_file");
  const JsonValue constants = all.object("constants");
  for (const JsonMember& constant : constants.members)
    file.constants[constant.key] = numbers_of(constant.key, constant.value, faults);
  return file;
}

CertificateFile file_of(const JsonValue& root, Diagnostics& faults) {
  const Section all(root, "the file", faults);
  CertificateFile file = with_subject<CertificateFile>(all, faults);
  const JsonValue law_object = all.object("law"), passivity_object = all.object("passivity");
  const Section law(law_object, "'law'", faults), passivity(passivity_object, "'passivity'", faults);
  file.choices = choices_of(law);
  file.asked_for_state_input = law.flag("state_input_asked");
  file.damping = law.number("damping", 0, largest);
  file.brake_command = law.number("brake_command", 0, largest);
  file.added_damping = law.number("added_damping", 0, largest);
  file.proof = passivity.text("proof");
  file.needed_damping = passivity.number("needed_damping");
  file.assured_damping = passivity.number("assured_damping");
  file.certified = passivity.flag("certified");
  if (!passivity.is_of("quantisation_gain", Kind::null)) file.quantisation_gain = passivity.number("quantisation_gain");
  return file;
}

// null means that no damping is enough.
double damping_of(const Section& passivity, const char* key) {
  return passivity.is_of(key, Kind::null) ? std::numeric_limits<double>::infinity() : passivity.number(key);
}

std::vector<double> dampings_of(const Section& all, Diagnostics& faults) {
  std::vector<double> dampings;
  const JsonValue* const ports = all.of_kind("ports", Kind::array, "a list");
  for (const JsonValue& port : ports == nullptr ? std::vector<JsonValue>() : ports->items) {
    if (port.kind != Kind::object) report_wrong_type("ports", port, "an object", faults);
    else dampings.push_back(Section(port, "a port", faults).number("damping", 0, largest));
  }
  return dampings;
}

AxesCertificateFile axes_file_of(const JsonValue& root, Diagnostics& faults) {
  const Section all(root, "the file", faults);
  AxesCertificateFile file = with_subject<AxesCertificateFile>(all, faults);
  const JsonValue law_object = all.object("law"), passivity_object = all.object("passivity");
  const Section law(law_object, "'law'", faults), passivity(passivity_object, "'passivity'", faults);
  file.choices = sampling_of(law);
  file.choices.decomposition = law.text("decomposition");
  file.port_dampings = dampings_of(all, faults);
  if (const JsonValue* added = passivity.of_kind("added_damping", Kind::array, "a list"))
    file.added_damping = numbers_of("added_damping", *added, faults);
  file.is_proved = passivity.flag("proved");
  file.needed_damping = damping_of(passivity, "needed_damping");
  file.for_estimates = damping_of(passivity, "for_estimates");
  file.for_lag = damping_of(passivity, "for_lag");
  file.missing_damping = damping_of(passivity, "missing_damping");
  file.certified = passivity.flag("certified");
  return file;
}

// What `read` makes of the text; nothing, with the first fault reported, where there is one.
template <class Read>
auto faultless(const SourceFile& file, Diagnostics& diagnostics, const Read& read)
    -> std::optional<decltype(read(JsonValue(), diagnostics))> {
  Diagnostics faults;
  decltype(read(JsonValue(), diagnostics)) certificate;
  if (const std::optional<JsonValue> root = parse_json(file, faults)) {
    if (root->kind != Kind::object) report_wrong_type(file.path(), *root, "an object", faults);
    else certificate = read(*root, faults);
  }
  if (!faults.has_errors()) return certificate;
  const Diagnostic first = faults.in_file_order().front();
  diagnostics.report<DiagnosticCode::no_certificate>(first.span, file.path(), first.text);
  diagnostics.note<DiagnosticCode::write_certificate>({});
  return std::nullopt;
}

}  // namespace

std::optional<CertificateFile> read_certificate(const SourceFile& file, Diagnostics& diagnostics) {
  return faultless(file, diagnostics, file_of);
}

std::optional<AxesCertificateFile> read_axes_certificate(const SourceFile& file, Diagnostics& diagnostics) {
  return faultless(file, diagnostics, axes_file_of);
}

}  // namespace dashpot::compiler
