// One step of slips that are coupled through a linear part of any shape, not only a tree: exact, with a bound on the
// work.
//
// Over a sample the linear part answers like springs between the ends of the slips, the tool and the ground, and forces
// held at them. The inner ends move to where Φ = Σ ½ c (x_i − x_j)² + Σ p_i x_i + Σ Y |x_a − x_b| is least. A pattern
// says of each slip whether it holds or to which side it slides. For a given pattern the least Φ follows from a linear
// system. On the way there the first slip that would turn back is made to hold; if none does, the first group of ends
// that is pulled harder than its slips hold is let go. Each pattern's least value is below the one before: none comes
// twice, and no more are tried than there are. The pattern of the sample before comes first.
//
// Systems are solved without a subtraction (Grassmann, Taksar & Heyman 1985), so that stiff and soft parts do not blur,
// and a pivot of a part that only slips hold is exactly 0. Neither heap nor recursion; every loop is bounded, also for
// non-finite inputs.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot {

// A slip between the ends a and b: an inner one by its number, `nodes` for the tool, `nodes` + 1 for the ground. It
// holds forces from `lowest` to `highest`: ∓Y, or for a contact of the tool 0 and infinity.
template <class Scalar>
struct slip_link {
  int a;
  int b;
  Scalar lowest;   // [N]
  Scalar highest;  // [N]
};

// The number of patterns: a contact has two states, a slip three.
template <class Scalar>
constexpr int slip_network_patterns(const slip_link<Scalar>* links, int slips) noexcept {
  int patterns = 1;
  for (int k = 0; k < slips; ++k) patterns *= links[k].lowest == Scalar(0) ? 2 : 3;
  return patterns;
}

// Floating-point additions, multiplications and divisions at most: for the forces at all ends,
constexpr int slip_network_pull_operations(int nodes, int slips) noexcept {
  return nodes * (9 * nodes + 20) + 4 * slips;
}

// for one pattern,
constexpr int slip_network_operations_each(int nodes, int slips) noexcept {
  int operations = 6 * slips + 8 * nodes + nodes * nodes;  // gathering, and the way to the new place
  for (int k = nodes - 1; k >= 0; --k) operations += k + 1 + k * (7 + 2 * k) + 2 * k + 3;
  operations += slip_network_pull_operations(nodes, slips);
  return operations + (1 << slips) * (2 * nodes + 2 * slips + 6);  // groups that may give way
}

// and for one step.
template <class Scalar>
constexpr int slip_network_operations(const slip_link<Scalar>* links, int slips, int nodes) noexcept {
  return (slip_network_patterns(links, slips) + 1) * slip_network_operations_each(nodes, slips) +
         slip_network_pull_operations(nodes, slips) + 4 * nodes + slips + 2;
}

// What an inner end is held by, beside slips: `between` the inner ends (nodes × nodes, symmetric, the diagonal unused),
// to the tool and to the ground; `through` joins these two [N/m].
template <class Scalar>
struct slip_network_ties {
  const Scalar* between;
  const Scalar* to_tool;
  const Scalar* to_ground;
  Scalar through;
};

// Room for the steps of one network; the contents do not matter between steps.
template <class Scalar>
struct slip_network_room {
  int* group;       // nodes + 2
  Scalar* between;  // nodes × nodes
  Scalar* numbers;  // 8 × nodes
};

template <class Scalar, int Nodes>
struct slip_network_scratch {
  int group[unsigned{Nodes + 2}];
  Scalar between[unsigned{Nodes * Nodes}];
  Scalar numbers[unsigned{8 * Nodes}];

  constexpr slip_network_room<Scalar> room() noexcept { return {group, between, numbers}; }
};

template <class Scalar>
class slip_network {
 public:
  constexpr slip_network(const slip_link<Scalar>* links, int slips, const slip_network_ties<Scalar>& ties, int nodes,
                         const slip_network_room<Scalar>& room) noexcept
      : links_(links),
        ties_(ties),
        slips_(slips),
        nodes_(nodes),
        tool_(nodes),
        ground_(nodes + 1),
        group_(room.group),
        between_(room.between),
        to_tool_(room.numbers),
        to_ground_(to_tool_ + nodes),
        load_(to_ground_ + nodes),
        weight_(load_ + nodes),
        pivot_(weight_ + nodes),
        target_(pivot_ + nodes),
        pull_(target_ + nodes),
        pull_weight_(pull_ + nodes) {}

