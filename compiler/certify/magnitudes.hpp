// How large the states of a law can be after a step, from how large they are before it.
#pragma once

#include <algorithm>
#include <boost/container/flat_map.hpp>
#include <boost/container/small_vector.hpp>
#include <map>
#include <optional>
#include <vector>

#include "certify/slip_answer.hpp"
#include "certify/state_box.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// A value during a step, as Σ c_i x_i over states and inputs at the beginning of the step and over forces of coupled
// slips, plus a constant, plus a rest whose magnitude alone is known: rounding, and what a slip or a contact decides if
// its cases are not told apart. In addition an interval, which uses what is known in the present case; rounding does
// not take a number beyond a bound that is itself a number of the type.
struct Amount {
  // The factor c of each x; there are few.
  boost::container::flat_map<std::size_t, double, std::less<std::size_t>,
                             boost::container::small_vector<std::pair<std::size_t, double>, 8>>
      shares;
  double constant = 0;
  double rest = 0;
  bool has_kept_share = false;  // depends on the share of all forces that a shedding law keeps
  double low, high;
};

// How finely the cases of a step are told apart. Where they are, terms that cancel in a case cancel in its bound too;
// where there are too many cases they are not told apart.
enum class Detail {
  none,
  choices,  // of every `where`: whether a surface is touched, and others
  slips,    // also of every clamp: whether it limits
};

// Goes through all combinations of the cases of a step's decisions.
class StepCases {
 public:
  unsigned choose(unsigned count) {
    if (at_ == taken_.size()) taken_.push_back({0, count});
    return taken_[at_++].first;
  }

  // False after the last.
  bool next() {
    at_ = 0;
    while (!taken_.empty() && ++taken_.back().first == taken_.back().second) taken_.pop_back();
    return !taken_.empty();
  }

 private:
  std::vector<std::pair<unsigned, unsigned>> taken_;  // case and number of cases
  std::size_t at_ = 0;
};

// For a state x the bounded quantity is x − Σ factor y, of other states y. For a force that decays while its spring is
// stretched, F ← a F + g (y⁺ − y), F − (g/a) y is bounded if y is, however slowly F decays. For a state that is a sum
// of others the difference is what rounding leaves.
struct Share {
  std::size_t at;  // index of y
  double factor;
};
struct Anchored {
  std::size_t at;  // index of x
  std::vector<Share> shares;
};
using Anchors = std::vector<Anchored>;  // each after those that its shares refer to

class Magnitudes {
  struct Bounds {
    std::vector<double> low, high;  // low ≤ 0 ≤ high
    void include(std::size_t at, double least, double most);
  };

 public:
  Magnitudes(const UpdateLaw& law, const InputRange& range, Detail detail, Anchors anchors = {});

  void step();
  Anchors find_anchors();
  const Anchors& anchors() const { return anchors_; }
  std::size_t effort() const { return effort_; }  // statements and steps of coupled slips so far, in all cases
  double force();                                 // largest magnitude [N]

  // How far below 0 and how far above each state may be, one after the other. For a force with an error that is carried
  // along these are bounds of their sum, for a state with an anchor of the difference.
  std::vector<double> states() const;
  void set_states(const std::vector<double>& flat);

 private:
  template <class Action>
  void for_each_state(Action action) const;
  std::size_t effort_of(const std::vector<Statement>& program) const;
  template <class Action>
  void in_every_case(std::initializer_list<const std::vector<Statement>*> programs, Action action);

  void begin();
  bool is_map(const Statement& s) const { return law_.mapped != no_variable && s.target == law_.mapped; }
  void run(const std::vector<Statement>& program);
  void solve(const Statement& statement);
  template <class Solved>
  const SlipAnswer& answer_of(const Solved& solved, bool is_free);
  template <class Solved>
  void solve(const Solved& solved, VariableId force, const Amount& change);
  void know(const Amount& amount, double sign);
  Amount tightened(Amount value) const;
  Amount combined(const SlipAnswerRow& row, const Amount& change, const std::vector<Amount>& held,
                  const std::vector<Amount>& slips, int operations) const;
  void carry(std::size_t force, Bounds& then) const;
  const std::vector<Share>* anchor_of(std::size_t at) const;
  double spring_of(std::size_t force) const;
  std::vector<Share> sum_at(const Statement& s) const;
  bool add_terms(ExpressionId id, std::vector<Share>& terms) const;
  Amount plus(const Amount& a, const Amount& b, double factor) const;
  Amount plus(Amount a, const std::vector<Share>& shares, double sign) const;

  double low_of(std::size_t symbol) const;
  double high_of(std::size_t symbol) const;
  double size_of(std::size_t symbol) const { return std::max(-low_of(symbol), high_of(symbol)); }
  double lowest(const Amount& value) const;
  double highest(const Amount& value) const;
  double magnitude(const Amount& value) const { return std::max(-lowest(value), highest(value)); }
  double rounded(double value) const;
  Amount exactly(double value) const;
  Amount sized(double magnitude) const;
  Amount within(Amount value, double low, double high) const;
  Amount symbol(std::size_t at) const;
  Amount sum(const Amount& a, const Amount& b, double sign) const;
  Amount scaled(const Amount& a, double factor) const;
  Amount product(const Amount& a, const Amount& b) const;
  Amount kept_share();
  Amount clamped(const Amount& value, double limit);
  Amount chosen(const Expression& where, std::size_t place);
  void take(ExpressionId condition, bool is_above);
  Amount of(ExpressionId id, std::size_t place);
  bool is_read_of(ExpressionId id, VariableId variable) const;
  std::size_t first(VariableId id) const { return starts_[id.place()]; }

  const UpdateLaw& law_;
  double roundoff_;
  Detail detail_;
  std::size_t effort_ = 0;
  StepCases cases_;
  std::vector<std::size_t> starts_;  // place of each variable in the lists below
  Bounds bounds_;
  std::map<std::size_t, std::size_t> errors_;  // index of the carried error, by force
  std::map<std::size_t, std::size_t> added_;   // index of what is added in a step, by force
  Anchors anchors_;
  std::map<std::pair<const std::string*, bool>, SlipAnswer> answers_;  // by the name of slips solved together
  // For the present case:
  std::vector<Amount> values_;
  std::vector<double> slip_forces_;  // largest magnitudes; their symbols follow those of the variables
  std::map<std::pair<VariableId, VariableId>, bool> known_;  // a − b > 0, or a > 0
  std::vector<Amount> positive_;                             // amounts known to be 0 or more
  bool is_possible_ = true;
};

}  // namespace dashpot::compiler
