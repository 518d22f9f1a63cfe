// The model concept: what a servo loop needs of an update law. Every emitted class satisfies it (architecture,
// section 5):
//     using scalar = double;                                             // or float
//     static constexpr scalar sample_period = 0.001;                     // [s]
//     static constexpr dashpot::motion port_motion = dashpot::motion::translation;
//     struct certified_for {
//       static constexpr bool any_device = false;                        // true: compiled for the ideal device
//       static constexpr const char* device = "pantograph_brake_2009";   // its name
//       static constexpr const char* device_digest = "…";                // of the device file's bytes
//       static constexpr const char* estimator = "butterworth";          // as in the device file
//       static constexpr unsigned loop_delay = 0;                        // whole samples between read and write
//       static constexpr bool is_certified = true;                       // passive there; without it: not certified
//     };
//     void reset(scalar position) noexcept;                              // at rest there
//     dashpot::command<scalar> output(scalar position, scalar velocity) noexcept;
//     void update() noexcept;                                            // after the command has left
//     scalar stored_energy() const noexcept;                             // [J]
// and may have
//     scalar kept_share() const noexcept;                                // of all forces, by the last output()
// where it sheds what the motor cannot make: 1 where it did not.
// A model whose facts are known only at run time (loaded from a library) has `model_facts facts() const noexcept` in
// place of sample_period, port_motion and certified_for.
#pragma once

#include <type_traits>
#include <utility>

#include <dashpot/command.hpp>
#include <dashpot/detected.hpp>

namespace dashpot {

// What a model was made for. The strings live as long as the model.
struct model_facts {
  double sample_period = 0;  // [s]
  motion port_motion = motion::translation;
  bool any_device = true;
  const char* device = "";
  const char* device_digest = "";
  const char* estimator = "";
  unsigned loop_delay = 0;    // [samples]
  bool is_certified = false;  // on that device, or on the ideal one
};

namespace model_claim {

template <class M>
using scalar = std::enable_if_t<std::is_floating_point_v<typename M::scalar>>;
template <class M>
using sample_period = std::enable_if_t<(M::sample_period > 0)>;
template <class M>
using port_motion = std::enable_if_t<M::port_motion == motion::translation || M::port_motion == motion::rotation>;
template <class M, class Estimator>
using certified_with = std::enable_if_t<std::is_convertible_v<decltype(M::certified_for::any_device), bool> &&
                                        std::is_convertible_v<decltype(M::certified_for::device), const char*> &&
                                        std::is_convertible_v<decltype(M::certified_for::device_digest), const char*> &&
                                        std::is_convertible_v<Estimator, const char*> &&
                                        std::is_convertible_v<decltype(M::certified_for::loop_delay), unsigned>>;
template <class M>
using certified_for = certified_with<M, decltype(M::certified_for::estimator)>;
template <class M>
using is_certified = std::enable_if_t<std::is_convertible_v<decltype(M::certified_for::is_certified), bool>>;
template <class M>
using facts = std::enable_if_t<noexcept(model_facts(std::declval<const M&>().facts()))>;
template <class M>
using reset = std::enable_if_t<noexcept(std::declval<M&>().reset(typename M::scalar()))>;
template <class M>
using output = std::enable_if_t<noexcept(
    command<typename M::scalar>(std::declval<M&>().output(typename M::scalar(), typename M::scalar())))>;
template <class M>
using update = std::enable_if_t<noexcept(std::declval<M&>().update())>;
template <class M>
using kept_share = std::enable_if_t<noexcept(double(std::declval<const M&>().kept_share()))>;
template <class M>
using stored_energy = std::enable_if_t<noexcept(double(std::declval<const M&>().stored_energy()))>;

}  // namespace model_claim

// Refuses, in words, to compile a class that is no model. Always true where it compiles.
template <class Model>
constexpr bool check_model() {
  constexpr bool own_facts = is_detected<model_claim::facts, Model>;
  static_assert(is_detected<model_claim::scalar, Model>, "the model needs 'using scalar = double;' or float");
  static_assert(own_facts || is_detected<model_claim::sample_period, Model>,
                "the model needs 'static constexpr scalar sample_period' [s], more than zero");
  static_assert(own_facts || is_detected<model_claim::port_motion, Model>,
                "the model needs 'static constexpr dashpot::motion port_motion'");
  static_assert(own_facts || is_detected<model_claim::certified_for, Model>,
                "the model needs 'struct certified_for' with static any_device, device, device_digest, estimator and "
                "loop_delay: it says which device the model may run on");
  static_assert(is_detected<model_claim::reset, Model>, "the model needs 'void reset(scalar position) noexcept'");
  static_assert(is_detected<model_claim::output, Model>,
                "the model needs 'dashpot::command<scalar> output(scalar position, scalar velocity) noexcept'");
  static_assert(is_detected<model_claim::update, Model>, "the model needs 'void update() noexcept'");
  static_assert(is_detected<model_claim::stored_energy, Model>,
                "the model needs 'scalar stored_energy() const noexcept' [J]");
  return true;
}

// The share of all forces in the network that the last output() kept so that the motor can follow; 1 for a model that
// never sheds.
template <class Model>
double kept_share_of([[maybe_unused]] const Model& model) noexcept {
  if constexpr (is_detected<model_claim::kept_share, Model>) return static_cast<double>(model.kept_share());
  else return 1;
}

// What a class says by its static members, with that estimator.
template <class Model>
model_facts stated_facts(const char* estimator) noexcept {
  using certified = typename Model::certified_for;
  bool is_certified = false;
  if constexpr (is_detected<model_claim::is_certified, Model>) is_certified = certified::is_certified;
  return {static_cast<double>(Model::sample_period),
          Model::port_motion,
          certified::any_device,
          certified::device,
          certified::device_digest,
          estimator,
          certified::loop_delay,
          is_certified};
}

// What `model` was made for, from its own facts() where it has one, else from its static members.
template <class Model>
model_facts facts_of([[maybe_unused]] const Model& model) noexcept {
  if constexpr (is_detected<model_claim::facts, Model>) return model.facts();
  else return stated_facts<Model>(Model::certified_for::estimator);
}

}  // namespace dashpot
