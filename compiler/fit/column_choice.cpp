#include "fit/column_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "network/decimal.hpp"
#include "network/port_units.hpp"
#include "network/unit.hpp"
#include "source/counted.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"
#include "source/utf8.hpp"

namespace dashpot::compiler::fitting {
namespace {

inline constexpr Dimension pressure{1, -1, -2};
inline constexpr Dimension per_pressure{-1, 1, 2};
inline constexpr Dimension compliance{-1, 0, 2};
inline constexpr Dimension rotational_compliance{-1, -2, 2, 0, 1};

struct RoleRule {
  Role role;
  const char* word;
  std::vector<std::string> names;  // as headers spell it, letters and digits only, lower case
  std::vector<Dimension> dimensions;
  const char* likely_unit;  // in a question
};

const std::vector<RoleRule>& rules() {
  static const std::vector<RoleRule> list = {
      {Role::time, "time", {"time", "t", "zeit", "elapsedtime", "testtime", "reltime"}, {dimensions::time}, "s"},
      {Role::position,
       "position",
       {"position", "pos", "displacement", "disp", "compression", "extension", "indentation", "depth", "deflection",
        "elongation", "crosshead", "stroke", "weg", "u", "x", "angle", "theta", "rotation"},
       {dimensions::length, dimensions::angle},
       "mm"},
      {Role::strain,
       "strain",
       {"strain", "engineeringstrain", "truestrain", "engstrain", "dehnung", "l"},
       {dimensions::number},
       "1"},
      {Role::force,
       "force",
       {"force", "load", "f", "fz", "kraft", "torque"},
       {dimensions::force, dimensions::torque},
       "N"},
      {Role::stress,
       "stress",
       {"stress", "engineeringstress", "truestress", "engstress", "spannung"},
       {pressure},
       "kPa"},
      {Role::omega,
       "omega",
       {"omega", "w", "ω", "angularfrequency"},
       {dimensions::angular_velocity, dimensions::frequency},
       "rad/s"},
      {Role::frequency, "frequency", {"frequency", "freq", "f"}, {dimensions::frequency}, "Hz"},
      {Role::storage,
       "storage",
       {"storage", "storagemodulus", "estor", "gstor", "estorage", "gstorage", "g1", "e1", "g", "e", "gprime",
        "eprime"},
       {pressure, dimensions::stiffness, dimensions::rotational_stiffness},
       "Pa"},
      {Role::loss,
       "loss",
       {"loss", "lossmodulus", "eloss", "gloss", "g2", "e2", "gdoubleprime", "edoubleprime"},
       {pressure, dimensions::stiffness, dimensions::rotational_stiffness},
       "Pa"},
      {Role::modulus,
       "modulus",
       {"modulus", "erelax", "grelax", "relaxation", "relaxationmodulus", "relmod", "e", "g", "et", "gt", "stiffness"},
       {pressure, dimensions::stiffness, dimensions::rotational_stiffness},
       "Pa"},
      {Role::compliance,
       "compliance",
       {"compliance", "creepcompliance", "j", "jt", "d", "dt"},
       {per_pressure, compliance, rotational_compliance},
       "1/Pa"},
      {Role::deviation,
       "deviation",
       {"deviation", "sd", "std", "stdev", "standarddeviation"},
       {dimensions::force, dimensions::torque, pressure, dimensions::stiffness, dimensions::rotational_stiffness,
        per_pressure, compliance},
       "N"},
      {Role::velocity,
       "velocity",
       {"velocity", "angularvelocity", "speed", "geschwindigkeit"},
       {dimensions::velocity, dimensions::angular_velocity},
       "m/s"},
  };
  return list;
}

const RoleRule& rule_of(Role role) {
  return *std::find_if(rules().begin(), rules().end(), [&](const RoleRule& rule) { return rule.role == role; });
}

// A name as letters_of() leaves it.
bool is_name_of(const RoleRule& rule, const std::string& letters) {
  return std::find(rule.names.begin(), rule.names.end(), letters) != rule.names.end();
}

bool takes(const RoleRule& rule, const Dimension& dimension) {
  return std::find(rule.dimensions.begin(), rule.dimensions.end(), dimension) != rule.dimensions.end();
}

struct ReadUnit {
  Dimension dimension;
  double factor;
};

std::optional<ReadUnit> unit_in(std::string_view field) {
  const std::string_view text = unit_text(field);
  if (text == "-" || text == "1") return ReadUnit{dimensions::number, 1};
  const auto unit = parse_unit(text);
  if (!std::holds_alternative<Unit>(unit)) return std::nullopt;
  const Unit& read = std::get<Unit>(unit);
  return ReadUnit{read.dimension, round_decimal("1", read).value};
}

// "position [in]" in two, whether the unit is known or not.
std::optional<TitleParts> split_at_bracket(std::string_view title) {
  for (const auto& [open, close] : {std::pair('(', ')'), std::pair('[', ']'), std::pair('{', '}')}) {
    const std::size_t begin = title.rfind(open);
    if (begin == std::string_view::npos || begin == 0 || !title.ends_with(close) || begin + 2 >= title.size()) continue;
    std::string_view name = title.substr(0, begin);
    while (name.ends_with(' ')) name.remove_suffix(1);
    return TitleParts{std::string(name), std::string(title.substr(begin + 1, title.size() - begin - 2))};
  }
  return std::nullopt;
}

// "Load (N)", "time [s]", "force_N", "t/s": a name, and what is its unit.
TitleParts title_of(std::string_view text) {
  if (const auto parts = split_at_bracket(text); parts && unit_in(*parts->unit)) return *parts;
  for (const char sign : {'_', '/', ' '}) {
    const std::size_t at = text.rfind(sign);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string unit(text.substr(at + 1));
    const bool is_letter = !unit.empty() && std::isdigit(static_cast<unsigned char>(unit[0])) == 0;
    if (is_letter && unit_in(unit)) return {std::string(text.substr(0, at)), unit};
  }
  return {std::string(text), std::nullopt};
}

// The primes at the end of "G'" and "E''", however they are typed.
std::size_t take_primes(std::string_view& text) {
  std::size_t primes = 0;
  for (bool found = true; found;) {
    found = false;
    for (const auto& [sign, count] : {std::pair("'", 1), std::pair("\"", 2), std::pair("′", 1), std::pair("’", 1),
                                      std::pair("″", 2), std::pair("”", 2)}) {
      if (!text.ends_with(sign)) continue;
      text.remove_suffix(std::string_view(sign).size());
      primes += static_cast<std::size_t>(count);
      found = true;
    }
  }
  return primes;
}

std::string letters_of(std::string_view text) {
  const std::size_t primes = take_primes(text);
  std::string letters;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  const bool is_symbol = std::count_if(letters.begin(), letters.end(), is_first_byte) == 1;
  if (is_symbol && text.find_first_of("*|") != std::string_view::npos) return letters + "star";  // G*, |G*|, |G|
  return letters + (primes == 1 ? "prime" : primes == 2 ? "doubleprime" : "");
}

// What rheometers write beside or in place of storage and loss. None of it is read, so it stands for no other quantity.
// The letter of the loss angle is that of an indentation too.
bool is_unread(const std::string& letters, RecordingKind kind) {
  static const std::vector<std::string> always = {
      "gstar",      "estar",        "kstar",    "jstar", "complexmodulus", "complexshearmodulus", "complexviscosity",
      "etastar",    "ηstar",        "tandelta", "tand",  "tanδ",           "tangentdelta",        "losstangent",
      "lossfactor", "dampingfactor"};
  static const std::vector<std::string> of_spectra = {"delta",      "δ",        "lossangle", "phase",
                                                      "phaseangle", "phaselag", "phaseshift"};
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), letters) != names.end();
  };
  return has(always) || (kind == RecordingKind::frequency && has(of_spectra));
}

