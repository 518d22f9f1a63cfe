#include <dashpot/simulated/sample_clock.hpp>

#include <algorithm>

#include <dashpot/simulated/draw.hpp>

namespace dashpot::simulated {
namespace {

double jitter_of(const loop_description& loop, std::uint64_t seed, std::uint64_t index) noexcept {
  if (!(loop.jitter > 0) || index == 0) return 0;
  return loop.jitter * draw_uniform(seed, draw_stream::jitter, index);
}

}  // namespace

sample_clock::step sample_clock::advance(const loop_description& loop, std::uint64_t seed,
                                         const std::vector<sample_fault>& faults) noexcept {
  const double lateness_before = jitter_of(loop, seed, index_);
  ++index_;
  const sample_fault* fault = fault_at(faults, index_);
  const double delay = fault && fault->kind == sample_fault_kind::late ? fault->size : 0;
  postponed_ += delay;
  const double period = loop.sample_period, lateness = jitter_of(loop, seed, index_);
  return {period + (lateness - lateness_before) + delay, static_cast<double>(index_) * period + postponed_ + lateness};
}

double sample_clock::until_write(const loop_description& loop, std::uint64_t seed, double duration) const noexcept {
  const double range = loop.write_latest - loop.write_earliest;
  const double later = range > 0 ? range * draw_uniform(seed, draw_stream::write, index_) : 0;
  return std::min(loop.write_earliest + later, duration);
}

}  // namespace dashpot::simulated
