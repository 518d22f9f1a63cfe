#include "syntax/file_format.hpp"

#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::string_view network_key = "dashpot";
constexpr std::string_view device_key = "dashpot_device";
constexpr std::string_view certificate_key = "dashpot_certificate";

const char* words_of(FileKind kind) { return kind == FileKind::network ? "network file" : "device file"; }

// True where another kind's key stands alone.
bool is_other_kind(FileKind kind, const ObjectReader& reader, Diagnostics& diagnostics) {
  const JsonMember* network = reader.find(network_key);
  const JsonMember* device = reader.find(device_key);
  const JsonMember* certificate = reader.find(certificate_key);
  if (kind == FileKind::network && network == nullptr && device != nullptr)
    diagnostics.report<DiagnosticCode::device_instead_of_network>(device->key_span);
  else if (kind == FileKind::device && device == nullptr && network != nullptr)
    diagnostics.report<DiagnosticCode::network_instead_of_device>(network->key_span);
  else if (network == nullptr && device == nullptr && certificate != nullptr) {
    diagnostics.report<DiagnosticCode::certificate_instead_of_file>(certificate->key_span, words_of(kind));
    diagnostics.note<DiagnosticCode::verify_takes_it>({});
  } else return false;
  return true;
}

}  // namespace

bool is_format_1(FileKind kind, const JsonValue& root, Diagnostics& diagnostics) {
  const bool is_network = kind == FileKind::network;
  if (root.kind != JsonValue::Kind::object) {
    report_wrong_type(words_of(kind), root, "an object", diagnostics);
    return false;
  }
  const ObjectReader reader(root, is_network ? "the network file" : "the device file", diagnostics);
  if (is_other_kind(kind, reader, diagnostics)) return false;
  const JsonMember* format = reader.require(is_network ? network_key : device_key);
  if (format == nullptr) {
    diagnostics.note<DiagnosticCode::write_format_key>({}, is_network ? network_key : device_key);
    return true;
  }
  if (format->value.kind != JsonValue::Kind::number)
    report_wrong_type(format->key, format->value, "the number 1", diagnostics);
  else if (number_in(format->value) != 1)
    diagnostics.report<DiagnosticCode::unknown_format>(format->value.span, excerpt(format->value.text));
  else return true;
  return false;
}

bool is_of_one_axis(FileKind kind, const JsonValue& root, Diagnostics& diagnostics) {
  const JsonMember* axes = find_member(root, "axes");
  if (axes == nullptr) return true;
  if (axes->value.kind != JsonValue::Kind::number) {
    report_wrong_type("axes", axes->value, "the number 1 or 2", diagnostics);
    return false;
  }
  const double number = number_in(axes->value);
  if (number == 1) return true;
  if (number != 2) diagnostics.report<DiagnosticCode::axes_number>(axes->value.span, excerpt(axes->value.text));
  else if (kind == FileKind::network) diagnostics.report<DiagnosticCode::several_axes>(axes->value.span);
  else diagnostics.report<DiagnosticCode::device_of_several_axes>(axes->value.span);
  return false;
}

}  // namespace dashpot::compiler