std::vector<TableColumn> columns_of(const TableShape& shape) {
  std::vector<TableColumn> columns;
  for (std::size_t i = 0; i < shape.names.size(); ++i) {
    columns.push_back(table_column(shape.names[i]));
    if (i < shape.units.size() && !shape.units[i].empty())
      columns.back() = {shape.names[i], shape.names[i], shape.units[i]};
  }
  return columns;
}

std::optional<std::size_t> index_of(const std::string& name, const std::vector<TableColumn>& columns,
                                    std::size_t width) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].title == name || columns[i].name == name) return i;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (letters_of(columns[i].name) == letters_of(name) && !letters_of(name).empty()) {
      if (found) return std::nullopt;
      found = i;
    }
  if (found) return found;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = error == std::errc() && end == name.data() + name.size();
  if (is_number && number >= 1 && number <= width) return number - 1;
  return std::nullopt;
}

// The name of a column; its number where it has none, or where the name would be read as something else or cannot be
// shown.
std::string spelt_by(const std::string& name, std::size_t index, const std::vector<TableColumn>& columns,
                     std::size_t width) {
  const bool is_plain = !name.empty() && name.find_first_of(",:=+-") == std::string::npos && is_utf8(name);
  return is_plain && index_of(name, columns, width) == index ? name : std::to_string(index + 1);
}

