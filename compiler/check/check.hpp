// Whether a header and its certificate prove the damping that they state (theory, sections 6a and 6b). Nothing in this
// folder includes anything of the compiler: it shares no code with what it checks. It throws what it does not know.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace dashpot_check {
using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using Form = std::map<std::string, Rational>;  // a sum: coefficients by quantity, the constant under the empty name
using Forms = std::map<std::string, Form>;
using Matrix = std::vector<std::vector<Integer>>;
using Storage = std::vector<std::vector<double>>;  // P's rows up to the diagonal, which roundings may follow
using Unknown = std::runtime_error;
// What a header computes in a sample, in exact arithmetic, for finite samples and a motor within its limit.
struct Program {
  std::map<std::string, Rational> constants;  // and the states at rest
  std::vector<std::string> states;            // in the order of the text
  Forms next;                                 // what they become, of the states, `position` and `velocity`
  Form force;
};
// What the certificate states about the loop, in SI.
struct Device {
  double sample_period, jitter, write_earliest, write_latest, amplifier_lag, cutoff, acceleration, joint_encoder_step;
  unsigned delay_samples, window, order;
  bool best_fit;
  std::string estimator;
  std::vector<double> estimator_coefficients;
  unsigned chosen = 1;  // of an adaptive window's lengths, the one that the sample takes
  bool operator==(const Device&) const = default;
};
// One linear recursion for the loop: w is the tool's way while a command acts, u its position when that begins, `moved`
// its way from the sample until then, `late` (a part of w) that of the next one. The motor holds stiffness·u + force.
// States: the last displacements q0, q1 …, those of estimator and law, and what a lagging force lacks, before decay.
struct LoopForm {
  std::vector<std::string> states;
  Forms next;          // of the states, w and late; what an estimate divides by T itself, pace0, before that
  Form force;          // of the states [N]
  Rational stiffness;  // k0 [N/m]
};
LoopForm loop_form(Program program, const Device& device);
// The range from the shortest to the longest hold in parts. With a lag, each part stands for all corners of its decay
// and shares; if the estimate divides by the measured interval, also for both ends of the rate.
struct Hold {
  Rational before, after, decay;       // longest time that a command acts until the next sample and after it [s]; q
  Rational share, spread, tilt, rate;  // p until that sample; κT, at most; p's increase after it; the estimate's 1/T
};
std::vector<Hold> holds(const Device& device);
// Whether P proves that `damping` b [N·s/m] is enough for any motion and all holds T up to the longest. With
// V = ½ k0 u² + xᵀPx, V⁺ − V ≤ (k0 u + Cx) w + b w²/T for all x and w when k0 ≥ 0, P ⪰ 0 and
//     M = [ P − AᵀPA,  ½C − AᵀPB;  ·,  b/T − ½k0 − BᵀPB ] ⪰ 0,
// with a row more for a lag and one for late commands (theory, section 6b); a window that adapts has an M for each.
bool proves(const Program& program, Device device, const Storage& storage, const Rational& damping);
// In words. 0: proved, and the law is certified; 4: proved, and damping is lacking; 1: not proved; 3: nothing is known.
std::pair<int, std::string> verdict(const std::string& header, const std::string& certificate);
}  // namespace dashpot_check
