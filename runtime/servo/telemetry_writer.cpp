#include <dashpot/servo/telemetry_writer.hpp>

#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <csignal>
#include <charconv>
#include <chrono>
#include <utility>

#include <dashpot/servo/unit_names.hpp>

namespace dashpot {
namespace {

constexpr std::size_t event_capacity = 256;
// Long enough to cost nothing, short against the time in which a ring of the usual size fills.
constexpr std::chrono::milliseconds pause{5};

// While it lives, what a write to a closed pipe (SIGPIPE) or beyond the largest file (SIGXFSZ) raises in this thread is
// held back and then taken away: the write fails with EPIPE or EFBIG, and a log never ends the process that drives a
// device. Other threads, and what the process does with these signals elsewhere, are left as they are.
class quiet_writes {
 public:
  quiet_writes() noexcept {
    sigemptyset(&raised_by_writes_);
    sigaddset(&raised_by_writes_, SIGPIPE);
    sigaddset(&raised_by_writes_, SIGXFSZ);
    sigpending(&pending_);
    pthread_sigmask(SIG_BLOCK, &raised_by_writes_, &before_);
  }
  ~quiet_writes() {
    for (const int signal : {SIGPIPE, SIGXFSZ})
      if (sigismember(&pending_, signal) == 1) sigdelset(&raised_by_writes_, signal);
    const timespec at_once{};
    while (sigtimedwait(&raised_by_writes_, nullptr, &at_once) > 0) {}
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  quiet_writes(const quiet_writes&) = delete;
  quiet_writes& operator=(const quiet_writes&) = delete;

 private:
  sigset_t raised_by_writes_;
  sigset_t pending_;  // before: somebody else's
  sigset_t before_;   // blocked
};

template <class Number>
void append(std::string& row, Number value) {
  char digits[32];
  row.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <class Number>
void append_cell(std::string& row, Number value) {
  row += ',';
  append(row, value);
}

std::string column(const std::string& name, const char* unit) { return "," + name + " [" + unit + "]"; }

constexpr const char* timing_columns = "time [s],period,state,fault,fresh,lateness [ns],response [ns]";

template <class Record>
std::string timing_cells(const Record& record) {
  std::string row;
  append(row, record.time);
  append_cell(row, record.period);
  row.append(",").append(name_of(record.state)).append(",").append(name_of(record.tripped));
  append_cell(row, record.fresh ? 1 : 0);
  append_cell(row, record.lateness);
  append_cell(row, record.response);
  return row;
}

std::string columns(const char* name, const char* unit, unsigned count) {
  std::string all;
  for (unsigned number = 1; number <= count; ++number) all += column(name + std::to_string(number), unit);
  return all;
}

void append_cells(std::string& row, const double* values, unsigned count) {
  for (unsigned i = 0; i < count; ++i) append_cell(row, values[i]);
}

}  // namespace

std::string csv_header(telemetry_units units) {
  return timing_columns + column("position", position_unit(units.model)) +
         column("velocity", velocity_unit(units.model)) + column("damping", damping_unit(units.model)) +
         column("motor_force", force_unit(units.model)) + column("motor_torque", force_unit(units.joint)) +
         column("brake_damping", damping_unit(units.joint)) + column("stored_energy", "J") + column("energy", "J") +
         "\n";
}

std::string csv_row(const telemetry_record& record, telemetry_units) {
  std::string row = timing_cells(record);
  for (const double value : {record.position, record.velocity, record.damping, record.motor_force, record.motor_torque,
                             record.brake_damping, record.stored_energy, record.energy}) {
    append_cell(row, value);
  }
  return row += '\n';
}

std::string csv_header(arm_telemetry_units units) {
  const char* const damping = damping_unit(units.joint);
  return timing_columns + columns("q", position_unit(units.joint), arm_axes) +
         columns("v", velocity_unit(units.joint), arm_axes) + columns("damping_", damping, units.brakes) +
         columns("torque_", force_unit(units.joint), arm_axes) +
         columns("motor_torque_", force_unit(units.joint), arm_axes) +
         columns("brake_damping_", damping, units.brakes) + column("stored_energy", "J") + column("energy", "J") + "\n";
}

std::string csv_row(const arm_telemetry_record& record, arm_telemetry_units units) {
  std::string row = timing_cells(record);
  append_cells(row, record.position, arm_axes);
  append_cells(row, record.velocity, arm_axes);
  append_cells(row, record.damping, units.brakes);
  append_cells(row, record.torque, arm_axes);
  append_cells(row, record.sent.motor_torque, arm_axes);
  append_cells(row, record.sent.brake_damping, units.brakes);
  append_cell(row, record.stored_energy);
  append_cell(row, record.energy);
  return row += '\n';
}

template <class Record, class Units>
record_writer<Record, Units>::record_writer(std::size_t capacity, outputs_of<Record> outputs, Units units)
    : records_(capacity), events_(event_capacity), outputs_(std::move(outputs)), units_(units) {
  if (outputs_.csv == nullptr) return;
  const quiet_writes guard;
  put(csv_header(units_));
}

template <class Record, class Units>
record_writer<Record, Units>::~record_writer() {
  stop();
}

template <class Record, class Units>
void record_writer<Record, Units>::start() {
  stopping_.store(false);
  thread_ = std::thread([this] { run(); });
}

template <class Record, class Units>
void record_writer<Record, Units>::stop() {
  stopping_.store(true);
  if (thread_.joinable()) thread_.join();
  drain();
}

template <class Record, class Units>
void record_writer<Record, Units>::run() {
  // A thread inherits the scheduling of the one that starts it; this one must never hold up a real-time loop.
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  while (!stopping_.load()) {
    drain();
    std::this_thread::sleep_for(pause);
  }
}

template <class Record, class Units>
void record_writer<Record, Units>::drain() {
  const quiet_writes guard;
  servo_event event;
  while (events_.pop(event)) say(to_text(event, units_.joint));
  Record record;
  while (records_.pop(record)) write(record);
  if (outputs_.csv != nullptr && std::fflush(outputs_.csv) != 0 && write_error_ == 0) write_error_ = errno;
}

template <class Record, class Units>
void record_writer<Record, Units>::say(const std::string& line) {
  if (outputs_.log == nullptr || line.empty()) return;
  const quiet_writes guard;
  std::fputs((line + '\n').c_str(), outputs_.log);
  std::fflush(outputs_.log);
}

template <class Record, class Units>
void record_writer<Record, Units>::write(const Record& record) {
  if (outputs_.csv != nullptr) put(csv_row(record, units_));
  if (outputs_.observe) outputs_.observe(record);
}

template <class Record, class Units>
void record_writer<Record, Units>::put(const std::string& text) {
  if (write_error_ != 0) return;
  if (std::fwrite(text.data(), 1, text.size(), outputs_.csv) != text.size()) write_error_ = errno;
}

template class record_writer<telemetry_record, telemetry_units>;
template class record_writer<arm_telemetry_record, arm_telemetry_units>;

}  // namespace dashpot
