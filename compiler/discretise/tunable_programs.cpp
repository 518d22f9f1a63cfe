#include "discretise/tunable_programs.hpp"

#include <map>
#include <string_view>
#include <tuple>

#include "discretise/contact_surface.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/rounding.hpp"
#include "discretise/tuned_springs.hpp"
#include "law/check_law.hpp"
#include "law/empty_law.hpp"

namespace dashpot::compiler {
namespace {

// Names that no parameter and no element has in the emitted class: those of the law itself, of its tables, and the one
// that `verify` gives to numbers without a name (verify/header_constants.hpp).
constexpr std::string_view names_taken =
    "position force stored held_force step_stiffness springs_stiffness mesh_stiffness mesh_feedthrough mesh_viscosity "
    "feedthrough_damping viscosity half_viscosity wanted_brake steady_brake velocity_gain brake_left assured_damping "
    "make_up surface_stiffness recovery_compliance feedthrough_stiffness last_position last_brake resting_brake "
    "surface brake max_damping period rate one zero minus_one two half quarter hysteresis_squared slid held no_damping "
    "largest_ratio chosen_damping "
    "assured_share law restrict tunables springs parts edges blocks cuts yields couplings nodes graphs links ties "
    "tables threshold scalar damping steady_damping added_damping sample_period parameters values clamped wanted self "
    "none surface_at encoder_step gap approach depth surface_change surface_now surface_recovery surface_back "
    "released pull opposing pushed_force position_change slips_force slips_feedthrough slips_brake slips_wanted "
    "slips_gain share sampled shifted literals ";

// The same of a law that sheds (lower/shed.cpp).
constexpr std::string_view names_of_shedding = "most least last_command motor_limit motor_step all_kept none_kept ";

// The same of the map of a static curve (lower/behind_map.cpp).
constexpr std::string_view names_of_map =
    "centre distance in_cells cells_per_length last_cell cell cell_begins within map_a map_b map_c map_e map_cubic "
    "map_bend mapped mapped_size mapped_velocity mapped_force tangent tangent_squared brake_command damping_at_tool "
    "pushed_in ";

// Functions and types of every law in C (<dashpot/command.h>), and those that begin with the law's own name.
constexpr std::string_view names_in_c =
    "dashpot_command dashpot_all_finite dashpot_all_finitef dashpot_flush_below dashpot_flush_belowf dashpot_clamp_to "
    "dashpot_clamp_tof ";
constexpr std::string_view ends_in_c =
    "square_root mean_decay tree_step tree_push network_step part_state corner tree network node link ";

class ProgramsBuilder {
 public:
  explicit ProgramsBuilder(UpdateLaw law)
      : law_(std::move(law)),
        writer_(law_, law_.tunable->head.port_motion),
        tables_(*law_.tunable),
        head_(tables_.head) {}

  UpdateLaw build() {
    take(names_taken);
    take(names_in_c);
    for (const std::string& law : {tables_.network, "law_" + tables_.network}) take(ends_in_c, law + "_");
    if (head_.map.is_there) take(names_of_map);
    if (tables_.sheds()) take(names_of_shedding);
    declare();
    write_coefficients();
    write_brake_rule();
    springs_->carry_over();
    springs_->numbers().begin(law_.output);
    head_.contact.is_there ? write_contact_output() : write_output();
    write_update();
    write_rest();
    springs_->write_energy();
    check_law(law_, "discretise");
    return std::move(law_);
  }

 private:
  void take(std::string_view names, const std::string& before = "") {
    for (std::size_t at = 0; at < names.size(); at = names.find(' ', at) + 1)
      writer_.unique(before + std::string(names.substr(at, names.find(' ', at) - at)));
  }

  void declare() {
    law_.position = writer_.scalar("position", writer_.length(), "port displacement u", Role::input);
    law_.velocity = writer_.scalar("velocity", writer_.velocity(), "estimate of u̇", Role::input);
    law_.force = writer_.scalar("force", writer_.force(), "motor's part m", Role::local);
    law_.stored = writer_.scalar("stored", "J", "energy in the springs", Role::local);
    held_ = state("held_force", writer_.force(), "force of the springs if the tool stays");
    if (tables_.sheds()) {
      law_.share = state("sampled_share", "1", "share of all forces that is kept");
      law_.variables[law_.share].rest_value = 1;
    }
    for (Tunable& t : tables_.tunables) {
      const bool is_like_kept = t.name.starts_with("sampled_");  // as what is kept of a sample is called
      t.value = writer_.scalar(writer_.unique(is_like_kept ? joined("parameter", t.name) : t.name), t.unit, "parameter",
                               Role::tuned);
      law_.variables[t.value].rest_value = t.range.value;
    }
  }