// Whether its unit is that of a tool that is shifted or turned; empty for times and for a material's quantities.
std::optional<motion> motion_in(const ChosenColumn& column) {
  if (column.role == Role::omega || column.role == Role::frequency) return std::nullopt;
  const auto is_one_of = [&](std::initializer_list<Dimension> list) {
    return std::find(list.begin(), list.end(), column.dimension) != list.end();
  };
  using namespace dimensions;
  if (is_one_of({length, velocity, force, stiffness, compliance})) return motion::translation;
  const bool turns = is_one_of({angle, angular_velocity, torque, rotational_stiffness, rotational_compliance});
  return turns ? std::optional(motion::rotation) : std::nullopt;
}

class Chooser {
 public:
  Chooser(const std::string& path, const TableShape& shape, const ColumnSearch& search, Diagnostics& diagnostics)
      : path_(path), shape_(shape), search_(search), diagnostics_(diagnostics), columns_(columns_of(shape)) {}

  std::optional<std::vector<ChosenColumn>> run() {
    const std::size_t errors_before = diagnostics_.error_count();
    choose();
    if (needs_answer_) note_answer();
    return diagnostics_.error_count() > errors_before ? std::nullopt : std::optional(chosen_);
  }

 private:
  void choose() {
    const std::size_t errors_before = diagnostics_.error_count();
    for (const ColumnRequest& request : search_.requests) take(request);
    if (diagnostics_.error_count() > errors_before) return;
    if (shape_.names.empty() && !has_all()) return ask_for_names();
    find_missing();
    if (diagnostics_.error_count() > errors_before) return;
    if (!has_all()) return ask_for_columns();
    check_that_they_agree();
  }

  // A column says whether a tool is shifted or turned, and those beside it have to say the same. A loss is in what its
  // storage is in.
  void check_that_they_agree() {
    const ChosenColumn* first = nullptr;
    for (const Role role : {Role::position, Role::storage, Role::modulus, Role::compliance})
      if (first == nullptr) first = find_column(chosen_, role);
    if (first == nullptr) return;
    const std::optional<motion> is = motion_in(*first);
    for (const ChosenColumn& other : chosen_) {
      const std::optional<motion> says = motion_in(other);
      const bool is_other_motion = is && says && says != is;
      const bool is_other_loss = other.role == Role::loss && other.dimension != first->dimension;
      if (!is_other_motion && !is_other_loss) continue;
      diagnostics_.report<DiagnosticCode::recording_wrong_unit>(
          {}, other.title, other.unit, fmt::format("{} that goes with '{}'", rule_of(other.role).word, first->title),
          other.role == Role::loss ? first->unit : unit_beside(other.role, port_units(*is)));
      return;
    }
  }

  static std::string unit_beside(Role role, const PortUnits& units) {
    switch (role) {
      case Role::velocity: return units.velocity;
      case Role::force: return units.force;
      default: return units.stiffness;
    }
  }

  bool has(Role role) const { return find_column(chosen_, role) != nullptr; }
  bool wants(Role role) const {
    return std::any_of(search_.requests.begin(), search_.requests.end(), [&](auto& r) { return r.role == role; });
  }

  // Which of the four kinds is looked for: what was asked for, else what the header holds.
  RecordingKind kind() const {
    if (search_.is_relaxation || wants(Role::modulus)) return RecordingKind::relaxation;
    if (search_.is_creep || wants(Role::compliance)) return RecordingKind::creep;
    const bool asks_spectrum = wants(Role::storage) || wants(Role::omega) || wants(Role::frequency);
    if (asks_spectrum || has_name(Role::storage, Role::loss)) return RecordingKind::frequency;
    // A modulus or a compliance beside the time alone, in a unit that says so.
    const bool has_motion = is_there(Role::position) || is_there(Role::strain) || is_there(Role::force) ||
                            is_there(Role::stress) || !search_.requests.empty();
    if (!has_motion && has_with_unit(Role::modulus)) return RecordingKind::relaxation;
    if (!has_motion && has_with_unit(Role::compliance)) return RecordingKind::creep;
    return kind_by_units();
  }

  // By units, for columns whose names do not tell: a frequency without a time is a spectrum's, a modulus beside the
  // time a relaxation's.
  RecordingKind kind_by_units() const {
    const bool is_named = (is_there(Role::frequency) && !is_there(Role::force)) || is_there(Role::omega);  // "f"
    const bool has_frequency = is_named || has_unit(Role::frequency);
    const bool has_displacement = is_there(Role::position) || is_there(Role::strain) || has_unit(Role::position);
    const bool is_motion = has_displacement || wants(Role::force) || wants(Role::stress);
    if (is_motion || !search_.requests.empty()) return RecordingKind::motion;
    const bool has_time = is_there(Role::time) || has_unit(Role::time);
    if (!has_time && (has_frequency || is_there(Role::storage) || is_there(Role::loss)))
      return RecordingKind::frequency;
    const bool is_alone = columns_.size() == 2 && has_time && !is_there(Role::force) && !is_there(Role::stress);
    if (is_alone && has_unit(Role::modulus)) return RecordingKind::relaxation;
    if (is_alone && has_unit(Role::compliance)) return RecordingKind::creep;
    return RecordingKind::motion;
  }

