#include "fit/read_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "source/counted.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr std::size_t least_rows = 3;
constexpr std::size_t most_reported = 5;  // cells of one file

// A force that stays at its greatest for so many rows, while the tool goes on by so much of its way, is a sensor's
// limit.
constexpr std::size_t saturated_rows = 5;
constexpr double saturated_travel = 0.01;

// Values of one row, as its roles need them.
struct Row {
  double time, drive, answer, loss, deviation;
};

class RecordingReader {
 public:
  RecordingReader(LineReader& lines, const ReadChoices& choices, Diagnostics& diagnostics)
      : lines_(lines), choices_(choices), diagnostics_(diagnostics) {}

  std::optional<ReadRecording> run() {
    const std::size_t errors_before = diagnostics_.error_count();
    if (!read_head()) return std::nullopt;
    const auto chosen = choose_columns(lines_.path(), shape_, choices_.columns, diagnostics_);
    if (!chosen || !settle(*chosen)) return std::nullopt;
    read_rows();
    if (lines_.has_failed() || diagnostics_.error_count() > errors_before) return std::nullopt;
    result_.recording.name = lines_.path();
    result_.recording.digest = lines_.digest();
    check_whole();
    if (diagnostics_.error_count() > errors_before) return std::nullopt;
    if (const ChosenColumn* material = material_column(); material != nullptr && !choices_.geometry) {
      diagnostics_.report<DiagnosticCode::recording_awaits_geometry>({}, lines_.path(), material->title,
                                                                     name_of(material->role));
      diagnostics_.note<DiagnosticCode::geometry_known>({});
    }
    begin_at_rest();
    return std::move(result_);
  }

 private:
  Recording& recording() { return result_.recording; }
  bool is_motion() const { return result_.recording.kind == RecordingKind::motion; }

  bool read_head() {
    std::vector<HeadLine> whole;
    while (head_.size() < head_lines)
      if (const auto line = lines_.next(diagnostics_)) head_.push_back({std::string(*line), lines_.number()});
      else break;
    if (lines_.has_failed()) return false;
    const bool is_empty = std::all_of(head_.begin(), head_.end(), [](const HeadLine& l) { return l.text.empty(); });
    if (is_empty) {
      diagnostics_.report<DiagnosticCode::recording_empty>({}, lines_.path());
      return false;
    }
    const auto shape = table_shape(lines_.path(), head_, choices_.has_header, diagnostics_);
    if (!shape) return false;
    shape_ = *shape;
    return true;
  }

  // Where each quantity stands, and what turns it into SI at the tool.
  bool settle(const std::vector<ChosenColumn>& columns) {
    columns_ = columns;
    recording().kind = kind_of(columns);
    recording().port_motion = motion_of(columns);
    const ChosenColumn* material = material_column();
    if (material != nullptr && !choices_.geometry && !choices_.awaits_geometry) {
      diagnostics_.report<DiagnosticCode::recording_without_geometry>({}, lines_.path(), material->title,
                                                                      name_of(material->role));
      std::vector<std::string> parts;
      for (const ColumnRequest& request : choices_.columns.requests) parts.push_back(spelt(request));
      diagnostics_.note<DiagnosticCode::recording_answer>(
          {}, "with your specimen's numbers",
          (parts.empty() ? choices_.columns.command : with_columns(parts)) +
              " --geometry column:area=1mm^2,length=10mm");
      diagnostics_.note<DiagnosticCode::geometry_known>({});
      if (!shape_.metadata.empty())
        diagnostics_.note<DiagnosticCode::recording_metadata>(
            {}, excerpt(fmt::format("{}", fmt::join(shape_.metadata, " | "))));
      return false;
    }
    return true;
  }

  // The first that is no force or displacement at a tool.
  const ChosenColumn* material_column() const {
    const auto material = std::find_if(columns_.begin(), columns_.end(), is_of_a_material);
    return material == columns_.end() ? nullptr : &*material;
  }

  double factor_of(const ChosenColumn& column) const {
    if (!choices_.geometry) return column.scale;
    const Geometry& geometry = *choices_.geometry;
    const bool is_modulus = column.dimension == Dimension{1, -1, -2};
    switch (column.role) {
      case Role::strain: return column.scale * geometry.length;
      case Role::stress: return column.scale * geometry.area;
      case Role::modulus:
      case Role::storage:
      case Role::loss: return is_modulus ? column.scale * geometry.stiffness_per_modulus : column.scale;
      case Role::compliance:
        return column.dimension == Dimension{-1, 1, 2} ? column.scale / geometry.stiffness_per_modulus : column.scale;
      case Role::deviation:
        return is_modulus ? column.scale * (is_motion() ? geometry.area : geometry.stiffness_per_modulus)
                          : column.scale;
      default: return column.scale;
    }
  }

