#include <gtest/gtest.h>

#include <string>

#include <dashpot/device_description.h>
#include <dashpot/servo/servo_loop.hpp>

#include "log_text.hpp"
#include "scripted_device.hpp"
#include "scripted_model.hpp"

namespace dashpot::tests {
namespace {

constexpr model_facts certified{0.001, motion::translation, false, "arm", "2f9c", "backward_difference", 0, true};

loop_facts fitting_loop() { return {{"arm", "2f9c"}, scripted_description(), "backward_difference"}; }

struct mismatch {
  const char* name;
  admission verdict;
  void (*change)(model_facts&, loop_facts&);
  const char* text;
};

void PrintTo(const mismatch& which, std::ostream* out) { *out << which.name; }

class Admission : public testing::TestWithParam<mismatch> {};

// Broken, a model would drive a device it was not certified for, or the refusal would not say what differs.
TEST_P(Admission, RefusesAndSaysWhatDiffers) {
  model_facts model = certified;
  loop_facts loop = fitting_loop();
  GetParam().change(model, loop);
  const admission verdict = admit(model, loop, false);
  EXPECT_EQ(verdict, GetParam().verdict);
  EXPECT_FALSE(is_admitted(verdict));
  EXPECT_EQ(to_text(verdict, model, loop), GetParam().text);
}

dashpot_device device_in_c(const loop_facts& loop) {
  dashpot_device device{};
  device.name = loop.identity.name;
  device.digest = loop.identity.digest;
  device.estimator = loop.estimator;
  device.motion = loop.device.motion == motion::rotation ? dashpot_motion_rotation : dashpot_motion_translation;
  device.arm_radius = loop.device.arm_radius;
  device.loop.sample_period = loop.device.loop.sample_period;
  device.loop.delay_samples = loop.device.loop.delay_samples;
  return device;
}

std::string refusal_in_c(const model_facts& model, const loop_facts& loop) {
  const dashpot_device device = device_in_c(loop);
  return dashpot_refusal_of(&device, model.sample_period, model.port_motion == motion::rotation ? 1 : 0,
                            model.any_device ? "ideal" : model.device, model.any_device ? "" : model.device_digest,
                            model.estimator, model.loop_delay);
}

const char* text_in_c(admission verdict) {
  switch (verdict) {
    case admission::no_period: return "the device states no sample period";
    case admission::other_rate: return "the law is made for another rate";
    case admission::other_motion: return "the law is made for another motion, and no arm radius converts it";
    case admission::other_device: return "the law is certified for another device";
    case admission::other_digest: return "the law is certified for another file of this device";
    case admission::other_estimator: return "the law is certified with another estimator";
    case admission::other_delay: return "the law is certified for another delay";
    default: return "";
  }
}

// Broken, a loop in C would run a law that the loop in C++ refuses, or refuse one that it runs.
TEST_P(Admission, IsTheSameInC) {
  for (const bool any_device : {false, true}) {
    model_facts model = certified;
    loop_facts loop = fitting_loop();
    GetParam().change(model, loop);
    model.any_device = any_device;
    EXPECT_EQ(refusal_in_c(model, loop), text_in_c(admit(model, loop, false)));
  }
  EXPECT_EQ(refusal_in_c(certified, fitting_loop()), "");
}

// Broken, a rotary device with an arm would be refused in C, or one whose period differs in its last bits.
TEST(AdmissionInC, TakesWhatFits) {
  loop_facts loop = fitting_loop();
  loop.device.motion = motion::rotation;
  loop.device.arm_radius = 0.05;
  loop.device.loop.sample_period = 1 / 999.9999999;
  EXPECT_TRUE(is_admitted(admit(certified, loop, true)));
  EXPECT_EQ(refusal_in_c(certified, loop), "");
}

constexpr mismatch mismatches[] = {
    {"OtherRate", admission::other_rate, [](model_facts& model, loop_facts&) { model.sample_period = 0.0005; },
     "model is made for a period of 0.0005 s, device 'arm' runs at 0.001 s"},
    {"OtherDevice", admission::other_device, [](model_facts&, loop_facts& loop) { loop.identity.name = "leg"; },
     "model is certified for device 'arm', this is device 'leg'"},
    {"OtherDigest", admission::other_digest, [](model_facts&, loop_facts& loop) { loop.identity.digest = "77aa"; },
     "model is certified for device 'arm' with digest '2f9c', this one's is '77aa'"},
    {"UnknownIdentity", admission::other_device, [](model_facts&, loop_facts& loop) { loop.identity = {}; },
     "model is certified for device 'arm', this is device ''"},
    {"OtherEstimator", admission::other_estimator, [](model_facts&, loop_facts& loop) { loop.estimator = "foaw"; },
     "model is certified for device 'arm' with estimator 'backward_difference', this loop uses 'foaw'"},
    {"OtherDelay", admission::other_delay, [](model_facts&, loop_facts& loop) { loop.device.loop.delay_samples = 1; },
     "model is certified for device 'arm' with a loop delay of 0 samples, the device states 1"},
    {"OtherMotion", admission::other_motion,
     [](model_facts& model, loop_facts&) { model.port_motion = motion::rotation; },
     "model is made for rotation, device 'arm' moves in translation and states no arm radius that would convert it"},
    {"NoArmRadius", admission::other_motion,
     [](model_facts&, loop_facts& loop) { loop.device.motion = motion::rotation; },
     "model is made for translation, device 'arm' moves in rotation and states no arm radius that would convert it"},
    {"NoPeriod", admission::no_period, [](model_facts&, loop_facts& loop) { loop.device.loop.sample_period = 0; },
     "device 'arm' states a sample period of 0 s; a loop needs one above zero"},
};

// A model that was made for what it is told, and an estimator that is called what it is told.
struct told_model : scripted_model {
  model_facts made_for;
  model_facts facts() const noexcept { return made_for; }
};
struct told_estimator : scripted_estimator {
  const char* called = "";
  const char* name() const noexcept { return called; }
};

struct told_loop {
  explicit told_loop(const model_facts& facts, const loop_facts& loop) : device(loop.device) {
    model.made_for = facts;
    estimator.called = loop.estimator;
    options.identity = loop.identity;
    options.duration = 0.01;
    options.outputs.log = log.file();
  }
  admission run() { return servo_loop(model, device, estimator, options, simulated_clock{}).run().verdict; }

