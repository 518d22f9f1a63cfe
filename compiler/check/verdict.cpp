#include <sstream>

#include "check.hpp"

namespace dashpot_check {
namespace {

// The least physical damping while the brake is told `brake`: (1 − ε) b + b_residual, faded at the largest speed, and
// the mechanics' own.
Rational assured(const Device& device, const Rational& brake) {
  const Rational critical = device.critical_speed, speed = device.largest_speed;
  Rational share = critical == 0 ? 1 : 0;
  if (critical != 0 && speed != 0) share = 1 / (1 + speed * speed / (critical * critical));
  return share * ((1 - Rational(device.brake_tolerance)) * brake + Rational(device.residual_damping)) +
         Rational(device.device_damping);
}

void require(bool holds, const char* otherwise) {
  if (!holds) throw Unknown(otherwise);
}

}  // namespace

Verdict verdict(const std::string& header, const nlohmann::json& certificate) {
  std::ostringstream words;
  words.precision(17);
  try {
    const Program program = program_of(header);
    const Device device = certificate.at("loop");
    const auto &passivity = certificate.at("passivity"), &storage = certificate.at("storage");
    const bool by_storage = !storage.is_null();
    const double needed = by_storage ? storage.at("damping") : passivity.at("needed_damping");
    const Rational period = device.sample_period, longest = period + Rational(device.jitter);
    const Rational brake = program.constants.at("damping").at(0);
    require(program.constants.at("sample_period").at(0) == period,
            "header and certificate differ in the sample period");
    require(program.constants.at("loop_delay").at(0) == device.delay_samples,
            "header and certificate differ in the delay");
    const LoopForm loop = loop_form(program, device);
    if (by_storage) {
      require(proves(loop, device, storage.at("matrix").get<Storage>(), needed),
              "the storage function does not prove the damping");
    } else {
      require(passivity.at("proof") == "hold", "the certificate holds no storage function");
      require(device.amplifier_lag == 0 && device.delay_samples == 0, "there is a delay, or a lag");
      require(Rational(needed) >= hold_stiffness(loop) * longest, "the hold certificate asks for more damping");
    }
    const bool enough = assured(device, brake) >= Rational(needed);
    require(enough || !passivity.at("certified").get<bool>(),
            "the brake does not surely give the damping that is needed");
    words << "proved: with a damping of " << needed
          << " at the tool, no motion takes energy out of the loop, whatever the\n"
          << "  lengths of its holds up to " << longest.convert_to<double>() << " s\n"
          << (enough ? "proved: the brake and the device surely give as much\n"
                     : "not proved: that as much damping is there\n")
          << "assumed: exact arithmetic in the statements of output(), update() and step(); the delay, the lag, the\n"
          << "  estimator and the damping of the device as the certificate states them; a motor that is not saturated\n"
          << "not proved here: that the constants are those of the network, the other functions of the header\n";
    return {true, words.str()};
  } catch (const std::exception& refusal) {
    return {false, std::string("not proved: ") + refusal.what() + "\n"};
  }
}

}  // namespace dashpot_check