  bool has_unit(Role role) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const TableColumn& column) {
      const auto unit = column.unit ? unit_of_column(column, role) : std::nullopt;
      const bool is_other =
          is_unread(letters_of(column.name), RecordingKind::frequency);  // "phase [deg]", not "δ [mm]"
      return unit && (!is_other || unit->dimension == dimensions::length);
    });
  }

  bool is_there(Role role) const { return has(role) || !candidates(role).empty(); }

  bool has_with_unit(Role role) const {
    if (has(role)) return true;
    const std::vector<std::size_t> found = candidates(role);
    return found.size() == 1 && columns_[found.front()].unit;
  }

  bool has_name(Role first, Role second) const { return is_there(first) && is_there(second); }

  std::vector<std::vector<Role>> needed() const {
    switch (kind()) {
      case RecordingKind::motion: return {{Role::time}, {Role::position, Role::strain}, {Role::force, Role::stress}};
      case RecordingKind::relaxation: return {{Role::time}, {Role::modulus}};
      case RecordingKind::creep: return {{Role::time}, {Role::compliance}};
      case RecordingKind::frequency: return {{Role::omega, Role::frequency}, {Role::storage}, {Role::loss}};
    }
    return {};
  }

  bool has_all() const {
    const auto groups = needed();
    return std::all_of(groups.begin(), groups.end(), [&](const std::vector<Role>& group) {
      return std::any_of(group.begin(), group.end(), [&](Role role) { return has(role); });
    });
  }

  void take(const ColumnRequest& request) {
    const std::optional<std::size_t> index = index_of(request.name, columns_, shape_.width);
    if (!index) return report_missing(request);
    const RoleRule& rule = rule_of(request.role);
    const bool is_named = *index < columns_.size();
    const std::string title = is_named ? columns_[*index].title : request.name;
    std::optional<std::string> unit = request.unit;
    if (!unit && is_named) unit = columns_[*index].unit;
    if (!unit && request.role == Role::strain) unit = "1";
    if (!unit && can_be_scaled(request.role)) return add_scaled(request, *index, title);
    if (!unit) return ask_for_unit(request.role, title);
    const std::optional<ReadUnit> read = unit_in(*unit);
    const bool is_plain = read && read->dimension == dimensions::number && can_be_scaled(request.role);
    if (is_plain) return add_scaled(request, *index, title);
    if (!read || !takes(rule, read->dimension)) {
      diagnostics_.report<DiagnosticCode::recording_wrong_unit>({}, title, *unit, rule.word, rule.likely_unit);
      return;
    }
    if (is_named && columns_[*index].unit) warn_of_unit(columns_[*index], *unit, *read);
    add({request.role, *index, request.offset, request.is_negated ? -read->factor : read->factor, read->dimension,
         title, *unit});
  }

  // Where --columns overrules a header that says otherwise.
  void warn_of_unit(const TableColumn& column, const std::string& asked, const ReadUnit& read) {
    const std::optional<ReadUnit> stated = unit_in(*column.unit);
    if (stated && stated->factor == read.factor && stated->dimension == read.dimension) return;
    diagnostics_.report<DiagnosticCode::recording_unit_overruled>({}, column.title, *column.unit, asked);
  }

  // A modulus without a unit, normalised for one, takes that of --scale.
  bool can_be_scaled(Role role) const {
    return search_.scale &&
           (role == Role::modulus || role == Role::compliance || role == Role::storage || role == Role::loss);
  }

  void add_scaled(const ColumnRequest& request, std::size_t index, const std::string& title) {
    add({request.role, index, request.offset, *search_.scale, search_.scale_dimension, title, ""});
  }

  void add(ChosenColumn column) {
    if (column.role == Role::omega && column.dimension == dimensions::frequency)
      column.dimension = dimensions::angular_velocity;
    chosen_.push_back(std::move(column));
  }

  void report_missing(const ColumnRequest& request) {
    diagnostics_.report<DiagnosticCode::recording_no_such_column>({}, path_, excerpt(request.name));
    if (columns_.empty()) diagnostics_.note<DiagnosticCode::recording_columns_by_number>({}, shape_.width);
    else {
      std::vector<std::string> names;
      for (const TableColumn& column : columns_) names.push_back(column.name);
      diagnostics_.note<DiagnosticCode::known_keys>({}, fmt::format("{}", fmt::join(names, ", ")));
    }
  }

  // Columns whose name says that they are this, and whose unit does not say otherwise.
  std::vector<std::size_t> candidates(Role role) const {
    const RoleRule& rule = rule_of(role);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const bool is_taken = std::any_of(chosen_.begin(), chosen_.end(), [&](auto& c) { return c.index == i; });
      if (is_taken || !is_name_of(rule, letters_of(columns_[i].name))) continue;
      if (!columns_[i].unit) {
        found.push_back(i);
        continue;
      }
      const std::optional<ReadUnit> unit = unit_in(*columns_[i].unit);
      if (unit && (takes(rule, unit->dimension) || (can_be_scaled(role) && unit->dimension == dimensions::number)))
        found.push_back(i);
    }
    return found;
  }

  void find_missing() {
    for (const std::vector<Role>& group : needed()) {
      if (std::any_of(group.begin(), group.end(), [&](Role role) { return has(role); })) continue;
      find_one_of(group);
      const bool is_found = std::any_of(group.begin(), group.end(), [&](Role role) { return has(role); });
      if (!is_found && has_unknown_unit(group)) return;
    }
    if (!has(Role::deviation) && candidates(Role::deviation).size() == 1) take_quietly(Role::deviation);
  }

  void take_quietly(Role role) {
    const TableColumn& column = columns_[candidates(role).front()];
    if (column.unit) take({role, column.title, false, 0, {}});
  }

  // A column that is plainly one of these, in a unit that is not known: no command line is right for that.
  bool has_unknown_unit(const std::vector<Role>& group) {
    for (const Role role : group)
      for (const TableColumn& column : columns_) {
        const RoleRule& rule = rule_of(role);
        const bool is_named =
            std::find(rule.names.begin(), rule.names.end(), letters_of(column.name)) != rule.names.end();
        if (!is_named || !column.unit || unit_in(*column.unit)) continue;
        diagnostics_.report<DiagnosticCode::recording_wrong_unit>({}, column.title, *column.unit, rule.word,
                                                                  rule.likely_unit);
        diagnostics_.note<DiagnosticCode::recording_columns_remedy>({}, words_of_columns(), words_of_needed());
        return true;
      }
    return false;
  }

  // The first role of the group that has a column: force before stress.
  void find_one_of(const std::vector<Role>& group) {
    for (const Role role : group) {
      const std::vector<std::size_t> found = candidates(role);
      if (found.empty()) continue;
      if (found.size() > 1) return ask_which(role, found);
      return take({role, columns_[found.front()].title, false, 0, {}});
    }
  }

  // A part of --columns that would choose a column: ROLE=NAME[:UNIT].
  struct Offer {
    Role role;
    std::size_t index;
    std::string text;
    bool guesses_unit = false;
  };

  struct Answer {
    std::string command;
    const char* condition;  // what must be true for it to be right
  };

  // A command line that would do, of what is known and else of what is likeliest: columns that are there, none in a
  // unit that the header contradicts. Empty if no column is left for a role.
  std::optional<Answer> answer() const {
    const std::vector<std::vector<Role>> groups = needed();
    std::vector<std::optional<Offer>> offers(groups.size());
    std::vector<bool> is_used(shape_.width);
    for (std::size_t i = 0; i < columns_.size(); ++i) is_used[i] = is_unread(letters_of(columns_[i].name), kind());
    for (const ChosenColumn& column : chosen_) is_used[column.index] = true;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if ((offers[i] = named_offer(groups[i]))) is_used[offers[i]->index] = true;
    for (const bool by_unit : {true, false})
      for (std::size_t i = 0; i < groups.size(); ++i)
        if (!offers[i] && (offers[i] = likely_offer(groups[i], is_used, by_unit))) is_used[offers[i]->index] = true;
    std::vector<std::string> parts;
    bool guesses_unit = false;
    for (const std::optional<Offer>& offer : offers) {
      if (!offer) return std::nullopt;
      guesses_unit = guesses_unit || offer->guesses_unit;
      parts.push_back(std::string(rule_of(offer->role).word) + "=" + offer->text);
    }
    const std::string columns = fmt::format("{}", fmt::join(parts, ","));
    return Answer{search_.command + " --columns " + columns_word(columns),
                  guesses_unit ? "if the units are right" : "if the columns are right"};
  }

  std::optional<Offer> named_offer(const std::vector<Role>& group) const {
    for (const Role role : group)
      if (const ChosenColumn* column = find_column(chosen_, role)) {
        std::string unit;
        for (const ColumnRequest& request : search_.requests)
          if (request.role == role && request.unit) unit = ":" + *request.unit;
        return Offer{role, column->index, spelt_by(column->title, column->index, columns_, shape_.width) + unit};
      }
    for (const Role role : group)
      if (const std::vector<std::size_t> found = candidates(role); !found.empty()) return offer_of(role, found.front());
    return std::nullopt;
  }

  std::optional<Offer> likely_offer(const std::vector<Role>& group, const std::vector<bool>& is_used,
                                    bool by_unit) const {
    for (const Role role : group)
      for (std::size_t i = 0; i < shape_.width; ++i) {
        const bool has_unit = i < columns_.size() && columns_[i].unit;
        if (is_used[i] || has_unit != by_unit || (by_unit && !unit_of_column(columns_[i], role))) continue;
        const bool turns = by_unit && unit_of_column(columns_[i], role)->dimension != dimensions::frequency;
        if (by_unit && role == Role::omega && !turns) continue;  // hertz are no angular frequency
        return offer_of(role, i);
      }
    return std::nullopt;
  }

  Offer offer_of(Role role, std::size_t index) const {
    const bool has_unit = index < columns_.size() && columns_[index].unit;
    const std::string likely = rule_of(role).likely_unit;
    const std::string name = index < columns_.size() ? columns_[index].name : "";
    const bool guesses_unit = !has_unit && likely != "1";
    return {role, index, spelt_by(name, index, columns_, shape_.width) + (guesses_unit ? ":" + likely : ""),
            guesses_unit};
  }

  void note_answer() {
    if (const std::optional<Answer> line = answer())
      diagnostics_.note<DiagnosticCode::recording_answer>({}, line->condition, line->command);
    else if (kind() == RecordingKind::frequency && !unread_titles().empty())
      diagnostics_.note<DiagnosticCode::recording_loss_remedy>({}, fmt::format("{}", fmt::join(unread_titles(), ", ")));
    else if (shape_.width < needed().size())
      diagnostics_.note<DiagnosticCode::recording_too_few_columns>({}, counted(shape_.width, "column"),
                                                                   words_of_needed());
    else diagnostics_.note<DiagnosticCode::recording_columns_remedy>({}, words_of_columns(), words_of_needed());
    if (!shape_.metadata.empty())
      diagnostics_.note<DiagnosticCode::recording_metadata>(
          {}, excerpt(fmt::format("{}", fmt::join(shape_.metadata, " | "))));
  }

  std::vector<std::string> unread_titles() const {
    std::vector<std::string> titles;
    for (const TableColumn& column : columns_)
      if (is_unread(letters_of(column.name), kind())) titles.push_back("'" + column.title + "'");
    return titles;
  }

  void ask_for_unit(Role role, const std::string& title) {
    diagnostics_.report<DiagnosticCode::recording_unit_missing>({}, path_, title, rule_of(role).word);
    needs_answer_ = true;
  }

  void ask_which(Role role, const std::vector<std::size_t>& found) {
    std::vector<std::string> names;
    for (const std::size_t i : found) names.push_back("'" + columns_[i].title + "'");
    diagnostics_.report<DiagnosticCode::recording_several_columns>({}, path_, rule_of(role).word,
                                                                   fmt::format("{}", fmt::join(names, ", ")));
    needs_answer_ = true;
  }

  void ask_for_names() {
    diagnostics_.report<DiagnosticCode::recording_without_names>({}, path_, shape_.width);
    needs_answer_ = true;
  }

  void ask_for_columns() {
    bool is_misfit = false;  // all wrong units are reported
    for (const std::vector<Role>& group : needed())
      if (std::none_of(group.begin(), group.end(), [&](Role role) { return has(role); }) && report_misfit(group))
        is_misfit = true;
    if (is_misfit) {
      diagnostics_.note<DiagnosticCode::recording_unit_remedy>({});
      needs_answer_ = true;
      return;
    }
    for (const std::vector<Role>& group : needed()) {
      if (std::any_of(group.begin(), group.end(), [&](Role role) { return has(role); })) continue;
      diagnostics_.report<DiagnosticCode::recording_column_missing>({}, path_, words_of(group));
      const bool has_spare = columns_.size() >= needed().size();
      if (is_force_after_a_step(group, has_spare)) diagnostics_.note<DiagnosticCode::recording_force_after_step>({});
      else if (has_spare) needs_answer_ = true;
      else
        diagnostics_.note<DiagnosticCode::recording_too_few_columns>({}, counted(columns_.size(), "column"),
                                                                     words_of_needed());
      return;
    }
  }

  // A column that is called like one of these, and is not taken for its unit.
  bool report_misfit(const std::vector<Role>& group) {
    for (const Role role : group)
      if (const auto misfit = misfit_unit(columns_, role)) {
        diagnostics_.report<DiagnosticCode::recording_wrong_unit>({}, columns_[misfit->index].title, misfit->unit,
                                                                  rule_of(role).word, rule_of(role).likely_unit);
        return true;
      }
    return false;
  }

  std::string words_of_columns() const {
    std::vector<std::string> titles;
    for (const TableColumn& column : columns_) titles.push_back("'" + column.title + "'");
    return fmt::format("{}", fmt::join(titles, ", "));
  }

  std::string words_of_needed() const {
    std::vector<std::string> all;
    for (const std::vector<Role>& group : needed()) all.push_back(words_of(group));
    return fmt::format("{}", fmt::join(all, ", "));
  }

  static std::string words_of(const std::vector<Role>& group) {
    std::vector<std::string> words;
    for (const Role role : group) words.emplace_back(rule_of(role).word);
    return fmt::format("{}", fmt::join(words, " or "));
  }

  // A force without the motion that made it: what a relaxation is measured as.
  bool is_force_after_a_step(const std::vector<Role>& missing, bool has_spare) const {
    const bool is_missing = missing.front() == Role::modulus || (missing.front() == Role::position && !has_spare);
    return is_missing && (has(Role::force) || !candidates(Role::force).empty());
  }

  const std::string& path_;
  const TableShape& shape_;
  const ColumnSearch& search_;
  Diagnostics& diagnostics_;
  std::vector<TableColumn> columns_;
  std::vector<ChosenColumn> chosen_;
  bool needs_answer_ = false;  // told once, after all that is missing
};

