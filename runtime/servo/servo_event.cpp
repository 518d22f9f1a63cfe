#include <dashpot/servo/servo_event.hpp>

#include <charconv>

#include <dashpot/device.hpp>
#include <dashpot/servo/unit_names.hpp>

namespace dashpot {
namespace {

std::string digits_of(double value, std::chars_format format = std::chars_format::general) {
  char digits[400];  // the longest double in fixed notation has 309 digits before the point
  return {digits, std::to_chars(digits, digits + sizeof digits, value, format, 6).ptr};
}

std::string with_unit(double value, const char* unit) { return digits_of(value) + ' ' + unit; }

std::string at_most(const std::string& seen, const std::string& limit) { return seen + ", at most " + limit; }

const char* name_of(device_status status) {
  switch (status) {
    case device_status::ok: return "ok";
    case device_status::no_data: return "no data";
    case device_status::stale: return "stale";
    case device_status::corrupted: return "corrupted";
    case device_status::disconnected: return "disconnected";
    case device_status::fault: return "fault";
  }
  return "unknown";
}

std::string evidence(const fault_report& report, motion joint) {
  const char* const position = position_unit(joint);
  const char* const velocity = velocity_unit(joint);
  switch (report.kind) {
    case fault::none: return {};
    case fault::missed_deadlines: return at_most(digits_of(report.seen) + " in a row", digits_of(report.limit));
    case fault::no_data:
      return at_most(digits_of(report.seen) + " periods without a fresh sample", digits_of(report.limit));
    case fault::device_error:
      return std::string("the device answers '") + name_of(static_cast<device_status>(report.seen)) + "'" +
             (report.cause != nullptr ? std::string(": ") + report.cause : std::string());
    case fault::position_not_finite: return "the device reads " + digits_of(report.seen);
    case fault::report_not_finite: return "the device says that it applies " + digits_of(report.seen);
    case fault::position_out_of_range:
      return with_unit(report.seen, position) + " is beyond " + with_unit(report.limit, position);
    case fault::encoder_jump:
      return at_most("moved " + with_unit(report.seen, position) + " between two samples",
                     with_unit(report.limit, position));
    case fault::velocity_not_finite: return "the estimator returns " + digits_of(report.seen);
    case fault::overspeed: return at_most(with_unit(report.seen, velocity), with_unit(report.limit, velocity));
    case fault::command_not_finite: return "the device would get " + digits_of(report.seen);
    case fault::suspended: return "the machine was asleep for " + with_unit(report.seen, "s");
    case fault::motor_saturated: return at_most("for " + with_unit(report.seen, "s"), with_unit(report.limit, "s"));
  }
  return {};
}

}  // namespace

std::string to_text(const servo_event& event, motion joint) {
  const std::string what = digits_of(event.time, std::chars_format::fixed) + " s: " + name_of(event.entered);
  if (!event.cause) return what;
  const std::string place = event.place.name != nullptr ? std::string(event.place.name) + ": " : std::string();
  const std::string seen = place + evidence(event.cause, event.place.is_tip ? motion::translation : joint);
  if (event.entered == servo_state::idle) return what + ": cannot start: " + seen;
  return what + ": " + name_of(event.cause.kind) + ": " + seen;
}

}  // namespace dashpot