  void read_rows() {
    places_.clear();
    for (const ChosenColumn& column : columns_) {
      const double turns = column.role == Role::frequency ? 2 * std::numbers::pi : 1;
      places_.push_back({column.index, column.offset, factor_of(column) * turns, slot_of(column.role), &column});
    }
    std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.index < b.index; });
    for (const HeadLine& line : head_)
      if (line.number >= shape_.first_line && may_go_on()) read_row(line.text, line.number);
    head_.clear();
    while (may_go_on()) {
      const auto line = lines_.next(diagnostics_);
      if (!line) break;
      read_row(*line, lines_.number());
    }
  }

  bool may_go_on() const { return reported_ < most_reported; }

  static double Row::*slot_of(Role role) {
    switch (role) {
      case Role::time:
      case Role::omega:
      case Role::frequency: return &Row::time;
      case Role::position:
      case Role::strain: return &Row::drive;
      case Role::force:
      case Role::stress:
      case Role::storage:
      case Role::modulus:
      case Role::compliance: return &Row::answer;
      case Role::loss: return &Row::loss;
      case Role::deviation: return &Row::deviation;
      case Role::velocity: break;  // of no recording
    }
    return &Row::answer;
  }

  struct Place {
    std::size_t index;
    double offset, factor;
    double Row::*slot;
    const ChosenColumn* column;
  };

  static bool is_remark(std::string_view line) {
    const std::size_t at = line.find_first_not_of(" \t");
    return at == std::string_view::npos || line[at] == '#' || line.find_first_not_of(" \t,;") == std::string_view::npos;
  }

  void read_row(std::string_view line, std::size_t number) {
    if (is_remark(line)) return;
    Row row{};
    std::size_t next = 0, count = 0;
    bool is_whole = true;
    const auto take = [&](std::string_view field) {
      while (next < places_.size() && places_[next].index == count)
        is_whole &= take_cell(field, line, number, places_[next++], row);
      ++count;
    };
    for_each_field(line, take);
    // A delimiter at the end of a line either ends the last field or precedes an empty one: the width decides.
    if (count + 1 == shape_.width && shape_.dialect.delimiter != ' ' && line.ends_with(shape_.dialect.delimiter))
      take(line.substr(line.size()));
    if (count != shape_.width)
      refuse<DiagnosticCode::recording_field_count, DiagnosticCode::recording_remove_row>(
          line, number, line, counted(count, "field"), shape_.width);
    else if (is_whole && is_in_order(row, line, number)) add(row, number);
  }

  template <class Take>
  void for_each_field(std::string_view line, Take take) const {
    const char delimiter = shape_.dialect.delimiter;
    if (delimiter == ' ' || line.find('"') != std::string_view::npos) {
      for (const std::string_view field : fields_of(line, shape_.dialect)) take(field);
      return;
    }
    std::size_t begin = 0;
    for (;;) {
      const std::size_t end = line.find(delimiter, begin);
      std::string_view field = line.substr(begin, end == std::string_view::npos ? end : end - begin);
      while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
      while (!field.empty() && (field.back() == ' ' || field.back() == '\t')) field.remove_suffix(1);
      if (end == std::string_view::npos && field.empty() && begin > 0 && delimiter != '\t') return;
      take(field);
      if (end == std::string_view::npos) return;
      begin = end + 1;
    }
  }

  bool take_cell(std::string_view field, std::string_view line, std::size_t number, const Place& place, Row& row) {
    const std::optional<double> value = number_of(field, shape_.dialect);
    if (!value)
      return refuse<DiagnosticCode::recording_not_a_number, DiagnosticCode::recording_remove_row>(
          line, number, field, place.column->title, excerpt(field));
    row.*(place.slot) = (*value + place.offset) * place.factor;
    return true;
  }

  // False: a row with a fault in `part` of its line.
  template <DiagnosticCode fault, DiagnosticCode remedy, class... Arguments>
  bool refuse(std::string_view line, std::size_t number, std::string_view part, const Arguments&... arguments) {
    ++reported_;
    diagnostics_.report<fault>(place_of(lines_.path(), line, number, part, diagnostics_), arguments...);
    diagnostics_.note<remedy>({});
    return false;
  }

  // A spectrum may come in falling order; it is sorted afterwards.
  bool is_in_order(const Row& row, std::string_view line, std::size_t number) {
    const Recording& so_far = result_.recording;
    const bool is_spectrum = so_far.kind == RecordingKind::frequency;
    if (is_spectrum && !(row.time > 0))
      return refuse<DiagnosticCode::recording_not_a_frequency, DiagnosticCode::recording_remove_row>(line, number,
                                                                                                     line);
    if (so_far.time.empty() || (is_spectrum && row.time != so_far.time.back())) return true;
    if (row.time < so_far.time.back())
      return refuse<DiagnosticCode::recording_time_falls, DiagnosticCode::recording_time_remedy>(
          line, number, line, row.time, so_far.time.back());
    if (row.time > so_far.time.back()) return true;
    if (row.drive == last_.drive && row.answer == last_.answer && row.loss == last_.loss) return false;
    return refuse<DiagnosticCode::recording_two_values, DiagnosticCode::recording_two_values_remedy>(line, number, line,
                                                                                                     row.time);
  }

  void add(const Row& row, std::size_t number) {
    Recording& r = recording();
    last_ = row;
    r.time.push_back(row.time);
    if (is_motion()) r.position.push_back(row.drive);
    r.force.push_back(row.answer);
    if (r.kind == RecordingKind::frequency) r.loss.push_back(row.loss);
    if (find_column(columns_, Role::deviation) != nullptr) r.deviation.push_back(row.deviation);
    if (last_number_ != 0 && number != last_number_ + 1) has_gaps_ = true;
    last_number_ = number;
    if (first_number_ == 0) first_number_ = number;
  }

  // The file's line of a row, for messages about what is only seen when all is read.
  Span line_of_row(std::size_t row) {
    if (has_gaps_) return place_of(lines_.path(), "", first_number_, "", diagnostics_);
    const std::size_t wanted = first_number_ + row;
    LineReader again(lines_.path(), ReadProgress());
    if (again.open(diagnostics_))
      while (const auto line = again.next(diagnostics_))
        if (again.number() == wanted) return place_of(lines_.path(), *line, wanted, *line, diagnostics_);
    return place_of(lines_.path(), "", wanted, "", diagnostics_);
  }

  void check_whole() {
    Recording& r = recording();
    if (r.time.size() < least_rows) {
      diagnostics_.report<DiagnosticCode::recording_too_short>(line_of_row(0), counted(r.time.size(), "row"),
                                                               least_rows);
      diagnostics_.note<DiagnosticCode::recording_more_rows>({});
      return;
    }
    if (r.kind == RecordingKind::frequency) return sort_spectrum();
    const auto [least, greatest] = std::minmax_element(r.force.begin(), r.force.end());
    if (*least == *greatest && is_motion()) {
      diagnostics_.report<DiagnosticCode::recording_force_constant>(line_of_row(0), *least);
      diagnostics_.note<DiagnosticCode::recording_other_column>({});
      return;
    }
    if (!is_motion()) return check_response();
    const auto [low, high] = std::minmax_element(r.position.begin(), r.position.end());
    if (*low == *high) {
      diagnostics_.report<DiagnosticCode::recording_without_motion>(line_of_row(0), *low);
      diagnostics_.note<DiagnosticCode::recording_motion_remedy>({});
      return;
    }
    if (const double whole = r.time.back() - r.time.front(); std::abs(choices_.force_delay) >= whole)
      return diagnostics_.report<DiagnosticCode::recording_delay_too_long>(line_of_row(0), choices_.force_delay, whole);
    if (choices_.force_delay != 0) move_force();
    check_signs();
    check_saturation(*high - *low);
  }

  void sort_spectrum() {
    Recording& r = recording();
    std::vector<std::size_t> order(r.time.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return r.time[a] < r.time[b]; });
    for (std::vector<double>* values : {&r.time, &r.force, &r.loss, &r.deviation}) {
      if (values->empty()) continue;
      std::vector<double> sorted;
      for (const std::size_t i : order) sorted.push_back((*values)[i]);
      *values = std::move(sorted);
    }
    if (r.time.front() == r.time.back()) {
      diagnostics_.report<DiagnosticCode::recording_without_motion>(line_of_row(0), r.time.front());
      diagnostics_.note<DiagnosticCode::recording_motion_remedy>({});
      return;
    }
    check_loss();
  }

  // With time as exp(−iωt) losses are below zero. What hardly loses anything may be so by the noise of its phase.
  void check_loss() {
    constexpr double by_noise = 0.01;  // of the magnitude
    const Recording& r = result_.recording;
    double shares = 0;
    for (std::size_t i = 0; i < r.time.size(); ++i)
      if (const double size = std::hypot(r.force[i], r.loss[i]); size > 0) shares += r.loss[i] / size;
    if (shares < -by_noise * static_cast<double>(r.time.size()))
      refuse_signs(0, "the loss is negative", "energy that is lost is counted as positive", {Role::loss});
  }

  // Stiffness and compliance are above zero, or a sign is wrong.
  void check_response() {
    const Recording& r = result_.recording;
    if (r.time.front() < 0) {
      diagnostics_.report<DiagnosticCode::recording_before_step>(line_of_row(0), r.time.front());
      diagnostics_.note<DiagnosticCode::recording_step_remedy>({});
    }
    const bool is_creep = r.kind == RecordingKind::creep;
    if (const double sum = std::accumulate(r.force.begin(), r.force.end(), 0.0); !(sum > 0))
      refuse_signs(0, fmt::format("the mean {} is not above 0", is_creep ? "compliance" : "modulus"),
                   "positive values are expected", {is_creep ? Role::compliance : Role::modulus});
  }

  // Work is put in over the whole of a recording; what gives work has a sign wrong.
  void check_signs() {
    const Recording& r = result_.recording;
    double products = 0;
    const double from = r.force.front();
    for (std::size_t i = 0; i < r.time.size(); ++i) products += (r.force[i] - from) * (r.position[i] - r.position[0]);
    if (products < 0)
      return refuse_signs(0, "force falls where position rises",
                          "a force that opposes the motion is counted as positive", {Role::force, Role::stress});
    if (choices_.keeps_positions) check_direction();
  }

  // Behind a surface the force is positive and the position beyond it: a recording of a tool that presses the other way
  // would have no row that touches. One that sticks pulls too, but does not go back beyond its first row for that.
  void check_direction() {
    const Recording& r = result_.recording;
    const auto [least, greatest] = std::minmax_element(r.force.begin(), r.force.end());
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < r.time.size(); ++i) {
      const double push = std::abs(r.force[i] - r.force.front());
      weights += push;
      sum += push * (r.position[i] - r.position.front());
    }
    if (-*least <= *greatest || sum >= 0) return;
    refuse_signs(static_cast<std::size_t>(least - r.force.begin()),
                 "the force is negative, and the tool presses towards falling positions",
                 "in front of a surface positions rise towards it, and behind it forces are positive",
                 {Role::position, Role::strain, Role::force, Role::stress});
  }

  void refuse_signs(std::size_t row, const std::string& what, const char* counted_as, const std::vector<Role>& roles) {
    diagnostics_.report<DiagnosticCode::recording_signs>(line_of_row(row), what, counted_as);
    std::vector<std::string> turned;
    for (const ChosenColumn& column : columns_)
      if (std::find(roles.begin(), roles.end(), column.role) != roles.end()) turned.emplace_back(name_of(column.role));
    diagnostics_.note<DiagnosticCode::recording_signs_remedy>({}, fmt::format("{}", fmt::join(turned, " and ")),
                                                              with_signs_turned(roles));
  }

  // The command line with all columns of this recording, those of some roles with their signs turned.
  std::string with_signs_turned(const std::vector<Role>& roles) const {
    std::vector<std::string> parts;
    for (const ChosenColumn& column : columns_) {
      const bool is_turned = std::find(roles.begin(), roles.end(), column.role) != roles.end();
      const auto request = std::find_if(choices_.columns.requests.begin(), choices_.columns.requests.end(),
                                        [&](const ColumnRequest& r) { return r.role == column.role; });
      ColumnRequest wanted = request != choices_.columns.requests.end()
                                 ? *request
                                 : ColumnRequest{column.role, spelt(shape_, column.index), false, 0, {}};
      wanted.is_negated = wanted.is_negated != is_turned;
      parts.push_back(spelt(wanted));
    }
    return with_columns(parts);
  }

  std::string with_columns(const std::vector<std::string>& parts) const {
    return choices_.columns.command + " --columns " + columns_word(fmt::format("{}", fmt::join(parts, ",")));
  }

  void check_saturation(double range) {
    const Recording& r = result_.recording;
    for (const double limit :
         {*std::max_element(r.force.begin(), r.force.end()), *std::min_element(r.force.begin(), r.force.end())}) {
      std::size_t first = 0, count = 0;
      for (std::size_t i = 0; i < r.force.size(); ++i) {
        if (r.force[i] != limit) {
          count = 0;
          continue;
        }
        if (count++ == 0) first = i;
        if (count < saturated_rows || std::abs(r.position[i] - r.position[first]) < saturated_travel * range) continue;
        if (limit == 0) break;
        diagnostics_.report<DiagnosticCode::recording_saturated>(line_of_row(first), limit, count);
        diagnostics_.note<DiagnosticCode::recording_saturated_remedy>({});
        return;
      }
    }
  }

  // Takes for each time the force that was recorded `force_delay` later.
  void move_force() {
    Recording& r = recording();
    std::vector<double> moved(r.force.size());
    std::size_t j = 0;
    for (std::size_t i = 0; i < r.time.size(); ++i) {
      const double wanted = std::clamp(r.time[i] + choices_.force_delay, r.time.front(), r.time.back());
      while (j + 2 < r.time.size() && r.time[j + 1] < wanted) ++j;
      while (j > 0 && r.time[j] > wanted) --j;
      const double share = (wanted - r.time[j]) / (r.time[j + 1] - r.time[j]);
      moved[i] = r.force[j] + share * (r.force[j + 1] - r.force[j]);
    }
    r.force = std::move(moved);
  }

  // Makes positions count from rest. A tool that is on its way from 0 at the first row was at rest there, a moment
  // before.
  void begin_at_rest() {
    Recording& r = recording();
    if (!is_motion() || choices_.keeps_positions) return;
    const auto [low, high] = std::minmax_element(r.position.begin(), r.position.end());
    const double first = r.position[0], step = r.position[1] - first;
    const bool is_moving = std::abs(step) > 1e-3 * (*high - *low);
    const bool comes_from_zero = first != 0 && first * step > 0 && std::abs(first) <= 3 * std::abs(step);
    // A tool that was at rest before its first row would have been at zero position and force.
    const auto [least, most] = std::minmax_element(r.force.begin(), r.force.end());
    const bool is_elsewhere = std::abs(first) > 0.05 * (*high - *low) || std::abs(r.force[0]) > 0.1 * (*most - *least);
    result_.begins_in_motion = is_moving && !comes_from_zero && is_elsewhere;
    if (choices_.start == Start::moving) {
      result_.begins_in_motion = true;
      return set_origin(first);
    }
    const bool is_asked = choices_.start == Start::zero && first != 0;
    if (is_asked || (choices_.start == Start::automatic && is_moving && comes_from_zero)) return put_rest_before();
    if (choices_.start != Start::zero) set_origin(first);
  }

  void set_origin(double origin) {
    recording().origin = origin;
    for (double& position : recording().position) position -= origin;
  }

  void put_rest_before() {
    Recording& r = recording();
    const double period = r.time[1] - r.time[0];
    const double speed = std::abs(r.position[1] - r.position[0]) / period;
    const double before = speed > 0 ? std::min(std::abs(r.position[0]) / speed, period) : period;
    const bool begins_at_zero = r.time[0] > 0 && r.time[0] <= 3 * period;
    r.time.insert(r.time.begin(), begins_at_zero ? 0 : r.time[0] - before);
    r.position.insert(r.position.begin(), 0.0);
    r.force.insert(r.force.begin(), 0.0);
    if (!r.deviation.empty()) r.deviation.insert(r.deviation.begin(), 1.0);
    r.assumed_rows = 1;
    result_.has_assumed_start = true;
  }

  LineReader& lines_;
  const ReadChoices& choices_;
  Diagnostics& diagnostics_;
  std::vector<HeadLine> head_;
  TableShape shape_;
  std::vector<ChosenColumn> columns_;
  std::vector<Place> places_;
  ReadRecording result_;
  Row last_{};
  std::size_t reported_ = 0, first_number_ = 0, last_number_ = 0;
  bool has_gaps_ = false;
};

}  // namespace

std::optional<ReadRecording> read_recording(LineReader& lines, const ReadChoices& choices, Diagnostics& diagnostics) {
  return RecordingReader(lines, choices, diagnostics).run();
}

}  // namespace dashpot::compiler::fitting
