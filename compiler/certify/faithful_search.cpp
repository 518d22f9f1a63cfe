#include "certify/faithful_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "certify/convex_search.hpp"

namespace dashpot::compiler {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double exactly = 1e-14, closely = 1e-10, roughly = 1e-6;  // relative precision of a place
constexpr std::size_t most_places = 48;                             // at which one convex function is evaluated
constexpr double fine = 1e-4;  // how well x is known before b is searched for, relative

struct Ends {
  double low, high;
  double at(double share) const { return low + share * (high - low); }
};

// Where a convex function is least, ends included; stops as soon as a value is at most `enough`.
template <class Function>
double least_place(Function f, Ends span, double enough, double precision = closely) {
  ValueAt best = golden_section(f, span.low, span.high, enough, precision);
  for (const double end : {span.low, span.high})
    if (best.value > enough)
      if (const double there = f(end); there < best.value) best = {end, there};
  return best.place;
}

// The interval where a convex function is at most `level`; empty if it is above it everywhere.
template <class Function>
std::optional<Ends> sublevel(Function f, Ends span, double level, double precision = exactly) {
  const ValueAt low{span.low, f(span.low)}, high{span.high, f(span.high)};
  const bool is_low = low.value <= level, is_high = high.value <= level;
  if (is_low && is_high) return span;
  ValueAt inside = is_low ? low : high;
  if (!is_low && !is_high) {
    inside = golden_section(f, span.low, span.high, level, std::max(precision, closely),
                            OfInterest{level, low.value, high.value});
    if (!(inside.value <= level)) return std::nullopt;
  }
  return Ends{is_low ? span.low : level_boundary(f, level, inside, low, precision),
              is_high ? span.high : level_boundary(f, level, inside, high, precision)};
}

// One state input: all that the search asks about it at a given b, remembered.
class InputLine {
 public:
  InputLine(const SearchLine& line, const SearchReach& reach, std::optional<double> noise)
      : line_(line), reach_(reach), noise_(noise) {}

  // Needed damping less assured damping; infinite if nothing is proved.
  double lack(double damping) {
    if (const auto known = lacks_.find(damping); known != lacks_.end()) return known->second;
    const std::optional<double> needed = line_.needed(damping);
    const double lack = needed ? *needed - reach_.assured_share * damping - reach_.assured_besides : unbounded;
    return lacks_[damping] = lack;
  }
  double added_for(double lack) const {
    if (lack <= 0) return 0;
    return reach_.assured_share > 0 && reach_.adds ? lack / reach_.assured_share : unbounded;
  }
  double added(double damping) { return added_for(lack(damping)); }

  // By how much b, what is added and a reserve exceed the brake: convex and finite as long as something is proved.
  double excess(double damping) {
    const double room = reach_.adds ? reach_.most - reach_.besides - damping : 0;
    const double lacking = lack(damping);
    const double needed = lacking + reach_.assured_share * damping + reach_.assured_besides;
    return lacking + reach_.reserve * needed - reach_.assured_share * std::max(room, 0.0);
  }
  bool fits(double damping) { return excess(damping) <= 0; }

  double felt(double damping, double added) const { return line_.felt->largest(damping, added); }
  double error(double damping) { return felt(damping, fits(damping) ? added(damping) : 0); }

  EvaluatedOption option(double damping) {
    const double gain = std::abs(reach_.feedthrough - damping);
    const double lacking = lack(damping);
    return {damping, error(damping), lacking < unbounded ? std::optional(added_for(lacking)) : std::nullopt,
            fits(damping), noise_ ? std::optional(gain * *noise_) : std::nullopt};
  }

