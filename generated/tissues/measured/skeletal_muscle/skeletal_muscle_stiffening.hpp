// Passive skinned skeletal muscle, a fibre of 1 mm² and 10 mm, behind the curve by which it stiffens
//
// source: Ramp-and-hold stretches from beards-lab/TitinViscoelasticity (MIT), averages without calcium. Fitted by
//   dashpot fit to AvgRelaxed_0.1s.csv, AvgRelaxed_1s.csv, AvgRelaxed_10s.csv, AvgRelaxed_100s.csv; a column, f =
//   E A u/L: force = stress times 1e-06 m^2, displacement = strain times 0.01 m; displacements are from each
//   recording's first row
// valid: displacement 0 to 0.00226 m, rate 0 to 0.0227 m/s, frequency 0.000531 to 30.3 Hz
// static curve: exponential, 1502 1/m, 0.006965 N at 0.00226 m, at rest; the network is stretched by w(u) instead
//   of the position u, and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0.4762 <= w' <=
//   1.924; the curve's force is off by at most 0.00011 % of the largest, and w' by 2.3e-05 % of its largest
// scheme: exact at 1000 Hz, double: a motion whose w is straight between two samples is answered exactly
// brake: makes b = 5.3572 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   B1 dissipates 100 % of the energy at low frequency, so that the brake makes its 0.2782 N s/m; in series, B2
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5.079 N s/m
// states: what the law remembers follows the measured position (position driven, as a network with a static curve
//   always is)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: a static curve's steepness changes while the tool moves, and no device states how fast
//   that is
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 13 additions, 12 multiplications, 0 guards against subnormal numbers
// cost of update(): 5 additions, 4 multiplications, 2 guards against subnormal numbers; 7 numbers kept between
//   samples
// rounding: in delta form the force of a mode is off by at most 9.9e-13 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 1946f395bca0e4e9886b257e09edefa3831588886130e3d06aeb7f30cf85c344. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class skeletal_muscle_stiffening {
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
    last_position_ = dashpot::all_finite(mapped) ? mapped : 0;
    relaxed_force_ = 0;
    B2_K2_force_ = 0;
    B1_K1_force_ = 0;
    sampled_position_change_ = 0;
    sampled_position_ = 0;
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
    // Δu = u − u₋
    const scalar position_change = mapped - last_position_;
    // m = f − b u̇
    const scalar mapped_force = relaxed_force_ + static_stiffness * mapped + (step_stiffness * position_change +
        velocity_gain * mapped_velocity);
    // m = w′ M
    const scalar force = tangent * mapped_force;
    // w′²
    const scalar tangent_squared = tangent * tangent;
    // b = w′² b_w
    const scalar brake_command = tangent_squared * mapped_damping;
    sampled_ = false;
    if (!dashpot::all_finite(position, force)) return {sampled_brake_command_, 0};
    sampled_ = true;
    sampled_position_change_ = position_change;
    sampled_position_ = mapped;
    sampled_brake_command_ = brake_command;
    return {brake_command, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← F + (a c Δu − α F)
    // B2, K2
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_force_ +
        (B2_K2_gain * sampled_position_change_ - B2_K2_loss * B2_K2_force_));
    // B1, K1
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_force_ +
        (B1_K1_gain * sampled_position_change_ - B1_K1_loss * B1_K1_force_));
    // S = Σ a_i F_i
    relaxed_force_ = B2_K2_force_ + B1_K1_force_;
    // u₋ = u
    last_position_ = sampled_position_;
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
    // Δu = u − u₋
    const scalar position_change = mapped - last_position_;
    // m = f − b u̇
    const scalar mapped_force = relaxed_force_ + static_stiffness * mapped + (step_stiffness * position_change +
        velocity_gain * mapped_velocity);
    // m = w′ M
    const scalar force = tangent * mapped_force;
    // w′²
    const scalar tangent_squared = tangent * tangent;
    // b = w′² b_w
    const scalar brake_command = tangent_squared * mapped_damping;
    if (!dashpot::all_finite(position, force)) {
      sampled_ = false;
      return {sampled_brake_command_, 0};
    }
    sampled_brake_command_ = brake_command;
    // F ← F + (a c Δu − α F)
    // B2, K2
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_force_ +
        (B2_K2_gain * position_change - B2_K2_loss * B2_K2_force_));
    // B1, K1
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_force_ +
        (B1_K1_gain * position_change - B1_K1_loss * B1_K1_force_));
    // S = Σ a_i F_i
    relaxed_force_ = B2_K2_force_ + B1_K1_force_;
    // u₋ = u
    last_position_ = mapped;
    sampled_ = false;
    return {brake_command, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar B2_K2_energy = B2_K2_energy_weight * B2_K2_force_ * B2_K2_force_;  // B2, K2
    const scalar B1_K1_energy = B1_K1_energy_weight * B1_K1_force_ * B1_K1_force_;  // B1, K1
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + (B2_K2_energy + B1_K1_energy);
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 1.602;  // k0 [N/m]
  static constexpr scalar step_stiffness = 2.1081969486151397;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -5.3572;  // b∞ − b [N·s/m]
  static constexpr scalar B2_K2_gain = 0.5694042226915098;  // a c [N/m]
  static constexpr scalar B1_K1_gain = 1.5302181406997355;  // a c [N/m]
  static constexpr scalar B2_K2_loss = 0.00011212208557579898;  // α = 1 − a [1]
  static constexpr scalar B1_K1_loss = 0.005531016807964259;  // α = 1 − a [1]
  static constexpr scalar half_static_stiffness = 0.801;  // ½ k0 [N/m]
  static constexpr scalar B2_K2_energy_weight = 0.8781600367786451;  // 1/(2 k a²) [m/N]
  static constexpr scalar B1_K1_energy_weight = 0.3276586168470807;  // 1/(2 k a²) [m/N]
  static constexpr scalar centre = 0.0;  // centre of the map [m]
  static constexpr scalar cells_per_length = 14159.292035398232;  // cells of the map per length [1/m]
  static constexpr scalar last_cell = 32.0;  // number of the map's last cell [1]
  // where each cell begins [m]
  static constexpr scalar cell_begins[33] = {0.0, 7.0625e-05, 0.00014125, 0.000211875, 0.0002825, 0.000353125,
      0.00042375, 0.000494375, 0.000565, 0.0006356249999999999, 0.00070625, 0.000776875, 0.0008475,
      0.0009181249999999999, 0.00098875, 0.001059375, 0.00113, 0.0012006249999999999, 0.0012712499999999998,
      0.001341875, 0.0014125, 0.0014831249999999999, 0.00155375, 0.001624375, 0.001695, 0.0017656249999999998,
      0.0018362499999999998, 0.001906875, 0.0019775, 0.002048125, 0.00211875, 0.002189375, 0.00226};
  // coefficient of d³ in each cell [1/m²]
  static constexpr scalar map_e[33] = {30698.536670771726, 32482.81137026927, 34367.861704600466,
      36358.98223901958, 38461.731070654874, 40681.944483064544, 43025.752650307644, 45499.59645528738,
      48110.245486978776, 50864.8172806821, 53770.79786470459, 56836.06367593807, 60068.904905754775,
      63478.050336587265, 67072.69372859893, 70862.52181510515, 74857.74396499126, 79069.12357041144,
      83508.01121865932, 88186.37970838448, 93116.86097238878, 98312.78497215554, 103788.2206331131,
      109558.01889446055, 115637.8579532191, 122044.29078902859, 128794.79506407528, 135907.8255013902,
      143402.8688545505, 151300.50159249804, 159622.45043468842, 168391.65588402914, 0.0};
  // coefficient of d² in each cell [1/m]
  static constexpr scalar map_c[33] = {119.1716785006216, 125.67454376835073, 132.55537925156975,
      139.83553316456218, 147.5374753077544, 155.68485288916378, 164.3025494498669, 173.41674711585316,
      183.05499241235486, 193.24626589043822, 204.02105582923411, 215.41143629062154, 227.45114981641422,
      240.17569507111335, 253.62241974607767, 267.8306190535446, 282.8416401513596, 298.69899285160466,
      315.44846697865603, 333.1382567546701, 351.8190926032329, 371.54438077508155, 392.37035121359855,
      414.3562140923835, 437.5643254728355, 462.0603625465441, 487.9135089456033, 515.1966506239476,
      543.98658283467, 574.3642287522201, 606.4148703145767, 640.2283918891341, 0.0};
  // w where each cell begins [m]
  static constexpr scalar map_a[33] = {0.0, 3.4234998136796425e-05, 6.972433349611606e-05, 0.00010653668365181547,
      0.00014474471157424395, 0.00018442528987788848, 0.00022565973681981338, 0.00026853406463709636,
      0.00031313924084466906, 0.000359571463150531, 0.0004079324486833592, 0.0004583297382682157,
      0.0005108770165294952, 0.0005656944486465907, 0.0006229090346371117, 0.0006826549820949952,
      0.0007450740983666377, 0.0008103162032073556, 0.0008785395630231916, 0.0009499113478694388,
      0.001024608112447378, 0.0011028163024147488, 0.0011847327874035306, 0.0012705654222208292,
      0.0013605336377952052, 0.0014548690635217878, 0.0015538161827551606, 0.0016576330232994803,
      0.0017665918848507802, 0.0018809801054571335, 0.002001100869178578, 0.002127274057250641,
      0.002259837145183289};
  // w′ where each cell begins [1]
  static constexpr scalar map_b[33] = {0.47617371571284717, 0.49346607813084403, 0.5117036695690458,
      0.5309413862939231, 0.5512372192333511, 0.5726524163440572, 0.5952516530831331, 0.6191032114377609,
      0.644279167999677, 0.670855591605215, 0.6989127510980093, 0.728535333809593, 0.7598126753931567,
      0.7928390016876254, 0.8277136833329216, 0.8645415039027823, 0.9034329423687717, 0.9445044707581461,
      0.9878788679189867, 1.0336855503585318, 1.0820609211749292, 1.1331487381587568, 1.1871005021986778,
      1.2440758671856427, 1.3042430726722036, 1.3677794006079813, 1.4348716575392648, 1.505716683730378,
      1.5805218907370582, 1.6595058290379283, 1.7428987874095325, 1.8309434258136545, 1.9238954436531313};
  static constexpr scalar mapped_damping = 5.3572;  // b_w, b behind the map [N·s/m]

  scalar relaxed_force_ = 0;  // sum of the modes' forces, decayed to the next sample [N]
  scalar B2_K2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B1_K1_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_brake_command_ = 0;  // b, at this sample [N·s/m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
