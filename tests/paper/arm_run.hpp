// Laws of two axes on the simulated arm, its joints led along a given motion.
#pragma once

#include <dashpot/arm_description.hpp>
#include <dashpot/command.hpp>
#include <dashpot/simulated/arm_scenario.hpp>

#include <string>
#include <vector>

namespace dashpot::paper {

using ArmCommand = commands<double, 2, 2>;

class ArmLaw {
 public:
  virtual ~ArmLaw() = default;
  virtual void reset(const double (&position)[2]) = 0;
  virtual ArmCommand output(const double (&position)[2], const double (&velocity)[2]) = 0;
  virtual void update() = 0;
};

// A class that dashpot has emitted, or one written by hand in the same form.
template <class Emitted>
class ArmLawOf final : public ArmLaw {
 public:
  explicit ArmLawOf(Emitted law = {}) : law_(law) {}
  void reset(const double (&position)[2]) override { law_.reset(position); }
  ArmCommand output(const double (&position)[2], const double (&velocity)[2]) override {
    return law_.output(position, velocity);
  }
  void update() override { law_.update(); }

 private:
  Emitted law_;
};

// At one sample. Forces and torques oppose the motion.
struct ArmSample {
  double time = 0;              // [s]
  double tip[2] = {};           // [m]
  double tip_velocity[2] = {};  // [m/s]
  ArmCommand commanded = {};
  double force[2] = {};  // of motors and brakes at the tip, mean of just before the sample and just after [N]
  double taken = 0;      // energy that motors and brakes took from the hand until now [J]
};
using ArmTrace = std::vector<ArmSample>;

// From time 0 to the end, of a law that has not begun.
ArmTrace run_law(const arm_description& arm, const simulated::arm_scenario& scene, double duration, ArmLaw& law);

// The same of a law of any class.
template <class Law>
ArmTrace run(const arm_description& arm, const simulated::arm_scenario& scene, double duration, const Law& law = {}) {
  ArmLawOf<Law> begun(law);
  return run_law(arm, scene, duration, begun);
}

// devices/NAME.json as the build has written it.
arm_description arm_of(const std::string& name);

// A tool in the plane with true positions and velocities, whose brakes and motors do what they are told at once.
arm_description ideal_plane(double sample_period);

// Mean power that was taken from one time to another [W].
double mean_power(const ArmTrace& trace, double from, double to);

// The least energy that had been taken at any time [J].
double least_taken(const ArmTrace& trace);

}  // namespace dashpot::paper
