// The two passivity controllers, by themselves and on a simulated device with a spring that comes too late.
#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/actuator.hpp>
#include <dashpot/energy/brake_controller.hpp>
#include <dashpot/energy/hold_observer.hpp>
#include <dashpot/energy/motor_controller.hpp>
#include <dashpot/simulated/simulated_device.hpp>

namespace dashpot {
namespace {

// If this failed, the brake would not repay exactly what is owed, or would go beyond its limit, or below what the model
// wants.
TEST(BrakeController, RepaysTheDebtWithinTheLimit) {
  const brake_controller<double> controller(10, 0.2);
  const double moved = 1e-3, period = 1e-3;
  // W + m Δu + 0.8 b Δu²/Δt = 0 for W = −5 mJ, m = 1 N.
  EXPECT_NEAR(controller.raise({1, 1}, -0.005, moved, period), 0.004 / (0.8 * moved * moved / period), 1e-12);
  EXPECT_EQ(controller.raise({1, 1}, 0, moved, period), 1);
  EXPECT_EQ(controller.raise({7, 1}, -0.005, moved, period), 7);
  EXPECT_EQ(controller.raise({1, 1}, -0.5, moved, period), 10);
  EXPECT_EQ(controller.raise({12, 1}, -0.5, moved, period), 12);
  // A motor that is about to push along the motion needs the brake before anything is owed.
  EXPECT_NEAR(controller.raise({0, -4}, 0.001, moved, period), 0.003 / (0.8 * moved * moved / period), 1e-12);
  // At rest nothing can be repaid yet, and nothing is divided by zero.
  EXPECT_EQ(controller.raise({1, 1}, -0.005, 0, period), 10);
  EXPECT_EQ(controller.raise({1, 1}, 0, 0, period), 1);
}

// If this failed, what the network has stored would be given away for nothing.
TEST(BrakeController, GuardsWhatIsStored) {
  const brake_controller<double> controller(10, 0);
  EXPECT_EQ(controller.raise_to_stored({0.5, 3}, 0.004, 0.004, 1e-3, 1e-3), 0.5);
  EXPECT_NEAR(controller.raise_to_stored({0.5, 3}, 0.004, 0.006, 1e-3, 1e-3), 2, 1e-12);
}

// If this failed, the classical controller would not bring its own account back to zero, or would act without need.
TEST(MotorController, DampsExactlyWhatIsMissing) {
  motor_controller<double> controller(100);
  EXPECT_EQ(controller.limit(2, 0.1, 0.001), 2);
  EXPECT_NEAR(controller.energy(), 2e-4, 1e-18);
  // Gives back 5e-4 J of the 2e-4 J: α = 3e-4/(v² Δt) = 30.
  EXPECT_NEAR(controller.limit(5, -0.1, 0.001), 5 - 30 * 0.1, 1e-12);
  EXPECT_NEAR(controller.energy(), 0, 1e-18);
  EXPECT_EQ(controller.limit(-1, 0, 0.001), -1);
  controller.reset();
  EXPECT_NEAR(controller.limit(50, -0.1, 0.001), 50 - 100 * 0.1, 1e-12);
  EXPECT_NEAR(controller.energy(), -0.005 + 0.001, 1e-15);
}

enum class guard { none, brake, brake_to_stored, motor };

struct outcome {
  double most_returned = 0;   // largest kinetic energy, over that of the throw
  double most_given = 0;      // motor's work beyond what the brake has dissipated, over the same
  double most_damping = 0;    // true, of the brake [N·s/m]
  double final_speed = 0;     // largest in the last tenth of the run [m/s]
  double observer_error = 0;  // of the motor's work, largest [J]
  double over_credit = 0;     // of the brake's dissipation beyond the true one, largest [J]
};

constexpr double stiffness = 2000, throw_speed = 0.1, mass = 0.2, period = 0.001;

// The worst brake within its tolerance, behind a coil.
device_description weak_device(double encoder_step) {
  device_description device;
  device.loop.sample_period = period;
  device.mechanics.inertia = mass;
  device.mechanics.damping = 2.5;
  device.encoder.step = encoder_step;
  device.brake.kind = brake_kind::eddy_current;
  device.brake.max_damping = 15;
  device.brake.coil_lag = 0.001;
  device.brake.tolerance = 0.1;
  return device;
}

simulated::scenario throw_it() {
  simulated::scenario scene;
  scene.initial_velocity = throw_speed;
  scene.gain = simulated::brake_gain::lowest;
  return scene;
}

void record(const simulated_device& plant, const hold_observer<double>& observer, bool at_the_end, outcome& seen) {
  const double thrown = mass * throw_speed * throw_speed / 2;
  const simulated::plant_view truth = plant.truth();
  const simulated::energy_ledger& ledger = plant.ledger();
  seen.most_returned = std::max(seen.most_returned, mass * truth.velocity * truth.velocity / 2 / thrown);
  seen.most_given = std::max(seen.most_given, (ledger.motor - ledger.brake) / thrown);
  seen.most_damping = std::max(seen.most_damping, truth.brake_damping);
  seen.observer_error = std::max(seen.observer_error, std::abs(observer.motor_energy() + ledger.motor));
  seen.over_credit = std::max(seen.over_credit, observer.brake_energy() - ledger.brake);
  if (at_the_end) seen.final_speed = std::max(seen.final_speed, std::abs(truth.velocity));
}

// A light tool is thrown against a spring, to either side, that comes two samples late: it needs K T/2 (1 + 2·2)
// = 5 N·s/m of damping (theory.md, section 6), twice what the device has.
outcome throw_against_late_spring(guard guard, double encoder_step = 0) {
  const device_description device = weak_device(encoder_step);
  simulated_device plant(device, throw_it());
  actuator<double> drive(device, motion::translation);
  hold_observer<double> observer(0, encoder_step);
  const brake_controller<double> by_brake(device.brake.max_damping, device.brake.tolerance);
  motor_controller<double> by_motor(15);
  device_sample sample;
  outcome seen;
  double before = 0, two_before = 0;
  const int samples = 2000;
  for (int k = 0; k < samples; ++k) {
    plant.read(sample);
    if (k > 0) observer.observe(sample.position, period);
    const double moved = sample.position - before;
    command<double> wanted{0, stiffness * two_before};
    two_before = before;
    before = sample.position;
    const double stored = stiffness * sample.position * sample.position / 2;
    record(plant, observer, k >= samples * 9 / 10, seen);
    if (guard == guard::brake) wanted.damping = by_brake.raise(wanted, observer.balance(), moved, period);
    if (guard == guard::brake_to_stored) {
      wanted.damping = by_brake.raise_to_stored(wanted, observer.balance(), stored, moved, period);
    }
    if (guard == guard::motor) wanted.force = by_motor.limit(wanted.force, moved / period, period);
    const actuator_output<double> output = drive.drive(wanted, moved / period);
    plant.write(output.demand());
    observer.hold(output.applied_force, output.assured_damping);
  }
  return seen;
}

// If this failed, the experiment would prove nothing: the late spring must run away where nobody guards it.
TEST(Controllers, LateSpringRunsAwayUnguarded) { EXPECT_GT(throw_against_late_spring(guard::none).most_returned, 1e6); }

// If this failed, the brake would let the spring give back more than was thrown in, or would need more than it has.
TEST(Controllers, BrakeRestoresPassivityWithinItsLimits) {
  for (const double encoder_step : {0.0, 1e-6, 30e-6}) {
    for (const guard by : {guard::brake, guard::brake_to_stored}) {
      const outcome seen = throw_against_late_spring(by, encoder_step);
      EXPECT_LE(seen.most_returned, 1);
      EXPECT_LT(seen.most_given, 1);
      EXPECT_LE(seen.most_damping, 0.9 * 15 * (1 + 1e-12));
      EXPECT_LT(seen.final_speed, 1e-3 * throw_speed);
    }
  }
}

// If this failed, guarding what is stored would react no earlier than guarding the whole: that is what it is for.
TEST(Controllers, GuardingTheStoredReactsEarlier) {
  EXPECT_LT(throw_against_late_spring(guard::brake_to_stored).most_given,
            throw_against_late_spring(guard::brake).most_given / 10);
}

// If this failed, the classical controller would not tame the spring, or it would tame it as well as the brake does: it
// does not see what the hold creates, and leaves that to the device's own damping.
TEST(Controllers, MotorRestoresPassivityAtAPrice) {
  const outcome by_motor = throw_against_late_spring(guard::motor);
  const outcome by_brake = throw_against_late_spring(guard::brake);
  EXPECT_LT(by_motor.final_speed, throw_speed / 10);
  EXPECT_GT(by_motor.most_returned, by_brake.most_returned);
  EXPECT_GT(by_motor.most_given, 10 * by_brake.most_given);
}

// If this failed, the observer would miscount the motor's work, or credit the brake with what a weak one behind its
// coil never did.
TEST(Controllers, ObserverIsRightAboutTheDevice) {
  for (const guard by : {guard::brake, guard::brake_to_stored, guard::motor}) {
    const outcome exact = throw_against_late_spring(by);
    // Rounding of 2000 products of some millijoules.
    EXPECT_LT(exact.observer_error, 1e-16);
    EXPECT_LE(exact.over_credit, 1e-16);
    EXPECT_LE(throw_against_late_spring(by, 30e-6).over_credit, 0);
  }
}

}  // namespace
}  // namespace dashpot
