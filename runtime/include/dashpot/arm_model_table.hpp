// model_table.hpp for laws of two axes: an emitted class behind plain functions, which a library exports as
// dashpot_arm_model(). Brakes that the class does not have are commanded 0.
#pragma once

#include <dashpot/arm_model.hpp>
#include <dashpot/model_table.hpp>

namespace dashpot {

inline constexpr unsigned arm_model_table_version = 1;

using any_arm_commands = commands<double, static_cast<int>(arm_axes), static_cast<int>(most_arm_brakes)>;

struct arm_model_table {
  unsigned version;
  unsigned size;       // of the model's object [bytes]
  unsigned alignment;  // [bytes]
  arm_model_facts facts;
  void (*construct)(void* model) noexcept;
  void (*reset)(void* model, const double (&position)[arm_axes]) noexcept;
  any_arm_commands (*output)(void* model, const double (&position)[arm_axes],
                             const double (&velocity)[arm_axes]) noexcept;
  void (*update)(void* model) noexcept;
  double (*stored_energy)(const void* model) noexcept;
  double (*kept_share)(const void* model) noexcept;
};

// The table of an emitted class. Its destructor is trivial, so that none is called.
template <class Model>
arm_model_table arm_table_of() noexcept {
  static_assert(check_arm_model<Model>() && std::is_trivially_destructible_v<Model>);
  using scalar = typename Model::scalar;
  return {
      arm_model_table_version,
      static_cast<unsigned>(sizeof(Model)),
      static_cast<unsigned>(alignof(Model)),
      arm_facts_of(Model()),
      [](void* model) noexcept { ::new (model, detail::placement{}) Model(); },
      [](void* model, const double(&position)[arm_axes]) noexcept {
        const scalar q[arm_axes] = {static_cast<scalar>(position[0]), static_cast<scalar>(position[1])};
        static_cast<Model*>(model)->reset(q);
      },
      [](void* model, const double(&position)[arm_axes], const double(&velocity)[arm_axes]) noexcept {
        const scalar q[arm_axes] = {static_cast<scalar>(position[0]), static_cast<scalar>(position[1])};
        const scalar v[arm_axes] = {static_cast<scalar>(velocity[0]), static_cast<scalar>(velocity[1])};
        const auto now = static_cast<Model*>(model)->output(q, v);
        any_arm_commands all{};
        for (int i = 0; i < Model::brakes; ++i) all.damping[i] = static_cast<double>(now.damping[i]);
        for (unsigned j = 0; j < arm_axes; ++j) all.torque[j] = static_cast<double>(now.torque[j]);
        return all;
      },
      [](void* model) noexcept { static_cast<Model*>(model)->update(); },
      [](const void* model) noexcept { return static_cast<double>(static_cast<const Model*>(model)->stored_energy()); },
      [](const void* model) noexcept { return kept_share_of(*static_cast<const Model*>(model)); }};
}

}  // namespace dashpot

extern "C" const dashpot::arm_model_table* dashpot_arm_model();
