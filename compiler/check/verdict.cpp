#include <nlohmann/json.hpp>
#include <sstream>

#include "check.hpp"

namespace dashpot_check {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Device, sample_period, jitter, amplifier_lag, cutoff, acceleration,
                                   joint_encoder_step, delay_samples, window, order, best_fit, estimator,
                                   estimator_coefficients)

namespace {

// β of a motor that position alone drives, without lag: V⁺ − V ≤ m w + β w² with V = ½ k0 u² + Σ F²/(2 c) and
// β = k0/2 + Σ c/(1 + a) + |the answer within a sample that no mode explains|; n samples late, β (1 + 2n).
Rational hold_stiffness(const LoopForm& loop, const Device& device) {
  const std::string drive = "q" + std::to_string(device.delay_samples);
  Rational sum = loop.stiffness / 2, left = of(loop.force, drive);
  if (device.amplifier_lag != 0 || loop.stiffness < 0) throw Unknown("the amplifier lags, or the spring pushes");
  for (std::size_t i = device.delay_samples + 1; i < loop.states.size(); ++i) {
    const Form& next = loop.next.at(loop.states[i]);
    const Rational a = of(next, loop.states[i]), d = of(next, drive);
    if (next.size() != (a == 0 ? 1u : 2u) || a < 0 || a >= 1 || d <= 0 || of(loop.force, loop.states[i]) != 1)
      throw Unknown("'" + loop.states[i] + "' is not a mode that relaxes and that position alone drives");
    sum += a == 0 ? d : Rational(d / (a + a * a)), left -= a == 0 ? Rational(0) : Rational(d / a);
  }
  return (sum + abs(left)) * (1 + 2 * device.delay_samples);
}

struct Refuted : std::domain_error {
  using std::domain_error::domain_error;
};

void require(bool holds, const char* otherwise) {
  if (!holds) throw Refuted(otherwise);
}

std::string proved(const std::string& header, const nlohmann::json& certificate) {
  const auto &passivity = certificate.at("passivity"), &stated = certificate.at("loop");
  if (passivity.at("any_regime").get<bool>() || passivity.at("any_value").get<bool>())
    throw Unknown("the law has slips, a contact or values that change, and only linear laws are known here");
  const auto number = [](const nlohmann::json& of, const char* name) { return Rational(of.at(name).get<double>()); };
  const Program program = program_of(header);
  Device device = stated;
  const Rational needed = number(passivity, "needed_damping"), period = number(stated, "sample_period");
  const bool is_punctual = passivity.at("constant_period_only"), is_certified = passivity.at("certified");
  if (is_punctual) device.jitter = 0;
  const Rational longest = period + device.jitter, said = program.constants.at("sample_period");
  require(said == period || said == float(device.sample_period), "the sample periods differ");
  require(program.constants.at("loop_delay") == device.delay_samples, "the delays differ");
  if (passivity.at("proof") == "hold")
    require(needed >= hold_stiffness(loop_form(program, device), device) * longest,
            "the hold certificate asks for more damping");
  else
    require(
        !certificate.at("storage").is_null() && proves(program, device, certificate.at("storage").at("matrix"), needed),
        "no storage function proves the damping that is stated");
  // Of what the brake gives, the share that is left at the largest speed, v / v_critical.
  const Rational critical = number(stated, "critical_speed"), fastest = number(stated, "largest_speed");
  const Rational ratio = critical == 0 ? Rational(0) : Rational(fastest / critical);
  const Rational share = critical != 0 && fastest == 0 ? Rational(0) : 1 / (1 + ratio * ratio);
  const Rational told = share * (1 - number(stated, "brake_tolerance"));
  const Rational assured = told * program.constants.at("damping") + share * number(stated, "residual_damping") +
                           number(stated, "device_damping");
  require(assured >= needed || !is_certified, "the brake does not surely give the damping that is needed");
  require(assured * (1 + Rational(1e-12)) >= number(passivity, "assured_damping"), "less is assured");
  if (!passivity.at("minimum_damping").is_null())
    require(assured + told * number(passivity, "minimum_damping") >= needed, "more would have to be added");
  std::ostringstream words;
  words.precision(17);
  words << "proved: with a damping of " << needed.convert_to<double>()
        << " at the tool, no motion takes energy out of the loop, for holds of "
        << (is_punctual ? "one length, " : "any lengths up to ") << longest.convert_to<double>() << " s\n"
        << (is_certified ? "proved: brake and device surely give as much\n"
                         : "not proved: that as much damping is there\n");
  if (assured > needed)  // e u̇ ≤ e²/4x + x u̇², x of the damping being left over
    words << "proved: " << Rational(assured - needed).convert_to<double>()
          << " more than that is there; if rounding puts the held force off by e, that brings in at most "
          << Rational(1 / (4 * (assured - needed))).convert_to<double>() << " e^2 a second\n";
  words << "assumed: exact arithmetic in output(), update() and step(), no state that is flushed to zero, and a motor "
           "within its\n  limits; delay, lag, estimator and damping of the device as the certificate states them\n"
           "not proved here: that the constants are those of the network, the remarks and the other functions of the "
           "header,\n  what the encoder's steps and the motor's limits add, and by how much rounding puts the force "
           "off\n";
  return words.str();
}

}  // namespace

std::pair<int, std::string> verdict(const std::string& header, const std::string& certificate) {
  try {
    return {0, proved(header, nlohmann::json::parse(certificate))};
  } catch (const Refuted& refusal) {
    return {1, std::string("not proved: ") + refusal.what() + "\n"};
  } catch (const std::out_of_range&) {
    return {3, "not proved here: a name or a place is used that is not there\n"};
  } catch (const std::exception& refusal) {
    return {3, std::string("not proved here: ") + refusal.what() + "\n"};
  }
}

}  // namespace dashpot_check
