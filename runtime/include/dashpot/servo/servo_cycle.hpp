// One period of the servo loop after another, in the only order that is allowed: read, answer, write, and then the
// rest. servo_loop.hpp sets it up and paces it.
#pragma once

#include <cstdint>

#include <dashpot/device.hpp>
#include <dashpot/servo/device_check.hpp>
#include <dashpot/servo/period_grid.hpp>
#include <dashpot/servo/safety_monitor.hpp>
#include <dashpot/servo/servo_control.hpp>
#include <dashpot/servo/servo_state.hpp>
#include <dashpot/servo/servo_summary.hpp>
#include <dashpot/servo/telemetry_writer.hpp>

namespace dashpot {

// `Path` is command_path.hpp's for one axis, arm_path.hpp's for two.
template <class Path, class Model, class Device, class Clock, class Writer>
class servo_cycle {
  using sample_type = typename Path::sample_type;
  using actuation_type = typename Path::actuation_type;
  using record_type = typename Path::record_type;
  using summary_type = typename Path::summary_type;

 public:
  // Refers to all but the path.
  servo_cycle(Path path, const loop_description& loop, Model& model, Device& device, Clock& clock,
              servo_control& control, Writer& writer) noexcept
      : model_(model), device_(device), clock_(clock), control_(control), writer_(writer), loop_(loop), path_(path) {}

  void serve(const wake_up& woken) {
    sample_type sample;
    const device_status status = listen(sample);
    const bool starts = start_asked_ && status == device_status::ok && begin();
    const bool running = machine_.is_running();
    const fault_report found = running
                                   ? path_.answer(starts ? 0 : woken.missed,
                                                  starts ? 0 : static_cast<double>(woken.asleep) * 1e-9, status, sample)
                                   : fault_report{};
    const device_status taken = write(running ? path_.demand() : path_.safe());
    const std::int64_t left = clock_.now();
    running ? path_.finish() : path_.rest();
    if (starts) announce(woken.period, {});
    if (running) trip(found ? found : path_.check_write(taken), woken.period);
    if (start_asked_) announce_waiting(woken.period, status);
    account(woken, left, running);
    publish(record_of(woken, left, running));
    obey(woken.period + 1);
    summary_.busy.record(clock_.now() - woken.instant);
  }

  // Requests of control(), acted on between two periods; `period` is the one that comes. A start waits in idle for the
  // first sample that is ok: a device may need some periods to leave a safe state of its own.
  void obey(std::uint64_t period) {
    const bool start = control_.take_start();  // taken first: a reset asked for before it is then visible too
    if (control_.take_reset() && !machine_.is_running()) reset(period);
    if (start && machine_.state() == servo_state::idle) start_asked_ = true;
  }

  // Gives the device the safe command, again every period while it does not take it, as often as deadlines may be
  // missed; a device that tells what it applies is asked until it confirms, and so is one that has given no sample
  // yet since its first command. Never for longer than `farewell` [s].
  void leave_device_safe(double farewell) noexcept {
    const double periods = farewell > 0 ? farewell / loop_.sample_period : 0;
    const unsigned longest = periods < 1e6 ? static_cast<unsigned>(periods) : 1'000'000;
    unsigned taken = 0;
    for (unsigned attempt = 0; attempt <= longest && !summary_.safe_confirmed; ++attempt) {
      if (attempt > 0) clock_.wait();
      if (attempt > 0 && may_tell()) confirm(taken);
      if (summary_.safe_confirmed || is_over(attempt, taken)) break;
      if (device_.write(path_.safe()) == device_status::ok) ++taken;
      if (taken != 0 && !may_tell()) break;
    }
    summary_.left_safe = summary_.safe_confirmed || (taken != 0 && !tells_);
    summary_.safe_sent = taken != 0;
  }

  // Of everything served so far.
  summary_type summary() const noexcept {
    summary_type result = summary_;
    result.state = machine_.state();
    result.faults = machine_.counts();
    result.last_fault = machine_.last_fault();
    return result;
  }

 private:
  device_status listen(sample_type& sample) noexcept {
    const device_status status = device_.read(sample);
    tells_ = tells_ || sample.report.told;
    heard_ = heard_ || (commanded_ && status == device_status::ok);
    return status;
  }

  // A device tells nothing before its first command.
  bool may_tell() const noexcept { return tells_ || !heard_; }

  device_status write(const actuation_type& command) noexcept {
    const device_status taken = device_.write(command);
    commanded_ = commanded_ || taken == device_status::ok;
    path_.note_write(command, taken == device_status::ok);
    return taken;
  }

