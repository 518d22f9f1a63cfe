#include "network/axes_network.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "network/name_rules.hpp"
#include "network/read_pair.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

const std::vector<std::string> map_kinds = {"along", "ball", "cavity", "wall", "line", "grid"};

// Reads the object of a map; a key that is missing is reported.
class MapReader {
 public:
  MapReader(const std::string& kind, const JsonValue& object, const std::vector<std::string>& keys,
            Diagnostics& diagnostics)
      : reader_(object, "'" + kind + "'", diagnostics), diagnostics_(diagnostics) {
    reader_.refuse_other_keys(keys);
  }

  std::optional<axes::Pair<double>> point(const char* key) const {
    const JsonMember* member = reader_.require(key);
    return member ? read_pair(key, member->value, dimensions::length, diagnostics_) : std::nullopt;
  }
  std::optional<axes::Pair<double>> direction(const char* key) const {
    const JsonMember* member = reader_.require(key);
    return member ? read_direction(key, member->value, diagnostics_) : std::nullopt;
  }
  const JsonValue* value(const char* key) const {
    const JsonMember* member = reader_.require(key);
    return member ? &member->value : nullptr;
  }
  std::optional<double> radius() const {
    const JsonMember* member = reader_.require("radius");
    if (member == nullptr) return std::nullopt;
    const std::optional<double> radius = read_single("radius", member->value, dimensions::length, diagnostics_);
    if (!radius || *radius > 0) return radius;
    diagnostics_.report<DiagnosticCode::not_above_zero>(member->value.span, "'radius'", fmt::format("{} m", *radius));
    return std::nullopt;
  }

 private:
  ObjectReader reader_;
  Diagnostics& diagnostics_;
};

std::optional<axes::PortMap> read_circle(const JsonMember& kind, Diagnostics& diagnostics) {
  const MapReader reader(kind.key, kind.value, {"centre", "radius"}, diagnostics);
  const auto centre = reader.point("centre");
  const auto radius = reader.radius();
  if (!centre || !radius) return std::nullopt;
  return kind.key == "ball" ? axes::ball(*centre, *radius) : axes::cavity(*centre, *radius);
}

std::optional<axes::PortMap> read_wall(const JsonMember& kind, Diagnostics& diagnostics) {
  const MapReader reader(kind.key, kind.value, {"through", "normal"}, diagnostics);
  const auto through = reader.point("through");
  const auto normal = reader.direction("normal");
  if (!through || !normal) return std::nullopt;
  return axes::wall(*through, *normal);
}

std::optional<axes::PortMap> read_line(const JsonMember& kind, Diagnostics& diagnostics) {
  const MapReader reader(kind.key, kind.value, {"through", "direction", "radius"}, diagnostics);
  const auto through = reader.point("through");
  const auto direction = reader.direction("direction");
  const auto radius = reader.radius();
  if (!through || !direction || !radius) return std::nullopt;
  return axes::line(*through, *direction, *radius);
}

// A list of lengths, or of numbers in metres.
std::optional<std::vector<double>> read_lengths(const std::string& key, const JsonValue& value,
                                                Diagnostics& diagnostics) {
  if (value.kind != JsonValue::Kind::array) {
    report_wrong_type(key, value, "a list", diagnostics);
    return std::nullopt;
  }
  std::vector<double> lengths;
  for (const JsonValue& item : value.items) {
    const std::optional<double> one = read_single(key, item, dimensions::length, diagnostics);
    if (!one) return std::nullopt;
    lengths.push_back(*one);
  }
  return lengths;
}

constexpr std::size_t most_knots_a_side = 64, most_knots = 1600;
constexpr double least_step = 1e-9;  // between knots [m]

// The step between the knots along one axis; reports knots that do not rise by equal steps. They are written in
// decimals, so a millionth of a step is allowed.
std::optional<double> step_of(const std::string& key, const JsonValue& value, const std::vector<double>& knots,
                              Diagnostics& diagnostics) {
  const double step = (knots.back() - knots.front()) / double(knots.size() - 1);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double due = knots.front() + double(i) * step;
    if (step >= least_step && std::isfinite(step) && std::abs(knots[i] - due) <= 1e-6 * step) continue;
    diagnostics.report<DiagnosticCode::grid_spacing>(
        value.items[i].span, key, knots[i - 1], knots[i],
        step >= least_step ? due : knots.front() + double(i) * std::max(std::abs(step), least_step));
    return std::nullopt;
  }
  return step;
}

// Uniform knots, and what is written for each.
struct KnotValues {
  axes::Pair<double> start, spacing;     // [m]
  std::array<std::size_t, 2> knots;      // in x and in y
  std::vector<const JsonValue*> values;  // rows of equal y, from below
};

