// Fig. 5 on the page of all figures, by the laws emitted at 5 Hz.
#pragma once

#include "page.hpp"
#include "response.hpp"

namespace dashpot::paper {

struct Fig5 {
  std::vector<ResponseSample> exact, euler;
};

Fig5 measure_fig5();
Section show(const Fig5& fig5);

}  // namespace dashpot::paper