  told_model model;
  scripted_device device;
  told_estimator estimator;
  servo_options options;
  log_text log;
};

// Broken, a verdict would be reached and not obeyed: each difference by itself must keep the loop from the device.
TEST_P(Admission, LoopLeavesTheDeviceAlone) {
  model_facts model = certified;
  loop_facts loop = fitting_loop();
  GetParam().change(model, loop);
  told_loop with(model, loop);
  EXPECT_EQ(with.run(), GetParam().verdict);
  EXPECT_EQ(with.log.text(), GetParam().text + std::string("\n"));
  EXPECT_EQ(with.device.reads(), 0u);
  EXPECT_EQ(with.device.written().size(), 0u);
  EXPECT_EQ(with.model.resets(), 0u);
}

// Broken, the test above would pass because no such loop ever runs.
TEST(AdmittedLoop, RunsOnTheDeviceOfTheCertificate) {
  told_loop with(certified, fitting_loop());
  EXPECT_EQ(with.run(), admission::admitted);
  EXPECT_EQ(with.device.reads(), 10u);
}

INSTANTIATE_TEST_SUITE_P(Every, Admission, testing::ValuesIn(mismatches),
                         [](const auto& which) { return std::string(which.param.name); });

// Broken, the device a model was made for would be refused.
TEST(Admission, AdmitsTheDeviceOfTheCertificate) {
  EXPECT_EQ(admit(certified, fitting_loop(), true), admission::admitted);
  EXPECT_EQ(to_text(admission::admitted, certified, fitting_loop()), "");
}

// Broken, a float model, whose period is stated in single precision, could not run at most rates.
TEST(Admission, PeriodsAgreeInSinglePrecision) {
  model_facts model = certified;
  loop_facts loop = fitting_loop();
  loop.device.loop.sample_period = 1.0 / 3000;
  model.sample_period = static_cast<double>(1.0f / 3000.0f);
  EXPECT_EQ(admit(model, loop, false), admission::admitted);
  model.sample_period = 0.0003333;
  EXPECT_EQ(admit(model, loop, false), admission::other_rate);
}

// Broken, a translational network could not be rendered by a rotating arm.
TEST(Admission, ArmRadiusCarriesTranslationToARotaryJoint) {
  loop_facts loop = fitting_loop();
  loop.device.motion = motion::rotation;
  loop.device.arm_radius = 0.05;
  EXPECT_EQ(admit(certified, loop, false), admission::admitted);
}

// A law of this very device that was written though it is not certified.
model_facts uncertified() {
  model_facts model = certified;
  model.is_certified = false;
  return model;
}

// Broken, a law that nobody proved passive would run in silence.
TEST(Admission, UncertifiedLawOfTheDeviceRunsWithAWarning) {
  told_loop with(uncertified(), fitting_loop());
  EXPECT_EQ(with.run(), admission::admitted_uncertified);
  EXPECT_EQ(
      with.log.text().find("model is made for device 'arm' and not certified on it; it may give more energy than it"),
      0u);
  EXPECT_EQ(with.device.reads(), 10u);
}

// Broken, a loop that requires a certificate would drive a law without one.
TEST(Admission, UncertifiedLawOfTheDeviceIsRefusedWhereRequired) {
  told_loop with(uncertified(), fitting_loop());
  with.options.require_certified = true;
  EXPECT_EQ(with.run(), admission::not_certified);
  EXPECT_EQ(
      with.log.text(),
      "model is made for device 'arm' and not certified on it; this loop requires one certified for device 'arm'\n");
  EXPECT_EQ(with.device.reads(), 0u);
}

// Broken, a law that is not certified could drive a device that it was not made for.
TEST_P(Admission, UncertifiedLawIsHeldAgainstTheDeviceToo) {
  model_facts model = uncertified();
  loop_facts loop = fitting_loop();
  GetParam().change(model, loop);
  EXPECT_EQ(admit(model, loop, false), GetParam().verdict);
  EXPECT_EQ(admit(model, loop, true), GetParam().verdict);
  EXPECT_EQ(to_text(GetParam().verdict, model, loop).find("is certified"), std::string::npos);
}

// Broken, a loop in C would refuse a law that the loop in C++ runs.
TEST(AdmissionInC, TakesAnUncertifiedLawOfTheDevice) { EXPECT_EQ(refusal_in_c(uncertified(), fitting_loop()), ""); }

struct law_of_the_arm {
  static constexpr double sample_period = 0.001;
  static constexpr motion port_motion = motion::translation;
  struct certified_for {
    static constexpr bool any_device = false;
    static constexpr const char* device = "arm";
    static constexpr const char* device_digest = "2f9c";
    static constexpr const char* estimator = "backward_difference";
    static constexpr unsigned loop_delay = 0;
  };
};
struct certified_law : law_of_the_arm {
  struct certified_for : law_of_the_arm::certified_for {
    static constexpr bool is_certified = true;
  };
};

// Broken, a class that says nothing of a certificate would count as certified, or a certified one would not.
TEST(Admission, CountsAsCertifiedWhatSaysSo) {
  EXPECT_EQ(admit(facts_of(certified_law()), fitting_loop(), true), admission::admitted);
  EXPECT_EQ(admit(facts_of(law_of_the_arm()), fitting_loop(), true), admission::not_certified);
}

struct run_result {
  servo_summary summary;
  std::string log;
  std::size_t reads;
  std::size_t writes;
};

run_result run_uncertified(bool require_certified) {
  scripted_device device;
  scripted_model model;
  scripted_estimator estimator;
  log_text log;
  servo_options options;
  options.identity = {"arm", "2f9c"};
  options.require_certified = require_certified;
  options.duration = 0.01;
  options.outputs.log = log.file();
  servo_loop loop(model, device, estimator, options, simulated_clock{});
  const servo_summary summary = loop.run();
  return {summary, log.text(), device.reads(), device.written().size()};
}

// Broken, a model without a certificate would run in silence.
TEST(Admission, UncertifiedModelRunsWithAWarning) {
  const run_result result = run_uncertified(false);
  EXPECT_EQ(result.summary.verdict, admission::admitted_uncertified);
  EXPECT_EQ(result.log.find("model is compiled for the ideal device; nothing is certified about device 'arm'\n"), 0u);
  EXPECT_NE(to_text(result.summary).find("warning   the law is not certified on this device\n"), std::string::npos);
  EXPECT_EQ(result.reads, 10u);
  EXPECT_EQ(result.writes, 11u);
}

// Broken, a refused model would still move the device once.
TEST(Admission, RefusedModelNeverTouchesTheDevice) {
  const run_result result = run_uncertified(true);
  EXPECT_EQ(result.summary.verdict, admission::not_certified);
  EXPECT_EQ(result.log, "model is compiled for the ideal device; this loop requires one certified for device 'arm'\n");
  EXPECT_EQ(result.reads, 0u);
  EXPECT_EQ(result.writes, 0u);
  EXPECT_EQ(to_text(result.summary), "refused before the device was touched\n");
}

}  // namespace
}  // namespace dashpot::tests