 private:
  const SearchLine& line_;
  const SearchReach& reach_;
  std::optional<double> noise_;
  std::map<double, double> lacks_;
};

// The certified dampings b of one state input, with x approximated by its chords.
class CertifiedPart {
 public:
  CertifiedPart(InputLine& line, Ends span) : line_(line) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) add(span.at(share));
  }

  // Adds places until chords and prolonged chords agree to a small share of x, or of the smallest x that changes the
  // error.
  void refine(double allowed) {
    while (places_.size() < most_places) {
      std::size_t worst = 0;
      double worst_gap = 1;
      for (std::size_t i = 0; i + 1 < places_.size(); ++i)
        if (const double gap = gap_of(i, allowed); gap > worst_gap) worst = i + 1, worst_gap = gap;
      if (worst == 0) return;
      const double middle = (places_[worst - 1].damping + places_[worst].damping) / 2;
      if (middle <= places_[worst - 1].damping || middle >= places_[worst].damping) return;
      add(middle);
    }
  }

  // The intervals of b where the error is at most `allowed`, chord by chord.
  std::vector<Ends> within(double allowed) const {
    std::vector<Ends> spans;
    for (const Chord& chord : chords())
      if (const auto share = sublevel([&](double s) { return error(chord, s); }, {0, 1}, allowed))
        join(spans, {chord.dampings.at(share->low), chord.dampings.at(share->high)});
    return spans;
  }

  // The b of the least error.
  double most_faithful() const {
    double best = places_.front().damping, least = unbounded;
    for (const Chord& chord : chords()) {
      const auto on_chord = [&](double s) { return error(chord, s); };
      const ValueAt ends[] = {{0, on_chord(0)}, {1, on_chord(1)}};
      ValueAt here = golden_section(on_chord, 0, 1, 0, closely, OfInterest{least, ends[0].value, ends[1].value});
      for (const ValueAt& end : ends)
        if (end.value < here.value) here = end;
      if (here.value < least) least = here.value, best = chord.dampings.at(here.place);
    }
    return best;
  }

 private:
  struct Place {
    double damping, lack;
  };
  struct Chord {
    Ends dampings, added;
  };

  void add(double damping) {
    const Place place{damping, line_.lack(damping)};
    const auto after = std::lower_bound(places_.begin(), places_.end(), damping,
                                        [](const Place& p, double value) { return p.damping < value; });
    if (after == places_.end() || after->damping != damping) places_.insert(after, place);
  }

  static void join(std::vector<Ends>& spans, const Ends& span) {
    if (!spans.empty() && span.low <= spans.back().high * (1 + 1e-12)) spans.back().high = span.high;
    else spans.push_back(span);
  }

  double slope(std::size_t i) const {
    return (places_[i + 1].lack - places_[i].lack) / (places_[i + 1].damping - places_[i].damping);
  }

  // How far the lack may lie below its chord between two places, as a multiple of what may be overlooked.
  double gap_of(std::size_t i, double allowed) const {
    const Place &low = places_[i], &high = places_[i + 1];
    const double width = high.damping - low.damping;
    if (low.lack <= 0 && high.lack <= 0) return 0;  // x is 0 on all of it
    if (width <= 1e-9 * high.damping) return 0;
    const double before = i > 0 ? slope(i - 1) : -unbounded, here = slope(i),
                 after = i + 2 < places_.size() ? slope(i + 1) : unbounded;
    // The prolonged neighbours meet at share s of the width, (here − before) s = (after − here)(1 − s).
    const double rise = here - before, fall = after - here;
    double depth = 0;
    if (std::isfinite(rise) && std::isfinite(fall)) depth = rise + fall > 0 ? width * rise * fall / (rise + fall) : 0;
    else if (std::isfinite(rise)) depth = width * rise;
    else if (std::isfinite(fall)) depth = width * fall;
    const double small = line_.added_for(std::max({low.lack, high.lack, 0.0})) * fine;
    const double unnoticed = fine * allowed / std::max(line_.felt(0, 1) + line_.felt(0, 0), 1e-300);
    return line_.added_for(std::max(depth, 0.0)) / std::max({small, unnoticed, 1e-300});
  }

  // The chords between neighbouring places, split where the lack becomes positive.
  std::vector<Chord> chords() const {
    std::vector<Chord> all;
    for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
      const Place &low = places_[i], &high = places_[i + 1];
      const Ends ends{line_.added_for(low.lack), line_.added_for(high.lack)};
      const bool parts = (low.lack < 0) != (high.lack < 0) && low.lack != 0 && high.lack != 0;
      const double share = parts ? low.lack / (low.lack - high.lack) : 1;
      const double middle = low.damping + share * (high.damping - low.damping);
      if (!parts || !(middle > low.damping && middle < high.damping)) {
        all.push_back({{low.damping, high.damping}, ends});
        continue;
      }
      all.push_back({{low.damping, middle}, {ends.low, 0}});
      all.push_back({{middle, high.damping}, {0, ends.high}});
    }
    return all;
  }

  double error(const Chord& chord, double share) const {
    return line_.felt(chord.dampings.at(share), chord.added.at(share));
  }

  InputLine& line_;
  std::vector<Place> places_;
};

