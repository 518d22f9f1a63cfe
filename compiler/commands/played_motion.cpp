#include "commands/played_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/led_device.hpp>
#include <dashpot/simulated/simulated_device.hpp>
#include <nlohmann/json.hpp>

#include "commands/value_columns.hpp"
#include "compile.hpp"
#include "law/evaluate.hpp"
#include "network/port_units.hpp"
#include "network/rate_limits.hpp"

namespace dashpot::compiler {
namespace {

constexpr double finer_steps = 32;  // of a reference that has no closed form, in a period of the loop

// The recorded motion, straight between its rows, from time 0; at rest before and after.
class Path {
 public:
  explicit Path(const Motion& motion) : motion_(motion) {}

  double end() const { return at(motion_.time.size() - 1); }
  double at(std::size_t row) const { return motion_.time[row] - motion_.time.front(); }
  double position_at(std::size_t row) const { return motion_.position[row]; }

  // The last row at or before a time, which is a sum of periods: what is as good as at a row is at it, so that the
  // velocity there is that of the piece that begins.
  std::size_t row(double time) const {
    const double wanted = time + motion_.time.front() + 1e-6 * motion_.period.value_or(0);
    const auto behind = std::upper_bound(motion_.time.begin(), motion_.time.end(), wanted);
    return behind == motion_.time.begin() ? 0 : std::size_t(behind - motion_.time.begin()) - 1;
  }

  simulated::motion_point point(double time) const {
    const std::size_t before = row(time);
    const bool at_rest = time < 0 || before + 1 == motion_.time.size();
    if (at_rest) return {motion_.position[before], 0};
    const double slope = (motion_.position[before + 1] - motion_.position[before]) / (at(before + 1) - at(before));
    return {motion_.position[before] + slope * (time - at(before)), slope};
  }

 private:
  const Motion& motion_;
};

// k0 u + b∞ u̇ + Σ F_i of a linear network under the motion, exactly: F_i decays, and along a straight piece it gains
// B_i u̇ (1 − e^(−λ t)) (theory, section 3).
class ClosedForm {
 public:
  ClosedForm(const LinearForm& form, const Path& path)
      : path_(path),
        static_stiffness_(to_double(form.static_stiffness)),
        feedthrough_(to_double(form.feedthrough_damping)) {
    for (const Mode& mode : form.modes)
      modes_.push_back({to_double(mode.relaxation_rate), to_double(mode.damping()), 0});
  }

  // Times must not fall.
  double force_at(double time) {
    while (next_row_ < path_.row(time) + 1) go_to(path_.at(next_row_++));
    go_to(time);
    const simulated::motion_point here = path_.point(time);
    double force = static_stiffness_ * here.position + feedthrough_ * here.velocity;
    for (const Relaxation& mode : modes_) force += mode.force;
    return force;
  }

 private:
  struct Relaxation {
    double rate, damping, force;
  };

  void go_to(double time) {
    const double duration = time - time_;
    if (!(duration > 0)) return;
    const double velocity = path_.point(time_ + duration / 2).velocity;
    for (Relaxation& mode : modes_) {
      const double lost = -std::expm1(-mode.rate * duration);
      mode.force += (mode.damping * velocity - mode.force) * lost;
    }
    time_ = time;
  }

  const Path& path_;
  double static_stiffness_, feedthrough_;
  std::vector<Relaxation> modes_;
  double time_ = 0;
  std::size_t next_row_ = 1;
};

// The force of a network with slips, a contact, a static curve or tunables, by its own steps in quick succession, all
// of it made by the motor: no brake and no estimate take part. Between two steps it is straight.
class OwnSteps {
 public:
  OwnSteps(const Compilation& fine, const Motion& motion, const Path& path, Diagnostics& diagnostics)
      : path_(path), law_(fine.law), values_(fine, motion, diagnostics), period_(1 / fine.rate) {
    law_.reset(path.position_at(0));
    last_ = force_ = step(0);
  }

  double force_at(double time) {
    Diagnostics heard_from_the_device;
    while (double(steps_) * period_ < time) {
      last_ = force_;
      ++steps_;
      values_.set(law_, path_.row(double(steps_) * period_), double(steps_) * period_, heard_from_the_device);
      force_ = step(double(steps_) * period_);
    }
    const double behind = std::clamp(double(steps_) - time / period_, 0.0, 1.0);
    return force_ + (last_ - force_) * behind;
  }

 private:
  double step(double time) {
    const double position = path_.point(time).position;
    const double velocity = steps_ == 0 ? 0 : (position - position_) / period_;
    position_ = position;
    const command<double> now = law_.step(position, velocity);
    return now.damping * velocity + now.force;
  }

