// Every emitted class behind one interface, with what it was compiled from: so that a test runs over all of them.
#pragma once

#include <dashpot/command.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "decompose/choices.hpp"

namespace dashpot::compiler {
struct Compilation;
}

namespace dashpot::responses {

using Command = dashpot::command<double>;

// An object of an emitted class; numbers go in rounded to its scalar.
class Model {
 public:
  virtual ~Model() = default;
  virtual void reset(double position) = 0;
  virtual Command output(double position, double velocity) = 0;
  virtual void update() = 0;
  virtual Command step(double position, double velocity) = 0;
  virtual double stored_energy() const = 0;

  virtual std::vector<unsigned char> bytes() const = 0;  // of the object, flags and all
  virtual std::vector<double> numbers() const = 0;       // every number that the object keeps
  virtual bool keeps_only_normal_numbers() const = 0;    // each is zero or normal in the class's scalar
};

// f = b u̇ + m: the brake's part is made by the true velocity.
inline double felt_force(const Command& now, double velocity) { return now.damping * velocity + now.force; }

struct EmittedLaw {
  std::string variant;       // folder and namespace, for messages
  std::string network;       // name
  std::string network_file;  // path
  compiler::Choices choices;
  double sample_period;  // [s], the class's own
  bool is_rotary;
  std::shared_ptr<Model> (*make)();

  // The same network and choices through the library: canonical form, decomposition, law ("emit/emission.hpp").
  const compiler::Compilation& compilation() const;
  double rate() const { return choices.rate.value_or(compiler::default_rate); }  // [Hz]
  compiler::StateInput state_input() const;  // as chosen, or as `auto` came to choose

  std::string title() const { return variant + "/" + network; }
  bool is_float() const { return choices.scalar == compiler::ScalarType::float32; }
  bool is_exact() const { return choices.scheme == compiler::Scheme::exact; }
};

// All that the build emitted, in a fixed order.
const std::vector<EmittedLaw>& all_laws();
std::vector<EmittedLaw> laws_of_variant(const std::string& variant);
const EmittedLaw& law_of(const std::string& variant, const std::string& network);

// What the command line's choices mean.
compiler::Choices parse_choices(const std::string& text);

template <class Class>
class ModelOf final : public Model {
  using scalar = typename Class::scalar;
  static_assert(std::is_trivially_copyable_v<Class> && std::is_standard_layout_v<Class>,
                "an emitted class is numbers followed by flags");

 public:
  void reset(double position) override { law_.reset(static_cast<scalar>(position)); }
  Command output(double position, double velocity) override {
    return widened(law_.output(static_cast<scalar>(position), static_cast<scalar>(velocity)));
  }
  void update() override { law_.update(); }
  Command step(double position, double velocity) override {
    return widened(law_.step(static_cast<scalar>(position), static_cast<scalar>(velocity)));
  }
  double stored_energy() const override { return static_cast<double>(law_.stored_energy()); }

  std::vector<unsigned char> bytes() const override {
    std::vector<unsigned char> copy(sizeof law_);
    std::memcpy(copy.data(), &law_, sizeof law_);
    return copy;
  }

  std::vector<double> numbers() const override {
    const std::vector<scalar> all = kept();
    return {all.begin(), all.end()};
  }

  bool keeps_only_normal_numbers() const override {
    const auto is_plain = [](scalar number) { return number == 0 || std::isnormal(number); };
    const std::vector<scalar> all = kept();
    return std::all_of(all.begin(), all.end(), is_plain);
  }

 private:
  // The last word holds flags.
  static constexpr std::size_t number_count = (sizeof(Class) - 1) / sizeof(scalar);

  std::vector<scalar> kept() const {
    std::vector<scalar> copy(number_count);
    if (number_count > 0) std::memcpy(copy.data(), &law_, number_count * sizeof(scalar));
    return copy;
  }

  static Command widened(dashpot::command<scalar> now) {
    return {static_cast<double>(now.damping), static_cast<double>(now.force)};
  }

  Class law_;
};

struct Variant {
  const char* name;
  const char* choices;
};

template <class Class>
void append(std::vector<EmittedLaw>& laws, const Variant& variant, const char* network, const char* file) {
  laws.push_back({variant.name, network, file, parse_choices(variant.choices),
                  static_cast<double>(Class::sample_period), Class::port_motion == dashpot::motion::rotation,
                  []() -> std::shared_ptr<Model> { return std::make_shared<ModelOf<Class>>(); }});
}

}  // namespace dashpot::responses
