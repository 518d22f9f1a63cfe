// Every number that the paper does not print and its experiments need, with the reason for it: chosen.json, in one
// place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <dashpot/simulated/hand.hpp>

#include "network/device.hpp"

namespace dashpot::paper {

struct Choice {
  std::string name;
  std::string value;  // with its unit
  std::string reason;
};

// The value of that name, in the unit that chosen.json states. Throws where there is none.
double chosen(std::string_view name);
std::vector<double> chosen_list(std::string_view name);

// All of them in the order of the file; those of the plant with the values of the device file that they refer to.
std::vector<Choice> all_choices();

// The paper's rig, runtime/devices/pantograph_brake_2009.json, and another device file of that folder.
const compiler::Device& rig();
compiler::Device device_of(const std::string& name);

// A device without faults for the paper's numerical experiments (section 5): a translating tool, true position and
// velocity, no lag; `sample_period` [s].
device_description ideal_plant(double sample_period);

// The rig without jitter, quantisation, delay, lag and friction of the drives: the same mechanics under a true
// velocity.
device_description ideal_rig();

// The two choices of dashpot for the rig: its default, and the rule of the paper (5.1).
inline constexpr const char* by_faithful_choice = "dashpot, faithful";
inline constexpr const char* by_papers_rule = "dashpot, the paper’s rule";

// A stiff grasp, the hand of the experiments.
simulated::hand grip();

// A velocity sensor without noise or lag.
velocity_description true_velocity();

}  // namespace dashpot::paper
