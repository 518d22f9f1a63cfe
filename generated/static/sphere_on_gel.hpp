// A sphere of 20 mm on a gel that relaxes by a third
//
// source: Hertz: F = 4/3 E/(1 - nu^2) sqrt(R) d^(3/2) with E = 50 kPa, nu = 0.5, R = 10 mm is 2.7 N at 4.5 mm; the
//   relaxation is assumed
// valid: displacement -0.006 to 0.006 m, rate 0 to 0.1 m/s
// static curve: power 1.5, 2.68328 N at 0.0045 m, at rest; the network is stretched by w(u) instead of the
//   position u, and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0 <= w' <= 1.467; the
//   curve's force is off by at most 0.047 % of the largest, and w' by 14 % of its largest
// scheme: exact at 1000 Hz, double: a motion whose w is straight between two samples is answered exactly, except
//   in samples in which a slip or a contact changes
// brake: makes b = 0.4 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   damper_4 dissipates 100 % of the energy at low frequency, so that the brake makes its 40 N s/m; with the
//   contact no more than the feedthrough damping, so that the motor compensates nothing
// states: what the law remembers follows the measured position (position driven, as a network with a contact
//   always is)
// contact: at 0 m; brake and motor 0 while the tool is free
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: a static curve's steepness changes while the tool moves, and no device states how fast
//   that is
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 18 additions, 14 multiplications, 1 guard against subnormal numbers
// cost of update(): 1 addition, 2 multiplications, 1 guard against subnormal numbers; 6 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 6.7e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// d72af726f13eba3ecb7e05e5c31c1ac3059b6049548ef36e99c08b91a0d88792. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class sphere_on_gel {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  // The part of the brake's command that was added for passivity: it is felt in addition to the network.
  static constexpr scalar added_damping = 0.0;

  // What the servo loop compares with the device that it drives.
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "ideal";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "exact";
    static constexpr unsigned loop_delay = 0;  // [samples]
    static constexpr bool is_certified = false;
  };

  struct parameters {};

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    if (!dashpot::all_finite(position)) position = 0;
    // |x|
    const scalar distance = position > 0 ? position : centre - position;
    const scalar in_cells = dashpot::clamp_to(last_cell, distance * cells_per_length);
    const scalar cell = in_cells > 0 ? in_cells : centre;
    // d = |x| − x_i
    const scalar within = distance - cell_begins[static_cast<int>(cell)];
    // map_e d
    const scalar map_cubic = map_e[static_cast<int>(cell)] * within;
    // map_c + map_e d
    const scalar map_bend = map_c[static_cast<int>(cell)] + map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar mapped_size = map_a[static_cast<int>(cell)] + within * (map_b[static_cast<int>(cell)] +
        within * map_bend);
    // w with the sign of x
    const scalar mapped = position > 0 ? mapped_size : centre - mapped_size;
    // s = (u − u0)⁺
    const scalar pushed_in = mapped > 0 ? mapped : none;
    surface_ = dashpot::all_finite(pushed_in) ? pushed_in : 0;
    spring_3_damper_4_force_ = 0;
    sampled_brake_ = 0;
    sampled_surface_change_ = 0;
    sampled_surface_now_ = 0;
    sampled_brake_command_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // |x|
    const scalar distance = position > 0 ? position : centre - position;
    const scalar in_cells = dashpot::clamp_to(last_cell, distance * cells_per_length);
    const scalar cell = in_cells > 0 ? in_cells : centre;
    // d = |x| − x_i
    const scalar within = distance - cell_begins[static_cast<int>(cell)];
    // map_e d
    const scalar map_cubic = map_e[static_cast<int>(cell)] * within;
    // map_c + map_e d
    const scalar map_bend = map_c[static_cast<int>(cell)] + map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar mapped_size = map_a[static_cast<int>(cell)] + within * (map_b[static_cast<int>(cell)] +
        within * map_bend);
    // w with the sign of x
    const scalar mapped = position > 0 ? mapped_size : centre - mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar tangent = map_b[static_cast<int>(cell)] + within * (map_bend + map_bend + map_cubic);
    // ẇ = w′ u̇
    const scalar mapped_velocity = tangent * velocity;
    // Δ = u − s₋
    const scalar approach = mapped - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_ + spring_3_damper_4_force_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : mapped;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now + step_stiffness * surface_change +
        spring_3_damper_4_force_;
    // −(f′ + b∞ v̂)
    const scalar pull = none - (opposing + feedthrough * mapped_velocity);
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // b = 0 of a free tool
    const scalar brake = released > 0 ? none : contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar mapped_force = released > 0 ? none : opposing;
    // m = w′ M
    const scalar force = tangent * mapped_force;
    // w′²
    const scalar tangent_squared = tangent * tangent;
    // b = w′² b_w
    const scalar brake_command = tangent_squared * brake;
    sampled_ = false;
    if (!dashpot::all_finite(position, velocity, force)) return {sampled_brake_command_, 0};
    sampled_ = true;
    sampled_brake_ = brake;
    sampled_surface_change_ = surface_change;
    sampled_surface_now_ = surface_now;
    sampled_brake_command_ = brake_command;
    return {brake_command, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    spring_3_damper_4_force_ = dashpot::relaxed(threshold, spring_3_damper_4_decay, spring_3_damper_4_force_,
        spring_3_damper_4_gain * sampled_surface_change_);
    // s₋ = s
    surface_ = sampled_surface_now_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // |x|
    const scalar distance = position > 0 ? position : centre - position;
    const scalar in_cells = dashpot::clamp_to(last_cell, distance * cells_per_length);
    const scalar cell = in_cells > 0 ? in_cells : centre;
    // d = |x| − x_i
    const scalar within = distance - cell_begins[static_cast<int>(cell)];
    // map_e d
    const scalar map_cubic = map_e[static_cast<int>(cell)] * within;
    // map_c + map_e d
    const scalar map_bend = map_c[static_cast<int>(cell)] + map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar mapped_size = map_a[static_cast<int>(cell)] + within * (map_b[static_cast<int>(cell)] +
        within * map_bend);
    // w with the sign of x
    const scalar mapped = position > 0 ? mapped_size : centre - mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar tangent = map_b[static_cast<int>(cell)] + within * (map_bend + map_bend + map_cubic);
    // ẇ = w′ u̇
    const scalar mapped_velocity = tangent * velocity;
    // Δ = u − s₋
    const scalar approach = mapped - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_ + spring_3_damper_4_force_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : mapped;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now + step_stiffness * surface_change +
        spring_3_damper_4_force_;
    // −(f′ + b∞ v̂)
    const scalar pull = none - (opposing + feedthrough * mapped_velocity);
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // b = 0 of a free tool
    const scalar brake = released > 0 ? none : contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar mapped_force = released > 0 ? none : opposing;
    // m = w′ M
    const scalar force = tangent * mapped_force;
    // w′²
    const scalar tangent_squared = tangent * tangent;
    // b = w′² b_w
    const scalar brake_command = tangent_squared * brake;
    if (!dashpot::all_finite(position, velocity, force)) {
      sampled_ = false;
      return {sampled_brake_command_, 0};
    }
    sampled_brake_command_ = brake_command;
    // F ← a (F + c Δu)
    spring_3_damper_4_force_ = dashpot::relaxed(threshold, spring_3_damper_4_decay, spring_3_damper_4_force_,
        spring_3_damper_4_gain * surface_change);
    // s₋ = s
    surface_ = surface_now;
    sampled_ = false;
    return {brake_command, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar spring_3_damper_4_energy = spring_3_damper_4_energy_weight * spring_3_damper_4_force_ *
        spring_3_damper_4_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * surface_ * surface_ + spring_3_damper_4_energy;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 400.0;  // k0 [N/m]
  static constexpr scalar none = 0.0;  // no force on a free tool [N]
  static constexpr scalar recovery_compliance = -0.0010004994170001314;  // −1/g [m/N]
  static constexpr scalar step_stiffness = 199.50083229270746;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar feedthrough = 0.4;  // b∞ [N·s/m]
  static constexpr scalar contact_damping = 0.4;  // b while the tool touches [N·s/m]
  static constexpr scalar spring_3_damper_4_gain = 198.5058177405704;  // a c [N/m]
  static constexpr scalar spring_3_damper_4_decay = 0.9950124791926823;  // a = e^{−λh} [1]
  static constexpr scalar half_static_stiffness = 200.0;  // ½ k0 [N/m]
  static constexpr scalar spring_3_damper_4_energy_weight = 0.00252512541771042;  // 1/(2 k a²) [m/N]
  static constexpr scalar centre = 0.0;  // centre of the map [m]
  static constexpr scalar cells_per_length = 5333.333333333333;  // cells of the map per length [1/m]
  static constexpr scalar last_cell = 32.0;  // number of the map's last cell [1]
  // where each cell begins [m]
  static constexpr scalar cell_begins[33] = {0.0, 0.0001875, 0.000375, 0.0005625000000000001, 0.00075, 0.0009375,
      0.0011250000000000001, 0.0013125, 0.0015, 0.0016875, 0.001875, 0.0020625, 0.0022500000000000003, 0.0024375,
      0.002625, 0.0028125, 0.003, 0.0031875000000000002, 0.003375, 0.0035625, 0.00375, 0.0039375, 0.004125,
      0.0043125, 0.0045000000000000005, 0.0046875, 0.004875, 0.0050625, 0.00525, 0.0054375000000000005, 0.005625,
      0.0058125, 0.006};
  // coefficient of d³ in each cell [1/m²]
  static constexpr scalar map_e[33] = {-10525622.108334724, -285168.10110871284, -112472.696506677,
      -61819.81512648931, -39665.92949736377, -27864.087140019252, -20777.2366708246, -16162.922072992897,
      -12977.39772699123, -10678.489632547293, -8960.652386282898, -7640.481233404911, -6602.1994641579295,
      -5769.647837401835, -5090.977491639094, -4529.848205696157, -4060.145858269205, -3662.6939474438195,
      -3323.140733711123, -3030.5637450797967, -2776.5254003935875, -2554.419970551163, -2359.0131978421673,
      -2186.112049497762, -2032.324069622238, -1894.8794984349981, -1771.4980616868413, -1660.288012771713,
      -1559.6687722785507, -1468.3110443339312, -1385.0900234245767, -1309.048509306585, 0.0};
  // coefficient of d² in each cell [1/m]
  static constexpr scalar map_c[33] = {4604.959672396441, 391.37893355039915, 240.2818561856215,
      178.78991848612245, 144.593332244947, 122.52625359245812, 106.97506051244024, 95.35606866467535,
      86.30559224792857, 79.03220023979897, 73.04329361798521, 68.01531975559026, 63.72648178544908,
      60.019355260125145, 56.77893159442536, 53.91911728029702, 51.374106946915056, 49.09268725793886,
      47.03436823575846, 45.16669028099729, 43.463308586491515, 41.90260414296807, 40.46665918321512,
      39.14048973127952, 37.91146269568457, 36.768847511272824, 35.70346728331298, 34.707424477917655,
      33.7738831310006, 32.89689437994061, 32.07125554087207, 31.292395405701903, 0.0};
  // w where each cell begins [m]
  static constexpr scalar map_a[33] = {0.0, 9.251035056153566e-05, 0.00022002793419834837, 0.00036525140490948634,
      0.0005233175696960528, 0.000691676199812701, 0.0008687191389662018, 0.0010533261755648765,
      0.0012446659545769568, 0.0014420936465872902, 0.0016450925161906158, 0.001853237942205302,
      0.0020661739619952896, 0.002283597280137273, 0.002505245964800713, 0.0027308912158536943,
      0.002960331217969141, 0.0031933864516635524, 0.0034298960500436498, 0.0036697149222807103,
      0.003912711450183219, 0.004158765620470706, 0.0044077674933270935, 0.004659615934026308,
      0.0049142175528763205, 0.0051714858119482395, 0.005431340266680213, 0.005693705917552285,
      0.005958512652345729, 0.006225694763527391, 0.006495190528383291, 0.006766941841911448,
      0.007040893894347148};
  // w′ where each cell begins [1]
  static constexpr scalar map_b[33] = {0.0, 0.6167356704102378, 0.7334264473278279, 0.8116697886877473,
      0.8721959494934214, 0.9222349330836014, 0.9652434877402243, 1.0031677862522634, 1.0372216288141307,
      1.0682175159905853, 1.0967283441270772, 1.1231745104274558, 1.1478744233307165, 1.1710755282755245,
      1.1929742689527205, 1.2137294292683087, 1.2334713408204756, 1.2523084124170794, 1.270331870386537,
      1.2876192709756877, 1.3042371500610728, 1.3202430541176844, 1.3356871191900284, 1.350613314210524,
      1.3650604313545336, 1.3790628831861973, 1.392651350430824, 1.4058533129758728, 1.418693488653745,
      1.4311941985120438, 1.4433756729740645, 1.4552563100884834, 1.4668528946556558};

  scalar spring_3_damper_4_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_brake_ = 0;  // b, at this sample [N·s/m]
  scalar sampled_surface_change_ = 0;  // Δs since the sample before, at this sample [m]
  scalar sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar sampled_brake_command_ = 0;  // b, at this sample [N·s/m]
  scalar surface_ = 0;  // s, how far the surface is pushed in [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