  // Without an answer from the device, as many attempts as deadlines may be missed are enough.
  bool is_over(unsigned attempt, unsigned taken) const noexcept {
    return taken == 0 && attempt > loop_.missed_deadlines_allowed;
  }

  // Only a sample that knows one of the last `taken` commands, all of them the safe one, says anything.
  void confirm(unsigned taken) noexcept {
    sample_type sample;
    listen(sample);
    summary_.safe_confirmed =
        sample.report.told && sample.report.commands_ago < taken && path_.is_safe(sample.report.applied);
  }

  bool begin() noexcept {
    start_asked_ = false;
    path_.start();
    return machine_.start();
  }

  void reset(std::uint64_t period) {
    if constexpr (is_detected<device_claim::reset, Device>) device_.reset();
    waiting_announced_ = false;
    waited_ = 0;
    if (machine_.reset()) announce(period, {});
  }

  void trip(const fault_report& report, std::uint64_t period) {
    if (report && machine_.trip(explained(report))) announce(period, explained(report), path_.place());
  }

  // What the device itself says of the fault that it answers.
  fault_report explained(fault_report report) const noexcept {
    if constexpr (is_detected<device_claim::cause, Device>) {
      const bool of_its_own = report.seen == static_cast<double>(device_status::fault);
      if (report.kind == fault::device_error && of_its_own) report.cause = device_.cause();
    }
    return report;
  }

  // A first sample may be under way for as long as any other.
  void announce_waiting(std::uint64_t period, device_status status) {
    const bool is_late = status != device_status::no_data || waited_++ >= loop_.missed_deadlines_allowed;
    if (waiting_announced_ || !is_late) return;
    announce(period, explained(safety_monitor::device_error(status)));
    waiting_announced_ = true;
  }

  void announce(std::uint64_t period, const fault_report& cause, fault_place place = {}) {
    make_room(writer_.events());
    writer_.events().push({time_of(period), period, machine_.state(), cause, place});
  }

  void account(const wake_up& woken, std::int64_t left, bool running) noexcept {
    ++summary_.periods;
    summary_.missed_deadlines += woken.missed;
    summary_.lateness.record(woken.lateness);
    summary_.response.record(left - woken.instant);
    if (loop_.jitter > 0 && static_cast<double>(woken.lateness) > loop_.jitter * 1e9) ++summary_.beyond_jitter;
    if (running && machine_.is_running()) account_answer();
  }

  void account_answer() noexcept {
    if (!path_.has_answered()) ++summary_.held;
    if (path_.has_answered()) path_.account(summary_);
    summary_.energy = path_.energy();
    if (summary_.energy < summary_.lowest_energy) summary_.lowest_energy = summary_.energy;
    if (path_.stored_at_start() > summary_.stored_at_start) summary_.stored_at_start = path_.stored_at_start();
  }

  record_type record_of(const wake_up& woken, std::int64_t left, bool running) const noexcept {
    record_type record;
    record.time = time_of(woken.period);
    record.period = woken.period;
    record.state = machine_.state();
    record.lateness = woken.lateness;
    record.response = left - woken.instant;
    path_.describe_sent(running ? path_.demand() : path_.safe(), record);
    record.stored_energy = static_cast<double>(model_.stored_energy());
    if (running) describe_answer(record);
    return record;
  }

  void describe_answer(record_type& record) const noexcept {
    if (!machine_.is_running()) record.tripped = machine_.last_fault().kind;
    record.fresh = path_.has_answered();
    path_.describe(record);
    record.energy = path_.energy();
  }

  void publish(const record_type& record) {
    make_room(writer_.records());
    writer_.records().push(record);
  }

  // In simulated time nothing is lost: the loop waits for the writer, which runs in this thread.
  template <class Record>
  void make_room([[maybe_unused]] spsc_ring<Record>& ring) {
    if constexpr (!Clock::is_real) {
      if (ring.is_full()) writer_.drain();
    }
  }

  double time_of(std::uint64_t period) const noexcept { return static_cast<double>(period) * loop_.sample_period; }

  Model& model_;
  Device& device_;
  Clock& clock_;
  servo_control& control_;
  Writer& writer_;
  loop_description loop_;
  Path path_;
  servo_state_machine machine_;
  bool start_asked_ = false;
  bool waiting_announced_ = false;
  bool tells_ = false;      // the device says what it applies
  bool commanded_ = false;  // it has taken a command
  bool heard_ = false;      // and given a sample since
  unsigned waited_ = 0;     // for the first sample [periods]
  summary_type summary_;
};

}  // namespace dashpot
