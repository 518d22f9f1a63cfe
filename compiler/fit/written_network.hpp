// A fitted model as the network file that a person would have written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/uncertainty.hpp"
#include "network/network.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler::fitting {

// One spring, damper, slip or springpot of the file.
struct FittedElement {
  std::string name;  // "K1"
  ElementKind kind;  // of a springpot: spring, since its value is a stiffness
  ElementQuantity quantity;
  double value;                          // as it stands in the file [N/m], [N·s/m] or [N]
  std::string text;                      // "5.722 kN/m"
  std::optional<Interval> interval;      // 95 %
  std::optional<Interval> spread;        // over the bootstrap, where intervals cannot be told
  std::optional<Interval> left_out;      // over fits that leave a file out
  std::optional<std::string> springpot;  // its other keys, as they are written
};

// A number of the static curve.
struct FittedCurveValue {
  std::string name;  // "power", "rate", "force", "force at 3 mm"
  CurveQuantity quantity;
  double value;      // as it stands in the file [1], [1/m] or [N]
  std::string text;  // "2.3", "612 1/m", "5.722 N"
  std::optional<Interval> interval, spread, left_out;
};

// Empty for a model without a curve.
std::vector<FittedCurveValue> curve_values_of(const Model& model, motion port_motion);
std::string unit_of(const CurveQuantity& quantity, const PortUnits& units);

// As digits of elements. In: the stiffness of the network as it was written, behind which the curve is to be the
// model's.
void round_values(std::vector<FittedCurveValue>& values, const Model& model, double stiffness, motion port_motion,
                  int extra);

// What stands under "static".
std::string static_text(const std::vector<FittedCurveValue>& values, const Model& model, motion port_motion);

const char* word_of(ElementKind kind);  // "spring", "damper", "slip"
std::string unit_of(ElementKind kind, const PortUnits& units);

// Names, kinds and quantities of a model's elements: K0, B0, then K1, B1, …; Y1 with its spring S1 and damper D1; P1
// for a springpot, to hold within 0.1 % over the recordings' own frequencies, and twice as far on either side.
std::vector<FittedElement> elements_of(const Problem& problem, const Model& model);

// Rounds each value to as many digits as its interval allows: the rounding stays below a tenth of it; four or more.
// `extra` digits are added to each.
void round_values(std::vector<FittedElement>& elements, const Model& model, motion port_motion, int extra);

// The tree under "network", indented as in the project's own files.
std::string tree_text(const std::vector<FittedElement>& elements, Form form);

// A number with its unit, so many significant digits, a prefix of the unit where one serves.
std::string quantity_text(double value, const std::string& unit, int digits);

// Both ends with their unit, in as many digits as tell how wide it is, four or more, and rounded outwards: what lies in
// the interval lies between them. Without a unit bare numbers; one such as "1/m" takes no prefix.
std::pair<std::string, std::string> interval_ends(const Interval& interval, const std::string& unit);
std::string interval_text(const Interval& interval, const std::string& unit);  // "1.2 N … 1.3 N"

// A bound of that many digits on the side of `direction` of a value, or the value itself.
double outwards(double value, double direction, int digits);

// In: a network as it was written and read back; the names are those of `elements_of`. Out: its terms with their
// weights, behind its curve, so that what is told of the file is told of what stands in it.
Model model_of(const Network& network, Form form);

}  // namespace dashpot::compiler::fitting
