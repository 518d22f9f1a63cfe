// The model concept for two axes, as model.hpp for one: what differs of an emitted class is
//     static constexpr int axes = 2;
//     static constexpr int brakes = 2;                                    // at most most_arm_brakes
//     certified_for::estimator[axes]
//     void reset(const scalar (&position)[axes]) noexcept;
//     dashpot::commands<scalar, axes, brakes> output(const scalar (&position)[axes],
//                                                    const scalar (&velocity)[axes]) noexcept;
// and, where facts are known only at run time, `arm_model_facts facts() const noexcept`.
#pragma once

#include <type_traits>
#include <utility>

#include <dashpot/arm_description.hpp>
#include <dashpot/command.hpp>
#include <dashpot/detected.hpp>
#include <dashpot/model.hpp>

namespace dashpot {

struct arm_model_facts {
  model_facts joints[arm_axes];  // alike but for the estimator
  unsigned brakes = 0;
};

namespace model_claim {

template <class M>
using two_axes = std::enable_if_t<M::axes == static_cast<int>(arm_axes)>;
template <class M>
using few_brakes = std::enable_if_t<(M::brakes >= 0 && M::brakes <= static_cast<int>(most_arm_brakes))>;
template <class M>
using arm_facts = std::enable_if_t<noexcept(arm_model_facts(std::declval<const M&>().facts()))>;
template <class M>
using arm_certified_for = certified_with<M, decltype(M::certified_for::estimator[1])>;
template <class M>
using arm_joints = const typename M::scalar (&)[arm_axes];
template <class M>
using arm_reset = std::enable_if_t<noexcept(std::declval<M&>().reset(std::declval<arm_joints<M>>()))>;
template <class M>
using arm_output = std::enable_if_t<noexcept(commands<typename M::scalar, M::axes, M::brakes>(
    std::declval<M&>().output(std::declval<arm_joints<M>>(), std::declval<arm_joints<M>>())))>;

}  // namespace model_claim

// False for a class that does not say how many axes it has: it has one.
template <class Model>
inline constexpr bool has_two_axes = is_detected<model_claim::two_axes, Model>;

// Refuses, in words, to compile a class that is no model of two axes. Always true where it compiles.
template <class Model>
constexpr bool check_arm_model() {
  constexpr bool own_facts = is_detected<model_claim::arm_facts, Model>;
  static_assert(is_detected<model_claim::scalar, Model>, "the model needs 'using scalar = double;' or float");
  static_assert(is_detected<model_claim::few_brakes, Model>, "the model needs 'static constexpr int brakes', 0 to 4");
  static_assert(own_facts || is_detected<model_claim::sample_period, Model>,
                "the model needs 'static constexpr scalar sample_period' [s], more than zero");
  static_assert(own_facts || is_detected<model_claim::port_motion, Model>,
                "the model needs 'static constexpr dashpot::motion port_motion', that of the joints");
  static_assert(own_facts || is_detected<model_claim::arm_certified_for, Model>,
                "the model needs 'struct certified_for' with static any_device, device, device_digest, estimator[axes] "
                "and loop_delay: it says which device the model may run on");
  static_assert(is_detected<model_claim::arm_reset, Model>,
                "the model needs 'void reset(const scalar (&position)[axes]) noexcept'");
  static_assert(is_detected<model_claim::arm_output, Model>,
                "the model needs 'dashpot::commands<scalar, axes, brakes> output(const scalar (&position)[axes], "
                "const scalar (&velocity)[axes]) noexcept'");
  static_assert(is_detected<model_claim::update, Model>, "the model needs 'void update() noexcept'");
  static_assert(is_detected<model_claim::stored_energy, Model>,
                "the model needs 'scalar stored_energy() const noexcept' [J]");
  return true;
}

template <class Model>
arm_model_facts arm_facts_of([[maybe_unused]] const Model& model) noexcept {
  if constexpr (is_detected<model_claim::arm_facts, Model>) {
    return model.facts();
  } else {
    arm_model_facts facts;
    for (unsigned j = 0; j < arm_axes; ++j) facts.joints[j] = stated_facts<Model>(Model::certified_for::estimator[j]);
    facts.brakes = static_cast<unsigned>(Model::brakes);
    return facts;
  }
}

}  // namespace dashpot