// Reads an object of x, y and rows of values under the key `what`; `whats` is its plural, for messages.
std::optional<KnotValues> read_grid_of(const std::string& key, const JsonValue& value, const char* what,
                                       const char* whats, Diagnostics& diagnostics) {
  const MapReader reader(key, value, {"x", "y", what}, diagnostics);
  const JsonValue *const x = reader.value("x"), *const y = reader.value("y"), *const rows = reader.value(what);
  if (x == nullptr || y == nullptr || rows == nullptr) return std::nullopt;
  const auto columns_at = read_lengths("x", *x, diagnostics), rows_at = read_lengths("y", *y, diagnostics);
  if (!columns_at || !rows_at) return std::nullopt;
  const std::size_t columns = columns_at->size(), height = rows_at->size();
  if (std::min(columns, height) < 2 || std::max(columns, height) > most_knots_a_side || columns * height > most_knots) {
    diagnostics.report<DiagnosticCode::grid_size>(value.span, columns, height, most_knots_a_side, most_knots);
    return std::nullopt;
  }
  if (rows->kind != JsonValue::Kind::array || rows->items.size() != height) {
    diagnostics.report<DiagnosticCode::grid_rows>(
        rows->span, what, rows->kind == JsonValue::Kind::array ? fmt::format("{} rows", rows->items.size()) : "no rows",
        height, columns, whats);
    return std::nullopt;
  }
  KnotValues grid{{columns_at->front(), rows_at->front()}, {0, 0}, {columns, height}, {}};
  for (const JsonValue& row : rows->items) {
    if (row.kind != JsonValue::Kind::array) {
      report_wrong_type(what, row, "a list", diagnostics);
      return std::nullopt;
    }
    if (row.items.size() != columns) {
      diagnostics.report<DiagnosticCode::grid_rows>(
          row.span, what, fmt::format("a row of {} {}", row.items.size(), whats), height, columns, whats);
      return std::nullopt;
    }
    for (const JsonValue& item : row.items) grid.values.push_back(&item);
  }
  const auto across = step_of("x", *x, *columns_at, diagnostics), up = step_of("y", *y, *rows_at, diagnostics);
  if (!across || !up) return std::nullopt;
  grid.spacing = {*across, *up};
  return grid;
}

std::optional<axes::PortMap> read_grid(const JsonMember& kind, Diagnostics& diagnostics) {
  const auto grid = read_grid_of(kind.key, kind.value, "values", "numbers", diagnostics);
  if (!grid) return std::nullopt;
  std::vector<std::vector<double>> values(grid->knots[1]);
  for (std::size_t i = 0; i < grid->values.size(); ++i) {
    const auto one = read_single("values", *grid->values[i], dimensions::length, diagnostics);
    if (!one) return std::nullopt;
    values[i / grid->knots[0]].push_back(*one);
  }
  return axes::grid_map(grid->start, grid->spacing, values);
}

std::optional<axes::PortMap> read_map(const JsonMember& kind, Diagnostics& diagnostics) {
  if (kind.key == "along") {
    const auto direction = read_direction(kind.key, kind.value, diagnostics);
    return direction ? std::optional<axes::PortMap>(axes::along(*direction)) : std::nullopt;
  }
  if (kind.value.kind != JsonValue::Kind::object) {
    report_wrong_type(kind.key, kind.value, "an object", diagnostics);
    return std::nullopt;
  }
  if (kind.key == "wall") return read_wall(kind, diagnostics);
  if (kind.key == "grid") return read_grid(kind, diagnostics);
  return kind.key == "line" ? read_line(kind, diagnostics) : read_circle(kind, diagnostics);
}

std::optional<Port> build_port(const PortDecl& decl, const std::optional<Range>& device_band,
                               Diagnostics& diagnostics) {
  ObjectReader reader(decl.map, "'map'", diagnostics);
  reader.refuse_other_keys(map_kinds);
  const JsonMember* kind =
      reader.one_of<DiagnosticCode::map_without_kind>(map_kinds, "map", fmt::format("{}", fmt::join(map_kinds, ", ")));
  const std::optional<axes::PortMap> map = kind ? read_map(*kind, diagnostics) : std::nullopt;
  std::optional<Network> network = build_network(decl.network, diagnostics, device_band);
  if (network)
    for (const Parameter& parameter : network->parameters)
      if (parameter.tunable) diagnostics.report<DiagnosticCode::tunable_with_ports>(parameter.span, parameter.name);
  if (!map || !network) return std::nullopt;
  return Port{decl.name.text, kind->key, *map, std::move(*network), decl.map.span};
}

// [[a, b], [c, d]].
std::optional<axes::Matrix<double>> read_matrix(const char* key, const JsonValue& value, const Dimension& due,
                                                const char* example, Diagnostics& diagnostics) {
  if (value.kind != JsonValue::Kind::array || value.items.size() != 2) {
    diagnostics.report<DiagnosticCode::not_a_list_of>(value.span, key, "two rows", example);
    return std::nullopt;
  }
  const auto first = read_pair(key, value.items[0], due, diagnostics);
  const auto second = read_pair(key, value.items[1], due, diagnostics);
  if (!first || !second) return std::nullopt;
  return axes::Matrix<double>{*first, *second};
}

