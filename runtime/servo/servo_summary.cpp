#include <dashpot/servo/servo_summary.hpp>

#include <cstdio>
#include <cstring>

namespace dashpot {
namespace {

template <class... Values>
std::string print(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

double microseconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1e3; }

std::string durations(const char* what, const histogram& times) {
  return print("%-9s median %8.1f us, 99 %% %8.1f us, 99.9 %% %8.1f us, longest %8.1f us\n", what,
               microseconds(times.percentile(50)), microseconds(times.percentile(99)),
               microseconds(times.percentile(99.9)), microseconds(times.max()));
}

// Nothing where time is simulated: a period takes none.
std::string timing(const servo_summary& summary) {
  if (summary.lateness.max() == 0 && summary.response.max() == 0 && summary.busy.max() == 0) return "";
  return durations("wake-up", summary.lateness) + durations("response", summary.response) +
         durations("busy", summary.busy);
}

std::string faults(const fault_counts& counts) {
  if (counts.total() == 0) return "faults    none\n";
  std::string text = "faults   ";
  for (unsigned i = 1; i < fault_kinds; ++i) {
    const auto which = static_cast<fault>(i);
    const auto count = static_cast<unsigned long long>(counts.of(which));
    if (count != 0) text += print(" %s %llu,", name_of(which), count);
  }
  text.back() = '\n';
  return text;
}

std::string losses(const servo_summary& summary) {
  std::string text;
  if (summary.telemetry_dropped + summary.events_dropped != 0) {
    text += print("telemetry %llu records and %llu events dropped\n",
                  static_cast<unsigned long long>(summary.telemetry_dropped),
                  static_cast<unsigned long long>(summary.events_dropped));
  }
  if (summary.telemetry_error != 0) text += print("telemetry stopped: %s\n", std::strerror(summary.telemetry_error));
  return text;
}

std::string shedding(const servo_summary& summary) {
  if (summary.shed == 0) return "";
  return print("shed      %llu commands were beyond the motor; the forces were scaled down to %.4g at least\n",
               static_cast<unsigned long long>(summary.shed), summary.least_share);
}

// Of a balance that was below zero: what may have come out, beside what the springs held before.
std::string debt(const servo_summary& summary) {
  if (summary.lowest_energy >= 0) return "";
  const double stored = summary.stored_at_start;
  if (stored > 0 && summary.lowest_energy >= -stored)
    return print(": below zero, but the springs held %.4g J when the run began, and no more than that came out",
                 stored);
  const std::string beyond = stored > 0
                                 ? print(": the springs held %.4g J when the run began; beyond that the tool", stored)
                                 : std::string(": below zero the tool");
  return beyond +
         " may have got more than it gave; of the brake's heat only what the encoder's steps leave certain is counted";
}

// A command that has left need not have arrived.
const char* ending(const servo_summary& summary) {
  if (summary.safe_confirmed) return "device left safe";
  if (summary.left_safe) return "device given the safe command, which it cannot confirm";
  return summary.safe_sent ? "safe command sent, NOT confirmed by the device" : "device NOT left safe";
}

}  // namespace

std::string to_text(const servo_summary& summary) {
  if (!is_admitted(summary.verdict)) return "refused before the device was touched\n";
  const auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  return print("periods   %llu served, %llu missed, %llu woken beyond the stated jitter, %llu held\n",
               count(summary.periods), count(summary.missed_deadlines), count(summary.beyond_jitter),
               count(summary.held)) +
         print("clipped   %llu commands at the motor's limit, %llu at the brake's\n", count(summary.motor_clipped),
               count(summary.brake_clipped)) +
         shedding(summary) + timing(summary) + faults(summary.faults) +
         print("energy    %.6g J that motor and brake took from the tool, never below %.6g J", summary.energy,
               summary.lowest_energy) +
         debt(summary) + "\n" + losses(summary) +
         (summary.verdict == admission::admitted ? "" : "warning   the law is not certified on this device\n") +
         print("ended     %s, %s\n", name_of(summary.state), ending(summary));
}

}  // namespace dashpot