class FaithfulSearch {
 public:
  FaithfulSearch(const std::vector<SearchLine>& lines, const SearchReach& reach, double tolerance,
                 std::optional<double> noise)
      : reach_(reach), tolerance_(tolerance), most_(std::max(reach.most - reach.besides, 0.0)) {
    for (const SearchLine& line : lines) lines_.emplace_back(line, reach, noise);
  }

  FaithfulFind find() {
    for (std::size_t i = 0; i < lines_.size(); ++i) look_at(i);
    look_for_least_error();
    look_until_settled(false);
    FaithfulChoice choice = chosen();
    if (!choice.certified && !certified_.empty()) {
      look_until_settled(true);
      choice = chosen();
    }
    return {std::move(options_), choice};
  }

 private:
  struct Stretch {
    std::size_t line;
    CertifiedPart certified;
  };
  struct Rest {
    std::size_t line;
    Ends span;
  };

  void keep(std::size_t line, double damping) { options_.push_back({line, lines_[line].option(damping)}); }

  FaithfulChoice chosen() const {
    std::vector<EvaluatedOption> all;
    for (const FoundOption& found : options_) all.push_back(found.option);
    return choose_faithful(all, tolerance_);
  }

  double least_error(bool certified_only) const {
    double least = unbounded;
    for (const FoundOption& found : options_)
      if (found.option.certified || !certified_only) least = std::min(least, found.option.error);
    return least;
  }

  // Looks at the ends and b∞, and on both sides of b∞ at the certified and the other dampings.
  void look_at(std::size_t i) {
    const double middle = reach_.feedthrough;
    keep(i, 0);
    if (most_ > 0) keep(i, most_);
    if (middle > 0 && middle < most_) keep(i, middle);
    constexpr double beside = 1e-9;
    if (middle <= 0 || middle >= most_) return part(i, {middle <= 0 ? most_ * 1e-12 : 0, most_});
    part(i, {0, middle * (1 - beside)});
    part(i, {middle * (1 + beside), most_});
  }

  void part(std::size_t i, Ends span) {
    if (!(span.high > span.low)) return;
    InputLine& line = lines_[i];
    const bool is_proved = line.lack(span.high) < unbounded;
    const auto excess = [&](double b) { return line.excess(b); };
    const std::optional<Ends> fitting = is_proved ? sublevel(excess, span, 0) : std::nullopt;
    if (!fitting) return rests_.push_back({i, span});
    if (fitting->low > span.low) rests_.push_back({i, {span.low, fitting->low}});
    if (fitting->high < span.high) rests_.push_back({i, {fitting->high, span.high}});
    if (const std::optional<Ends> near = worth_looking(line, *fitting)) certified_.push_back({i, {line, *near}});
  }

  // The span of b where some x would keep within the largest error that is allowed: the convex error is minimised over
  // x, then searched over b.
  std::optional<Ends> worth_looking(InputLine& line, Ends span) const {
    const double reached = least_error(true);
    if (reached == unbounded) return span;  // no certified option is known yet
    const double allowed = allowed_error(tolerance_, reached) * leeway;
    const double most_added = std::max(line.added(span.low), line.added(span.high));  // of a convex function
    const auto least_felt = [&](double b) {
      if (most_added == 0) return line.felt(b, 0);
      return line.felt(b, least_place([&](double x) { return line.felt(b, x); }, {0, most_added}, allowed, roughly));
    };
    return sublevel(least_felt, span, allowed, roughly);
  }

  void look_for_least_error() {
    for (const Rest& rest : rests_) {
      const auto error = [&](double b) { return lines_[rest.line].felt(b, 0); };
      keep(rest.line, least_place(error, rest.span, 0));
    }
    const double allowed = allowed_error(tolerance_, least_error(false));
    for (Stretch& stretch : certified_) {
      stretch.certified.refine(allowed);
      keep(stretch.line, stretch.certified.most_faithful());
    }
  }

