// The simulated device as a loop sees it: time, delay, faults, repeatability.
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// If this failed, samples would not lie a period apart, or be numbered otherwise.
TEST(Device, TimeGoesOnByOnePeriodARead) {
  simulated_device device(plain_device());
  device_sample sample;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    EXPECT_EQ(device.read(sample), device_status::ok);
    EXPECT_EQ(sample.sequence, k);
    EXPECT_EQ(sample.timestamp_ns, k * 1000000);
  }
}

// If this failed, a network that rotates would be led by the arm, which only one that moves the tool has to do with; or
// one that does not move as the joint would be simulated without an arm.
TEST(Device, TheNetworkSaysWhetherTheArmIsBetween) {
  device_description arm = imperfect_arm();
  scenario scene;
  scene.initial_position = 0.01;
  for (const auto& [network, angle] :
       {std::pair(motion::translation, 0.01 / 0.05), std::pair(motion::rotation, 0.01)}) {
    scene.network = network;
    EXPECT_DOUBLE_EQ(simulated_device(arm, scene).truth().position, angle);
  }
  arm.arm_radius = 0;
  EXPECT_EQ(simulated_device::refusal(arm, scene), nullptr);
  scene.network = motion::translation;
  EXPECT_NE(simulated_device::refusal(arm, scene), nullptr);
}

// If this failed, jitter would exceed its bound, add up from sample to sample, or not be there at all.
TEST(Device, JitterDelaysEachSampleByItself) {
  device_description description = plain_device();
  description.loop.jitter = 0.0004;
  simulated_device device(description);
  device_sample sample;
  double least = 1, most = 0;
  device.read(sample);
  for (std::uint64_t k = 1; k < 1000; ++k) {
    device.read(sample);
    const double lateness = static_cast<double>(sample.timestamp_ns) * 1e-9 - static_cast<double>(k) * 0.001;
    least = std::min(least, lateness);
    most = std::max(most, lateness);
  }
  // Timestamps are rounded to 1 ns; 1000 draws come near both ends.
  EXPECT_GT(least, -1e-9);
  EXPECT_LT(least, 0.00001);
  EXPECT_LT(most, 0.0004 + 1e-9);
  EXPECT_GT(most, 0.00039);
}

// If this failed, the motion would go on for another time than the sample's, so that jitter would look like noise of
// the position.
TEST(Device, JitteredSamplesShowTheMotionAtTheirOwnTime) {
  device_description description = plain_device();
  description.loop.jitter = 0.0004;
  scenario scene;
  scene.initial_velocity = 0.3;
  scene.faults = {{sample_fault_kind::late, 50, 2, 0.0123}};
  simulated_device device(description, scene);
  device_sample sample;
  for (int k = 0; k < 200; ++k) {
    device.read(sample);
    // The timestamp is rounded to a nanosecond.
    EXPECT_NEAR(sample.position, 0.3 * static_cast<double>(sample.timestamp_ns) * 1e-9, 0.3 * 0.51e-9);
  }
}

// If this failed, a command would take effect at another sample than the device's loop delay says.
TEST(Device, CommandsTakeEffectAfterTheLoopDelay) {
  for (unsigned delay : {0u, 1u, 3u}) {
    device_description description = plain_device();
    description.loop.delay_samples = delay;
    simulated_device device(description);
    device_sample sample;
    for (unsigned k = 0; k < 10; ++k) {
      device.read(sample);
      const double expected = k < 5 + delay + 1 ? 0 : 0.7;
      EXPECT_EQ(device.truth().motor_torque, expected) << "delay " << delay << " sample " << k;
      device.write({k < 5 ? 0 : 0.7, 0});
    }
  }
}

// If this failed, a command would act with its sample, or later than the device says.
TEST(Device, CommandsActWithinTheSampleWhenTheDeviceSays) {
  const double earliest[] = {0, 2e-4, 1e-4}, latest[] = {0, 2e-4, 9e-4};
  for (int i = 0; i < 3; ++i) {
    device_description description = plain_device();
    description.loop.write_earliest = earliest[i];
    description.loop.write_latest = latest[i];
    simulated_device device(description);
    device_sample sample;
    device.read(sample);
    device.write({0.7, 0});
    device.read(sample);
    const double acceleration = 0.7 / description.mechanics.inertia, period = description.loop.sample_period;
    const auto moved = [&](double after) { return acceleration / 2 * (period - after) * (period - after); };
    EXPECT_LE(sample.position, moved(earliest[i]) * (1 + 1e-12));
    EXPECT_GE(sample.position, moved(latest[i]) * (1 - 1e-12));
    EXPECT_EQ(device.truth().motor_torque, 0.7);
    device.write({0, 0});
    EXPECT_EQ(device.truth_from_now_on().motor_torque, latest[i] > 0 ? 0.7 : 0);
  }
}

