// The laws that run on the host and on the micro-controllers, in the number type of the build.
#pragma once

#include "branches_512.hpp"
#include "branches_64.hpp"
#include "branches_8.hpp"
#include "fig_5.hpp"
#include "fig_5_exact.hpp"
#include "needle.hpp"
#include "two_kelvins.hpp"

namespace dashpot::micro {

// Calls `visit(name, law)` with a fresh object of each.
template <class Visit>
void for_each_law(Visit&& visit) {
  visit("fig_5", generated::fig_5());
  visit("fig_5_exact", generated::fig_5_exact());
  visit("kelvin_11", generated::two_kelvins());
  visit("fig_10", generated::needle());
  visit("maxwell_8", generated::branches_8());
  visit("maxwell_64", generated::branches_64());
  visit("maxwell_512", generated::branches_512());
}

}  // namespace dashpot::micro
