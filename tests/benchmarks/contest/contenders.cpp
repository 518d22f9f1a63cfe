#include "contender.hpp"

#include "branches_512.hpp"
#include "branches_64.hpp"
#include "branches_8.hpp"
#include "eigen_laws.hpp"
#include "element_list.hpp"
#include "faust_laws.hpp"
#include "fig_5.hpp"
#include "hand_written.hpp"
#include "needle.hpp"
#include "printed_laws.hpp"
#include "two_kelvins.hpp"
#include "two_kelvins_tunable.hpp"

namespace dashpot::contest {
namespace {

// How many doubles a vector of the target holds.
#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX2__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif

#ifdef DASHPOT_FAUST
template <class Network>
double brake_of() {
  return constants_of<Network>.brake;
}
template <>
double brake_of<two_kelvins>() {
  return two_kelvins::damping[0];
}
template <>
double brake_of<needle>() {
  return needle::damping[0];
}

template <class Process, class Network>
struct faust_of : faust_law<Process> {
  faust_of() : faust_law<Process>(brake_of<Network>()) {}
};

template <class Process, class Blocks, class Network>
void add_faust(std::vector<contender>& all, const std::string& network) {
  all.push_back(fused<faust_of<Blocks, Network>>(network, "Faust"));
  all.push_back(fused<faust_of<Process, Network>>(network, "Faust, one sample"));
}
#define ADD_FAUST(name, network_type) add_faust<faust_##name, faust_blocks_##name, network_type>(all, network)
#else
#define ADD_FAUST(name, network_type) static_cast<void>(0)
#endif

template <class Law>
void add_ours(std::vector<contender>& all, const std::string& network) {
  all.push_back(fused<Law>(network, "dashpot, fused"));
  all.push_back(split<Law>(network, "dashpot, split"));
}

// All parameters are taken, and all coefficients computed from them, behind each sample.
template <class Law>
class set_each_sample {
 public:
  command<double> step(double position, double velocity) noexcept {
    const command<double> told = law_.step(position, velocity);
    law_.set(values_);
    return told;
  }

 private:
  Law law_;
  typename Law::parameters values_;
};

template <class Network>
void add_maxwell(std::vector<contender>& all, const std::string& network) {
  all.push_back(fused<printed_maxwell<Network>>(network, "as printed"));
  all.push_back(split <
                hand_maxwell<Network, Network::size<lanes ? Network::size : lanes>>(network, "by hand, vectors"));
  all.push_back(fused<eigen_fixed<Network>>(network, "Eigen, fixed arrays"));
  all.push_back(fused<eigen_dynamic<Network>>(network, "Eigen, dynamic state space"));
  all.push_back(fused<element_list<Network>>(network, "virtual element list"));
}

void add_fig_5(std::vector<contender>& all, const std::string& network) {
  add_maxwell<fig_5>(all, network);
  all.push_back(fused<hand_fig_5>(network, "by hand, one pair"));
  all.push_back(fused<hand_fig_5_scalar>(network, "by hand, scalar"));
  ADD_FAUST(fig_5, fig_5);
  add_ours<generated::fig_5>(all, network);
}

void add_kelvin(std::vector<contender>& all, const std::string& network) {
  all.push_back(fused<printed_kelvin>(network, "as printed"));
  all.push_back(fused<hand_kelvin>(network, "by hand, displacement"));
  all.push_back(fused<hand_kelvin_forces>(network, "by hand, force"));
  all.push_back(fused<eigen_fixed_kelvin>(network, "Eigen, fixed state space"));
  all.push_back(fused<eigen_dynamic<two_kelvins>>(network, "Eigen, dynamic state space"));
  all.push_back(fused<element_list<two_kelvins>>(network, "virtual element list"));
  ADD_FAUST(two_kelvins, two_kelvins);
  add_ours<generated::two_kelvins>(all, network);
  all.push_back(fused<generated::two_kelvins_tunable>(network, "dashpot, tunable"));
  all.push_back(fused<set_each_sample<generated::two_kelvins_tunable>>(network, "dashpot, set each sample"));
}

// No matrix describes a slip, so Eigen has no part in it.
void add_needle(std::vector<contender>& all, const std::string& network) {
  all.push_back(fused<printed_needle>(network, "as printed"));
  all.push_back(fused<hand_needle>(network, "by hand, both bounds"));
  all.push_back(fused<hand_needle_branches>(network, "by hand, branches"));
  all.push_back(fused<element_list<needle>>(network, "virtual element list"));
  ADD_FAUST(needle, needle);
  add_ours<generated::needle>(all, network);
}

void add_branches(std::vector<contender>& all) {
  std::string network = "maxwell_8";
  add_maxwell<many_branches<8>>(all, network);
  ADD_FAUST(branches_8, many_branches<8>);
  add_ours<generated::branches_8>(all, network);
  network = "maxwell_64";
  add_maxwell<many_branches<64>>(all, network);
  ADD_FAUST(branches_64, many_branches<64>);
  add_ours<generated::branches_64>(all, network);
  network = "maxwell_512";
  add_maxwell<many_branches<512>>(all, network);
  ADD_FAUST(branches_512, many_branches<512>);
  add_ours<generated::branches_512>(all, network);
}

struct hand_through {
  command<double> step(double position, double velocity) noexcept { return {velocity, position}; }
};

}  // namespace

contender nothing() { return fused<hand_through>("nothing", "nothing"); }

std::vector<contender> all_contenders() {
  std::vector<contender> all;
  add_fig_5(all, "fig_5");
  add_kelvin(all, "kelvin_11");
  for (const char* network : {"fig_10_stuck", "fig_10_sliding", "fig_10_switching"}) add_needle(all, network);
  add_branches(all);
  return all;
}

}  // namespace dashpot::contest
