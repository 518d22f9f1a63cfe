// A tool stuck to muscle is drawn along the fibres, then across them, then pressed in, and held. What the tissue
// answers is a force vector. Writes it as a table, and ends with 1 where it is not the closed form of three standard
// linear solids.
#include <cmath>
#include <cstdio>
#include <cstring>

#include <desktop_arm_device.hpp>

#include "tissue.hpp"

// As CHAI3D's cVector3d, with what this program needs of it.
class vector3 {
 public:
  vector3(double x, double y, double z) : x_(x), y_(y), z_(z) {}
  double x() const { return x_; }
  double y() const { return y_; }
  double z() const { return z_; }

 private:
  double x_, y_, z_;
};

using described = dashpot::devices::desktop_arm;

constexpr double speed = 0.02;   // [m/s]
constexpr double stroke = 8e-3;  // [m] on each axis
constexpr double ramp = stroke / speed;

// The values of the network files, once more by hand.
struct solid {
  double stiffness, branch, relaxation;  // [N/m], [N/m], [s]
};
constexpr solid along_fibres{300, 200, 0.4}, across_fibres{120, 80, 0.25}, into_muscle{200, 400, 0.15};

// Drawn from `start` on for a ramp, and then held (Findley, Lai & Onaran 1976).
double closed_form(const solid& of, double since_start) {
  if (since_start <= 0) return 0;
  const double drawn = std::fmin(since_start, ramp), held = since_start - drawn;
  return of.stiffness * speed * drawn +
         of.branch * speed * of.relaxation * (1 - std::exp(-drawn / of.relaxation)) * std::exp(-held / of.relaxation);
}

double position_of(double since_start) { return speed * std::fmin(std::fmax(since_start, 0), ramp); }
double velocity_of(double since_start) { return since_start > 0 && since_start <= ramp ? speed : 0; }

template <class Law>
bool is_made_for_the_arm() {
  return std::strcmp(Law::certified_for::device_digest, described::digest) == 0;
}

int main(int, char** arguments) {
  constexpr dashpot::device_description facts = described::description();
  const double period = facts.loop.sample_period;  // [s]
  std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr;
  if (table) std::fputs("curve,time [s],force [N]\n", table);

  const vector3 start(0.1, -0.05, 0.02);
  anisotropic_tissue<vector3> muscle(start);
  double worst = 0, work = 0, largest = 0;  // [N], [J], [N]
  vector3 last = start, before(0, 0, 0);
  const int samples = static_cast<int>(4 * ramp / period);
  for (int k = 0; k <= samples; ++k) {
    const double x = k * period, y = x - ramp, z = x - 2 * ramp;  // [s] since each axis began
    const vector3 position(start.x() + position_of(x), start.y() + position_of(y), start.z() + position_of(z));
    const vector3 velocity(velocity_of(x), velocity_of(y), velocity_of(z));  // as getLinearVelocity() gives it
    const vector3 force = muscle.force(position, velocity);
    const double off[] = {force.x() + closed_form(along_fibres, x), force.y() + closed_form(across_fibres, y),
                          force.z() + closed_form(into_muscle, z)};
    for (const double difference : off) worst = std::fmax(worst, std::fabs(difference));
    largest = std::fmax(largest, std::fabs(force.x()));
    work -= 0.5 * ((force.x() + before.x()) * (position.x() - last.x()) +
                   (force.y() + before.y()) * (position.y() - last.y()) +
                   (force.z() + before.z()) * (position.z() - last.z()));
    last = position;
    before = force;
    if (table && k % 40 == 0) {
      std::fprintf(table, "along,%.2f,%.4f\n", x, -force.x());
      std::fprintf(table, "across,%.2f,%.4f\n", x, -force.y());
      std::fprintf(table, "into,%.2f,%.4f\n", x, -force.z());
    }
  }
  if (table) std::fclose(table);
  const bool is_certified = is_made_for_the_arm<dashpot::generated::along>() &&
                            is_made_for_the_arm<dashpot::generated::across>() &&
                            is_made_for_the_arm<dashpot::generated::into>();
  const vector3 lost = muscle.force(vector3(std::nan(""), last.y(), last.z()), vector3(0, 0, 0));
  const bool right = worst < 1e-12 * largest && work > muscle.stored_energy() && lost.x() == 0 && lost.y() != 0;
  std::printf("three axes as by hand, to 1e-12 of the largest force: %s\n", worst < 1e-12 * largest ? "yes" : "no");
  std::printf("the hand put in %.1f mJ, %.1f mJ are stored\n", work * 1e3, muscle.stored_energy() * 1e3);
  std::printf("made for %s: %s\n", described::name, is_certified ? "yes" : "no");
  return right && is_certified ? 0 : 1;
}
