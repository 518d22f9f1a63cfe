// What is certified of several ports side by side, against motions that take as much energy as they can: each port is
// proved on its share of the device, and the sum is claimed of all of them together.
#include <cmath>

#include "curve_attack.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

// A curve or none, in contact or not, with relaxations, a damper, or a slip.
std::string random_port(std::uint64_t seed, Random& random, double at, int number, bool with_brake) {
  std::string more;
  const bool has_curve = random.chance(0.6), in_contact = random.chance(0.3);
  if (has_curve)
    more += R"("static": )" + curve_of(seed + std::uint64_t(number), random, at, random.log_uniform(0.3, 5)) + ", ";
  if (in_contact) more += fmt::format(R"("contact": {{ "at": {:.9g} }}, )", random.uniform(-0.3, 0.3) * at);
  std::string elements = fmt::format(R"({{ "spring": {:.9g} }})", random.log_uniform(50, 2000));
  for (std::size_t i = 0, modes = random.index(3); i < modes; ++i) {
    const double stiffness = random.log_uniform(20, 2000);
    elements += fmt::format(R"(, {{ "series": [ {{ "spring": {:.9g} }}, {{ "damper": {:.9g} }} ] }})", stiffness,
                            stiffness * random.log_uniform(0.02, 20));
  }
  if (random.chance(0.3) && !in_contact)
    elements += fmt::format(R"(, {{ "series": [ {{ "spring": {:.9g} }}, {{ "slip": {:.9g} }} ] }})",
                            random.log_uniform(200, 5000), random.log_uniform(0.05, 2));
  if (with_brake && !in_contact && random.chance(0.5))
    elements += fmt::format(R"(, {{ "damper": {:.9g} }})", random.log_uniform(0.1, 20));
  return fmt::format(R"({{ "name": "port_{}", {}"network": {{ "parallel": [ {} ] }} }})", number, more, elements);
}

Case random_ports(std::uint64_t seed, bool with_brake) {
  Random random(seed);
  const double at = random.log_uniform(1e-3, 1e-2);
  std::string ports;
  for (int i = 0, count = 2 + int(seed % 2); i < count; ++i)
    ports += (i == 0 ? "" : ", ") + random_port(seed, random, at, i, with_brake);
  Case one;
  one.in_contact = false;
  one.network = fmt::format(R"({{ "dashpot": 1, "name": "curved", "ports": [ {} ],
                                  "valid": {{ "displacement": {:.9g} }} }})",
                            ports, random.uniform(0.7, 1.5) * at);
  one.loop = {1 / random.log_uniform(500, 5000), 0,
              random.log_uniform(0.01, 0.5),     random.uniform(1, 2) * at,
              with_brake ? 100.0 : 0.0,          unsigned(seed / 7 % 2)};
  one.loop.jitter = random.chance(0.5) ? 0 : random.uniform(0, 0.3) * one.loop.period;
  // Behind a curve nothing is proved at the limit of a motor that is late.
  if (one.loop.delay == 0 && random.chance(0.6)) one.loop.force = random.log_uniform(0.1, 5);
  return one;
}

constexpr double rounding = 1e-12;  // of what a period exchanges at most, in each of them
constexpr int samples = 2000;

// Wanders, trembles as fast as it can, and goes where the held force gives most.
Balance after_attacks(const Compilation& c, const Case& one, double damping, std::uint64_t seed) {
  Balance worst;
  for (const double share : {0.9, 1.1}) {
    Random random(1000 + seed);
    Attack attack(c, one.loop, damping);
    attack.wait();
    double goal = 0;
    for (int k = 0; k < samples; ++k) {
      if (random.chance(0.02)) goal = random.uniform(-1, 1) * one.loop.travel;
      if (k / 100 % 3 == 2) attack.take(random.uniform(0, 2), share);
      else attack.go(goal + (k % 2 == 0 ? 1 : -1) * random.uniform() * one.loop.speed * one.loop.period, share);
    }
    worst.least = std::min(worst.least, attack.balance().least);
    worst.largest = std::max(worst.largest, attack.balance().largest);
  }
  return worst;
}

// If this fails, ports that are called certified side by side give out energy.
TEST(Ports, CertifiedLawsGiveOutNoEnergy) {
  int certified = 0, limited = 0;
  const int cases = int(repetitions(10, 1000));
  for (std::uint64_t seed = 1; seed <= std::uint64_t(cases); ++seed) {
    const Case one = random_ports(seed, true);
    double damping = 0.3;
    Compilation c = on(one, damping);
    // A contact asks for damping of the device's own, on its share of it: as much as it takes.
    const auto is_proved = [&] { return c.certificate.certified && c.certificate.limits.is_covered; };
    for (int attempt = 0; attempt < 5 && !is_proved(); ++attempt)
      c = on(one, damping = std::max(4 * damping, 1.0000001 * c.certificate.bound.needed));
    if (!is_proved()) continue;
    ++certified;
    limited += c.law.sheds();
    const Balance balance = after_attacks(c, one, damping, seed);
    EXPECT_GE(balance.least, -rounding * samples * balance.largest) << seed << " " << one.network;
  }
  EXPECT_GT(certified, cases * 6 / 10);
  EXPECT_GT(limited, cases / 10);
}

// If this fails, the sum asks for much more than the ports need together: most laws give out energy with nine tenths of
// it, and with all of it none, whether their slips hold nothing or have given way on the way. Where places at which one
// port needs most are not those of another it is fewer than of one port.
TEST(Ports, SomeLawsGiveOutEnergyWithNineTenths) {
  int cases = 0, gains = 0;
  for (std::uint64_t seed = 1; seed <= repetitions(12, 300); ++seed) {
    Case one = random_ports(seed, false);
    one.loop.delay = 0;
    one.loop.force = 1e6;
    one.loop.speed = 0.001 * one.loop.travel / one.loop.period;
    const Compilation first = on(one, 1e3, "virtual");
    if (!first.certificate.certified) continue;
    const double needed = 1.0000001 * first.certificate.bound.needed;
    ++cases;
    bool gained = false;
    for (int i = -40; i <= 40; ++i)
      for (const double part : {1.0, 0.1}) {
        const double place = one.loop.travel * i / 40;
        const Balance less = after_trembling(first, one.loop, 0.9 * needed, place, part);
        gained = gained || less.least < -rounding * trembles * less.largest;
        const Balance enough = after_trembling(first, one.loop, needed, place, part);
        EXPECT_GE(enough.least, -rounding * trembles * enough.largest) << seed << " " << place << " " << one.network;
        if (i % 8 != 0) continue;
        const double from = (i % 16 == 0 ? 0.2 : -0.2) * one.loop.travel;
        const Balance loaded = after_coming(first, one.loop, needed, place, from, part);
        EXPECT_GE(loaded.least, -rounding * trembles * loaded.largest) << seed << " " << place << " " << one.network;
      }
    gains += gained;
  }
  RecordProperty("cases", cases);
  RecordProperty("gains", gains);
  EXPECT_GE(cases, int(repetitions(12, 300)) * 8 / 10);
  EXPECT_GE(gains, cases * 7 / 10) << "of " << cases;
}

}  // namespace
}  // namespace dashpot::testing
