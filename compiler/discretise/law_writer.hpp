// Writes the statements of an update law.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "law/update_law.hpp"
#include "linear/normal_form.hpp"
#include "linear/real.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// Joins two parts of a C++ name by one underscore; the first may be empty.
std::string joined(const std::string& first, const std::string& second);

// The nearest number of the law's scalar type; zero below smallest_constant().
double rounded(const Real& value, ScalarType scalar);

// For vectors, one emitted name for each place: "B1_K1" gives "B1_K1_force", …
using Names = std::vector<std::string>;

// The name of a vector: what it holds and, if several vectors hold the same quantity, whose it is. The vector is named
// by both, its places by their own names and `what`.
struct VectorName {
  std::string whose;
  std::string what;
};

// Where a constant comes from: its role in the law's equations and, if it belongs to a part of the network, that part.
struct Derivation {
  Derivation(ConstantRole role_of_it) : role(role_of_it) {}
  Derivation(ConstantRole role_of_it, Subject one) : role(role_of_it), of{std::move(one)} {}
  Derivation(ConstantRole role_of_it, std::vector<Subject> one_a_value, std::size_t bank_of_it = port_bank)
      : role(role_of_it), of(std::move(one_a_value)), bank(bank_of_it) {}

  ConstantRole role;
  std::vector<Subject> of = {};
  std::size_t bank = port_bank;
};

class LawWriter {
 public:
  LawWriter(UpdateLaw& law, motion port_motion);

  UpdateLaw& law() { return law_; }
  const std::string& length() const { return length_; }
  const std::string& force() const { return force_; }
  std::string velocity() const { return length_ + "/s"; }
  std::string stiffness() const { return length_ == "m" ? "N/m" : "N·m/rad"; }
  std::string damping() const { return length_ == "m" ? "N·s/m" : "N·m·s/rad"; }
  std::string compliance() const { return length_ + "/" + force_; }

  // The name itself, or with a number behind it if the law has that name already, ignoring case.
  std::string unique(const std::string& name);

  VariableId scalar(const std::string& name, const std::string& unit, const std::string& meaning, Role role);
  // One place for each of `names`.
  VariableId vector(const VectorName& name, const std::string& unit, const std::string& meaning, Role role,
                    const Names& names);

  ExpressionId read(VariableId variable) { return law_.expressions.add({Operation::read, {}, variable}); }
  ExpressionId add(ExpressionId left, ExpressionId right) { return node(Operation::add, {left, right}); }
  ExpressionId subtract(ExpressionId left, ExpressionId right) { return node(Operation::subtract, {left, right}); }
  ExpressionId divide(ExpressionId left, ExpressionId right) { return node(Operation::divide, {left, right}); }
  ExpressionId square_root(ExpressionId value) { return node(Operation::square_root, {value}); }
  // (1 − e^(−x))/x
  ExpressionId mean_decay(ExpressionId x) { return node(Operation::mean_decay, {x}); }
  ExpressionId multiply(ExpressionId left, ExpressionId right) { return node(Operation::multiply, {left, right}); }
  ExpressionId flush(ExpressionId value) { return node(Operation::flush, {value}); }
  ExpressionId clamp(ExpressionId value, ExpressionId limit) { return node(Operation::clamp, {value, limit}); }
  // `yes` where `condition` is above zero, else `no`.
  ExpressionId where(ExpressionId condition, ExpressionId yes, ExpressionId no) {
    return node(Operation::where, {condition, yes, no});
  }
  // drive + decay·flush(force)
  ExpressionId relax(ExpressionId decay, ExpressionId force, ExpressionId drive) {
    return node(Operation::relax, {decay, force, drive});
  }
  ExpressionId sum(VariableId vector) { return law_.expressions.add({Operation::sum, {}, vector}); }
  // The constant of that name; it is made if there is none yet.
  ExpressionId constant(const std::string& name, const std::string& unit, const std::string& meaning, const Real& value,
                        Derivation from = ConstantRole::brake_choice);
  ExpressionId constants(const VectorName& name, const std::string& unit, const std::string& meaning,
                         const std::vector<Real>& values, const Names& names,
                         Derivation from = ConstantRole::brake_choice);
  std::size_t new_bank() { return ++last_bank_; }

  // The entry of a table that an expression selects.
  ExpressionId pick(const std::string& name, const std::string& unit, const std::string& meaning,
                    const std::vector<Real>& values, ExpressionId place, Derivation from = ConstantRole::brake_choice);

  // The variable that an expression reads and nothing else, or `nothing` if it is more than that.
  VariableId reads(ExpressionId expression) const;

  // The state in which a local of the output, or an input, is kept for the update.
  VariableId kept(VariableId local);

  // sum + value, where either may be `nothing`.
  ExpressionId plus(ExpressionId sum, ExpressionId value);

  void assign(std::vector<Statement>& program, VariableId target, ExpressionId value, std::string purpose,
              std::vector<std::vector<std::size_t>> origins = {});

 private:
  ExpressionId node(Operation operation, const std::array<ExpressionId, 3>& operands) {
    return law_.expressions.add({operation, operands});
  }
  CoefficientId add_constants(Coefficient coefficient, const std::vector<Real>& values, Derivation from);

  UpdateLaw& law_;
  std::string length_, force_;
  std::size_t last_bank_ = port_bank;
  // Beginnings of the law's own names, and what C calls whether parameters are there.
  std::set<std::string> taken_ = {"relaxed", "velocity", "no", "step", "last", "sampled", "steady", "has_parameters"};
};

}  // namespace dashpot::compiler
