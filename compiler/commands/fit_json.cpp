#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/fit_output.hpp"
#include "fit/network_text.hpp"

namespace dashpot::compiler {
namespace {

using namespace fitting;
using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json interval_json(const std::optional<Interval>& interval) {
  return interval ? Json{number(interval->low), number(interval->high)} : Json(nullptr);
}

const char* word_of(TermKind kind) {
  switch (kind) {
    case TermKind::spring: return "spring";
    case TermKind::damper: return "damper";
    case TermKind::maxwell: return "relaxation";
    case TermKind::stop: return "slip";
    case TermKind::sliding: return "slip beside damper";
    case TermKind::springpot: return "springpot";
    case TermKind::offset: return "offset";
    case TermKind::initial: return "initial force";
  }
  return "";
}

Json score_json(const FileScore& score) {
  return {{"file", score.name},
          {"digest", score.digest},
          {"rows", score.rows},
          {"free_rows", score.free_rows},
          {"free_rms", score.free_rows > 0 ? number(score.free_rms) : Json(nullptr)},
          {"rms", number(score.rms)},
          {"range", number(score.range)},
          {"r_squared", number(score.r_squared)},
          {"largest_error", number(score.largest_error)},
          {"largest_error_time", number(score.largest_time)},
          {"largest_error_position", number(score.largest_position)},
          {"lag_one_correlation", number(score.lag_one)},
          {"effective_samples", number(score.effective_samples)},
          {"best_gain", number(score.best_gain)},
          {"gain", number(score.gain)},
          {"offset", number(score.offset)},
          {"left_out_rms", score.left_out_rms ? number(*score.left_out_rms) : Json(nullptr)}};
}

Json model_json(const Model& model) {
  Json terms = Json::array();
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    const Term& term = model.terms[j];
    Json one{{"kind", word_of(term.kind)}, {"weight", number(model.weights[static_cast<Eigen::Index>(j)])}};
    if (term.time > 0) one["time"] = number(term.time);
    if (term.threshold > 0) one["threshold"] = number(term.threshold);
    if (term.exponent > 0) one["exponent"] = number(term.exponent);
    terms.push_back(one);
  }
  return terms;
}

}  // namespace

std::string fit_json(const Fit& fit, const std::vector<Recording>& recordings) {
  const Problem problem(recordings, fit.choices.form, fit.choices.weighting, 2);
  Json json{{"name", fit.network_name},
            {"error_unit", error_unit(fit, problem) == "%" ? "1" : error_unit(fit, problem)},
            {"rms", number(fit.rms)},
            {"r_squared", number(fit.r_squared)},
            {"linear_floor", number(fit.floor_rms)},
            {"floor_cosine", number(fit.floor.largest_cosine)},
            {"noise", fit.noise ? number(*fit.noise) : Json(nullptr)},
            {"parameters", fit.parameters},
            {"effective_samples", number(fit.effective_samples)},
            {"criterion", number(fit.criterion)},
            {"condition", number(fit.condition)}};
  if (fit.choices.contact)
    json["contact"] = {{"at", number(*fit.choices.contact)}, {"found", fit.choices.contact_is_found}};
  if (fit.model.curve) {
    json["static"] = {{"kind", word_of(fit.model.curve->kind())},
                      {"is", curve_stiffness(fit.model).is_instantaneous ? "instantaneous" : "equilibrium"}};
    for (const FittedCurveValue& value : fit.curve_values)
      json["static"]["values"].push_back({{"name", value.name},
                                          {"value", number(value.value)},
                                          {"displacement", number(value.quantity.displacement)},
                                          {"interval", interval_json(value.interval)},
                                          {"bootstrap", interval_json(value.spread)},
                                          {"leaving_a_file_out", interval_json(value.left_out)}});
  }
  for (const ShapeTried& one : fit.shapes)
    json["shapes"].push_back({{"kind", one.kind ? Json(word_of(*one.kind)) : Json(nullptr)},
                              {"parameters", one.parameters},
                              {"rms", number(one.rms)},
                              {"criterion", number(one.criterion)}});
  json["elements"] = Json::array();
  for (const FittedElement& element : fit.elements)
    json["elements"].push_back({{"name", element.name},
                                {"kind", word_of(element.kind)},
                                {"value", number(element.value)},
                                {"interval", interval_json(element.interval)},
                                {"bootstrap", interval_json(element.spread)},
                                {"leaving_a_file_out", interval_json(element.left_out)}});
  json["terms"] = model_json(fit.model);
  json["files"] = Json::array();
  for (const FileScore& score : fit.files) json["files"].push_back(score_json(score));
  json["held_out"] = Json::array();
  for (const FileScore& score : fit.held_out) json["held_out"].push_back(score_json(score));
  json["sizes"] = Json::array();
  for (std::size_t i = 0; i < fit.path.size(); ++i) {
    const PathEntry& entry = fit.path[i];
    json["sizes"].push_back({{"relaxations", entry.model.count(TermKind::maxwell)},
                             {"slips", entry.model.slip_count()},
                             {"springpots", entry.model.count(TermKind::springpot)},
                             {"parameters", entry.parameters},
                             {"rms", number(entry.rms)},
                             {"criterion", number(entry.criterion)},
                             {"chosen", i == fit.chosen}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dashpot::compiler
