// A data-acquisition card under Comedi as a device of the servo loop (dashpot/device.hpp): a counter for the encoder,
// an analogue output for the motor's amplifier, another for the brake's.
//
//     dashpot::comedi_device device(wiring, description);
//     device.start(error);                            // opens, compares, makes safe, arms the counter
//     device.read(sample); device.write(actuation);   // once a period; no heap, no lock of ours
//
// Where the description states a delay of one sample, a cycle is one list of instructions: read() writes both outputs
// of the cycle before and reads the counter. Where it states none, write() sends its own list at once. What ends a
// loop, motor 0 and the safe damping, is always sent at once. One thread at a time.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <dashpot/device.hpp>

struct comedi_t_struct;

namespace dashpot {

struct comedi_counter {
  unsigned subdevice = 0;
  unsigned channel = 0;
  bool is_configured = false;  // by `mode`, before it is armed; otherwise left as whoever set it up has left it
  unsigned mode = 0;           // the driver's own bits, as comedi_set_counter_mode() takes them
};

struct comedi_output {
  unsigned subdevice = 0;
  unsigned channel = 0;
  unsigned range = 0;
  unsigned reference = 0;       // AREF_GROUND and the like
  double current_per_volt = 0;  // of the amplifier behind it [A/V]; negative where it is wired the other way round
};

// A measured point of the brake: joint damping that this voltage makes.
struct brake_point {
  double voltage = 0;  // [V]
  double damping = 0;  // [N·m·s/rad] or [N·s/m]
};

struct comedi_wiring {
  std::string file = "/dev/comedi0";
  comedi_counter counter;
  comedi_output motor;
  comedi_output brake;  // without meaning where the device has none
  // With points the brake follows them, √b straight between two; the first makes none. Empty: i = √(b/κ), from
  // damping_per_current_squared and current_per_volt.
  std::vector<brake_point> brake_points;
};

class comedi_device {
 public:
  comedi_device(comedi_wiring wiring, const device_description& description);
  ~comedi_device();  // close()
  comedi_device(const comedi_device&) = delete;
  comedi_device& operator=(const comedi_device&) = delete;

  // False with what is wrong and what would do in `error`: a card that does not open, an output that is none or not in
  // volts, a range that does not reach what the description states, a counter that wraps within a sample.
  bool start(std::string& error);

  // ok            `sample` is new; its position is 0 where the tool was in start()
  // fault         the card refused; it has been asked for the safe command. cause() says what it refused
  // disconnected  start() has not succeeded, or the card is gone
  device_status read(device_sample& sample) noexcept;

  // ok            the command has left, or leaves with the next read() where the description states a delay
  // fault         not finite, or the card refused; motor 0 and the safe damping were sent instead
  // disconnected  as above
  device_status write(const actuation& command) noexcept;

  // Motor 0, safe damping, and the card is released. The outputs stay there.
  void close() noexcept;

  const device_description& description() const noexcept { return description_; }
  const char* cause() const noexcept { return cause_; }

  // What an actuation is on the two outputs, within their limits [V].
  std::pair<double, double> voltages(const actuation& command) const noexcept;

 private:
  struct scale {
    double low = 0, high = 0;  // [V]
    unsigned most = 0;         // the sample that stands for `high`
    unsigned sample(double voltage) const noexcept;
  };

  bool has_brake() const noexcept { return description_.brake.kind != brake_kind::none; }
  bool check_description(std::string& error) const;
  bool open_card(std::string& error);
  bool find_output(const char* what, const comedi_output& output, scale& found, std::string& error);
  bool check_reach(std::string& error) const;
  bool arm_counter(std::string& error);
  double brake_voltage(double damping) const noexcept;
  actuation within_limits(const actuation& command) const noexcept;
  actuation safe() const noexcept { return {0, description_.brake.safe_damping}; }
  bool run_list(const actuation* command, unsigned* counts) noexcept;
  device_status refused(const char* what) noexcept;
  void take_counts(unsigned counts) noexcept;

  comedi_wiring wiring_;
  device_description description_;
  comedi_t_struct* card_ = nullptr;
  scale motor_, brake_;
  unsigned most_counts_ = 0;
  unsigned last_counts_ = 0;
  std::int64_t position_ = 0;  // counts since start(), as if the counter never wrapped around
  std::uint32_t samples_ = 0;
  actuation in_force_, pending_;
  bool has_pending_ = false;
  const char* cause_ = "start() has not succeeded";
};

}  // namespace dashpot
