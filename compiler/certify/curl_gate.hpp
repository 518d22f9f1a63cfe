// The gate that limits the antisymmetric part of a viscous field, which the motors make (theory, section 12): whether a
// device has one, its numbers, and how much passes.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "axes/brakes.hpp"
#include "axes/viscous_field.hpp"
#include "certify/sampled_loop.hpp"
#include "network/axes_device.hpp"

namespace dashpot::compiler {

// Why brakes cannot pay, sample by sample, for the coupling between them, as a clause; empty if they can.
std::string why_no_gate(const AxesDevice& device, axes::BrakeRule rule);

// In: a device for which why_no_gate() is empty, how much of its brakes is used up, and a viscous field. Empty if at
// some place of the workspace a brake makes nothing of the field, so that nothing would pass there.
std::optional<axes::CurlGate> curl_gate(const AxesDevice& device, const std::vector<double>& added,
                                        const axes::ViscousField& viscous);

// The share of max(|r|, |σ|) of the field that passes while the tool moves slowly through the workspace [1].
struct GatePassage {
  double mean, least;
  axes::Pair<double> least_at;  // tip [m]
};
GatePassage gate_passage(const axes::CurlGate& gate, const AxesDevice& device, const std::vector<double>& added,
                         const axes::ViscousField& viscous);

// Whether each brake acts on one joint alone.
bool are_along_joints(const AxesDevice& device);

// The share of a brake's damping that is left at the largest joint speeds; and the least share of its command that it
// makes there [1].
double share_at_speed(const AlongBrake& brake, const AxesDevice& device);
double assured_share(const AlongBrake& brake, const AxesDevice& device);

// The part of a wanted damping that a brake can make besides what is added to its command already.
template <typename S>
S within_brake(const S& wanted, const brake_description& brake, double added) {
  using std::min;
  return brake.kind == brake_kind::none ? wanted : min(wanted, S(std::max(brake.max_damping - added, 0.0)));
}

// The loop of one joint, as for a device of one axis.
SampledLoop loop_of_joint(const device_description& joint);

}  // namespace dashpot::compiler
