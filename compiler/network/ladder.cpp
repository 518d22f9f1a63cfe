#include "network/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "network/passive_prony.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

constexpr double default_time = 1;      // τ of K τ^α D^α u [s]
constexpr double default_error = 0.01;  // of a springpot over its band
constexpr double least_error = 1e-9;    // beyond it the rounding of the constants counts
constexpr double greatest_error = 0.5;
constexpr double widest_band = 1e24;  // highest over lowest frequency, as far as any two values may be apart

class LadderReader {
 public:
  LadderReader(const LeafDecl& leaf, ParameterTable& table, motion port_motion, const LadderDefaults& defaults,
               Diagnostics& diagnostics)
      : leaf_(leaf), table_(table), motion_(port_motion), defaults_(defaults), diagnostics_(diagnostics) {}

  std::optional<Ladder> read_springpot() {
    const SpringpotDecl& decl = *leaf_.springpot;
    const auto stiffness = read_springpot_stiffness();
    const auto exponent = read_exponent(decl.exponent);
    const auto time = decl.time ? read_positive(*decl.time, "the time of a springpot", dimensions::time)
                                : std::optional(default_time);
    const auto band = read_band(decl.band);
    const auto error = decl.error ? read_error(*decl.error) : std::optional(default_error);
    if (!stiffness || !exponent || !time || !band || !error) return std::nullopt;
    const double most = stiffness->range.high;
    if (most == 0) return Ladder{0, {}, {}};
    constexpr double turn = 2 * std::numbers::pi;
    SpringpotLadder unit = springpot_ladder(*exponent, turn * band->low, turn * band->high, *error);
    // Of a tunable stiffness the ladder is that of 1, which its value scales.
    const double scale = (stiffness->tunable ? 1 : stiffness->value) * std::pow(*time, *exponent);
    for (MaxwellBranch& branch : unit.branches) branch.stiffness *= scale;
    if (!are_finite(unit.branches, stiffness->tunable ? most : 1)) {
      diagnostics_.report<DiagnosticCode::number_too_large>(leaf_.value->span, excerpt(leaf_.value->text));
      return std::nullopt;
    }
    const Springpot springpot{{},         stiffness->value,     *exponent, *time, *band,
                              unit.error, unit.branches.size(), leaf_.span};
    return Ladder{{}, std::move(unit.branches), springpot, stiffness->tunable};
  }

  std::optional<Ladder> read_prony() {
    const PronyDecl& decl = *leaf_.prony;
    const auto stiffness = read_stiffness(leaf_.value, "a Prony series");
    const auto of = read_of(decl.of);
    PronySeries series;
    for (const PronyTermDecl& term : decl.terms) read_term(term, of == PronyOf::absolute, series);
    if (!stiffness || !of || series.terms.size() != decl.terms.size()) return std::nullopt;
    series.of = *of;
    series.stiffness = *stiffness;
    if (!is_passive(series)) {
      report_active(series);
      return std::nullopt;
    }
    Ladder ladder = ladder_of(series);
    if (are_finite(ladder.branches, 1) && std::isfinite(ladder.stiffness.value_or(0))) return ladder;
    diagnostics_.report<DiagnosticCode::number_too_large>(leaf_.value->span, excerpt(leaf_.value->text));
    return std::nullopt;
  }

 private:
  static bool are_finite(const std::vector<MaxwellBranch>& branches, double scale) {
    return std::all_of(branches.begin(), branches.end(), [&](const MaxwellBranch& branch) {
      return std::isfinite(scale * branch.stiffness) &&
             std::isfinite(scale * branch.stiffness / branch.relaxation_rate);
    });
  }

  std::optional<ReadValue> read_springpot_stiffness() {
    if (!leaf_.value) return std::nullopt;
    const auto value = table_.read(*leaf_.value, {"a springpot", stiffness_dimension(), motion_});
    if (!value) return std::nullopt;
    if (value->range.low >= 0) return value;
    report_negative_stiffness(*leaf_.value, "a springpot", value->range.low);
    if (value->parameter) diagnostics_.note<DiagnosticCode::given_here>(table_.place_of_least(*value->parameter));
    return std::nullopt;
  }

  void report_negative_stiffness(const ValueDecl& decl, std::string_view taker, double value) {
    diagnostics_.report<DiagnosticCode::negative_value>(decl.span, fmt::format("the stiffness of {}", taker),
                                                        fmt::format("{} {}", value, unit_of(stiffness_dimension())));
  }

  std::optional<double> read_constant(const ValueDecl& decl, std::string_view taker, const Dimension& due) {
    return table_.read_constant(decl, {std::string(taker), due, motion_});
  }

  Dimension stiffness_dimension() const {
    return motion_ == motion::rotation ? dimensions::rotational_stiffness : dimensions::stiffness;
  }

  std::optional<double> read_stiffness(const std::optional<ValueDecl>& decl, std::string_view taker) {
    if (!decl) return std::nullopt;
    const auto value = read_constant(*decl, taker, stiffness_dimension());
    if (!value || *value >= 0) return value;
    report_negative_stiffness(*decl, taker, *value);
    return std::nullopt;
  }

  std::optional<double> read_positive(const ValueDecl& decl, std::string_view taker, const Dimension& due) {
    const auto value = read_constant(decl, taker, due);
    if (!value || *value > 0) return value;
    diagnostics_.report<DiagnosticCode::not_above_zero>(decl.span, taker, fmt::format("{} {}", *value, unit_of(due)));
    return std::nullopt;
  }