// NAME, NAME-0.95, -NAME, NAME:kPa
ColumnRequest request_of(Role role, std::string text) {
  ColumnRequest request{role, {}, false, 0, {}};
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos && unit_in(text.substr(colon + 1))) {
    request.unit = text.substr(colon + 1);
    text.erase(colon);
  }
  if (text.starts_with('-')) {
    request.is_negated = true;
    text.erase(0, 1);
  }
  // From the first sign behind which all is a number: the last may be that of an exponent.
  for (std::size_t sign = text.find_first_of("+-", 1); sign < text.size(); sign = text.find_first_of("+-", sign + 1)) {
    const std::string number = text.substr(sign + (text[sign] == '+' ? 1 : 0));
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) continue;
    request.offset = value;
    text.erase(sign);
    break;
  }
  request.name = text;
  return request;
}

}  // namespace

std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" ()[]{}'\"$&;|<>*?\\!#~") == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string columns_word(const std::string& columns) {
  const bool has_primes = columns.find('\'') != std::string::npos;  // better to read between double quotes
  const bool is_plain = columns.find_first_of("\"$`\\!") == std::string::npos;
  return has_primes && is_plain ? '"' + columns + '"' : shell_word(columns);
}

std::string spelt(const TableShape& shape, std::size_t index) {
  const std::vector<TableColumn> columns = columns_of(shape);
  return spelt_by(index < columns.size() ? columns[index].name : "", index, columns, shape.width);
}