  // In: the tool's displacement in this sample [m], the force held at every inner end and at the tool [N], the pattern
  // of the sample before. Out: the force that opposes the tool [N], the displacement of every inner end [m], the
  // pattern.
  constexpr Scalar step(Scalar change, const Scalar* held, Scalar* moved, int* sign) noexcept {
    change_ = change;
    held_ = held;
    moved_ = moved;
    sign_ = sign;
    patterns_tried_ = 1;
    for (int i = 0; i < nodes_; ++i) moved_[i] = Scalar(0);
    aim();
    arrive();
    bool settled = !turn_back() && !give_way();
    const int most = slip_network_patterns(links_, slips_);
    for (int i = 0; i < most && !settled; ++i) {
      ++patterns_tried_;
      aim();
      settled = advance() && !give_way();
    }
    return force();
  }

  constexpr int patterns_tried() const noexcept { return patterns_tried_; }  // in the last step

 private:
  static constexpr Scalar roundoff = sizeof(Scalar) == 4 ? Scalar(0x1p-20) : Scalar(0x1p-48);  // of sums of a few dozen

  static constexpr Scalar size(Scalar x) noexcept { return x < Scalar(0) ? -x : x; }
  constexpr Scalar at(int end) const noexcept {
    return end == tool_ ? change_ : end == ground_ ? Scalar(0) : moved_[end];
  }
  constexpr Scalar target(int end) const noexcept {
    const int group = group_[end];
    return group == tool_ ? change_ : group == ground_ ? Scalar(0) : target_[group];
  }
  constexpr Scalar stretch(int k) const noexcept { return at(links_[k].a) - at(links_[k].b); }
  constexpr Scalar held_by(int k) const noexcept { return sign_[k] > 0 ? links_[k].highest : links_[k].lowest; }
  constexpr bool is_free(int i) const noexcept {
    return group_[i] == i;
  }  // the last of a group that neither tool nor ground holds
  constexpr Scalar& link(int i, int j) noexcept { return between_[i * nodes_ + j]; }

  // Ends joined by slips that hold move as one. A slip between ends of one group holds, whatever the pattern says.
  constexpr void join() noexcept {
    for (int i = 0; i < nodes_ + 2; ++i) group_[i] = i;
    for (int k = 0; k < slips_; ++k)
      if (sign_[k] == 0) rename(group_[links_[k].a], group_[links_[k].b]);
    for (int k = 0; k < slips_; ++k)
      if (group_[links_[k].a] == group_[links_[k].b]) sign_[k] = 0;
  }

  constexpr void rename(int a, int b) noexcept {
    const int from = a < b ? a : b, to = a < b ? b : a;
    for (int i = 0; i < nodes_ + 2; ++i)
      if (group_[i] == from) group_[i] = to;
  }

  // Finds where Φ is least with this pattern.
  constexpr void aim() noexcept {
    join();
    gather();
    eliminate();
    ray_ = nodes_;
    for (int k = nodes_ - 1; k >= 0; --k)
      if (is_free(k)) place(k);
  }

  constexpr void gather() noexcept {
    for (int i = 0; i < nodes_ * nodes_; ++i) between_[i] = Scalar(0);
    for (int i = 0; i < nodes_; ++i) to_tool_[i] = to_ground_[i] = load_[i] = weight_[i] = Scalar(0);
    for (int i = 0; i < nodes_; ++i) {
      if (group_[i] < nodes_) {
        to_tool_[group_[i]] += ties_.to_tool[i];
        to_ground_[group_[i]] += ties_.to_ground[i];
        add_load(i, held_[i]);
      }
      for (int j = 0; j < i; ++j) tie(group_[i], group_[j], ties_.between[i * nodes_ + j]);
    }
    for (int k = 0; k < slips_; ++k) {
      if (sign_[k] == 0) continue;
      add_load(links_[k].a, held_by(k));
      add_load(links_[k].b, -held_by(k));
    }
  }

  constexpr void add_load(int end, Scalar force) noexcept {
    if (group_[end] >= nodes_) return;
    load_[group_[end]] += force;
    weight_[group_[end]] += size(force);
  }

  constexpr void tie(int a, int b, Scalar stiffness) noexcept {
    if (a == b || (a >= nodes_ && b >= nodes_)) return;
    const int inner = a < b ? a : b, other = a < b ? b : a;
    if (other == tool_) to_tool_[inner] += stiffness;
    if (other == ground_) to_ground_[inner] += stiffness;
    if (other < nodes_) link(other, inner) = link(inner, other) += stiffness;
  }