  // A new option may have a little less error, or less added damping, than all before: then the bounds are tightened
  // and the search is repeated.
  void look_until_settled(bool certified_only) {
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds; ++round) {
      const double allowed = allowed_error(tolerance_, least_error(certified_only));
      const double added = look_for_most_damping(allowed);
      if (allowed_error(tolerance_, least_error(certified_only)) == allowed && least_added(allowed) == added) return;
    }
  }

  // Returns the least added damping that it used as its bound.
  double look_for_most_damping(double allowed) {
    for (const Rest& rest : rests_) {
      const auto error = [&](double b) { return lines_[rest.line].felt(b, 0); };
      if (const auto span = sublevel(error, rest.span, allowed)) keep(rest.line, span->high);
    }
    for (Stretch& stretch : certified_) look_for_least_added(stretch, allowed);
    const double least = least_added(allowed);
    if (least < unbounded)
      for (Stretch& stretch : certified_) look_for_end(stretch, allowed, leeway * least);
    return least;
  }

  double least_added(double allowed) const {
    double least = unbounded;
    for (const FoundOption& found : options_)
      if (found.option.certified && is_within(found.option.error, allowed))
        least = std::min(least, found.option.added.value_or(0));
    return least;
  }

  void look_for_least_added(Stretch& stretch, double allowed) {
    InputLine& line = lines_[stretch.line];
    for (const Ends& span : stretch.certified.within(allowed)) {
      const auto is_allowed = [&](double b) { return is_within(line.error(b), allowed); };
      const double least = least_place([&](double b) { return line.lack(b); }, span, 0, roughly);
      keep(stretch.line, nearest_allowed(is_allowed, least, span.at(0.5)));
    }
  }

  // Finds the largest b of each span with x small enough: first on the chord, then with the exact functions.
  void look_for_end(Stretch& stretch, double allowed, double most_added) {
    InputLine& line = lines_[stretch.line];
    const auto is_allowed = [&](double b) {
      return line.fits(b) && is_within(line.added(b), most_added) && is_within(line.error(b), allowed);
    };
    for (const Ends& span : stretch.certified.within(allowed)) {
      double inside = least_place([&](double b) { return line.lack(b); }, span, 0, roughly);
      if (!is_within(line.added(inside), most_added)) continue;
      const double end =
          line.added(span.high) <= most_added
              ? span.high
              : boundary([&](double b) { return line.added(b) <= most_added; }, inside, span.high, 1e-12);
      keep(stretch.line, settled_end(is_allowed, end, std::min(most_, span.high + (span.high - span.low))));
    }
  }

  // A place near `guess`, towards `inner`, where the claim holds: the end found on a chord is not quite the exact one.
  template <class Claim>
  static double nearest_allowed(Claim is_allowed, double guess, double inner) {
    for (double share = 0; share < 1; share = share == 0 ? 1e-9 : 4 * share) {
      const double inside = guess + share * (inner - guess);
      if (is_allowed(inside)) return boundary(is_allowed, inside, guess, closely);
    }
    return guess;
  }

  // The exact end of where the claim holds, near `guess`.
  template <class Claim>
  static double settled_end(Claim is_allowed, double guess, double most) {
    double step = 1e-9 * guess;
    if (is_allowed(guess)) {
      double outside = std::min(guess + step, most);
      while (outside < most && is_allowed(outside)) guess = outside, step *= 4, outside = std::min(guess + step, most);
      if (is_allowed(outside)) return outside;
      return boundary(is_allowed, guess, outside, 1e-13);
    }
    double inside = guess;
    for (; step < guess && !is_allowed(inside); step *= 4) inside = guess - step;
    return is_allowed(inside) ? boundary(is_allowed, inside, guess, 1e-13) : guess;
  }

  const SearchReach& reach_;
  double tolerance_, most_;
  std::vector<InputLine> lines_;
  std::vector<Stretch> certified_;
  std::vector<Rest> rests_;
  std::vector<FoundOption> options_;
};

}  // namespace

FaithfulFind find_faithful(const std::vector<SearchLine>& lines, const SearchReach& reach, double tolerance,
                           std::optional<double> noise) {
  return FaithfulSearch(lines, reach, tolerance, noise).find();
}

}  // namespace dashpot::compiler
