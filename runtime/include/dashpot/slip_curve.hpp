// The curve of a part that gives way, p against δ: a non-decreasing polyline. It is read by elongation where parts
// stand in parallel and forces add, by force where they stand in series and elongations do.
//
// Besides its kinks a curve stores its force at δ = 0, near which the next samples lie: kinks may be so far away that
// an interpolation between two of them alone would be off by more than all that happens there.
#pragma once

namespace dashpot {

template <class Scalar>
struct slip_corner {
  Scalar elongation;  // δ [m]
  Scalar force;       // p [N]
  bool is_kink;       // else the point at δ = 0
};

template <class Scalar>
struct slip_curve {
  const slip_corner<Scalar>* corners;
  int count;
  Scalar end_slope;  // of what is read, at both ends
  bool is_open;      // flat ends, read by force: no value beyond them, any value at them
};

// All values of a curve at one place: more than one on a step.
template <class Scalar>
struct slip_range {
  Scalar low, high;
  bool open_low, open_high;  // reaches to infinity
  bool exists;               // false beyond open ends
  bool is_kink;
};

// The two ways to read a curve: `at` is the quantity that parts share, `value` the one that adds up over them.
template <class Scalar>
struct by_elongation {
  using Corner = slip_corner<Scalar>;
  static constexpr Scalar at(const Corner& corner) noexcept { return corner.elongation; }
  static constexpr Scalar value(const Corner& corner) noexcept { return corner.force; }
  static constexpr Corner corner(Scalar at, Scalar value, bool is_kink) noexcept { return {at, value, is_kink}; }
};

template <class Scalar>
struct by_force {
  using Corner = slip_corner<Scalar>;
  static constexpr Scalar at(const Corner& corner) noexcept { return corner.force; }
  static constexpr Scalar value(const Corner& corner) noexcept { return corner.elongation; }
  static constexpr Corner corner(Scalar at, Scalar value, bool is_kink) noexcept { return {value, at, is_kink}; }
};

// Reads a curve at non-decreasing abscissae.
template <class Scalar, class Way>
class slip_curve_reader {
 public:
  using Corner = slip_corner<Scalar>;
  using Range = slip_range<Scalar>;

  explicit constexpr slip_curve_reader(const slip_curve<Scalar>& curve) noexcept : curve_(curve) {}
  constexpr bool at_end() const noexcept { return next_ == curve_.count; }
  constexpr Scalar next() const noexcept { return Way::at(curve_.corners[next_]); }
  constexpr void skip() noexcept { ++next_; }

  constexpr Range read(Scalar at) noexcept {
    const int first = next_;
    bool is_kink = false;
    while (!at_end() && next() == at) is_kink = curve_.corners[next_++].is_kink || is_kink;
    if (first == next_) return beside(at);
    return {Way::value(curve_.corners[first]),
            Way::value(curve_.corners[next_ - 1]),
            curve_.is_open && first == 0,
            curve_.is_open && at_end(),
            true,
            is_kink};
  }

 private:
  constexpr Range beside(Scalar at) const noexcept {
    const bool is_end = next_ == 0 || at_end();
    const Scalar value = is_end ? beyond(curve_.corners[next_ == 0 ? 0 : next_ - 1], at)
                                : between(curve_.corners[next_ - 1], curve_.corners[next_], at);
    const bool is_open = is_end && curve_.is_open;
    return {value, value, is_open && next_ == 0, is_open && next_ != 0, !is_open, false};
  }

  constexpr Scalar beyond(const Corner& end, Scalar at) const noexcept {
    if (curve_.end_slope == Scalar(0)) return Way::value(end);
    return Way::value(end) + curve_.end_slope * (at - Way::at(end));
  }

  // Interpolates from the nearer corner, never beyond either.
  static constexpr Scalar between(const Corner& a, const Corner& b, Scalar at) noexcept {
    if (Way::value(a) == Way::value(b)) return Way::value(a);
    const Scalar before = at - Way::at(a), after = Way::at(b) - at;
    const Scalar rise = (Way::value(b) - Way::value(a)) / (before + after);
    return before < after ? Way::value(a) + before * rise : Way::value(b) - after * rise;
  }

  slip_curve<Scalar> curve_;
  int next_ = 0;
};

template <class Way, class Scalar>
constexpr slip_range<Scalar> slip_curve_at(const slip_curve<Scalar>& curve, Scalar at) noexcept {
  slip_curve_reader<Scalar, Way> reader(curve);
  while (!reader.at_end() && reader.next() < at) reader.skip();
  return reader.read(at);
}

// Appends a corner to the `count` corners in `to`. Rounding must not make a curve fall.
template <class Way, class Scalar>
constexpr int append_corner(slip_corner<Scalar>* to, int count, Scalar at, Scalar value, bool is_kink) noexcept {
  const bool falls = count > 0 && value < Way::value(to[count - 1]);
  to[count] = Way::corner(at, falls ? Way::value(to[count - 1]) : value, is_kink);
  return count + 1;
}

// The sum of two curves; `to` has room for the corners of both. Returns how many there are.
template <class Way, class Scalar>
constexpr int merge_curves(const slip_curve<Scalar>& first, const slip_curve<Scalar>& second,
                           slip_corner<Scalar>* to) noexcept {
  slip_curve_reader<Scalar, Way> a(first), b(second);
  const int room = first.count + second.count;
  int count = 0;
  for (int i = 0; i < room && !(a.at_end() && b.at_end()); ++i) {
    const Scalar at = a.at_end() || (!b.at_end() && b.next() < a.next()) ? b.next() : a.next();
    const slip_range<Scalar> in_a = a.read(at), in_b = b.read(at);
    if (!in_a.exists || !in_b.exists) continue;
    const bool is_kink = in_a.is_kink || in_b.is_kink;
    count = append_corner<Way>(to, count, at, in_a.low + in_b.low, is_kink);
    if (count < room && (in_a.low < in_a.high || in_b.low < in_b.high))
      count = append_corner<Way>(to, count, at, in_a.high + in_b.high, is_kink);
  }
  return count;
}

// Inserts a point of the curve in order among the `count` corners. Returns how many there then are.
template <class Way, class Scalar>
constexpr int insert_corner(slip_corner<Scalar>* corners, int count, const slip_corner<Scalar>& corner) noexcept {
  int place = count;
  for (; place > 0 && Way::at(corners[place - 1]) > Way::at(corner); --place) corners[place] = corners[place - 1];
  corners[place] = corner;
  return count + 1;
}

// Keeps the kinks, and adds the point at δ = 0 unless that is a kink or lies on a flat end. Returns how many there are.
template <class Scalar>
constexpr int mark_rest(const slip_curve<Scalar>& curve, slip_corner<Scalar>* corners) noexcept {
  const slip_range<Scalar> rest = slip_curve_at<by_elongation<Scalar>>(curve, Scalar(0));
  int count = 0;
  for (int i = 0; i < curve.count; ++i)
    if (corners[i].is_kink) corners[count++] = corners[i];
  const bool is_flat =
      curve.end_slope == Scalar(0) && (corners[0].elongation > Scalar(0) || corners[count - 1].elongation < Scalar(0));
  return rest.is_kink || is_flat ? count
                                 : insert_corner<by_elongation<Scalar>>(corners, count, {Scalar(0), rest.low, false});
}

}  // namespace dashpot
