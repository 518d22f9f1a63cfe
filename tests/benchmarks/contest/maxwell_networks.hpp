// Generalised Maxwell networks of the contest, in the paper's Fig. 4b realisation at 1 kHz, and their normalised
// constants.
//
// (17) x_k = (B v + (B/h) x_{k−1})/(K + B/h) and (19) m = K0 u − Σ B (x_k − x_{k−1})/h become, with F = (B/h)(1 − a) x,
//     a = 1/(1 + K h/B),    m = K0 u + (−Σ B a) v + Σ F,    F ← a F + g v,    g = B a (1 − a)
// so that a hidden state costs one multiplication and one fused one, and the command does not wait for them.
#pragma once

namespace dashpot::contest {

constexpr double period = 0.001;  // h [s]

// Fig. 5.
struct fig_5 {
  static constexpr int size = 2;
  static constexpr double static_stiffness = 5;                          // K3 [N/m]
  static constexpr double stiffness(int i) { return i == 0 ? 12 : 10; }  // K1, K2 [N/m]
  static constexpr double damping(int i) { return i == 0 ? 5 : 6; }      // B1, B2 [N·s/m]
};

// `Size` branches with relaxation times from a hundredth of a second upwards.
template <int Size>
struct many_branches {
  static constexpr int size = Size;
  static constexpr double static_stiffness = 5;                       // [N/m]
  static constexpr double stiffness(int) { return 12; }               // [N/m]
  static constexpr double damping(int i) { return 0.125 * (i + 1); }  // [N·s/m]
};

template <class Network>
struct normalised {
  alignas(64) double decay[Network::size] = {};  // a [1]
  alignas(64) double drive[Network::size] = {};  // g [N·s/m]
  double velocity_gain = 0;                      // −Σ B a [N·s/m]
  double brake = 0;                              // Σ B [N·s/m]

  constexpr normalised() {
    for (int i = 0; i < Network::size; ++i) {
      const double damping = Network::damping(i);
      // 1 − a = (K h/B)/(1 + K h/B) without cancellation
      const double relaxed = Network::stiffness(i) * period / damping;
      decay[i] = 1 / (1 + relaxed);
      drive[i] = damping * decay[i] * (relaxed / (1 + relaxed));
      velocity_gain -= damping * decay[i];
      brake += damping;
    }
  }
};

template <class Network>
inline constexpr normalised<Network> constants_of{};

}  // namespace dashpot::contest
