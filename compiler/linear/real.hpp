// The extended precision in which constants are derived before they are rounded once, for emission.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace dashpot::compiler {

// 50 decimal digits: relaxation times may span 12 decades, and static stiffness is left over from cancellation.
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

// Amounts below this share of the whole are rounding left over from cancellation.
inline const Real negligible_share{"1e-30"};

inline double to_double(const Real& value) { return value.convert_to<double>(); }

}  // namespace dashpot::compiler
