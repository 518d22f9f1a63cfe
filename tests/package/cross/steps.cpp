#include <tissue.hpp>

extern "C" float force_in_cpp(float position, float velocity);

float force_in_cpp(float position, float velocity) {
  static dashpot::generated::tissue tissue;
  return tissue.step(position, velocity).force;
}