std::string spelt(const ColumnRequest& request) {
  std::string part = std::string(name_of(request.role)) + "=" + (request.is_negated ? "-" : "") + request.name;
  if (request.offset != 0) part += fmt::format("{:+}", request.offset);
  return request.unit ? part + ":" + *request.unit : part;
}

const char* name_of(Role role) { return rule_of(role).word; }

std::string other_names_of(Role role) {
  const RoleRule& rule = rule_of(role);
  std::string text;
  for (std::size_t i = 0; i < rule.names.size(); ++i) {
    if (rule.names[i] == rule.word) continue;
    if (!text.empty()) text += i + 1 == rule.names.size() ? " or " : ", ";
    text += "'" + rule.names[i] + "'";
  }
  return text;
}

const std::vector<std::string>& names_of(Role role) { return rule_of(role).names; }

const char* likely_unit(Role role) { return rule_of(role).likely_unit; }

std::optional<ColumnUnit> unit_named(std::string_view unit) {
  const std::optional<ReadUnit> read = unit_in(unit);
  return read ? std::optional(ColumnUnit{read->dimension, read->factor}) : std::nullopt;
}

TitleParts parts_of(const TableColumn& column) {
  if (column.unit) return {column.name, column.unit};
  return split_at_bracket(column.title).value_or(TitleParts{column.title, std::nullopt});
}