std::vector<unsigned char> bytes_of_a_run(std::uint64_t seed, std::vector<sample_fault> faults = {},
                                          std::uint64_t samples = 3000) {
  device_description arm = imperfect_arm();
  arm.velocity.estimator = estimator_kind::sensor;
  arm.velocity.noise = 0.01;
  scenario scene;
  scene.user = firm_hand();
  scene.intended = sine(0.03, 3);
  scene.high = end_stop{0.02};
  scene.gain = brake_gain::drawn;
  scene.seed = seed;
  scene.faults = std::move(faults);
  simulated_device device(arm, scene);
  std::vector<unsigned char> bytes;
  const auto append = [&](double value) {
    unsigned char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.insert(bytes.end(), raw, raw + sizeof raw);
  };
  device_sample sample;
  for (std::uint64_t k = 0; k < samples; ++k) {
    device.read(sample);
    append(sample.position);
    append(sample.velocity);
    append(static_cast<double>(sample.timestamp_ns));
    append(static_cast<double>(sample.edge_time_ns));
    append(device.ledger().brake);
    device.write({-0.3 * sample.position, 2e-3});
  }
  return bytes;
}

// If this failed, two runs from one seed would differ, or all seeds would give the same run.
TEST(Device, SameSeedGivesTheSameBytes) {
  EXPECT_EQ(bytes_of_a_run(7), bytes_of_a_run(7));
  EXPECT_NE(bytes_of_a_run(7), bytes_of_a_run(8));
}

// If this failed, a fault that is still to come would already disturb the run.
TEST(Device, FaultsLeaveThePastAlone) {
  const std::vector<unsigned char> sound = bytes_of_a_run(7, {}, 500);
  for (const sample_fault_kind kind : {sample_fault_kind::lost, sample_fault_kind::repeated, sample_fault_kind::late,
                                       sample_fault_kind::not_a_number, sample_fault_kind::jump}) {
    EXPECT_EQ(bytes_of_a_run(7, {{kind, 500, 10, 0.002}}, 500), sound);
    EXPECT_NE(bytes_of_a_run(7, {{kind, 499, 1, 0.002}}, 500), sound);
  }
}

struct answer {
  device_status status;
  device_sample sample;
};

// The answers to reads 0 … 19 of a tool led at 0.1 m/s, with a fault at samples 10 and 11.
std::vector<answer> answers_with(sample_fault_kind kind, double size = 0) {
  device_description description = plain_device();
  description.encoder.step = 1e-6;
  scenario scene;
  scene.prescribed = true;
  scene.intended = through({{0, 0}, {1, 0.1}});
  scene.faults = {{kind, 10, 2, size}};
  simulated_device device(description, scene);
  std::vector<answer> answers;
  device_sample sample;
  for (int k = 0; k < 20; ++k) {
    const device_status status = device.read(sample);
    answers.push_back({status, sample});
  }
  return answers;
}

// If this failed, a fault would be answered with the wrong status, deliver a sample, or last longer than told.
TEST(Device, FaultsWithoutASampleSayWhichTheyAre) {
  const auto check = [](sample_fault_kind kind, device_status status) {
    const std::vector<answer> answers = answers_with(kind);
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const bool struck = k == 10 || k == 11;
      EXPECT_EQ(answers[k].status, struck ? status : device_status::ok);
      EXPECT_EQ(answers[k].sample.sequence, struck ? 9u : k);
    }
  };
  check(sample_fault_kind::lost, device_status::no_data);
  check(sample_fault_kind::repeated, device_status::stale);
  check(sample_fault_kind::corrupted, device_status::corrupted);
  check(sample_fault_kind::disconnected, device_status::disconnected);
  check(sample_fault_kind::device_error, device_status::fault);
}