  // Every number, φ and α of every relaxation, and what follows from them for springs, meshes and slips.
  void write_coefficients() {
    std::vector<ExpressionId> given;
    for (int i = 0; i < tables_.brake.observed; ++i) given.push_back(number(i));
    for (BlockPart& part : tables_.parts)
      if (part.kind == PartKind::relaxation) write_relaxation(part, given);
    const bool has_meshes = has(PartKind::mesh);
    step_stiffness_ = tuned(has_meshes ? "springs_stiffness" : "step_stiffness", writer_.stiffness(),
                            "stiffness of the springs over one sample");
    springs_.emplace(writer_, tables_, given, held_);
    springs_->tune(step_stiffness_);
    for_each_part([&](const BlockPart& part) {
      if (part.kind == PartKind::damper) feedthrough_ = writer_.plus(feedthrough_, number(part.damping));
    });
    viscosity_ = feedthrough_;
    if (has_meshes) write_meshes();
    if (feedthrough_ == nothing) feedthrough_ = none();
    if (!follows_viscosity()) return;
    for_each_part([&](const BlockPart& part) {
      if (part.kind == PartKind::relaxation) viscosity_ = writer_.plus(viscosity_, number(part.damping));
    });
    viscosity_ = viscosity_ == nothing ? none()
                                       : named("viscosity", writer_.damping(),
                                               "Z(0), zero-frequency damping of the network", viscosity_, "Z(0)");
  }

  // z ← z + φ δ − α z with x = h k/B, α = x φ. Exact φ = (1 − e^(−x))/x; backward Euler φ = 1/(1 + x).
  void write_relaxation(BlockPart& part, std::vector<ExpressionId>& given) {
    const auto spring = static_cast<std::size_t>(part.spring);
    const std::string& name = tables_.spring_names[spring];
    part.share = static_cast<int>(given.size());
    part.loss = part.share + 1;
    const char* const kept_means = "φ, share of a displacement that is left in the spring at the end of the sample";
    const char* const loss_means = "α, share of its elongation that is lost in a sample";
    if (const std::optional<FixedRelaxation>& fixed = tables_.fixed[spring]) {
      given.push_back(writer_.constant(writer_.unique(joined(name, "kept")), "1", kept_means, fixed->share,
                                       {ConstantRole::relaxation_share, OfTablePlace{spring}}));
      given.push_back(writer_.constant(writer_.unique(joined(name, "loss")), "1", loss_means, fixed->loss,
                                       {ConstantRole::relaxation_loss, OfTablePlace{spring}}));
      return;
    }
    const auto tuned_one = [&](const char* what, const char* meaning, ExpressionId value, const char* purpose) {
      return named(writer_.unique(joined(name, what)), "1", meaning, value, purpose);
    };
    const ExpressionId k = number(tables_.springs[spring]), b = number(part.damping);
    ExpressionId ratio = writer_.clamp(writer_.divide(writer_.multiply(k, period()), b), largest());
    if (!(least(part.damping) > 0)) ratio = writer_.where(b, ratio, writer_.where(k, largest(), zero()));
    const ExpressionId x = tuned_one("ratio", "x, the sample period over the relaxation time", ratio, "x = h k/B");
    const ExpressionId kept = tuned_one(
        "kept", kept_means, tables_.is_exact ? writer_.mean_decay(x) : writer_.divide(one(), writer_.add(one(), x)),
        tables_.is_exact ? "φ = (1 − e^(−x))/x" : "φ = 1/(1 + x)");
    given.push_back(kept);
    given.push_back(tuned_one("loss", loss_means, writer_.multiply(x, kept), "α = x φ"));
  }

