#include "fit/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "fit/column_choice.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler::fitting {
namespace {

struct KindRule {
  const char* word;
  std::vector<std::pair<const char*, Dimension>> required;
  bool has_poisson;
};

const std::vector<KindRule>& kinds() {
  static const Dimension area = power(dimensions::length, 2);
  static const std::vector<KindRule> list = {
      {"column", {{"area", area}, {"length", dimensions::length}}, false},
      {"shear", {{"area", area}, {"thickness", dimensions::length}}, false},
      {"punch", {{"radius", dimensions::length}}, true},
      {"sphere", {{"radius", dimensions::length}, {"depth", dimensions::length}}, true},
      {"needle",
       {{"radius", dimensions::length}, {"length", dimensions::length}, {"outer", dimensions::length}},
       true}};
  return list;
}

using Values = std::map<std::string, double>;

// Of a flat punch of that radius.
double punch_factor(double radius, const Values& values) {
  const auto poisson = values.find("poisson");
  if (poisson == values.end()) return 8 * radius;
  return 2 * radius / (1 - poisson->second * poisson->second);
}

const char* modulus_word(const Values& values) {
  return values.count("poisson") > 0 ? "Young's modulus" : "the shear modulus of an incompressible material";
}

Geometry bar(double area, double length, const char* formula) {
  Geometry geometry;
  geometry.stiffness_per_modulus = area / length;
  geometry.length = length;
  geometry.area = area;
  geometry.sentence =
      fmt::format("{}: force = stress times {:.6g} m^2, displacement = strain times {:.6g} m", formula, area, length);
  return geometry;
}

Geometry indenter(double factor, double length, const std::string& what, const Values& values) {
  Geometry geometry;
  geometry.stiffness_per_modulus = factor;
  geometry.length = length;
  geometry.area = factor * length;
  geometry.sentence =
      fmt::format("{}, moduli read as {}: stiffness = modulus times {:.6g} m", what, modulus_word(values), factor);
  return geometry;
}

Geometry geometry_of(const std::string& kind, const Values& v) {
  if (kind == "column") return bar(v.at("area"), v.at("length"), "a column, f = E A u/L");
  if (kind == "shear") return bar(v.at("area"), v.at("thickness"), "a pad in shear, f = G A u/t");
  if (kind == "punch")
    return indenter(punch_factor(v.at("radius"), v), v.at("radius"),
                    fmt::format("at a flat punch of radius {:.6g} m", v.at("radius")), v);
  if (kind == "sphere") {
    const double contact = std::sqrt(v.at("radius") * v.at("depth"));
    return indenter(
        punch_factor(contact, v), v.at("depth"),
        fmt::format("at a sphere of radius {:.6g} m, tangent at depth {:.6g} m", v.at("radius"), v.at("depth")), v);
  }
  const auto poisson = v.find("poisson");
  const double shear = poisson == v.end() ? 1 : 1 / (2 * (1 + poisson->second));
  const double factor = 2 * std::numbers::pi * v.at("length") * shear / std::log(v.at("outer") / v.at("radius"));
  return indenter(factor, v.at("radius"), fmt::format("along a needle of radius {:.6g} m", v.at("radius")), v);
}

bool is_sound(const std::string& kind, const Values& values) {
  for (const auto& [key, value] : values)
    if (key == "poisson" ? !(value > -1 && value <= 0.5) : !(value > 0)) return false;
  return kind != "needle" || values.at("outer") > values.at("radius");
}

std::optional<Values> values_in(const KindRule& kind, const std::string& words) {
  Values values;
  std::size_t begin = 0;
  while (begin < words.size()) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const std::string part = words.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    if (equals == std::string::npos) return std::nullopt;
    const std::optional<SpokenQuantity> value = spoken_quantity(part.substr(equals + 1));
    std::optional<Dimension> due;
    for (const auto& [name, dimension] : kind.required)
      if (name == key) due = dimension;
    if (kind.has_poisson && key == "poisson") due = dimensions::number;
    if (!value || !due || !(value->dimension == *due) || !values.emplace(key, value->value).second) return std::nullopt;
  }
  for (const auto& [name, dimension] : kind.required)
    if (values.count(name) == 0) return std::nullopt;
  return values;
}

}  // namespace

std::optional<Geometry> parse_geometry(const std::string& words, Diagnostics& diagnostics) {
  const std::size_t colon = words.find(':');
  const std::string word = words.substr(0, colon);
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&](const KindRule& k) { return k.word == word; });
  std::optional<Values> values;
  if (kind != kinds().end() && colon != std::string::npos) values = values_in(*kind, words.substr(colon + 1));
  if (!values || !is_sound(word, *values)) {
    diagnostics.report<DiagnosticCode::geometry_malformed>({}, excerpt(words));
    diagnostics.note<DiagnosticCode::geometry_known>({});
    return std::nullopt;
  }
  Geometry geometry = geometry_of(word, *values);
  geometry.words = words;
  return geometry;
}

}  // namespace dashpot::compiler::fitting
