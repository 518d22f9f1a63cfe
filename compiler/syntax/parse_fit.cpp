#include "syntax/parse_fit.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

void expect_number(const ObjectReader& reader, std::string_view key, Diagnostics& diagnostics) {
  const JsonMember* member = reader.find(key);
  if (member != nullptr && member->value.kind != Kind::number)
    report_wrong_type(key, member->value, "a number", diagnostics);
}

void check_recording(const JsonValue& value, Diagnostics& diagnostics) {
  if (value.kind != Kind::object) return report_wrong_type("recordings", value, "a list of objects", diagnostics);
  ObjectReader reader(value, "a recording", diagnostics);
  reader.refuse_other_keys({"file", "digest", "rows", "free_rows", "rms", "r_squared", "gain", "offset"});
  for (const std::string_view key : {"file", "digest"}) reader.text(key);
  for (const std::string_view key : {"rows", "free_rows", "r_squared", "gain"}) expect_number(reader, key, diagnostics);
  for (const std::string_view key : {"rms", "offset"}) reader.value(key);
}

// "K1": ["5 kN/m", "6 kN/m"]
void check_intervals(const ObjectReader& fit, std::string_view key, Diagnostics& diagnostics) {
  const JsonValue* object = fit.object(key);
  if (object == nullptr) return;
  for (const JsonMember& member : object->members) {
    const bool is_pair = member.value.kind == Kind::array && member.value.items.size() == 2;
    if (!is_pair) report_wrong_type(member.key, member.value, "a list of two bounds", diagnostics);
    else
      for (const JsonValue& bound : member.value.items) read_value(member.key, bound, diagnostics);
  }
}

}  // namespace

void check_fit_record(const ObjectReader& network, Diagnostics& diagnostics) {
  const JsonValue* object = network.object("fit");
  if (object == nullptr) return;
  ObjectReader reader(*object, "'fit'", diagnostics);
  reader.refuse_other_keys({"command", "recordings", "rms", "r_squared", "linear_floor", "parameters",
                            "effective_samples", "intervals", "bootstrap", "leaving_a_file_out"});
  reader.text("command");
  if (const JsonValue* list = reader.list("recordings"))
    for (const JsonValue& recording : list->items) check_recording(recording, diagnostics);
  for (const std::string_view key : {"rms", "linear_floor"}) reader.value(key);
  for (const std::string_view key : {"r_squared", "parameters", "effective_samples"})
    expect_number(reader, key, diagnostics);
  for (const std::string_view key : {"intervals", "bootstrap", "leaving_a_file_out"})
    check_intervals(reader, key, diagnostics);
}

}  // namespace dashpot::compiler