  void write_meshes() {
    const VariableId stiffness =
                         tuned("mesh_stiffness", writer_.stiffness(), "stiffness of the meshes over one sample"),
                     through = tuned("mesh_feedthrough", writer_.damping(), "b∞ of the meshes");
    springs_->tune_meshes(stiffness, through);
    const VariableId both =
        tuned("step_stiffness", writer_.stiffness(), "stiffness of springs and meshes over one sample");
    writer_.assign(law_.tune, both, writer_.add(writer_.read(step_stiffness_), writer_.read(stiffness)), "");
    step_stiffness_ = both;
    feedthrough_ = writer_.plus(feedthrough_, writer_.read(through));
    if (!follows_viscosity()) return;
    const VariableId viscosity = tuned("mesh_viscosity", writer_.damping(), "zero-frequency damping of the meshes");
    springs_->tune_viscosity(viscosity);
    viscosity_ = writer_.plus(viscosity_, writer_.read(viscosity));
  }

  // b of what no slip changes, and the motor's b∞ − b.
  void write_brake_rule() {
    feedthrough_ =
        named("feedthrough_damping", writer_.damping(), "b∞ of the parts that no slip changes", feedthrough_, "b∞");
    ExpressionId brake = followed();
    // The brake's limit is a constant, which the certificate may still change.
    if (tables_.brake.max_damping < largest_finite(law_.scalar))
      brake = least_of(named("wanted_brake", writer_.damping(), "b before the brake's limit", brake, ""), reach());
    // Where a surface can be left the motor compensates nothing, so that b is at most b∞.
    if (head_.contact.is_there) brake = least_of(brake, feedthrough_);
    steady_brake_ = tuned("steady_brake", writer_.damping(), "b of the parts that no slip changes");
    writer_.assign(law_.tune, steady_brake_, brake, "b: " + tables_.brake.text);
    velocity_gain_ = tuned("velocity_gain", writer_.damping(), "b∞ − b");
    writer_.assign(law_.tune, velocity_gain_, writer_.subtract(feedthrough_, writer_.read(steady_brake_)), "b∞ − b");
    if (!head_.slip_rule.takes_part) return;
    left_ = tuned("brake_left", writer_.damping(), "damping that the brake has left for slips");
    writer_.assign(law_.tune, left_, writer_.subtract(reach(), writer_.read(steady_brake_)), "");
    if (tables_.brake.assured_share > 0 && !head_.contact.is_there) write_make_up();
  }

  ExpressionId followed() {
    const TunableBrake& rule = tables_.brake;
    const ExpressionId constant =
        rule.follows == BrakeFollows::constant || rule.follows == BrakeFollows::within_viscosity
            ? writer_.constant("chosen_damping", writer_.damping(), "b chosen for the default values", rule.damping)
            : nothing;
    switch (rule.follows) {
      case BrakeFollows::constant: return constant;
      case BrakeFollows::observed: return number(rule.observed);
      case BrakeFollows::zero_frequency: return viscosity_;
      case BrakeFollows::half_zero_frequency: {
        const ExpressionId half =
            named("half_viscosity", writer_.damping(), "½ Z(0)",
                  writer_.multiply(writer_.constant("half", "1", "a half", Real(0.5), ConstantRole::plain_number),
                                   viscosity_),
                  "");
        return writer_.where(writer_.subtract(half, feedthrough_), half, feedthrough_);
      }
      case BrakeFollows::feedthrough: return feedthrough_;
      case BrakeFollows::within_viscosity: return least_of(constant, viscosity_);
    }
    return constant;
  }

  // While the coil lags, the motor adds no more damping than the share of b that is assured.
  void write_make_up() {
    const ExpressionId gain = writer_.read(velocity_gain_);
    const ExpressionId size = writer_.where(gain, gain, writer_.subtract(none(), gain));
    const ExpressionId share =
        writer_.constant("assured_share", "1", "share of b that the motor may add", tables_.brake.assured_share);
    const ExpressionId assured = named(
        "assured_damping", writer_.damping(), "damping that is assured, less what the motor's velocity gain needs",
        writer_.subtract(writer_.multiply(share, writer_.read(steady_brake_)), size), "");
    make_up_ = named("make_up", writer_.damping(), "largest damping that the motor adds while the coil lags",
                     writer_.where(assured, assured, none()), "");
  }

  bool follows_viscosity() const {
    const BrakeFollows follows = tables_.brake.follows;
    return follows == BrakeFollows::zero_frequency || follows == BrakeFollows::half_zero_frequency ||
           follows == BrakeFollows::within_viscosity;
  }

