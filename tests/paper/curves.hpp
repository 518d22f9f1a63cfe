// From a run to what is drawn of it.
#pragma once

#include "experiment.hpp"
#include "figure.hpp"

namespace dashpot::paper {

template <class Value>
Curve curve_of(const std::string& name, const Style& style, const Trace& trace, Value value,
               Maker maker = Maker::emitted) {
  Curve curve{name, style, {}, {}, maker};
  for (const Sample& sample : trace) {
    curve.x.push_back(sample.time);
    curve.y.push_back(value(sample));
  }
  return curve;
}

// `values` beside the times of the trace.
inline Curve curve_of(const std::string& name, const Style& style, const Trace& trace,
                      const std::vector<double>& values, Maker maker = Maker::emitted) {
  Curve curve{name, style, {}, values, maker};
  for (const Sample& sample : trace) curve.x.push_back(sample.time);
  return curve;
}

}  // namespace dashpot::paper
