// Components with one slip each and the same shape, written as vectors with one place a component (theory, section 5,
// closed form): the slip's force if it held, less what it cannot hold.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"
#include "discretise/mode_bank.hpp"
#include "discretise/slip_brake.hpp"
#include "discretise/slip_response.hpp"

namespace dashpot::compiler {

class SlipGroup {
 public:
  // `settings` of the brake must outlive this object.
  SlipGroup(LawWriter& writer, const Network& network, const Real& sample_period, const SlipDecomposition& settings);

  // True if the component can share the code of those already added: it has rows of the same form, and no modes.
  // `split` is null if it leaves nothing to the brake. Both must outlive this object.
  bool accepts(const NormalTree& component, const ComponentSplit* split) const;
  void add(const NormalTree& component, const ComponentSplit* split);

  double smallest_loss() const;
  void declare();  // to be called when the law's mode form is settled

  // The components' part of the force, from the tool's displacement in this sample.
  ExpressionId write_output(VariableId change, VariableId position);
  void write_update(VariableId sampled_change);
  ExpressionId energy();  // nothing without springs

  const SlipBrake& brake() const { return brake_; }
  // Sums over the slips; `nothing` if there are none: b that changes, b that lagging coils lack, and β, where β v̂ is to
  // be taken from the force.
  ExpressionId changing_damping() const { return damping_; }
  ExpressionId shortfall() const { return shortfall_; }
  ExpressionId compensation() const { return compensation_; }

 private:
  struct Block {
    Names names;
    std::vector<LinearForm> forms;      // one for each component
    std::vector<ElementList> elements;  // the same
    std::unique_ptr<ModeBank> modes;    // of a single component
    VariableId spring_force = nothing;  // F0, of the static stiffness
    bool has_spring = false;
  };

  // The component's force less the part that the brake makes: f′ = f − x Δu/h.
  struct MotorForce {
    Row stuck, sliding;
    bool differs = false;  // in more than the excess
  };

  // What a row computes: a quantity of the component, or of one of its blocks.
  struct Quantity {
    RowOf of;
    std::size_t block = 0;
  };
  struct Term {
    Quantity quantity;
    RowFor factor;
    std::size_t held_block = 0;
  };

  // The variables that a row may refer to.
  struct Terms {
    VariableId change, trial, slip, excess;
  };

  SlipResponse response_of(const NormalTree& component) const;
  // Decides how the code of a component looks: components of one shape share a loop.
  enum class Factor { zero, one, minus_one, other };
  struct RowShape {
    std::vector<Factor> factors;

    bool operator==(const RowShape&) const = default;
  };
  struct BlockShape {
    bool has_spring, has_modes;
    RowShape elongation;

    bool operator==(const BlockShape&) const = default;
  };
  struct Shape {
    RowShape trial, stuck, sliding;
    bool stuck_is_like_trial, sliding_is_like_trial, differs;
    std::vector<BlockShape> blocks;

    bool operator==(const Shape&) const = default;
  };
  static RowShape shape_of(const Row& row);
  static Shape shape_of(const SlipResponse& response, const MotorForce& force);
  MotorForce motor_force(const SlipResponse& response, const ComponentSplit* split) const;
  std::vector<Row> rows(Row SlipResponse::*row) const;
  std::vector<Row> rows(Row MotorForce::*row) const;
  ExpressionId write_force(ExpressionId sliding);
  ExpressionId summed(const std::string& what, VariableId vector);
  std::vector<Row> elongations(std::size_t block) const;
  ExpressionId held_force(const Block& block);
  std::string called(Quantity quantity) const;
  Derivation row_of(const Term& term, bool is_subtracted) const;
  ExpressionId expression(Quantity quantity, const std::vector<Row>& rows, Terms terms);
  // sum + values·variable
  ExpressionId term(const Term& term, std::vector<Real> values, ExpressionId variable, ExpressionId sum);
  ExpressionId factors(const Term& term, const std::vector<Real>& values, bool is_subtracted);
  bool is_only_state(std::size_t block) const;
  VariableId kept(VariableId local);
  VariableId local(const std::string& what, const std::string& meaning);
  std::vector<std::vector<std::size_t>> origins() const;

  LawWriter& writer_;
  const Network& network_;
  Real sample_period_;
  std::string prefix_;
  Names names_;             // of the slips
  bool has_modes_ = false;  // then it has one component
  std::vector<SlipResponse> responses_;
  std::vector<MotorForce> forces_;
  SlipBrake brake_;
  SlipBrake::Shape brake_shape_;
  std::vector<Block> blocks_;
  ExpressionId damping_ = nothing, shortfall_ = nothing, compensation_ = nothing;
  Terms now_{nothing, nothing, nothing, nothing};
};

}  // namespace dashpot::compiler
