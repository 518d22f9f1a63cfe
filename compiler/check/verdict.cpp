#include <nlohmann/json.hpp>
#include <sstream>

#include "check.hpp"

namespace dashpot_check {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Device, sample_period, jitter, amplifier_lag, brake_tolerance, largest_speed,
                                   critical_speed, residual_damping, device_damping, cutoff, acceleration,
                                   joint_encoder_step, delay_samples, window, order, best_fit, estimator,
                                   estimator_coefficients)

namespace {

struct Refuted : std::logic_error {
  using std::logic_error::logic_error;
};

void require(bool holds, const char* otherwise) {
  if (!holds) throw Refuted(otherwise);
}

// Of what the brake gives, the share that is left at the largest speed.
Rational share_at_speed(const Device& device) {
  if (device.critical_speed == 0) return 1;
  const Rational ratio = Rational(device.largest_speed) / Rational(device.critical_speed);
  return device.largest_speed == 0 ? Rational(0) : 1 / (1 + ratio * ratio);
}

}  // namespace

Verdict verdict(const std::string& header, const std::string& certificate) {
  try {
    const auto stated = nlohmann::json::parse(certificate);
    const auto &passivity = stated.at("passivity"), &storage = stated.at("storage");
    if (passivity.at("any_regime").get<bool>() || passivity.at("any_value").get<bool>())
      throw Unknown("the law has slips, a contact or values that change, and only linear laws are known here");
    const Program program = program_of(header);
    Device device = stated.at("loop");
    const double needed = passivity.at("needed_damping");
    const bool is_punctual = passivity.at("constant_period_only"), is_certified = passivity.at("certified");
    const Rational period = program.constants.at("sample_period"), brake = program.constants.at("damping");
    require(period == device.sample_period || period == float(device.sample_period), "the sample periods differ");
    require(program.constants.at("loop_delay") == device.delay_samples, "the delays differ");
    if (is_punctual) device.jitter = 0;
    const LoopForm loop = loop_form(program, device);
    const Rational longest = Rational(device.sample_period) + Rational(device.jitter);
    if (passivity.at("proof") == "hold")
      require(needed >= hold_stiffness(loop, device) * longest, "the hold certificate asks for more damping");
    else
      require(!storage.is_null() && proves(program, device, storage.at("matrix"), needed),
              "no storage function proves the damping that is stated");
    const Rational share = share_at_speed(device), told = share * (1 - Rational(device.brake_tolerance));
    const Rational assured = told * brake + share * Rational(device.residual_damping) + Rational(device.device_damping);
    require(assured >= needed || !is_certified, "the brake does not surely give the damping that is needed");
    require(assured * (1 + Rational(1e-12)) >= passivity.at("assured_damping").get<double>(), "less is assured");
    if (const auto& added = passivity.at("minimum_damping"); !added.is_null())
      require(assured + told * Rational(added.get<double>()) >= needed, "more would have to be added");
    std::ostringstream words;
    words.precision(17);
    words
        << "proved: with a damping of " << needed
        << " at the tool, no motion takes energy out of the loop, for holds of "
        << (is_punctual ? "one length, " : "any lengths up to ") << longest.convert_to<double>() << " s\n"
        << (is_certified ? "proved: brake and device surely give as much\n"
                         : "not proved: that as much damping is there\n")
        << "assumed: exact arithmetic in output(), update() and step(), no state that is flushed to zero, and a motor "
           "within its\n  limits; delay, lag, estimator and damping of the device as the certificate states them\n"
        << "not proved here: that the constants are those of the network, the remarks and the other functions of the "
           "header,\n  what the encoder's steps, rounding and the motor's limits add\n";
    return {true, true, words.str()};
  } catch (const Refuted& refusal) {
    return {false, true, std::string("not proved: ") + refusal.what() + "\n"};
  } catch (const std::out_of_range&) {
    return {false, false, "not proved here: a name or a place is used that is not there\n"};
  } catch (const std::exception& refusal) {
    return {false, false, std::string("not proved here: ") + refusal.what() + "\n"};
  }
}

}  // namespace dashpot_check