  constexpr void eliminate() noexcept {
    for (int k = 0; k < nodes_; ++k) {
      if (!is_free(k)) continue;
      pivot_[k] = to_tool_[k] + to_ground_[k];
      for (int i = k + 1; i < nodes_; ++i) pivot_[k] += link(k, i);
      if (pivot_[k] == Scalar(0)) continue;
      for (int i = k + 1; i < nodes_; ++i)
        if (is_free(i) && link(i, k) != Scalar(0)) pass_on(k, i, link(i, k) / pivot_[k]);
    }
  }

  constexpr void pass_on(int k, int i, Scalar share) noexcept {
    to_tool_[i] += share * to_tool_[k];
    to_ground_[i] += share * to_ground_[k];
    load_[i] += share * load_[k];
    weight_[i] += size(share) * weight_[k];
    for (int j = k + 1; j < nodes_; ++j)
      if (j != i) link(i, j) += share * link(k, j);
  }

  // A part that is tied to nothing but sliding slips, whose forces do not balance, moves on until one of them holds.
  constexpr void place(int k) noexcept {
    target_[k] = moved_[k];
    if (pivot_[k] == Scalar(0)) {
      if (size(load_[k]) > roundoff * weight_[k]) ray_ = k;
      return;
    }
    Scalar sum = to_tool_[k] * change_ - load_[k];
    for (int i = k + 1; i < nodes_; ++i)
      if (is_free(i)) sum += link(k, i) * target_[i];
    target_[k] = sum / pivot_[k];
  }

  constexpr void arrive() noexcept {
    for (int i = 0; i < nodes_; ++i) moved_[i] = target(i);
  }

  // After a guessed pattern: sets every slip to the side to which it moved; true if that differs from the guess. A
  // surface that the tool would have passed is moved along with it first.
  constexpr bool turn_back() noexcept {
    for (int k = 0; k < slips_; ++k)
      if (is_contact(k) && stretch(k) > Scalar(0) && links_[k].b < nodes_) moved_[links_[k].b] = at(links_[k].a);
    bool any = ray_ < nodes_;
    for (int k = 0; k < slips_; ++k) {
      const Scalar now = stretch(k);
      const int side = now > Scalar(0) ? 1 : now < Scalar(0) ? -1 : 0;
      any = any || side != sign_[k];
      sign_[k] = side;
    }
    return any;
  }

  constexpr bool is_contact(int k) const noexcept { return links_[k].lowest == Scalar(0); }

  // Moves towards the target until a slip would turn back: true if none does on the whole way.
  constexpr bool advance() noexcept {
    if (ray_ < nodes_) point_along_ray();
    int first = slips_;
    Scalar way = Scalar(1);
    for (int k = 0; k < slips_; ++k) {
      if (sign_[k] == 0) continue;
      const Scalar here = stretch(k), further = target(links_[k].a) - target(links_[k].b) - here;
      if (sign_[k] > 0 ? !(further < Scalar(0)) : !(further > Scalar(0))) continue;
      Scalar until = -here / further;
      if (until < Scalar(0)) until = Scalar(0);
      if (first < slips_ || ray_ < nodes_ ? first < slips_ && !(until < way) : !(until < way)) continue;
      first = k;
      way = until;
    }
    if (first == slips_) {
      if (ray_ == nodes_) arrive();
      return true;
    }
    for (int i = 0; i < nodes_; ++i) moved_[i] += way * (target(i) - moved_[i]);
    sign_[first] = 0;
    return false;
  }

  // All else stays; the part moves as a whole, against its load, by a length of the order of all others.
  constexpr void point_along_ray() noexcept {
    Scalar length = size(change_);
    for (int i = 0; i < nodes_; ++i) length += size(moved_[i]);
    for (int i = 0; i < nodes_; ++i) target_[i] = Scalar(0);
    target_[ray_] = load_[ray_] > Scalar(0) ? -length : length;
    for (int k = ray_ - 1; k >= 0; --k) {
      if (!is_free(k) || pivot_[k] == Scalar(0)) continue;
      Scalar sum = 0;
      for (int i = k + 1; i <= ray_; ++i)
        if (is_free(i)) sum += link(k, i) * target_[i];
      target_[k] = sum / pivot_[k];
    }
    for (int i = 0; i < nodes_; ++i)
      if (is_free(i)) target_[i] += moved_[i];
  }

