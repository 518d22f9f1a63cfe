#include "experiment.hpp"

#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <deque>

namespace dashpot::paper {
namespace {

// The estimate of `lateness` samples ago; 0 before there was one.
class DelayLine {
 public:
  explicit DelayLine(unsigned lateness) : line_(lateness + 1, 0.0) {}
  double update(double value) {
    line_.pop_front();
    line_.push_back(value);
    return line_.front();
  }

 private:
  std::deque<double> line_;
};

device_description with_estimator(device_description plant, const velocity_description& velocity) {
  plant.velocity = velocity;
  return plant;
}

class Run {
 public:
  Run(const Experiment& experiment, const Realisation& realisation)
      : plant_(with_estimator(experiment.plant, realisation.velocity)),
        device_(plant_, experiment.motion),
        estimator_(plant_.velocity, plant_.loop.sample_period, plant_.encoder.step),
        late_(realisation.lateness),
        actuator_(plant_, motion::translation),
        law_(realisation.law()) {}

  Trace over(double duration) {
    const long last = std::lround(duration / plant_.loop.sample_period);
    Trace trace;
    trace.reserve(static_cast<std::size_t>(last) + 1);
    for (long k = 0; k <= last; ++k) trace.push_back(step(k == 0));
    return trace;
  }

 private:
  Sample step(bool first) {
    device_sample reading;
    device_.read(reading);
    if (first) {
      estimator_.reset(reading.position);
      law_->reset(actuator_.gear().tool_motion(reading.position));
    }
    Sample sample = truth();
    sample.measured = actuator_.gear().tool_motion(reading.position);
    sample.estimate = late_.update(actuator_.gear().tool_motion(estimator_.update(reading)));
    sample.commanded = law_->output(sample.measured, sample.estimate);
    device_.write(actuator_.drive(sample.commanded, sample.estimate).demand());
    law_->update();
    return sample;
  }

  Sample truth() const {
    const simulated::plant_view now = device_.truth();
    const transmission<double>& gear = actuator_.gear();
    Sample sample;
    sample.time = now.time;
    sample.position = gear.tool_motion(now.position);
    sample.velocity = gear.tool_motion(now.velocity);
    sample.motor = -gear.tool_force(now.motor_torque);
    sample.damping = gear.tool_damping(now.brake_damping);
    sample.hand = gear.tool_force(now.hand_torque);
    return sample;
  }

  device_description plant_;
  simulated_device device_;
  any_estimator<double> estimator_;
  DelayLine late_;
  actuator<double> actuator_;
  std::unique_ptr<Law> law_;
};

}  // namespace

Trace run(const Experiment& experiment, const Realisation& realisation) {
  return Run(experiment, realisation).over(experiment.duration);
}

std::vector<Trace> run(const Experiment& experiment) {
  std::vector<Trace> traces;
  for (const Realisation& realisation : experiment.realisations) traces.push_back(run(experiment, realisation));
  return traces;
}

}  // namespace dashpot::paper
