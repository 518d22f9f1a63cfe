// Runs one network in three ways over samples that are not all finite, and says where they differ in a bit. Compiled at
// the time of the test, with the headers that it is to run.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

namespace points {

constexpr int samples = 300;
constexpr int new_ones = 3;      // a batch of so many points is not reset at first,
constexpr int put_nowhere = 37;  // and one of so many is reset to a NaN

template <class Scalar>
bool same(Scalar a, Scalar b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Moves of all sizes, rests and returns, another one at each point; now and then NaN or infinity.
template <class Scalar>
Scalar position_of(int point, int n) {
  if ((n + 7 * point) % 41 == 40) return std::numeric_limits<Scalar>::quiet_NaN();
  const double phase = 0.05 * (n < 200 ? n : 200) * (1 + 0.1 * point);
  return static_cast<Scalar>(0.02 * std::sin(phase) + 1e-7 * point);
}

template <class Scalar>
Scalar velocity_of(int point, int n) {
  if ((n + 3 * point) % 53 == 52) return std::numeric_limits<Scalar>::infinity();
  if ((n + point) % 61 == 60) return std::numeric_limits<Scalar>::max();  // overflows the force
  return static_cast<Scalar>(0.3 * std::cos(0.05 * n * (1 + 0.1 * point)));
}

template <class Batch>
auto dampings_of(const Batch&, typename Batch::scalar* dampings, long long points) -> decltype(Batch::damping + 0) {
  for (long long i = 0; i < points; ++i) dampings[i] = Batch::damping;
  return 0;
}
inline void dampings_of(...) {}

template <class Batch, class Scalar>
auto step(Batch& batch, const Scalar* p, const Scalar* v, Scalar*, Scalar* f) -> decltype(batch.step(p, v, f)) {
  batch.step(p, v, f);
}
template <class Batch, class Scalar>
auto step(Batch& batch, const Scalar* p, const Scalar* v, Scalar* d, Scalar* f) -> decltype(batch.step(p, v, d, f)) {
  batch.step(p, v, d, f);
}
template <class Batch, class Scalar>
auto output(Batch& batch, const Scalar* p, const Scalar* v, Scalar*, Scalar* f) -> decltype(batch.output(p, v, f)) {
  batch.output(p, v, f);
}
template <class Batch, class Scalar>
auto output(Batch& batch, const Scalar* p, const Scalar* v, Scalar* d, Scalar* f)
    -> decltype(batch.output(p, v, d, f)) {
  batch.output(p, v, d, f);
}

// Parameters are set now and then, to other values at each point: within their ranges, beyond them, and to NaN.
template <class Scalar, class Parameters>
Parameters parameters_of(int point, int n, const Scalar* largest, std::size_t count) {
  Parameters wanted;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = 0.55 + 0.55 * std::sin(1.7 * n + 0.9 * point + 2.3 * static_cast<double>(i));
    Scalar value = static_cast<Scalar>(share) * largest[i];
    if ((n + point + static_cast<int>(i)) % 29 == 28) value = std::numeric_limits<Scalar>::quiet_NaN();
    std::memcpy(reinterpret_cast<char*>(&wanted) + i * sizeof value, &value, sizeof value);
  }
  return wanted;
}

template <class Law, class Timed, class Batch>
struct Run {
  using scalar = typename Law::scalar;

  explicit Run(int points)
      : laws(static_cast<std::size_t>(points)),
        timed(laws.size()),
        storage(static_cast<std::size_t>(Batch::storage_size(points))),
        split_storage(storage.size()),
        batch(storage.data(), points),
        split(split_storage.data(), points),
        p(laws.size()),
        v(laws.size()),
        f(laws.size()),
        d(laws.size()),
        split_f(laws.size()),
        split_d(laws.size()) {
    dampings_of(batch, d.data(), points);
    split_d = d;
    if (points == new_ones) return;
    const scalar start = points == put_nowhere ? std::numeric_limits<scalar>::quiet_NaN() : static_cast<scalar>(0.001);
    for (std::size_t i = 0; i < laws.size(); ++i) {
      laws[i].reset(start);
      timed[i].reset(start);
    }
    batch.reset(start);
    split.reset(start);
  }