  std::optional<double> read_exponent(const std::optional<ValueDecl>& decl) {
    if (!decl) return std::nullopt;
    const auto value = read_constant(*decl, "the exponent of a springpot", dimensions::number);
    if (!value || (*value > 0 && *value < 1)) return value;
    diagnostics_.report<DiagnosticCode::springpot_exponent>(decl->span, *value);
    if (*value == 0) diagnostics_.note<DiagnosticCode::springpot_is_spring>({});
    if (*value == 1) diagnostics_.note<DiagnosticCode::springpot_is_damper>({});
    return std::nullopt;
  }

  std::optional<double> read_error(const ValueDecl& decl) {
    const auto value = read_constant(decl, "the error of a springpot", dimensions::number);
    if (!value || (least_error <= *value && *value <= greatest_error)) return value;
    diagnostics_.report<DiagnosticCode::springpot_error>(decl.span, excerpt(decl.text), least_error, greatest_error);
    return std::nullopt;
  }

  std::optional<Range> read_band(const std::optional<RangeDecl>& decl) {
    if (decl) return read_stated_band(*decl);
    for (const std::optional<Range>& band : {defaults_.valid_frequency, defaults_.device_band})
      if (band && band->low > 0 && band->high > band->low && band->high / band->low <= widest_band) return band;
    diagnostics_.report<DiagnosticCode::springpot_without_band>(leaf_.kind_span);
    diagnostics_.note<DiagnosticCode::state_springpot_band>({});
    return std::nullopt;
  }

  std::optional<Range> read_stated_band(const RangeDecl& decl) {
    if (!decl.low) {
      diagnostics_.report<DiagnosticCode::springpot_band_from_zero>(decl.span);
      return std::nullopt;
    }
    const auto low = read_positive(*decl.low, "the lower end of a springpot's band", dimensions::frequency);
    const auto high = read_positive(decl.high, "the upper end of a springpot's band", dimensions::frequency);
    if (!low || !high) return std::nullopt;
    if (*low<*high&& * high / *low> widest_band) {
      diagnostics_.report<DiagnosticCode::device_limit>(decl.span, "band",
                                                        excerpt(decl.low->text) + " to " + excerpt(decl.high.text),
                                                        fmt::format("a factor of at most {}", widest_band));
      return std::nullopt;
    }
    if (*low < *high) return Range{*low, *high};
    diagnostics_.report<DiagnosticCode::empty_range>(decl.span, "the band of a springpot", excerpt(decl.low->text),
                                                     excerpt(decl.high.text));
    return std::nullopt;
  }

  std::optional<PronyOf> read_of(const std::optional<Text>& of) {
    if (!of) return std::nullopt;
    if (const std::optional<PronyOf> known = prony_of(of->text)) return known;
    diagnostics_.report<DiagnosticCode::unknown_word>(of->span, "'of'", excerpt(of->text),
                                                      "'instantaneous', 'long-term', 'absolute'");
    return std::nullopt;
  }

  void read_term(const PronyTermDecl& decl, bool is_absolute, PronySeries& series) {
    if (!decl.weight || !decl.time) return;
    const auto weight =
        read_constant(*decl.weight, is_absolute ? "a weight of an absolute series" : "a relative weight",
                      is_absolute ? stiffness_dimension() : dimensions::number);
    const auto time = read_positive(*decl.time, "the time of a Prony term", dimensions::time);
    if (weight && time) series.terms.push_back({*weight, *time});
  }

  static Ladder ladder_of(const PronySeries& series) {
    Ladder ladder{series.long_term_stiffness(), {}, {}};
    for (const PronyTerm& term : series.terms)
      if (const double stiffness = series.stiffness_of(term); stiffness > 0)
        ladder.branches.push_back({stiffness, 1 / term.time});
    if (*ladder.stiffness == 0 && !ladder.branches.empty()) ladder.stiffness.reset();
    return ladder;
  }

  void report_active(const PronySeries& series) {
    const auto negative = std::find_if(series.terms.begin(), series.terms.end(), [](auto& t) { return t.weight < 0; });
    if (negative != series.terms.end()) {
      const auto index = static_cast<std::size_t>(negative - series.terms.begin());
      diagnostics_.report<DiagnosticCode::prony_weight_negative>(leaf_.prony->terms[index].weight->span,
                                                                 negative->weight);
    } else {
      // Without the rounding of the addition, unless the result is then no longer above 1.
      const double sum = series.sum_of_weights(), rounded = std::round(1e12 * sum) / 1e12;
      diagnostics_.report<DiagnosticCode::prony_sum_above_one>(leaf_.prony->terms_span, rounded > 1 ? rounded : sum);
    }
    const PassiveFit fit = nearest_passive(series);
    diagnostics_.note<DiagnosticCode::prony_nearest_passive>(
        {}, absolute_leaf(fit.series, unit_of(stiffness_dimension())), 100 * fit.error);
  }

  const LeafDecl& leaf_;
  ParameterTable& table_;
  motion motion_;
  const LadderDefaults& defaults_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Ladder> read_ladder(const LeafDecl& leaf, ParameterTable& table, motion port_motion,
                                  const LadderDefaults& defaults, Diagnostics& diagnostics) {
  LadderReader reader(leaf, table, port_motion, defaults, diagnostics);
  return leaf.springpot ? reader.read_springpot() : reader.read_prony();
}

}  // namespace dashpot::compiler
