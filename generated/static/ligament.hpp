// A joint that its ligaments hold, soft about the middle and stiff at both ends
//
// source: assumed: 4 N m at 30 degrees, and four times as stiff there as at 10 degrees
// valid: displacement -0.5235987755982989 to 0.5235987755982989 rad, rate 0 to 1 rad/s
// static curve: exponential, 4 1/rad, 4 N m at 0.523599 rad, at rest; the network is stretched by w(u) instead of
//   the position u, and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0.6704 <= w' <=
//   1.506; the curve's force is off by at most 2.5e-05 % of the largest, and w' by 9.4e-06 % of its largest
// scheme: exact at 1000 Hz, double: a motion whose w is straight between two samples is answered exactly
// brake: makes b = 0.42000000000000004 N·m·s/rad of damping, and the motor the rest of the force; by the rule
//   'paper': in series, damper_3 dissipates 100 % of the energy at low frequency, so that the brake makes its 0.4
//   N m s/rad
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
// cost of update(): 1 addition, 2 multiplications, 1 guard against subnormal numbers; 5 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 6.7e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// b9951e4d33b7bf9ac942c91926eb8d20ff50467dd6ffdebe854aa5750b8f4286. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class ligament {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::rotation;

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

  // Starts at rest at `position` [rad]: only the springs that hold a force at rest are loaded, from 0. A
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
    spring_2_damper_3_force_ = 0;
    sampled_position_change_ = 0;
    sampled_position_ = 0;
    sampled_brake_command_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [rad] and an estimate of its velocity [rad/s].
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
    const scalar mapped_force = spring_2_damper_3_force_ + static_stiffness * mapped +
        (step_stiffness * position_change + velocity_gain * mapped_velocity);
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
    // F ← a (F + c Δu)
    spring_2_damper_3_force_ = dashpot::relaxed(threshold, spring_2_damper_3_decay, spring_2_damper_3_force_,
        spring_2_damper_3_gain * sampled_position_change_);
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
    const scalar mapped_force = spring_2_damper_3_force_ + static_stiffness * mapped +
        (step_stiffness * position_change + velocity_gain * mapped_velocity);
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
    // F ← a (F + c Δu)
    spring_2_damper_3_force_ = dashpot::relaxed(threshold, spring_2_damper_3_decay, spring_2_damper_3_force_,
        spring_2_damper_3_gain * position_change);
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
    const scalar spring_2_damper_3_energy = spring_2_damper_3_energy_weight * spring_2_damper_3_force_ *
        spring_2_damper_3_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + spring_2_damper_3_energy;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 5.0;  // k0 [N·m/rad]
  static constexpr scalar step_stiffness = 1.9950083229270748;  // Σ c_i, stiffness of all modes within a sample [N·m/rad]
  static constexpr scalar velocity_gain = -0.4;  // b∞ − b [N·m·s/rad]
  static constexpr scalar spring_2_damper_3_gain = 1.985058177405704;  // a c [N·m/rad]
  static constexpr scalar spring_2_damper_3_decay = 0.9950124791926823;  // a = e^{−λh} [1]
  static constexpr scalar half_static_stiffness = 2.5;  // ½ k0 [N·m/rad]
  static constexpr scalar spring_2_damper_3_energy_weight = 0.252512541771042;  // 1/(2 k a²) [rad/N·m]
  static constexpr scalar centre = 0.0;  // centre of the map [rad]
  static constexpr scalar cells_per_length = 61.1154981472878;  // cells of the map per length [1/rad]
  static constexpr scalar last_cell = 32.0;  // number of the map's last cell [1]
  // where each cell begins [rad]
  static constexpr scalar cell_begins[33] = {0.0, 0.01636246173744684, 0.03272492347489368, 0.049087385212340524,
      0.06544984694978737, 0.08181230868723421, 0.09817477042468105, 0.11453723216212788, 0.13089969389957473,
      0.14726215563702158, 0.16362461737446843, 0.17998707911191525, 0.1963495408493621, 0.21271200258680895,
      0.22907446432425577, 0.24543692606170261, 0.26179938779914946, 0.2781618495365963, 0.29452431127404316,
      0.31088677301149, 0.32724923474893686, 0.3436116964863837, 0.3599741582238305, 0.3763366199612774,
      0.3926990816987242, 0.409061543436171, 0.4254240051736179, 0.4417864669110647, 0.45814892864851153,
      0.4745113903859584, 0.49087385212340523, 0.5072363138608521, 0.5235987755982989};
  // coefficient of d³ in each cell [1/rad²]
  static constexpr scalar map_e[33] = {0.3031988795842966, 0.3139601228417473, 0.32509322017102354,
      0.3366101337891429, 0.3485231881061274, 0.3608450817942815, 0.3735889003879129, 0.38676812943536254,
      0.4003966682253144, 0.4144888441094101, 0.42905942744319786, 0.44412364716740177, 0.45969720705141665,
      0.47579630262080524, 0.49243763879042196, 0.5096384482245988, 0.5274165104456242, 0.5457901717115239,
      0.5647783656839246, 0.5844006349065567, 0.6046771531147341, 0.6256287483959573, 0.6472769272216133,
      0.6696438993696243, 0.6927526037578108, 0.7166267352077187, 0.7412907721586995, 0.7667700053521604,
      0.7930905675061033, 0.8202794640003769, 0.8483646045934652, 0.8773748361921481, 0.0};
  // coefficient of d² in each cell [1/rad]
  static constexpr scalar map_c[33] = {0.4468746687487857, 0.4617567112663678, 0.47716695651142466,
      0.49312365666196734, 0.5096456510513107, 0.5267523839454805, 0.5444639229129988, 0.5628009778130847,
      0.5817849204293818, 0.6014378047774027, 0.6217823881149604, 0.6428421526859409, 0.6646413282288467,
      0.6872049152826216, 0.7105587093233304, 0.7347293257663331, 0.7597442258696436, 0.7856317435752054,
      0.8124211133258471, 0.8401424988967037, 0.8688270232808942, 0.898506799670248, 0.9292149635728596,
      0.9609857061102316, 0.9938543085377409, 1.0278571780331331, 1.0630318847987164, 1.0994172005239045,
      1.1370531382557254, 1.1759809937259103, 1.2162433881841712, 1.2578843127883026, 0.0};
  // w where each cell begins [rad]
  static constexpr scalar map_a[33] = {0.0, 0.011089983082047733, 0.022427266017728396, 0.03402010202102603,
      0.04587703696355217, 0.05800691946385807, 0.07041891130071772, 0.08312249816022028, 0.09612750072684187,
      0.10944408612901209, 0.12308277975005207, 0.1370544774157368, 0.15137045797012752, 0.1660423962517296,
      0.18108237648245823, 0.19650290608233925, 0.21231692992333592, 0.2285378450361754, 0.24517951578455052,
      0.26225628952159513, 0.27978301274407513, 0.2977750477603008, 0.31624828988835363, 0.3352191852018291,
      0.3547047488409281, 0.37472258390738633, 0.3952909009624079, 0.416428538147475, 0.4381549819486329,
      0.46049038862560315, 0.4834556063278591, 0.5070721979206035, 0.531362464544422};
  // w′ where each cell begins [1]
  static constexpr scalar map_b[33] = {0.6703766953527481, 0.6852441611386914, 0.7006072839551196,
      0.7164836478655129, 0.732891443842418, 0.7498494892729716, 0.7673772480558805, 0.785494851309672,
      0.8042231187128955, 0.8235835804978608, 0.8435985001204395, 0.8642908976294326, 0.8856845737600152,
      0.9078041347768185, 0.9306750180932892, 0.9543235186950824, 0.9787768163963956, 1.0040630039593363,
      1.0302111161076335, 1.0572511594672565, 1.0852141434677924, 1.114132112239749, 1.1440381775442994,
      1.1749665527733768, 1.206952588059431, 1.2400328065356132, 1.274244941788636, 1.3096279765480556,
      1.3462221826572804, 1.3840691623731702, 1.423211891042709, 1.4636947612068676, 1.5055636281834504};
  static constexpr scalar mapped_damping = 0.42000000000000004;  // b_w, b behind the map [N·m·s/rad]

  scalar spring_2_damper_3_force_ = 0;  // force of the mode, decayed to the next sample [N·m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [rad]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [rad]
  scalar sampled_brake_command_ = 0;  // b, at this sample [N·m·s/rad]
  scalar last_position_ = 0;  // u of the sample before [rad]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