  template <class Visit>
  void for_each_part(Visit visit) const {  // of what joins tool and ground without a slip
    const TunableBlock& block = tables_.blocks.front();
    for (int i = block.first_part; i < block.first_part + block.part_count; ++i)
      visit(tables_.parts[static_cast<std::size_t>(i)]);
  }
  bool has(PartKind kind) const {
    bool found = false;
    for_each_part([&](const BlockPart& part) { found |= part.kind == kind; });
    return found;
  }

  // A number of the tables: a constant, a parameter, or a sum.
  ExpressionId number(int index) {
    auto [known, is_new] = numbers_.emplace(index, nothing);
    if (is_new) known->second = new_number(static_cast<std::size_t>(index));
    return known->second;
  }
  ExpressionId new_number(std::size_t index) {
    const TunableNumber& n = tables_.numbers[index];
    ExpressionId sum = nothing;
    for (const TunableTerm& term : n.terms) {
      const Tunable& t = tables_.tunables[term.tunable];
      ExpressionId part = writer_.read(t.value);
      if (term.share != 1)
        part = writer_.multiply(constant_of(joined(n.name, "share"), "1", "factor of " + t.name, term.share,
                                            {index, static_cast<std::size_t>(&term - n.terms.data())}),
                                part);
      sum = writer_.plus(sum, part);
    }
    if (n.terms.size() == 1 && n.base == 0)
      return is_plain(sum) ? sum : named(writer_.unique(n.name), n.unit, "the parameter times its factor", sum, "");
    if (!n.terms.empty() && n.base == 0)
      return named(writer_.unique(joined(n.name, "sum")), n.unit, "sum over these elements", sum, "");
    const bool is_sum = !n.terms.empty();
    const ExpressionId base = constant_of(
        n.name, n.unit, is_sum ? "sum of the values that do not change" : "as in the network", n.base, {index, {}});
    return is_sum ? named(writer_.unique(joined(n.name, "sum")), n.unit, "sum over these elements",
                          writer_.add(base, sum), "")
                  : base;
  }

  // Of that name, or with a number behind it; the same again for the same value.
  ExpressionId constant_of(const std::string& name, const std::string& unit, const std::string& meaning, double value,
                           OfNumber of) {
    auto [known, is_new] = constants_.emplace(std::tuple(name, unit, value), nothing);
    if (is_new)
      known->second = writer_.constant(writer_.unique(name), unit, meaning, value, {ConstantRole::element_value, of});
    return known->second;
  }

  double least(int index) const {
    const TunableNumber& n = tables_.numbers[static_cast<std::size_t>(index)];
    double sum = n.base;
    for (const TunableTerm& term : n.terms) sum += tables_.tunables[term.tunable].range.min;
    return sum;
  }

  ExpressionId least_of(ExpressionId one, ExpressionId other) {
    return writer_.where(writer_.subtract(one, other), other, one);
  }
  ExpressionId reach() {
    return writer_.constant("max_damping", writer_.damping(), "largest damping that the brake can give",
                            tables_.brake.max_damping, ConstantRole::brake_reach);
  }
  ExpressionId period() {
    return writer_.constant("period", "s", "h, the sample period", law_.sample_period, ConstantRole::sample_period);
  }
  ExpressionId rate() { return writer_.constant("rate", "Hz", "1/h", head_.rate, ConstantRole::sample_rate); }
  ExpressionId one() { return writer_.constant("one", "1", "one", 1, ConstantRole::plain_number); }
  ExpressionId zero() { return writer_.constant("zero", "1", "zero", 0, ConstantRole::zero); }
  ExpressionId none() { return writer_.constant("no_damping", writer_.damping(), "zero", 0, ConstantRole::zero); }
  ExpressionId largest() {
    return writer_.constant("largest_ratio", "1", "largest x: beyond it nothing is left after a sample", largest_ratio);
  }