  // The sum of the forces of the linear part and of the sliding slips at each inner end.
  constexpr void find_pulls() noexcept {
    for (int i = 0; i < nodes_; ++i) {
      pull_[i] = held_[i];
      pull_weight_[i] = size(held_[i]);
      add_tie(i, ties_.to_tool[i], change_);
      add_tie(i, ties_.to_ground[i], Scalar(0));
      for (int j = 0; j < nodes_; ++j)
        if (j != i) add_tie(i, ties_.between[i * nodes_ + j], moved_[j]);
    }
    for (int k = 0; k < slips_; ++k) {
      if (sign_[k] == 0) continue;
      if (links_[k].a < nodes_) add_pull(links_[k].a, held_by(k));
      if (links_[k].b < nodes_) add_pull(links_[k].b, -held_by(k));
    }
  }

  // The pull of a stiff tie contains the rounding errors of both ends' displacements.
  constexpr void add_tie(int i, Scalar stiffness, Scalar other) noexcept {
    add_pull(i, stiffness * (moved_[i] - other));
    pull_weight_[i] += size(stiffness) * (size(moved_[i]) + size(other)) * Scalar(0.125);
  }

  constexpr void add_pull(int i, Scalar force) noexcept {
    pull_[i] += force;
    pull_weight_[i] += size(force);
  }

  // Lets go ends of a group that are pulled harder than the slips around them hold, and returns true; false if there
  // are none. They and the rest of the group are each connected. The rest has the tool or ground, or else the last end.
  constexpr bool give_way() noexcept {
    find_pulls();
    for (int group = 0; group < nodes_ + 2; ++group) {
      unsigned members = 0;
      for (int i = 0; i < nodes_; ++i)
        if (group_[i] == group && i != group) members |= 1u << i;
      for (unsigned ends = members & (~members + 1u); ends != 0; ends = (ends - members) & members)
        if (try_ends(ends, members, group)) return true;
    }
    return false;
  }

  static constexpr bool is_in(int end, unsigned ends) noexcept { return end < 31 && ((ends >> end) & 1u) != 0; }

  constexpr bool try_ends(unsigned ends, unsigned members, int group) noexcept {
    Scalar pull = 0, up = 0, down = 0, weight = 0;
    for (int i = 0; i < nodes_; ++i) {
      if (!is_in(i, ends)) continue;
      pull += pull_[i];
      weight += pull_weight_[i];
    }
    for (int k = 0; k < slips_; ++k) {
      if (sign_[k] != 0 || is_in(links_[k].a, ends) == is_in(links_[k].b, ends)) continue;
      up += is_in(links_[k].a, ends) ? links_[k].highest : -links_[k].lowest;
      down += is_in(links_[k].a, ends) ? -links_[k].lowest : links_[k].highest;
    }
    const bool rises = pull + up < -roundoff * weight, falls = down - pull < -roundoff * weight;
    if (!rises && !falls) return false;
    const unsigned others = (members & ~ends) | 1u << group;
    if (!in_one_piece(ends) || !in_one_piece(others)) return false;
    for (int k = 0; k < slips_; ++k)
      if (sign_[k] == 0 && is_in(links_[k].a, ends) != is_in(links_[k].b, ends))
        sign_[k] = is_in(links_[k].a, ends) == rises ? 1 : -1;
    return true;
  }

  constexpr bool in_one_piece(unsigned ends) const noexcept {
    unsigned reached = ends & (~ends + 1u);
    for (int round = 0; round < slips_; ++round)
      for (int k = 0; k < slips_; ++k) {
        if (sign_[k] != 0) continue;
        const unsigned both = (1u << links_[k].a | 1u << links_[k].b) & ends;
        if ((both & reached) != 0 && is_in(links_[k].a, ends) && is_in(links_[k].b, ends)) reached |= both;
      }
    return reached == ends;
  }

  constexpr Scalar force() noexcept {
    find_pulls();
    Scalar force = held_[nodes_] + ties_.through * change_;
    for (int i = 0; i < nodes_; ++i) {
      force += ties_.to_tool[i] * (change_ - moved_[i]);
      if (group_[i] == tool_) force += pull_[i];
    }
    for (int k = 0; k < slips_; ++k) {
      if (sign_[k] == 0) continue;
      if (links_[k].a == tool_) force += held_by(k);
      if (links_[k].b == tool_) force -= held_by(k);
    }
    return force;
  }

  const slip_link<Scalar>* links_;
  slip_network_ties<Scalar> ties_;
  int slips_, nodes_, tool_, ground_;
  int* group_;
  Scalar *between_, *to_tool_, *to_ground_, *load_, *weight_, *pivot_, *target_, *pull_, *pull_weight_;
  Scalar change_ = 0;
  const Scalar* held_ = nullptr;
  Scalar* moved_ = nullptr;
  int* sign_ = nullptr;
  int ray_ = 0;
  int patterns_tried_ = 0;
};

}  // namespace dashpot