  const Path& path_;
  Evaluation<double> law_;
  ValueColumns values_;
  double period_, position_ = 0, last_ = 0, force_ = 0;
  std::uint64_t steps_ = 0;
};

bool has_closed_form(const Compilation& c) {
  return !c.form.has_slips() && !c.network.contact && !c.network.map && !c.law.tunable;
}

std::optional<Compilation> compiled_finely(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  Choices fine = choices;
  fine.decomposition = "virtual";
  fine.state_input.reset();
  fine.scheme = Scheme::exact;
  fine.scalar = ScalarType::float64;
  fine.rate = std::min(c.rate * finer_steps, highest_rate);
  Diagnostics of_rates;  // what a finer rate is told of is not for the device
  StageTimes unseen;
  std::optional<Compilation> compiled = compile(c.network, fine, std::nullopt, of_rates, unseen);
  if (!compiled) compile(c.network, fine, std::nullopt, diagnostics, unseen);
  return compiled;
}

// Law and device in the order of a servo loop: read, estimate, step, drive, write.
template <class Scalar>
class DevicePlayer {
 public:
  DevicePlayer(const Compilation& c, const Motion& motion, const Path& path, std::uint64_t seed,
               Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        description_(c.device->description),
        path_(path),
        values_(c, motion, diagnostics),
        lead_in_(lead_in_samples(description_) * description_.loop.sample_period),
        device_(description_, scene(c.network.port_motion, seed)),
        estimator_(description_.velocity, description_.loop.sample_period, description_.encoder.step),
        actuator_(description_, c.network.port_motion),
        law_(c.law) {
    const double start = path.position_at(0);
    law_.reset(static_cast<Scalar>(start));
    stored_at_start_ = double(law_.stored_energy());
    estimator_.reset(actuator_.gear().joint_motion(start));
  }

  static const char* refusal(const device_description& description, motion network) {
    simulated::scenario scene;
    scene.network = network;
    scene.prescribed = true;
    scene.intended = simulated::hold_at(0);
    return simulated_device::refusal(description, scene);
  }

  // Nothing before the motion begins. The closed form is left to the caller.
  std::optional<PlayedSample> next() {
    device_sample sample{};
    device_.read(sample);
    const transmission<double>& gear = actuator_.gear();
    const simulated::plant_view before = device_.truth();
    const double since = before.time - lead_in_, time = std::abs(since) < 1e-9 * lead_in_ ? 0 : since;
    if (time >= 0) values_.set(law_, path_.row(time), time, diagnostics_);
    const Scalar position = static_cast<Scalar>(gear.tool_motion(sample.position)),
                 velocity = static_cast<Scalar>(gear.tool_motion(estimator_.update(sample)));
    const command<Scalar> wanted = law_.step(position, velocity);
    const actuator_output<double> driven =
        actuator_.drive({double(wanted.damping), double(wanted.force)}, double(velocity));
    device_.write(driven.demand());
    if (time < 0) return std::nullopt;
    const simulated::energy_ledger& ledger = device_.ledger();
    if (!taken_before_) taken_before_ = ledger.brake - ledger.motor;
    energy_ = ledger.brake - ledger.motor - *taken_before_;
    const auto felt = [&](const simulated::plant_view& view) {
      return gear.tool_force(view.brake_damping * view.velocity - view.motor_torque);
    };
    return PlayedSample{time,
                        gear.tool_motion(before.position),
                        double(velocity),
                        (felt(before) + felt(device_.truth_from_now_on())) / 2,
                        0,
                        double(wanted.damping),
                        double(wanted.force),
                        driven.motor_saturated() || law_.kept_share() < 1};
  }

  double stored_at_start() const { return stored_at_start_; }  // by the network, held at its first position [J]
  double energy() const { return energy_; }                    // taken from the tool since the motion began [J]

 private:
  simulated::scenario scene(motion network, std::uint64_t seed) const {
    simulated::scenario scene;
    scene.network = network;
    scene.prescribed = true;
    scene.intended = [path = &path_, lead_in = lead_in_](double time) { return path->point(time - lead_in); };
    scene.initial_position = path_.position_at(0);
    scene.seed = seed;
    return scene;
  }

  Diagnostics& diagnostics_;
  const device_description& description_;
  const Path& path_;
  ValueColumns values_;
  double lead_in_;  // [s]
  simulated_device device_;
  any_estimator<double> estimator_;
  actuator<double> actuator_;
  Evaluation<Scalar> law_;
  std::optional<double> taken_before_;
  double stored_at_start_ = 0, energy_ = 0;
};

void sum_up(PlayedMotion& played) {
  double errors = 0, forces = 0;
  for (const PlayedSample& sample : played.samples) {
    const double error = sample.felt_force - sample.closed_form;
    errors += error * error;
    forces += sample.closed_form * sample.closed_form;
    played.peak_error = std::max(played.peak_error, std::abs(error));
    played.peak_force = std::max(played.peak_force, std::abs(sample.closed_form));
    played.mean_damping += sample.damping;
    played.most_damping = std::max(played.most_damping, sample.damping);
    played.limited += sample.is_limited ? 1 : 0;
  }
  const double count = double(std::max<std::size_t>(played.samples.size(), 1));
  played.mean_damping /= count;
  played.rms_error = std::sqrt(errors / count);
  played.rms_force = std::sqrt(forces / count);
}

template <class Scalar, class Reference>
PlayedMotion played_by(DevicePlayer<Scalar> player, Reference reference, double end, double period) {
  PlayedMotion played;
  played.stored_at_start = player.stored_at_start();
  const auto count = static_cast<std::size_t>(end / period + 1e-9) + 1;
  while (played.samples.size() < count) {
    std::optional<PlayedSample> sample = player.next();
    if (!sample) continue;
    sample->closed_form = reference.force_at(sample->time);
    played.samples.push_back(*sample);
    played.energy = player.energy();
    played.lowest_energy = std::min(played.lowest_energy, played.energy);
  }
  sum_up(played);
  return played;
}

double share(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

}  // namespace

std::optional<PlayedMotion> play(const Compilation& c, const Choices& choices, const Motion& motion, std::uint64_t seed,
                                 Diagnostics& diagnostics) {
  const device_description& device = c.device->description;
  if (const char* refusal = DevicePlayer<double>::refusal(device, c.network.port_motion)) {
    diagnostics.report<DiagnosticCode::cannot_start_device>({}, c.device->name, std::string(refusal));
    return std::nullopt;
  }
  warn_outside_valid(motion, c.network, diagnostics);
  const Path path(motion);
  const std::optional<Compilation> fine = has_closed_form(c) ? std::nullopt : compiled_finely(c, choices, diagnostics);
  ValueColumns(c, motion, diagnostics);
  if (diagnostics.has_errors() || (!fine && !has_closed_form(c))) return std::nullopt;
  Diagnostics told_once;
  const auto run = [&](auto player) {
    const double end = path.end(), period = device.loop.sample_period;
    return fine ? played_by(std::move(player), OwnSteps(*fine, motion, path, told_once), end, period)
                : played_by(std::move(player), ClosedForm(c.form.linear, path), end, period);
  };
  if (c.law.scalar == ScalarType::float32) return run(DevicePlayer<float>(c, motion, path, seed, diagnostics));
  return run(DevicePlayer<double>(c, motion, path, seed, diagnostics));
}

std::string csv_of(const PlayedMotion& played) {
  std::string text = "time,position,estimate,felt_force,closed_form,damping,motor_force\n";
  for (const PlayedSample& s : played.samples)
    text += fmt::format("{},{},{},{},{},{},{}\n", s.time, s.position, s.estimate, s.felt_force, s.closed_form,
                        s.damping, s.motor_force);
  return text;
}

std::string to_text(const PlayedMotion& p, const Compilation& c) {
  const PortUnits units = port_units(c.network.port_motion);
  const double added = c.certificate.added_damping;
  std::string text = fmt::format("{} on {}: {} samples at {:.6g} Hz, decomposition {}\n", c.network.name,
                                 c.device->name, p.samples.size(), c.rate, c.decomposition.choice().name);
  text += fmt::format("the brake is told {:.4g} {} on average, {:.4g} at most", p.mean_damping, units.damping,
                      p.most_damping);
  if (added > 0) text += fmt::format("; of it {:.4g} are there for passivity alone", added);
  text += fmt::format("\nthe network's force: rms {:.4g} {}, peak {:.4g} {}\n", p.rms_force, units.force, p.peak_force,
                      units.force);
  if (p.limited > 0)
    text += fmt::format("the motor's limits: it could not make the force of {} samples in {}\n", p.limited,
                        p.samples.size());
  return text +
         fmt::format("error of what is felt: rms {:.4g} {} ({:.3g} %), peak {:.4g} {} ({:.3g} %)\n", p.rms_error,
                     units.force, share(p.rms_error, p.rms_force), p.peak_error, units.force,
                     share(p.peak_error, p.peak_force)) +
         fmt::format("energy: {:.4g} J that motor and brake took from the tool, never below {:.4g} J{}\n", p.energy,
                     p.lowest_energy,
                     p.stored_at_start > 0
                         ? fmt::format("; the network held {:.4g} J as the motion began", p.stored_at_start)
                         : "");
}

std::string to_json(const PlayedMotion& p, const Compilation& c, const std::string& file) {
  const Candidate& choice = c.decomposition.choice();
  const nlohmann::ordered_json all = {
      {"name", c.network.name},
      {"device", c.device->name},
      {"rate", c.rate},
      {"samples", p.samples.size()},
      {"decomposition", choice.name},
      {"damping", choice.damping},
      {"brake", {{"mean", p.mean_damping}, {"most", p.most_damping}, {"for_passivity", c.certificate.added_damping}}},
      {"limited_samples", p.limited},
      {"force", {{"rms", p.rms_force}, {"peak", p.peak_force}}},
      {"error",
       {{"rms", p.rms_error},
        {"peak", p.peak_error},
        {"rms_share", p.rms_force > 0 ? p.rms_error / p.rms_force : 0},
        {"peak_share", p.peak_force > 0 ? p.peak_error / p.peak_force : 0}}},
      {"energy", {{"taken", p.energy}, {"lowest", p.lowest_energy}, {"stored_at_start", p.stored_at_start}}},
      {"file", file}};
  return all.dump(2) + "\n";
}

}  // namespace dashpot::compiler