  // With the largest value of each parameter, where there are some.
  template <std::size_t Count>
  bool differs_after_set(int n, const scalar (&largest)[Count]) {
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const int point = static_cast<int>(i);
      if ((n + 3 * point) % 5 != 0) continue;
      const auto wanted = parameters_of<scalar, typename Law::parameters>(point, n, largest, Count);
      const unsigned expected = laws[i].set(wanted);
      const auto for_timed = parameters_of<scalar, typename Timed::parameters>(point, n, largest, Count);
      const auto for_batch = parameters_of<scalar, typename Batch::parameters>(point, n, largest, Count);
      if (timed[i].set(for_timed) != expected || batch.set(point, for_batch) != expected ||
          split.set(point, for_batch) != expected)
        return std::printf("set() of sample %d, point %d says otherwise\n", n, point) > 0;
    }
    return false;
  }

  // As a law that has been used is put to rest again.
  void reset_some(int n) {
    for (std::size_t i = static_cast<std::size_t>(n) % 7; i < laws.size(); i += 7) {
      const auto at = static_cast<scalar>(1e-3 * static_cast<double>(n % 5) - 2e-3);
      laws[i].reset(at);
      timed[i].reset(at);
      batch.reset_point(static_cast<long long>(i), at);
      split.reset_point(static_cast<long long>(i), at);
    }
  }

  bool differs_at(int n) {
    for (std::size_t i = 0; i < laws.size(); ++i) {
      p[i] = position_of<scalar>(static_cast<int>(i), n);
      v[i] = velocity_of<scalar>(static_cast<int>(i), n);
    }
    step(batch, p.data(), v.data(), d.data(), f.data());
    output(split, p.data(), v.data(), split_d.data(), split_f.data());
    split.update(p.data(), v.data());
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const auto expected = laws[i].step(p[i], v[i]), found = timed[i].step(p[i], v[i]);
      if (!same(expected.force, found.force) || !same(expected.damping, found.damping))
        return says("constant time", n, i, expected.force, found.force);
      if (!same(expected.force, f[i]) || !same(expected.damping, d[i]))
        return says("batch", n, i, expected.force, f[i]);
      if (!same(expected.force, split_f[i]) || !same(expected.damping, split_d[i]))
        return says("batch in two phases", n, i, expected.force, split_f[i]);
      const scalar energy = laws[i].stored_energy(), others = batch.stored_energy(static_cast<long long>(i));
      if (!same(energy, others) || !same(energy, timed[i].stored_energy())) return says("energy", n, i, energy, others);
    }
    return false;
  }

  static bool says(const char* what, int n, std::size_t point, scalar expected, scalar found) {
    std::printf("%s, sample %d, point %zu: %.17g, single %.17g\n", what, n, point, static_cast<double>(found),
                static_cast<double>(expected));
    return true;
  }

  std::vector<Law> laws;
  std::vector<Timed> timed;
  std::vector<scalar> storage, split_storage;
  Batch batch, split;
  std::vector<scalar> p, v, f, d, split_f, split_d;
};

template <class Law, class Timed, class Batch>
bool differ(const char* name) {
  for (int points : {1, 3, 16, 37}) {
    Run<Law, Timed, Batch> run(points);
    for (int n = 0; n < samples; ++n)
      if (run.differs_at(n)) {
        std::printf("  in %s with %d points\n", name, points);
        return true;
      }
  }
  return false;
}

// The same with parameters that change between samples.
template <class Law, class Timed, class Batch, std::size_t Count>
bool differ_when_set(const char* name, const typename Law::scalar (&largest)[Count]) {
  for (int points : {1, 3, 37}) {
    Run<Law, Timed, Batch> run(points);
    for (int n = 0; n < 1500; ++n) {
      if (n % 97 == 96) run.reset_some(n);
      if (run.differs_after_set(n, largest) || run.differs_at(n)) {
        std::printf("  in %s with %d points\n", name, points);
        return true;
      }
    }
  }
  return false;
}

// A batch with storage of its own.
template <class Law, class Points>
bool own_storage_differs(const char* name) {
  using scalar = typename Law::scalar;
  static Points points;
  std::vector<Law> laws(static_cast<std::size_t>(points.points()));
  std::vector<scalar> p(laws.size()), v(laws.size()), f(laws.size());
  for (int n = 0; n < samples; ++n) {
    for (std::size_t i = 0; i < laws.size(); ++i) p[i] = position_of<scalar>(static_cast<int>(i), n);
    points.step(p.data(), v.data(), f.data());
    for (std::size_t i = 0; i < laws.size(); ++i)
      if (!same(laws[i].step(p[i], v[i]).force, f[i])) return std::printf("%s, sample %d, point %zu\n", name, n, i) > 0;
  }
  return false;
}

}  // namespace points
