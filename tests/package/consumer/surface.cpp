// Points of a surface, pressed side by side, and each of them alone. Returns 0 where the two agree in every bit.
#include <surface.hpp>
#include <surface_batch.hpp>

int main() {
  static dashpot::generated::surface_points<100> points;
  static dashpot::generated::surface alone[100];
  float positions[100], velocities[100] = {}, forces[100];
  for (int sample = 0; sample < 50; ++sample) {
    for (int i = 0; i < 100; ++i) positions[i] = 1e-5f * static_cast<float>(i * sample % 70);
    points.step(positions, velocities, forces);
    for (int i = 0; i < 100; ++i)
      if (alone[i].step(positions[i], velocities[i]).force != forces[i]) return 1;
  }
  return forces[99] != 0 ? 0 : 1;
}
