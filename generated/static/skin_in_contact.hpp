// Skin under a flat punch, soft at first and stiff beyond 3 mm
//
// source: assumed, of the size that indentation of the forearm shows: a table that grows by three quarters a
//   millimetre
// valid: displacement -0.008 to 0.008 m, rate 0 to 0.05 m/s
// static curve: table of 6 points up to 1 N at 0.005 m, at rest; the network is stretched by w(u) instead of the
//   position u, and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0.5774 <= w' <= 1.629;
//   the curve's force is off by at most 0.05 % of the largest, and w' by 0.00066 % of its largest
// scheme: exact at 1000 Hz, double: a motion whose w is straight between two samples is answered exactly, except
//   in samples in which a slip or a contact changes
// brake: makes b = 0 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   damper_3 dissipates 100 % of the energy at low frequency, so that the brake makes its 9 N s/m; in series,
//   damper_5 dissipates 100 % of the energy at low frequency, so that the brake makes its 60 N s/m; with the
//   contact no more than the feedthrough damping, so that the motor compensates nothing
// states: what the law remembers follows the measured position (position driven, as a network with a contact
//   always is)
// contact: at 0.002 m; brake and motor 0 while the tool is free
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: a static curve's steepness changes while the tool moves, and no device states how fast
//   that is
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 18 additions, 10 multiplications, 1 guard against subnormal numbers
// cost of update(): 3 additions, 4 multiplications, 2 guards against subnormal numbers; 6 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 3.3e-13 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 0d4c784fc5868aa6d6cf0ec9708b63c48e3831627a746460dc503584c312e95e. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class skin_in_contact {
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
    // x = u − u0
    const scalar depth = position - surface_at;
    // |x|
    const scalar distance = depth > 0 ? depth : centre - depth;
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
    const scalar mapped = depth > 0 ? mapped_size : centre - mapped_size;
    // s = (u − u0)⁺
    const scalar pushed_in = mapped > 0 ? mapped : none;
    surface_ = dashpot::all_finite(pushed_in) ? pushed_in : 0;
    relaxed_force_ = 0;
    spring_4_damper_5_force_ = 0;
    spring_2_damper_3_force_ = 0;
    sampled_surface_change_ = 0;
    sampled_surface_now_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // x = u − u0
    const scalar depth = position - surface_at;
    // |x|
    const scalar distance = depth > 0 ? depth : centre - depth;
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
    const scalar mapped = depth > 0 ? mapped_size : centre - mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar tangent = map_b[static_cast<int>(cell)] + within * (map_bend + map_bend + map_cubic);
    // Δ = u − s₋
    const scalar approach = mapped - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_ + relaxed_force_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : mapped;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now + step_stiffness * surface_change + relaxed_force_;
    // −(f′ + b∞ v̂)
    const scalar pull = none - opposing;
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // m = f − b u̇ of a tool that touches
    const scalar mapped_force = released > 0 ? none : opposing;
    // m = w′ M
    const scalar force = tangent * mapped_force;
    sampled_ = false;
    if (!dashpot::all_finite(position, velocity, force)) return {damping, 0};
    sampled_ = true;
    sampled_surface_change_ = surface_change;
    sampled_surface_now_ = surface_now;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    // spring_4, damper_5
    spring_4_damper_5_force_ = dashpot::relaxed(threshold, spring_4_damper_5_decay, spring_4_damper_5_force_,
        spring_4_damper_5_gain * sampled_surface_change_);
    // spring_2, damper_3
    spring_2_damper_3_force_ = dashpot::relaxed(threshold, spring_2_damper_3_decay, spring_2_damper_3_force_,
        spring_2_damper_3_gain * sampled_surface_change_);
    // S = Σ a_i F_i
    relaxed_force_ = spring_4_damper_5_force_ + spring_2_damper_3_force_;
    // s₋ = s
    surface_ = sampled_surface_now_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // x = u − u0
    const scalar depth = position - surface_at;
    // |x|
    const scalar distance = depth > 0 ? depth : centre - depth;
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
    const scalar mapped = depth > 0 ? mapped_size : centre - mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar tangent = map_b[static_cast<int>(cell)] + within * (map_bend + map_bend + map_cubic);
    // Δ = u − s₋
    const scalar approach = mapped - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_ + relaxed_force_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : mapped;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now + step_stiffness * surface_change + relaxed_force_;
    // −(f′ + b∞ v̂)
    const scalar pull = none - opposing;
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // m = f − b u̇ of a tool that touches
    const scalar mapped_force = released > 0 ? none : opposing;
    // m = w′ M
    const scalar force = tangent * mapped_force;
    if (!dashpot::all_finite(position, velocity, force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← a (F + c Δu)
    // spring_4, damper_5
    spring_4_damper_5_force_ = dashpot::relaxed(threshold, spring_4_damper_5_decay, spring_4_damper_5_force_,
        spring_4_damper_5_gain * surface_change);
    // spring_2, damper_3
    spring_2_damper_3_force_ = dashpot::relaxed(threshold, spring_2_damper_3_decay, spring_2_damper_3_force_,
        spring_2_damper_3_gain * surface_change);
    // S = Σ a_i F_i
    relaxed_force_ = spring_4_damper_5_force_ + spring_2_damper_3_force_;
    // s₋ = s
    surface_ = surface_now;
    sampled_ = false;
    return {damping, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    // spring_4, damper_5
    const scalar spring_4_damper_5_energy = spring_4_damper_5_energy_weight * spring_4_damper_5_force_ *
        spring_4_damper_5_force_;
    // spring_2, damper_3
    const scalar spring_2_damper_3_energy = spring_2_damper_3_energy_weight * spring_2_damper_3_force_ *
        spring_2_damper_3_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * surface_ * surface_ + (spring_4_damper_5_energy +
        spring_2_damper_3_energy);
    return stored;
  }

 private:
  static constexpr scalar damping = 0.0;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 150.0;  // k0 [N/m]
  static constexpr scalar none = 0.0;  // no force on a free tool [N]
  static constexpr scalar recovery_compliance = -0.0033386584239085727;  // −1/g [m/N]
  static constexpr scalar step_stiffness = 149.52150625498803;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar spring_4_damper_5_gain = 59.91006996251549;  // a c [N/m]
  static constexpr scalar spring_2_damper_3_gain = 88.66044398171476;  // a c [N/m]
  static constexpr scalar spring_4_damper_5_decay = 0.999000499833375;  // a = e^{−λh} [1]
  static constexpr scalar spring_2_damper_3_decay = 0.9900498337491681;  // a = e^{−λh} [1]
  static constexpr scalar half_static_stiffness = 75.0;  // ½ k0 [N/m]
  static constexpr scalar spring_4_damper_5_energy_weight = 0.008350016677783335;  // 1/(2 k a²) [m/N]
  static constexpr scalar spring_2_damper_3_energy_weight = 0.0056677852223708655;  // 1/(2 k a²) [m/N]
  static constexpr scalar surface_at = 0.002;  // where the unloaded surface lies [m]
  static constexpr scalar centre = 0.0;  // centre of the map [m]
  static constexpr scalar cells_per_length = 21333.333333333332;  // cells of the map per length [1/m]
  static constexpr scalar last_cell = 128.0;  // number of the map's last cell [1]
  // where each cell begins [m]
  static constexpr scalar cell_begins[129] = {0.0, 4.6875e-05, 9.375e-05, 0.00014062500000000002, 0.0001875,
      0.000234375, 0.00028125000000000003, 0.000328125, 0.000375, 0.000421875, 0.00046875, 0.000515625,
      0.0005625000000000001, 0.000609375, 0.00065625, 0.000703125, 0.00075, 0.0007968750000000001, 0.00084375,
      0.000890625, 0.0009375, 0.000984375, 0.00103125, 0.001078125, 0.0011250000000000001, 0.001171875,
      0.00121875, 0.001265625, 0.0013125, 0.0013593750000000001, 0.00140625, 0.001453125, 0.0015, 0.001546875,
      0.0015937500000000001, 0.001640625, 0.0016875, 0.001734375, 0.00178125, 0.001828125, 0.001875, 0.001921875,
      0.00196875, 0.002015625, 0.0020625, 0.002109375, 0.00215625, 0.0022031250000000002, 0.0022500000000000003,
      0.002296875, 0.00234375, 0.002390625, 0.0024375, 0.002484375, 0.00253125, 0.002578125, 0.002625,
      0.002671875, 0.0027187500000000002, 0.002765625, 0.0028125, 0.002859375, 0.00290625, 0.002953125, 0.003,
      0.003046875, 0.00309375, 0.003140625, 0.0031875000000000002, 0.0032343750000000003, 0.00328125, 0.003328125,
      0.003375, 0.003421875, 0.00346875, 0.003515625, 0.0035625, 0.003609375, 0.00365625, 0.0037031250000000003,
      0.00375, 0.003796875, 0.00384375, 0.003890625, 0.0039375, 0.003984375, 0.00403125, 0.004078125, 0.004125,
      0.004171875, 0.00421875, 0.004265625, 0.0043125, 0.004359375, 0.0044062500000000004, 0.0044531250000000005,
      0.0045000000000000005, 0.004546875, 0.00459375, 0.004640625, 0.0046875, 0.004734375, 0.00478125,
      0.004828125, 0.004875, 0.004921875, 0.00496875, 0.005015625, 0.0050625, 0.005109375, 0.00515625,
      0.005203125, 0.00525, 0.005296875, 0.00534375, 0.0053906250000000005, 0.0054375000000000005,
      0.0054843750000000005, 0.00553125, 0.005578125, 0.005625, 0.005671875, 0.00571875, 0.005765625, 0.0058125,
      0.005859375, 0.00590625, 0.005953125, 0.006};
  // coefficient of d³ in each cell [1/m²]
  static constexpr scalar map_e[129] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1519243.5492316422, -143847.49736657052, -122651.64021658845,
      -104720.30538041727, -89595.38810495519, -76852.05541846628, -66113.25262033661, -57053.28573145161,
      -49395.660777637044, -42908.255805864355, -37397.56794225259, -32702.96536620264, -28691.396323641762,
      -25252.736776751935, -22295.812304975592, -19745.056670273047, -17537.737495342855, -15621.669992527266,
      -13953.341687359018, -12496.378398802895, -11220.290963143922, 1497853.4725588795, -94473.84761345024,
      -86824.72550941224, -79690.4305502863, -73075.55862956129, -66971.09849010433, -61358.6246814625,
      -56213.55371987887, -51507.61805529722, -47210.70435732888, -43292.18654719878, -39721.86488067659,
      -36470.603185926535, -33510.738680316215, -30816.32335832237, -28363.242956413786, -26129.24886109353,
      -24093.929786824436, -22238.643309163857, -20546.422089473308, -19001.865589376397, -17591.025000026802,
      -97806.116365739, -92330.00593229379, -86987.77064278875, -81818.38288682645, -76850.01432447728,
      -72101.83127461464, -67585.61473769376, -63307.1894020509, -59267.66050434247, -55464.4670190588,
      -51892.265483166026, -48543.661815659565, -45409.80958757948, -42480.89298077777, -39746.51163186376,
      -37195.98304800744, -34818.57655465367, -32603.690961003456, -30540.986415609415, -28620.479335668035,
      -26832.60786263899, 2062824.7442030802, -103671.5664217221, -98740.10371760403, -93881.3603993526,
      -89128.99753385638, -84509.26224117527, -80041.98142651019, -75741.49387640861, -71617.50560712411,
      -67675.86076737462, -63919.225905938256, -60347.68933308239, -56959.279942913716, -53750.41150286101,
      -50716.259300498066, -47851.07636999235, -45148.45646457576, -42601.55062609476, -40203.243725919434,
      -37946.29678596444, -35823.460286594585, -33827.563066041774, -31951.58083768019, -30188.687811958516,
      -28532.294417154615, -26976.073670843463, -25513.978362251935, -24140.25086258704, -22849.42708273927,
      -21636.33584154151, -20496.094688773683, -19424.103041094866, -18416.033331976145, -17467.82074469095,
      -16575.651987022844, -15735.953474457247, -14945.37921247589, -14200.798605754539, -13499.284370479216,
      -12838.100683835912, -12214.69167044665, -11626.670297802377, -11071.807730463735, 0.0};
  // coefficient of d² in each cell [1/m]
  static constexpr scalar map_c[129] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.4224869946035605, 157.52735785131995, 137.3315971849287, 120.11213040803165,
      105.4100805060178, 92.83119985074701, 82.0410564031793, 72.75824124816715, 64.7471094613219,
      57.81084630863344, 51.78522418571266, 46.53317458980587, 41.94017110316734, 37.91035727681881,
      34.36332864829334, 31.23147362545054, 28.457783535513776, 25.99405206794043, 23.799395530538067,
      21.839036204441136, 20.083300897912633, -34.389876986919695, 174.29737745647842, 161.0167471448488,
      148.81189603611523, 137.61027626484048, 127.33873781927281, 117.92543254347972, 109.30112995430089,
      101.4000765917721, 94.16050877483843, 87.52490798334077, 81.44006973421742, 75.85704117624383,
      70.73096969436016, 66.02089437144183, 61.68950388242327, 57.702877947112405, 54.0302245129776,
      50.6436210820803, 47.51776578444248, 44.62974172390555, 41.95879661205591, 234.61586475439475,
      220.86291625060676, 207.88046737659, 195.64958181337403, 184.14586031801784, 173.34095806041478,
      163.20384925180176, 153.70186388852093, 144.8015235837237, 136.46920357800246, 128.67164679773728,
      121.37635379627397, 114.55186995678795, 108.16798873061, 102.19588711417725, 96.60820714647814,
      91.37909500180383, 86.48420728963792, 81.90069246081362, 77.60715374776237, 73.58359881898987,
      71.5385888161991, 285.17291762658886, 270.5946035804609, 256.71012982333826, 243.50919589176158,
      230.97677727661807, 219.09416752869228, 207.83988043798274, 197.1904210336565, 187.12093625733957,
      177.60575722853937, 168.61884531548353, 160.13415397089514, 152.12591766995013, 144.56887843698289,
      137.43845947423108, 130.71089438729922, 124.36331949232192, 118.37383572524449, 112.72154577670035,
      107.38657125896138, 102.35005397936435, 97.59414474739819, 93.10198257684284, 88.85766665448227,
      84.84622302633709, 81.05356759397087, 77.46646671009171, 74.0724964075512, 70.86000108254609,
      67.8180522755221, 64.93640804672994, 62.205473322953786, 59.61626149356348, 57.16035745420409,
      54.829882232098726, 52.61745927549872, 50.51618244906214, 48.51958574500329, 46.62161469515629,
      44.816599450311706, 43.09922947921062, 41.4645298294945, 0.0};
  // w where each cell begins [m]
  static constexpr scalar map_a[129] = {0.0, 2.706329386826371e-05, 5.412658773652742e-05, 8.118988160479112e-05,
      0.00010825317547305484, 0.00013531646934131854, 0.00016237976320958224, 0.00018944305707784597,
      0.00021650635094610967, 0.00024356964481437338, 0.0002706329386826371, 0.0002976962325509008,
      0.0003247595264191645, 0.0003518228202874282, 0.00037888611415569194, 0.0004059494080239556,
      0.00043301270189221935, 0.000460075995760483, 0.00048713928962874675, 0.0005142025834970104,
      0.0005412658773652742, 0.0005683291712335379, 0.0005955564624785798, 0.0006234355419768751,
      0.0006519202405202649, 0.0006809345599982424, 0.0007104136119191411, 0.0007403018809918019,
      0.0007705517503711221, 0.0008011222597082171, 0.0008319780646146869, 0.0008630885672977021,
      0.0008944271909999159, 0.0009259707743768158, 0.0009576990654688978, 0.0009895942981848673,
      0.0010216408370851274, 0.0010538248787156242, 0.001086134199811423, 0.0011185579444087821,
      0.001151086443322134, 0.0011837110606055855, 0.0012164240625702864, 0.0012492575920321637,
      0.0012826973532365303, 0.0013168454849563787, 0.0013516482992997846, 0.0013870565169631698,
      0.0014230249470757708, 0.001459512172354174, 0.0014964802454426186, 0.0015338944002929276,
      0.0015717227808999907, 0.0016099361885646276, 0.001648507848024995, 0.0016874131922116765,
      0.0017266296649832008, 0.001766136540941838, 0.0018059147612775085, 0.001845946784511948,
      0.0018862164509938937, 0.0019267088600123268, 0.0019674102584362014, 0.0020083079398463773,
      0.0020493901531919195, 0.0020910663771745745, 0.0021337137518889454, 0.0021772752108426717,
      0.002221696986539794, 0.0022669285043313563, 0.002312922258745417, 0.0023596336778724785,
      0.002407020980382182, 0.002455045028864033, 0.002503669182420074, 0.002552859150785644,
      0.0026025828517071267, 0.002652810272852169, 0.0027035133391570313, 0.0027546657862161793,
      0.0028062430400804562, 0.0028582221036424025, 0.0029105814496419784, 0.0029633009202154953,
      0.003016361632828531, 0.003069745892374481, 0.0031236559609694537, 0.0031787640704564724,
      0.0032350618232114205, 0.003292488195214221, 0.003350985162978195, 0.003410497638267032,
      0.0034709733865300667, 0.0035323629330272677, 0.003594619460040242, 0.00365769869803747,
      0.003721558813185679, 0.0037861602931763207, 0.003851465832965418, 0.003917440221704091,
      0.003984050231862044, 0.004051264511313104, 0.004119053478956057, 0.004187389224281044,
      0.004256245411157585, 0.004325597186010852, 0.004395421090464485, 0.0044656949784580005,
      0.004536397937791614, 0.00460751021600875, 0.00467901315049445, 0.004750889102644367, 0.004823121395942673,
      0.004895694257776419, 0.004968592764807758, 0.005041802791722917, 0.005115310963177117,
      0.005189104608757179, 0.005263171720787761, 0.005337500914812568, 0.005412081392588253,
      0.005486902907435578, 0.005561955731799742, 0.005637230626879213, 0.005712718814189965, 0.00578841194893945,
      0.005864302095091964, 0.00594038170201419, 0.0060166435825965295};
  // w′ where each cell begins [1]
  static constexpr scalar map_b[129] = {0.5773502691896257, 0.5773502691896257, 0.5773502691896257,
      0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257,
      0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257,
      0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257,
      0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257, 0.5876856722255589,
      0.6015056485405026, 0.6135719910778964, 0.6241422083218936, 0.6334338087700082, 0.641630140617271,
      0.6488856845230502, 0.6553306859694727, 0.661075121319119, 0.6662120456540207, 0.6708203932499369,
      0.674967307062827, 0.6787100702471234, 0.682097705330455, 0.685172297925355, 0.6879700931748851,
      0.6905224051781232, 0.6928563726840535, 0.694995588420911, 0.6969606244769992, 0.6987694720572711,
      0.705418966929369, 0.7211365936524462, 0.7356595827429901, 0.7490853948653071, 0.7615046590261227,
      0.7730012058189372, 0.7836522515294588, 0.7935286841349312, 0.8026954135596742, 0.8112117578838661,
      0.8191318447073106, 0.8265050127801039, 0.8333762035822664, 0.8397863360086008, 0.8457726599119111,
      0.8513690861646033, 0.8566064922711565, 0.8615130035281728, 0.8661142503851483, 0.870433603086518,
      0.8744923849349229, 0.8783100656536799, 0.8996605849221888, 0.91975786267611, 0.9386732507779789,
      0.9564760689123518, 0.9732331636328982, 0.9890085978249843, 1.0038634480483177, 1.0178556896546012,
      1.0310401521112742, 1.0434685294463422, 1.0551894330601814, 1.0662484762703246, 1.0766883818378397,
      1.0865491053637366, 1.0958679688495236, 1.1046797999046876, 1.1130170730769817, 1.120910050602195,
      1.1283869205415824, 1.1354739308191892, 1.1421955181078125, 1.1624999825118418, 1.1885515616317694,
      1.2132689310103149, 1.2367166588231515, 1.2589581256905886, 1.2800551306695216, 1.3000675883923005,
      1.319053304640719, 1.3370678185629679, 1.3541643008095743, 1.3703934979961705, 1.385803715034538,
      1.4004408279657794, 1.4143483209527627, 1.427567342026661, 1.4401367730266892, 1.4520933099212643,
      1.4634715503553821, 1.4743040858382663, 1.4846215964742606, 1.4944529465562193, 1.503825279692277,
      1.5127641124316287, 1.5212934256002284, 1.5294357527599105, 1.5372122653705065, 1.544642854369604,
      1.5517462079934774, 1.5585398857496457, 1.5650403885201478, 1.571263224828059, 1.5772229733407137,
      1.582933341713773, 1.5884072219025966, 1.5936567420829593, 1.5986933153332803, 1.60352768523637,
      1.6081699685610975, 1.6126296951841637, 1.6169158454098658, 1.6210368848419503, 1.6250007969566904,
      1.6288151135206073};

  scalar relaxed_force_ = 0;  // sum of the modes' forces, decayed to the next sample [N]
  scalar spring_4_damper_5_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar spring_2_damper_3_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_surface_change_ = 0;  // Δs since the sample before, at this sample [m]
  scalar sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar surface_ = 0;  // s, how far the surface is pushed in [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