std::optional<MisfitUnit> misfit_unit(const std::vector<TableColumn>& columns, Role role) {
  const RoleRule& rule = rule_of(role);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TitleParts parts = parts_of(columns[i]);
    if (is_name_of(rule, letters_of(parts.name)) && parts.unit &&
        !(columns[i].unit && unit_of_column(columns[i], role)))
      return MisfitUnit{i, *parts.unit};
  }
  return std::nullopt;
}

TableColumn table_column(std::string_view text) {
  const TitleParts title = title_of(text);
  return {std::string(text), title.name, title.unit};
}

std::optional<ColumnUnit> unit_of_column(const TableColumn& column, Role role) {
  const RoleRule& rule = rule_of(role);
  if (!column.unit) return ColumnUnit{rule.dimensions.front(), 1};
  const std::optional<ReadUnit> unit = unit_in(*column.unit);
  if (!unit || !takes(rule, unit->dimension)) return std::nullopt;
  return ColumnUnit{unit->dimension, unit->factor};
}

std::vector<std::size_t> columns_for(const std::vector<TableColumn>& columns, Role role) {
  const RoleRule& rule = rule_of(role);
  std::vector<std::size_t> by_word, by_name;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string letters = letters_of(columns[i].name);
    if (!is_name_of(rule, letters) || !unit_of_column(columns[i], role)) continue;
    by_name.push_back(i);
    if (letters == rule.word) by_word.push_back(i);
  }
  return by_word.empty() ? by_name : by_word;
}

