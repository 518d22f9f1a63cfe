// A second opinion on networks with slips: backward Euler on every element by itself, in a hundred digits.
//
// In each sample the inner nodes minimise Φ (theory, section 5). Its dual, ½σᵀGσ − wᵀσ over |σ_i| ≤ Y_i, exists once
// every node is tied to where it was, and every slip let creep, by 1e-30 of the network's stiffness; 40 digits remain.
// The box problem is solved by changing the first slip that is wrong until none is: G being definite, that ends (Murty
// 1974).
//
// A contact is one more of them, between the tool and the surface: it holds any force from 0 up.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <map>
#include <vector>

#include "network/network.hpp"

namespace dashpot::testing {

class ElementReference {
 public:
  using Number =
      boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

  // Springs relaxed at 0. `sample_period` [s]. All of the network's elements must have an effect.
  ElementReference(const compiler::Network& network, double sample_period);

  // In: the displacement of this sample [m]. Out: the force that the network opposes [N].
  double step(double position);

  double surface() const { return surface_.convert_to<double>(); }  // of a contact, from where it lies unloaded [m]

  double stored_energy() const;                            // [J]
  double largest_force() const { return largest_force_; }  // of any element so far [N]

 private:
  using Vector = std::vector<Number>;
  using Matrix = std::vector<Vector>;

  struct Branch {
    int a, b;              // rows of inner nodes; outside for tool and ground
    Number spring = 0;     // K [N/m]
    Number companion = 0;  // K, or B/h [N/m]
    Number force = 0;      // K d of a spring [N]
  };

  int row_of(compiler::NodeIndex node) const;
  void add_contact(double at);
  void build();
  Number elongation(const Branch& branch, const Vector& inner, const Number& tool) const;
  void add_to(Vector& rows, const Branch& branch, const Number& force) const;
  Vector solve_box(const Vector& without_slips);
  bool correct(const Vector& gap, const Vector& forces);
  Vector forces_for(const Vector& without_slips) const;

  std::vector<Branch> linear_, slips_;
  Vector lowest_, highest_;  // what a slip holds [N]
  int inner_ = 0;
  int surface_row_ = -1;  // with a contact: of the node that takes the tool's place
  Number at_ = 0, surface_ = 0;
  Matrix give_;       // A = (H + ε)⁻¹ over the inner nodes
  Matrix slip_give_;  // G = S A Sᵀ + η
  std::vector<int> signs_;
  Number position_ = 0;
  double largest_force_ = 0;
};

}  // namespace dashpot::testing