// If this failed, a repeated sample would not be the one delivered last, whatever the caller's variable holds.
TEST(Device, RepeatedSampleIsTheOneBefore) {
  scenario scene;
  scene.faults = {{sample_fault_kind::repeated, 3, 1, 0}};
  simulated_device device(plain_device(), scene);
  const device_sample last = run(device, 3, {0.1, 0});
  device_sample sample;
  sample.position = 99;
  EXPECT_EQ(device.read(sample), device_status::stale);
  EXPECT_EQ(sample.position, last.position);
  EXPECT_EQ(sample.sequence, 2u);
}

// If this failed, a position fault would not show, would show elsewhere, or would stay.
TEST(Device, FaultsOfThePositionShowInItAlone) {
  const std::vector<answer> sound = answers_with(sample_fault_kind::late, 0);
  const std::vector<answer> jumped = answers_with(sample_fault_kind::jump, -0.25);
  const std::vector<answer> lost_mind = answers_with(sample_fault_kind::not_a_number);
  for (std::size_t k = 0; k < sound.size(); ++k) {
    const bool struck = k == 10 || k == 11;
    EXPECT_NEAR(jumped[k].sample.position - sound[k].sample.position, struck ? -0.25 : 0, 1e-15);
    EXPECT_EQ(jumped[k].sample.counts - sound[k].sample.counts, struck ? -250000 : 0);
    EXPECT_EQ(std::isnan(lost_mind[k].sample.position), struck);
    EXPECT_EQ(lost_mind[k].sample.counts, sound[k].sample.counts);
    EXPECT_EQ(lost_mind[k].status, device_status::ok);
  }
}

// If this failed, a late sample would carry the time at which it should have come, or the motion would not go on
// meanwhile.
TEST(Device, LateSamplesComeLate) {
  const std::vector<answer> late = answers_with(sample_fault_kind::late, 0.0105);
  EXPECT_EQ(late[9].sample.timestamp_ns, 9000000u);
  EXPECT_EQ(late[10].sample.timestamp_ns, 20500000u);
  EXPECT_EQ(late[11].sample.timestamp_ns, 32000000u);
  EXPECT_EQ(late[12].sample.timestamp_ns, 33000000u);
  EXPECT_NEAR(late[12].sample.position, 0.1 * 0.033, 1e-6);
}

// If this failed, a NaN or infinite demand would reach motor or brake.
TEST(Device, DemandsThatAreNoNumbersAreRefusedSafely) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  device_description description = plain_device();
  description.brake.safe_damping = 4;
  const actuation demands[] = {{nan, 1}, {1, nan}, {infinite, 1}, {1, infinite}};
  for (const actuation& demand : demands) {
    simulated_device device(description);
    run(device, 2, {1, 1});
    EXPECT_EQ(device.write(demand), device_status::fault);
    device_sample sample;
    device.read(sample);
    EXPECT_EQ(device.truth().motor_torque, 0);
    EXPECT_EQ(device.truth().brake_damping, 4);
  }
}

// If this failed, a description that cannot be simulated would be, with some result.
TEST(Device, RefusesWhatCannotBeSimulated) {
  EXPECT_EQ(simulated_device::refusal(plain_device(), {}), nullptr);
  const auto expect_refusal = [](const char* word, const device_description& description, const scenario& scene) {
    const char* reason = simulated_device::refusal(description, scene);
    ASSERT_NE(reason, nullptr) << word;
    EXPECT_NE(std::strstr(reason, word), nullptr) << reason;
    EXPECT_THROW(simulated_device(description, scene), std::invalid_argument);
  };
  device_description description = plain_device();
  description.mechanics.inertia = 0;
  expect_refusal("inertia", description, {});
  description = plain_device();
  description.loop.sample_period = 0;
  expect_refusal("period", description, {});
  description = plain_device();
  description.loop.jitter = description.loop.sample_period;
  expect_refusal("jitter", description, {});
  scenario scene;
  scene.prescribed = true;
  expect_refusal("not given", plain_device(), scene);
  scene.intended = hold_at(0);
  scene.low = end_stop{};
  expect_refusal("end-stops", plain_device(), scene);
  scenario outside;
  outside.high = end_stop{-0.001};
  expect_refusal("above", plain_device(), outside);
  outside.high.reset();
  outside.low = end_stop{0.001};
  expect_refusal("below", plain_device(), outside);
  scenario pushy;
  pushy.user.damping = -1;
  expect_refusal("hand", plain_device(), pushy);
  scenario hasty;
  hasty.faults = {{sample_fault_kind::late, 3, 1, -0.002}};
  expect_refusal("early", plain_device(), hasty);
}

}  // namespace
}  // namespace dashpot::simulated
