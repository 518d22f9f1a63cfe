// Whether a header and its certificate prove what they say (theory, sections 6a and 6b). Nothing in this folder
// includes anything of the compiler: it shares no code with what it checks. What cannot be checked is thrown as
// Unknown.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace dashpot_check {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using Form = std::map<std::string, Rational>;  // a sum: coefficients by quantity, the constant under the empty name
using Matrix = std::vector<std::vector<Integer>>;

struct Unknown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline Form operator+(Form sum, const Form& other) {
  for (const auto& [name, value] : other)
    if ((sum[name] += value) == 0) sum.erase(name);
  return sum;
}
inline Form operator*(const Rational& factor, Form form) {
  for (auto& [name, value] : form) value *= factor;
  return factor == 0 ? Form{} : form;
}
inline Rational of(const Form& form, const std::string& name) { return form.count(name) ? form.at(name) : Rational(0); }

// What a header computes in a sample: its statements carried out exactly, but that a state is not flushed to zero.
struct Program {
  std::map<std::string, std::vector<Rational>> constants;
  std::vector<std::string> states;   // in the order of the text
  std::map<std::string, Form> next;  // what they become, of the states, `position` and `velocity`
  Form force;
};
Program program_of(const std::string& header);

// The certificate's "loop", in SI.
struct Device {
  double sample_period, jitter, amplifier_lag, brake_tolerance, largest_speed, critical_speed, residual_damping;
  double device_damping, cutoff, acceleration, joint_encoder_step;
  unsigned delay_samples, window, order;
  std::string estimator;
  std::vector<double> estimator_coefficients;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Device, sample_period, jitter, amplifier_lag, brake_tolerance, largest_speed,
                                   critical_speed, residual_damping, device_damping, cutoff, acceleration,
                                   joint_encoder_step, delay_samples, window, order, estimator, estimator_coefficients)

// The loop as one linear recursion: w is the tool's displacement over the hold that follows, u the position at the
// sample; the motor holds stiffness·u + force. States: the last displacements q0, q1 …, those of the estimator, for
// every force G of the law F = G + c Δu + d v̂, where c and d are near G's drives over its decay (exact whatever they
// are), and with an amplifier lag what the force still lacks at the sample, whose own decay is left out here.
struct LoopForm {
  std::vector<std::string> states;
  std::map<std::string, Form> next;  // of the states and w
  Form force;                        // of the states [N]
  Rational stiffness;                // k0 [N/m]
  bool follows_estimate = false;
};
LoopForm loop_form(const Program& program, const Device& device);

// By M = L Lᵀ + R with a diagonally dominant R, in integers. Of M, what is on and below the diagonal is read.
bool is_nonnegative(const Matrix& matrix);

// Whether `storage`, P by rows up to the diagonal, proves that `damping` [N·s/m] is enough for any motion and all holds
// up to the longest. With V = ½ k0 u² + xᵀPx, V⁺ − V ≤ (k0 u + Cx) w + b w²/T for all x and w when P ⪰ 0 and
//     M = [ P − AᵀPA,  ½C − AᵀPB;  ·,  b/T − ½k0 − BᵀPB ] ⪰ 0.
// A lag τ adds e, the force that is lacking, e⁺ = q e + …, and the independent input ρ = ∫ (e^{−s/τ} − p) u̇ ds: work
// (Cx + pe) w + eρ, dissipation b (w²/T + ρ²/(κT)), q = e^{−T/τ}, p = (1 − q) τ/T, κ = p ((1 + q)/2 − p).
using Storage = std::vector<std::vector<double>>;
bool proves(const LoopForm& loop, const Device& device, const Storage& storage, const Rational& damping);

// The holds from the shortest to the longest in parts, each with its longest and the corners of its lag: M is concave
// in q, affine in p and falls with κ.
struct LagHold {
  Rational decay, share, spread;  // q; p; not below κ; all zero without a lag
};
struct HoldPart {
  Rational longest;  // [s]
  std::vector<LagHold> corners;
};
std::vector<HoldPart> hold_parts(const Device& device);

// β of a motor that position alone drives, in time and without lag: V⁺ − V ≤ m w + β w² with V = ½ k0 u² + Σ F²/(2 c),
// β = k0/2 + Σ c/(1 + a) + |the answer within a sample that no mode explains|.
Rational hold_stiffness(const LoopForm& loop);

struct Verdict {
  bool proved = false;
  std::string words;
};
Verdict verdict(const std::string& header, const nlohmann::json& certificate);

}  // namespace dashpot_check
