// What Eigen must know to work in extended precision. Boost's own traits of this version lack members that Eigen asks
// for.
#pragma once

#include <Eigen/Core>

#include "linear/real.hpp"

template <>
struct Eigen::NumTraits<dashpot::compiler::Real> : Eigen::GenericNumTraits<dashpot::compiler::Real> {
  using Real = dashpot::compiler::Real;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 40,
    MulCost = 60
  };
};