// Empty, with an error, for a matrix that feeds power to the tool.
std::optional<axes::Matrix<double>> read_viscous(const JsonValue& value, Diagnostics& diagnostics) {
  const std::optional<axes::Matrix<double>> matrix =
      read_matrix("viscous", value, dimensions::damping, "[[\"5 N s/m\", 0], [0, \"5 N s/m\"]]", diagnostics);
  if (!matrix) return std::nullopt;
  if (const auto power = axes::driving(*matrix)) {
    diagnostics.report<DiagnosticCode::field_not_passive>(value.span, power->power, power->direction[0],
                                                          power->direction[1]);
    return std::nullopt;
  }
  return matrix;
}

std::optional<axes::ViscousField> read_field_grid(const JsonValue& value, Diagnostics& diagnostics) {
  const auto frame = read_grid_of("grid", value, "viscous", "matrices", diagnostics);
  if (!frame) return std::nullopt;
  axes::ViscousField field{frame->start, frame->spacing, frame->knots, {}};
  for (const JsonValue* knot : frame->values) {
    const std::optional<axes::Matrix<double>> there = read_viscous(*knot, diagnostics);
    if (!there) return std::nullopt;
    field.at_knot.push_back(*there);
  }
  return field;
}

void read_field(const AxesNetworkDecl& decl, AxesNetwork& network, Diagnostics& diagnostics) {
  if (decl.viscous)
    if (const auto matrix = read_viscous(*decl.viscous, diagnostics)) network.field.at_knot = {*matrix};
  if (!decl.field_grid) return;
  if (auto field = read_field_grid(*decl.field_grid, diagnostics)) network.field = std::move(*field);
}

// A force that depends on position is no viscous field, and with a curl it would drive the tool round.
void refuse_stiffness(const JsonValue& value, Diagnostics& diagnostics) {
  const std::optional<axes::Matrix<double>> matrix =
      read_matrix("stiffness", value, dimensions::stiffness, "[[\"500 N/m\", 0], [0, \"500 N/m\"]]", diagnostics);
  if (!matrix) return;
  constexpr double area = 3.14159265358979323846 * 10e-3 * 10e-3;  // of the circle that the message names [m²]
  if (const std::optional<double> curl = axes::curl_in_position(*matrix))
    diagnostics.report<DiagnosticCode::field_curl>(value.span, std::abs(*curl), std::abs(*curl) * area);
  else diagnostics.report<DiagnosticCode::field_of_position>(value.span);
}

void check_names(const AxesNetworkDecl& decl, Diagnostics& diagnostics) {
  UniqueNames names;
  if (decl.name && check_name(*decl.name, "network", diagnostics)) names.add(*decl.name, diagnostics);
  for (const PortDecl& port : decl.ports) names.add(port.name, diagnostics);
}

}  // namespace

std::optional<AxesNetwork> build_axes_network(const AxesNetworkDecl& decl, Diagnostics& diagnostics,
                                              const std::optional<Range>& device_band) {
  const std::size_t errors_before = diagnostics.error_count();
  const auto text_of = [](const std::optional<Text>& text) { return text ? text->text : std::string(); };
  AxesNetwork network{text_of(decl.name), text_of(decl.title), text_of(decl.source), {}, {}, {}, decl.digest, {}};
  network.name_span = decl.name ? decl.name->span : Span{};
  for (const CommentDecl& comment : decl.comments) network.comments.push_back({comment.about, comment.text});
  check_names(decl, diagnostics);
  for (const PortDecl& port : decl.ports) {
    if (std::optional<Port> built = build_port(port, device_band, diagnostics))
      network.ports.push_back(std::move(*built));
    // All ports share the parameters: what is wrong with them is reported once.
    else if (!port.network.parameters.empty()) break;
  }
  read_field(decl, network, diagnostics);
  if (decl.stiffness) refuse_stiffness(*decl.stiffness, diagnostics);
  if (!decl.complete || diagnostics.error_count() > errors_before) return std::nullopt;
  return network;
}

std::string to_text(const AxesNetwork& network) {
  std::string text = fmt::format("network {}, two axes\n", network.name);
  for (const Port& port : network.ports)
    text += fmt::format("port {} behind the map '{}'\n", port.name, port.map_kind) + to_text(port.network);
  if (network.has_field()) text += to_text(network.field) + '\n';
  return text;
}

std::string to_text(const axes::ViscousField& field) {
  if (!field.is_uniform())
    return fmt::format("viscous field over a grid of {} x {} knots", field.knots[0], field.knots[1]);
  const axes::Matrix<double>& a = field.at_knot.front();
  return fmt::format("viscous field [[{}, {}], [{}, {}]] N s/m", a[0][0], a[0][1], a[1][0], a[1][1]);
}

}  // namespace dashpot::compiler