  VariableId tuned(const std::string& name, const std::string& unit, const std::string& meaning) {
    return writer_.scalar(name, unit, meaning, Role::tuned);
  }
  bool is_plain(ExpressionId value) const { return facts_of(law_.expressions[value].operation).operands == 0; }
  // What is a variable or a constant already keeps its name.
  ExpressionId named(const std::string& name, const std::string& unit, const std::string& meaning, ExpressionId value,
                     const std::string& purpose) {
    if (is_plain(value)) return value;
    const VariableId variable = tuned(name, unit, meaning);
    writer_.assign(law_.tune, variable, value, purpose);
    return writer_.read(variable);
  }
  ExpressionId stiffness() { return writer_.read(step_stiffness_); }
  ExpressionId damping() { return writer_.read(steady_brake_); }
  ExpressionId gain() { return writer_.read(velocity_gain_); }

  // −1/g of a surface that nothing touches
  ExpressionId recovery() {
    const ExpressionId all =
        named("surface_stiffness", writer_.stiffness(), "g, stiffness of the surface over one sample",
              writer_.add(stiffness(), writer_.multiply(feedthrough_, rate())), "g");
    const ExpressionId minus_one = writer_.constant("minus_one", "1", "minus one", -1, ConstantRole::plain_number);
    return named("recovery_compliance", writer_.compliance(), "−1/g of a surface that nothing touches",
                 writer_.where(all, writer_.divide(minus_one, all), zero()), "−1/g");
  }

  VariableId state(const char* name, const std::string& unit, const char* meaning) {
    return writer_.scalar(name, unit, meaning, Role::state);
  }
  VariableId local(const char* name, const std::string& unit, const char* meaning) {
    return writer_.scalar(name, unit, meaning, Role::local);
  }
  ExpressionId product(ExpressionId first, VariableId second) { return writer_.multiply(first, writer_.read(second)); }

  // m = g Δu + π + σ + (b∞ − b) u̇, where π is held_force and σ the force of the slips
  void write_output() {
    law_.rest_position = state("last_position", writer_.length(), "u of the sample before");
    change_ = local("position_change", writer_.length(), "Δu since the sample before");
    place_ = law_.position;
    writer_.assign(law_.output, change_,
                   writer_.subtract(writer_.read(law_.position), writer_.read(law_.rest_position)), "Δu = u − u₋");
    ExpressionId sum = writer_.add(product(stiffness(), change_), writer_.read(held_));
    sum = springs_->brought_home(sum, writer_.read(law_.position));
    if (tables_.has_slips()) {
      const VariableId slips = local("slips_force", writer_.force(), "σ, force of all slips");
      springs_->slips().write_step(slips, writer_.read(change_));
      sum = writer_.add(sum, writer_.read(slips));
    }
    ExpressionId brake = damping(), driven = gain();
    sum = left_to_brake(sum, brake, &driven);
    writer_.assign(law_.output, law_.force, writer_.add(sum, product(driven, law_.velocity)), "m = f − b u̇");
    law_.brake = local("brake", writer_.damping(), "b");
    writer_.assign(law_.output, law_.brake, with_added(brake), "b");
    law_.last_brake = state("last_brake", writer_.damping(), "b of the sample before");
    writer_.assign(law_.keep, law_.last_brake, writer_.read(law_.brake), "");
  }

  // Takes from the force the part that the brake makes behind slips, and adds what slips ask for to b and to the
  // motor's velocity gain.
  ExpressionId left_to_brake(ExpressionId force, ExpressionId& brake, ExpressionId* gain) {
    if (!head_.slip_rule.takes_part) return force;
    const VariableId now = local("slips_feedthrough", writer_.stiffness(),
                                 "b∞/h of the parts with slips, left to the brake"),
                     damping = local("slips_brake", writer_.damping(), "b of the parts with slips");
    brake = writer_.add(brake, writer_.read(damping));
    const bool makes_up = gain != nullptr && make_up_ != nothing;
    const VariableId wanted =
        makes_up ? local("slips_wanted", writer_.damping(), "b of the parts with slips that the coil is moving to")
                 : no_variable;
    springs_->slips().write_brake({now, damping, wanted}, law_.position, writer_.read(left_));
    if (makes_up) {
      const VariableId slips_gain =
          local("slips_gain", writer_.damping(), "damping that the motor adds while the coil lags");
      writer_.assign(law_.output, slips_gain,
                     writer_.clamp(writer_.subtract(writer_.read(wanted), writer_.read(damping)), make_up_), "");
      *gain = writer_.add(*gain, writer_.read(slips_gain));
    }
    return writer_.subtract(force, product(writer_.read(now), change_));
  }

