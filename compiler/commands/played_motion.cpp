#include "commands/played_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/led_device.hpp>
#include <dashpot/simulated/simulated_device.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "network/port_units.hpp"
#include "network/rate_limits.hpp"

namespace dashpot::compiler {
namespace {

// Law and device in the order of a servo loop: read, estimate, step, drive, write.
template <class Scalar>
class DevicePlayer : public Player {
 public:
  DevicePlayer(const Compilation& c, const ValueColumns& values, const RecordedPath& path, std::uint64_t seed,
               Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        description_(c.device->description),
        path_(path),
        values_(values),
        lead_in_(lead_in_samples(description_) * description_.loop.sample_period),
        device_(description_, scene(c.network.port_motion, seed)),
        estimator_(description_.velocity, description_.loop.sample_period, description_.encoder.step),
        actuator_(description_, c.network.port_motion),
        law_(c.law) {
    const double start = path.point(0).position;
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

  std::optional<PlayedSample> next() override {
    device_sample sample{};
    device_.read(sample);
    const transmission<double>& gear = actuator_.gear();
    const simulated::plant_view before = device_.truth();
    const double since = before.time - lead_in_, time = std::abs(since) < 1e-9 * lead_in_ ? 0 : since;
    if (time >= 0) {
      values_.warn_outside_range(path_.piece(time), time, diagnostics_);
      values_.set(law_, path_.piece(time));
    }
    const Scalar position = static_cast<Scalar>(gear.tool_motion(sample.position)),
                 velocity = static_cast<Scalar>(gear.tool_motion(estimator_.update(sample)));
    const command<Scalar> wanted = law_.step(position, velocity);
    const actuator_output<double> driven =
        actuator_.drive({double(wanted.damping), double(wanted.force)}, double(velocity));
    device_.write(driven.demand());
    if (time < 0) return std::nullopt;
    look_at(device_.ledger());
    const auto felt = [&](const simulated::plant_view& view) {
      return gear.tool_force(view.brake_damping * view.velocity - view.motor_torque);
    };
    PlayedSample played;
    played.time = time;
    played.position[0] = gear.tool_motion(before.position);
    played.estimate[0] = double(velocity);
    played.felt_force[0] = (felt(before) + felt(device_.truth_from_now_on())) / 2;
    played.damping[0] = double(wanted.damping);
    played.motor_force[0] = double(wanted.force);
    played.is_limited = driven.motor_saturated() || law_.kept_share() < 1;
    return played;
  }

 private:
  simulated::scenario scene(motion network, std::uint64_t seed) const {
    simulated::scenario scene;
    scene.network = network;
    scene.prescribed = true;
    scene.intended = [path = &path_, lead_in = lead_in_](double time) { return path->point(time - lead_in); };
    scene.initial_position = path_.point(0).position;
    scene.seed = seed;
    return scene;
  }

  Diagnostics& diagnostics_;
  const device_description& description_;
  const RecordedPath& path_;
  ValueColumns values_;
  double lead_in_;  // [s]
  simulated_device device_;
  any_estimator<double> estimator_;
  actuator<double> actuator_;
  Evaluation<Scalar> law_;
};

// Root mean squares are summed up as mean squares.
void add(ForceError& error, double felt_off, double wanted, double count) {
  error.rms_error += felt_off * felt_off / count;
  error.rms_force += wanted * wanted / count;
  error.peak_error = std::max(error.peak_error, std::abs(felt_off));
  error.peak_force = std::max(error.peak_force, std::abs(wanted));
}

void sum_up(PlayedMotion& played) {
  const double count = double(std::max<std::size_t>(played.samples.size(), 1));
  double number = 0;
  for (const PlayedSample& sample : played.samples) {
    ++number;
    for (unsigned j = 0; j < played.axes; ++j)
      add(played.errors[j], sample.felt_force[j] - sample.closed_form[j], sample.closed_form[j], count);
    const auto& [felt, wanted] = std::pair(sample.felt_at_tip, sample.closed_form_at_tip);
    add(played.at_tip, std::hypot(felt[0] - wanted[0], felt[1] - wanted[1]), std::hypot(wanted[0], wanted[1]), count);
    for (unsigned i = 0; i < played.brakes; ++i) {
      // Of those so far, which no rounding takes beyond the largest of them.
      played.mean_damping[i] += (sample.damping[i] - played.mean_damping[i]) / number;
      played.most_damping[i] = std::max(played.most_damping[i], sample.damping[i]);
    }
    played.limited += sample.is_limited ? 1 : 0;
  }
  for (ForceError* error : {&played.errors[0], &played.errors[1], &played.at_tip}) {
    error->rms_error = std::sqrt(error->rms_error);
    error->rms_force = std::sqrt(error->rms_force);
  }
}

bool is_finite(const PlayedSample& sample, unsigned axis) {
  const double wanted = sample.closed_form[axis], off = sample.felt_force[axis] - wanted;
  return all_finite(sample.position[axis], sample.estimate[axis], sample.motor_force[axis]) &&
         all_finite(wanted * wanted, off * off);
}

// Nothing where there is nothing to be a share of.
std::optional<double> share(double part, double whole) {
  return whole > 0 ? std::optional(part / whole) : std::nullopt;
}

std::string text_of_share(double part, double whole) {
  const std::optional<double> of_it = share(part, whole);
  return of_it ? fmt::format(" ({:.3g} %)", 100 * *of_it) : "";
}

nlohmann::ordered_json json_of_share(double part, double whole) {
  const std::optional<double> of_it = share(part, whole);
  return of_it ? nlohmann::ordered_json(*of_it) : nlohmann::ordered_json();
}

}  // namespace

void Player::look_at(const simulated::energy_ledger& ledger) {
  const double taken = ledger.brake - ledger.motor;
  if (!taken_before_) taken_before_ = taken;
  energy_ = taken - *taken_before_;
}

bool has_speeds(const RecordedPath& path, Diagnostics& diagnostics) {
  const std::optional<std::size_t> row = path.first_beyond(std::numeric_limits<double>::max());
  if (!row) return true;
  const simulated::motion_point there = path.beginning(*row);
  diagnostics.report<DiagnosticCode::answer_not_finite>({}, path.at(*row), there.position, there.velocity);
  return false;
}

void warn_of_speed(const RecordedPath& path, double limit, const std::string& what, const std::string& unit, Span span,
                   Diagnostics& diagnostics) {
  const std::optional<std::size_t> row = limit > 0 ? path.first_beyond(limit) : std::nullopt;
  if (row)
    diagnostics.report<DiagnosticCode::motion_too_fast>(span, path.at(*row), what, path.beginning(*row).velocity, unit,
                                                        limit, unit);
}

std::optional<PlayedMotion> played_by(Player& player, const std::function<void(PlayedSample&)>& answer, unsigned axes,
                                      unsigned brakes, double end, double period, Diagnostics& diagnostics) {
  PlayedMotion played;
  played.axes = axes, played.brakes = brakes;
  played.stored_at_start = player.stored_at_start();
  const auto count = static_cast<std::size_t>(end / period + 1e-9) + 1;
  while (played.samples.size() < count) {
    std::optional<PlayedSample> sample = player.next();
    if (!sample) continue;
    answer(*sample);
    played.samples.push_back(*sample);
    played.energy = player.energy();
    played.lowest_energy = std::min(played.lowest_energy, played.energy);
    for (unsigned j = 0; j < axes; ++j) {
      if (is_finite(*sample, j) && std::isfinite(played.energy)) continue;
      diagnostics.report<DiagnosticCode::answer_not_finite>({}, sample->time, sample->position[j], sample->velocity[j]);
      return std::nullopt;
    }
  }
  sum_up(played);
  return played;
}

std::optional<PlayedMotion> play(const Compilation& c, const Choices& choices, const Motion& motion, std::uint64_t seed,
                                 Diagnostics& diagnostics) {
  const device_description& device = c.device->description;
  if (const char* refusal = DevicePlayer<double>::refusal(device, c.network.port_motion)) {
    diagnostics.report<DiagnosticCode::cannot_start_device>({}, c.device->name, std::string(refusal));
    return std::nullopt;
  }
  const RecordedPath path(motion, motion.position);
  if (!has_speeds(path, diagnostics)) return std::nullopt;
  warn_outside_valid(motion, c.network, diagnostics);
  const std::optional<ReferenceForce> reference = ReferenceForce::of(c, choices, diagnostics);
  const ValueColumns values(c, motion, diagnostics);
  if (diagnostics.has_errors() || !reference) return std::nullopt;
  const std::unique_ptr<NetworkForce> force = reference->along(path, values);
  const auto answer = [&](PlayedSample& sample) {
    sample.velocity[0] = path.point(sample.time).velocity;
    sample.closed_form[0] = force->force_at(sample.time);
  };
  const auto run = [&](auto player) {
    return played_by(player, answer, 1, 1, path.end(), device.loop.sample_period, diagnostics);
  };
  if (c.law.scalar == ScalarType::float32) return run(DevicePlayer<float>(c, values, path, seed, diagnostics));
  return run(DevicePlayer<double>(c, values, path, seed, diagnostics));
}

std::string csv_of(const PlayedMotion& played) {
  std::string text = "time,position,estimate,felt_force,closed_form,damping,motor_force\n";
  for (const PlayedSample& s : played.samples)
    text += fmt::format("{},{},{},{},{},{},{}\n", s.time, s.position[0], s.estimate[0], s.felt_force[0],
                        s.closed_form[0], s.damping[0], s.motor_force[0]);
  return text;
}

std::string text_of_error(const ForceError& error, const std::string& unit) {
  return fmt::format("rms {:.4g} {}{}, peak {:.4g} {}{}", error.rms_error, unit,
                     text_of_share(error.rms_error, error.rms_force), error.peak_error, unit,
                     text_of_share(error.peak_error, error.peak_force));
}

std::string text_of_brake(double mean, double most, double for_passivity, const std::string& unit) {
  return fmt::format("{:.4g} {} on average, {:.4g} at most", mean, unit, most) +
         (for_passivity > 0 ? fmt::format("; {:.4g} of it are for passivity alone", for_passivity) : "");
}

std::string text_of_limits(const PlayedMotion& p) {
  if (p.limited == 0) return "";
  if (p.axes > 1)
    return fmt::format(
        "the motors' limits: reached in {} samples of {}; each motor then makes what it can, and nothing is proved\n",
        p.limited, p.samples.size());
  return fmt::format(
      "the motor's limits: reached in {} samples of {}; a law that scales its forces down there asks for less "
      "afterwards\n",
      p.limited, p.samples.size());
}

std::string text_of_energy(const PlayedMotion& p) {
  return fmt::format(
      "energy: {:.4g} J that {} took from the tool, never below {:.4g} J{}\n", p.energy,
      p.axes == 1 ? "motor and brake" : "motors and brakes", p.lowest_energy,
      p.stored_at_start > 0 ? fmt::format("; the network held {:.4g} J as the motion began", p.stored_at_start) : "");
}

std::string to_text(const PlayedMotion& p, const Compilation& c) {
  const PortUnits units = port_units(c.network.port_motion);
  return fmt::format("{} on {}: {} samples at {:.6g} Hz, decomposition {}\n", c.network.name, c.device->name,
                     p.samples.size(), c.rate, c.decomposition.choice().name) +
         "the brake's command is " +
         text_of_brake(p.mean_damping[0], p.most_damping[0], c.certificate.added_damping, units.damping) +
         fmt::format("\nthe network's force: rms {:.4g} {}, peak {:.4g} {}\n", p.errors[0].rms_force, units.force,
                     p.errors[0].peak_force, units.force) +
         text_of_limits(p) + "felt error: " + text_of_error(p.errors[0], units.force) + "\n" + text_of_energy(p);
}

nlohmann::ordered_json json_of_force(const ForceError& error) {
  return {{"rms", error.rms_force}, {"peak", error.peak_force}};
}

nlohmann::ordered_json json_of_error(const ForceError& error) {
  return {{"rms", error.rms_error},
          {"peak", error.peak_error},
          {"rms_share", json_of_share(error.rms_error, error.rms_force)},
          {"peak_share", json_of_share(error.peak_error, error.peak_force)}};
}

nlohmann::ordered_json json_of_energy(const PlayedMotion& p) {
  return {{"taken", p.energy}, {"lowest", p.lowest_energy}, {"stored_at_start", p.stored_at_start}};
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
      {"brake",
       {{"mean", p.mean_damping[0]}, {"most", p.most_damping[0]}, {"for_passivity", c.certificate.added_damping}}},
      {"limited_samples", p.limited},
      {"force", json_of_force(p.errors[0])},
      {"error", json_of_error(p.errors[0])},
      {"energy", json_of_energy(p)},
      {"file", file}};
  return all.dump(2) + "\n";
}

}  // namespace dashpot::compiler