std::optional<std::vector<ColumnRequest>> parse_columns(const std::string& words, Diagnostics& diagnostics) {
  std::vector<ColumnRequest> requests;
  std::size_t begin = 0;
  while (begin <= words.size()) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const std::string part = words.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = part.find('=');
    const std::string word = part.substr(0, equals);
    const auto rule = std::find_if(rules().begin(), rules().end(),
                                   [&](const RoleRule& r) { return r.role != Role::velocity && r.word == word; });
    if (equals == std::string::npos || equals + 1 == part.size() || rule == rules().end()) {
      diagnostics.report<DiagnosticCode::columns_malformed>({}, excerpt(part));
      std::vector<std::string> known;
      for (const RoleRule& r : rules())
        if (r.role != Role::velocity) known.emplace_back(r.word);
      diagnostics.note<DiagnosticCode::known_keys>({}, fmt::format("{}", fmt::join(known, ", ")));
      return std::nullopt;
    }
    requests.push_back(request_of(rule->role, part.substr(equals + 1)));
  }
  return requests;
}

const ChosenColumn* find_column(const std::vector<ChosenColumn>& columns, Role role) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const ChosenColumn& c) { return c.role == role; });
  return found == columns.end() ? nullptr : &*found;
}

RecordingKind kind_of(const std::vector<ChosenColumn>& columns) {
  if (find_column(columns, Role::storage) != nullptr) return RecordingKind::frequency;
  if (find_column(columns, Role::modulus) != nullptr) return RecordingKind::relaxation;
  if (find_column(columns, Role::compliance) != nullptr) return RecordingKind::creep;
  return RecordingKind::motion;
}

motion motion_of(const std::vector<ChosenColumn>& columns) {
  const bool turns = std::any_of(columns.begin(), columns.end(),
                                 [](const ChosenColumn& column) { return motion_in(column) == motion::rotation; });
  return turns ? motion::rotation : motion::translation;
}

bool is_of_a_material(const ChosenColumn& column) {
  return column.role == Role::strain || column.role == Role::stress || column.dimension == pressure ||
         column.dimension == per_pressure;
}

std::optional<std::vector<ChosenColumn>> choose_columns(const std::string& path, const TableShape& shape,
                                                        const ColumnSearch& search, Diagnostics& diagnostics) {
  return Chooser(path, shape, search, diagnostics).run();
}

std::optional<SpokenQuantity> spoken_quantity(const std::string& text) {
  const std::size_t length = decimal_length(text);
  if (length == 0) return std::nullopt;
  std::size_t begin = length;
  while (begin < text.size() && text[begin] == ' ') ++begin;
  const std::string unit_text = text.substr(begin);
  Unit unit{};
  if (!unit_text.empty()) {
    const auto read = parse_unit(unit_text);
    if (!std::holds_alternative<Unit>(read)) return std::nullopt;
    unit = std::get<Unit>(read);
  }
  const RoundedDecimal rounded = round_decimal(std::string_view(text).substr(0, length), unit);
  if (rounded.rounding != Rounding::finite) return std::nullopt;
  return SpokenQuantity{rounded.value, unit.dimension};
}

}  // namespace dashpot::compiler::fitting