  // f′ = g Δs + π, or what slips answer beside it, less b∞ Δs/h
  void write_contact_output() {
    ContactSurface surface(writer_, head_.contact.at, head_.contact.encoder_step);
    surface.declare();
    change_ = surface.change();
    surface.write_approach();
    ExpressionId sum = nothing;
    if (!tables_.has_slips()) {
      surface.write_change(recovery(), held_);
      sum = writer_.add(product(stiffness(), change_), writer_.read(held_));
    } else {
      const VariableId pushed = local("pushed_force", writer_.force(), "force of all slips and of what is beside them");
      springs_->slips().write_push(pushed, writer_.read(surface.approach()), change_);
      const ExpressionId through =
          named("feedthrough_stiffness", writer_.stiffness(), "b∞/h", writer_.multiply(feedthrough_, rate()), "b∞/h");
      sum = writer_.subtract(writer_.read(pushed), product(through, change_));
    }
    surface.write_surface();
    ExpressionId brake = damping();
    sum = left_to_brake(sum, brake, nullptr);
    const VariableId opposing = local("opposing", writer_.force(), "f′, the network's force without b∞ Δs/h");
    writer_.assign(law_.output, opposing, sum, "f′ = f − b∞ Δs/h");
    const ExpressionId driven = product(gain(), law_.velocity);
    const ExpressionId braked = writer_.add(writer_.read(opposing), product(brake, law_.velocity));
    surface.write_command(opposing, {writer_.add(braked, driven), writer_.add(writer_.read(opposing), driven), brake});
    place_ = surface.now();
    if (head_.static_spring == no_index && tables_.has_slips()) return;
    place_ = local("surface_back", writer_.length(), "s, after the surface has followed a tool that left");
    writer_.assign(law_.output, place_, springs_->followed(writer_.read(surface.now()), writer_.read(surface.depth())),
                   tables_.sheds() ? "a surface that shedding has pushed in comes back with the tool" : "s");
  }

  // Separate statements, so that every compiler creates the states in the same order.
  void write_update() {
    const VariableId placed = writer_.kept(place_);
    const VariableId change = writer_.kept(change_);
    springs_->write_update(writer_.read(change), writer_.read(placed));
    writer_.assign(law_.update, law_.rest_position, writer_.read(placed), head_.contact.is_there ? "s₋ = s" : "u₋ = u");
  }

  void write_rest() {
    springs_->write_rest(writer_.read(law_.rest_position));
    ExpressionId resting = damping();
    if (head_.slip_rule.takes_part) {
      const VariableId slips = state("resting_brake", writer_.damping(), "b of the parts with slips that stick");
      springs_->slips().write_resting_brake(slips, writer_.read(left_));
      resting = writer_.add(resting, writer_.read(slips));
    }
    if (!head_.contact.is_there) writer_.assign(law_.rest, law_.last_brake, with_added(resting), "");
  }

  // What the certificate adds in every regime.
  ExpressionId with_added(ExpressionId brake) {
    if (tables_.brake.added == 0) return brake;
    return writer_.add(brake, writer_.constant("steady_damping", writer_.damping(), "added for passivity",
                                               tables_.brake.added, ConstantRole::steady_damping));
  }

  UpdateLaw law_;
  LawWriter writer_;
  TunableTables& tables_;
  const TunableHead& head_;
  std::map<int, ExpressionId> numbers_;
  std::map<std::tuple<std::string, std::string, double>, ExpressionId> constants_;
  VariableId held_, change_, place_, step_stiffness_, steady_brake_, velocity_gain_, left_;
  ExpressionId feedthrough_ = nothing, viscosity_ = nothing, make_up_ = nothing;
  std::optional<TunedSprings> springs_;  // once the numbers are there
};

UpdateLaw without_programs(UpdateLaw law) {
  UpdateLaw bare = empty_law_like(law);
  bare.damping = law.damping;
  bare.largest_damping = law.largest_damping;
  bare.mode_form = law.mode_form;
  bare.tunable = std::move(law.tunable);
  return bare;
}

}  // namespace

UpdateLaw with_programs(UpdateLaw law) { return ProgramsBuilder(without_programs(std::move(law))).build(); }

}  // namespace dashpot::compiler
