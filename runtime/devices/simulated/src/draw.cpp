#include <dashpot/simulated/draw.hpp>

#include <cmath>

namespace dashpot::simulated {
namespace {

// SplitMix64 (Steele, Lea & Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

double draw_uniform(std::uint64_t seed, draw_stream stream, std::uint64_t index) {
  const std::uint64_t bits = mix(mix(mix(seed) + static_cast<std::uint64_t>(stream)) + index);
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// Box and Muller.
double draw_normal(std::uint64_t seed, draw_stream stream, std::uint64_t index) {
  const double radius = std::sqrt(-2 * std::log(1 - draw_uniform(seed, stream, 2 * index)));
  return radius * std::cos(2 * 3.14159265358979323846 * draw_uniform(seed, stream, 2 * index + 1));
}

}  // namespace dashpot::simulated
