// Which element of Fig. 3's two Kelvin elements in series to observe (paper, 5.1): what every choice costs in passivity
// and in error while the estimate of the velocity grows late.
#pragma once

#include <string>
#include <vector>

#include "page.hpp"

namespace dashpot::paper {

struct KelvinPair {
  double K1, B1, K2, B2;  // [N/m], [N·s/m]

  double share(int element) const;  // of element 1 or 2 in the dissipation of slow motion, to a common factor: B/K²
};

// The paper's (10) and (11), with the observed element next to the tool, or a law of theory, section 4, for comparison.
struct Observer {
  std::string name;
  double brake;                            // b [N·s/m]
  std::vector<double> missing;             // per delay: damping without which it is active at some frequency [N·s/m]
  std::vector<double> missing_when_short;  // the same with a brake that makes 5 % less
  std::vector<double> error;               // per delay: largest |Z_felt − Z|/|Z| below 5 Hz [1]
  std::vector<double> slow_error;          // per delay: the same at the 0.5 Hz of Fig. 6 [1]
};

struct Fig3 {
  struct Case {
    std::string title;
    KelvinPair pair;
    std::vector<Observer> observers;  // element 1, element 2, all of Z_d(0), single motor
  };
  std::vector<double> delays;  // [s]
  std::vector<Case> cases;
  // Of random pairs, at 5 ms: how often the rule's observer is the better of the two.
  struct Poll {
    std::string rule;
    int pairs = 0, less_missing = 0, less_missing_when_short = 0, less_error = 0, less_slow_error = 0;

    double share(int Poll::*of) const { return double(this->*of) / pairs; }
  };
  std::vector<Poll> polls;  // larger share, larger damping, smaller damping
};

Fig3 measure_fig3();
const Fig3& measured_fig3();  // once a process
Section show(const Fig3& fig3);

}  // namespace dashpot::paper
