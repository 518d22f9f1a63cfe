// An emitted model behind plain functions, so that a program can load it from a shared library at run time. The library
// exports one function, dashpot_model(); loaded_model is the host's side of it.
#pragma once

#include <dashpot/model.hpp>

namespace dashpot {

// Version of the table's own shape; a host refuses another.
inline constexpr unsigned model_table_version = 3;

struct model_table {
  unsigned version;
  unsigned size;       // of the model's object [bytes]
  unsigned alignment;  // [bytes]
  model_facts facts;
  void (*construct)(void* model) noexcept;
  void (*reset)(void* model, double position) noexcept;
  command<double> (*output)(void* model, double position, double velocity) noexcept;
  void (*update)(void* model) noexcept;
  double (*stored_energy)(const void* model) noexcept;
  double (*kept_share)(const void* model) noexcept;
};

namespace detail {

struct placement {};

}  // namespace detail

}  // namespace dashpot

// Placement new without the standard library's header, which emitted code does without.
inline void* operator new(decltype(sizeof(0)), void* place, dashpot::detail::placement) noexcept { return place; }

namespace dashpot {

// The table of an emitted class. Its destructor is trivial, so that none is called.
template <class Model>
model_table table_of() noexcept {
  static_assert(check_model<Model>() && std::is_trivially_destructible_v<Model>);
  using scalar = typename Model::scalar;
  return {
      model_table_version,
      static_cast<unsigned>(sizeof(Model)),
      static_cast<unsigned>(alignof(Model)),
      facts_of(Model()),
      [](void* model) noexcept { ::new (model, detail::placement{}) Model(); },
      [](void* model, double position) noexcept { static_cast<Model*>(model)->reset(static_cast<scalar>(position)); },
      [](void* model, double position, double velocity) noexcept {
        const command<scalar> now =
            static_cast<Model*>(model)->output(static_cast<scalar>(position), static_cast<scalar>(velocity));
        return command<double>{static_cast<double>(now.damping), static_cast<double>(now.force)};
      },
      [](void* model) noexcept { static_cast<Model*>(model)->update(); },
      [](const void* model) noexcept { return static_cast<double>(static_cast<const Model*>(model)->stored_energy()); },
      [](const void* model) noexcept { return kept_share_of(*static_cast<const Model*>(model)); }};
}

}  // namespace dashpot

extern "C" const dashpot::model_table* dashpot_model();
