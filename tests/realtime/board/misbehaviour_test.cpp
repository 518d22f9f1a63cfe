// A board, or what lies between it and the host, that misbehaves in every way that we have thought of, under the servo
// loop. README.md has the table of what each ends in, and this test holds it.
#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "springs_of_arm.hpp"
#include "stepped_session.hpp"

namespace dashpot {
namespace {

using namespace board;
template <class Plant>
using session_of = stepped_session<no_model, Plant>;

constexpr std::uint64_t begins = 400, ends = 1'500;  // of the misbehaviour and of the run [periods]

template <class Plant>
struct misbehaviour {
  sampling when = sampling::on_command;
  std::function<void(session_of<Plant>&)> prepare;
};

// The frames in a string of whole ones.
std::vector<byte_string> frames_of(const byte_string& bytes) {
  std::vector<byte_string> frames;
  for (std::size_t at = 0; at + header_size <= bytes.size();) {
    const std::size_t size = header_size + bytes[at + 4] + 2u;
    frames.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  }
  return frames;
}

byte_string joined(const std::vector<byte_string>& frames) {
  byte_string all;
  for (const byte_string& one : frames) all.insert(all.end(), one.begin(), one.end());
  return all;
}

template <class Message>
byte_string bytes_of(const Message& message, std::uint32_t sequence = 0) {
  const encoded_frame frame = encode(message, sequence);
  return {frame.bytes, frame.bytes + frame.size};
}

// Every sample that passes, changed; its number and check sum are made anew.
template <class Plant, class Change>
mischief with_samples(session_of<Plant>& with, Change change) {
  using sample_type = basic_sample_message<Plant::axes>;
  return [&with, change](const byte_string& bytes) {
    if (with.periods < begins) return bytes;
    std::vector<byte_string> frames = frames_of(bytes);
    for (byte_string& one : frames) {
      frame_decoder decoder;
      decoder.accept(one.data(), one.size());
      frame found;
      if (!decoder.next(found) || found.type != sample_type::type) continue;
      auto sample = decode<sample_type>(found);
      std::uint32_t number = found.sequence;
      change(sample, number);
      one = bytes_of(sample, number);
    }
    return joined(frames);
  };
}

// Both ways, once it begins.
template <class Session>
std::function<void(Session&)> both_ways(mischief (*mischief_of)(Session&)) {
  return [mischief_of](Session& with) {
    with.up = mischief_of(with);
    with.down = mischief_of(with);
  };
}

template <class Session>
mischief duplicating(Session& with) {
  return [&with](byte_string bytes) {
    if (with.periods >= begins) bytes = joined({bytes, bytes});
    return bytes;
  };
}

// Every fourth frame changes places with the one behind it.
template <class Session>
mischief reordering(Session& with) {
  return [&with, kept = byte_string(), count = 0](byte_string bytes) mutable {
    if (with.periods < begins) return bytes;
    if (!kept.empty()) {
      bytes.insert(bytes.end(), kept.begin(), kept.end());
      kept.clear();
    } else if (++count % 4 == 0) {
      std::swap(kept, bytes);
    }
    return bytes;
  };
}

// A hundred frames of a second ago come again before every tenth.
template <class Session>
mischief replaying(Session& with) {
  return [&with, past = std::deque<byte_string>()](const byte_string& bytes) mutable {
    past.push_back(bytes);
    if (past.size() > 400) past.pop_front();
    if (with.periods < begins || with.periods % 10 != 0 || bytes.empty()) return bytes;
    byte_string all;
    for (std::size_t k = 0; k < 100; ++k) all.insert(all.end(), past[k].begin(), past[k].end());
    all.insert(all.end(), bytes.begin(), bytes.end());
    return all;
  };
}

// The second half of everything comes a period later.
template <class Session>
mischief splitting(Session& with) {
  return [&with, rest = byte_string()](const byte_string& bytes) mutable {
    byte_string now = std::exchange(rest, {});
    const std::size_t half = with.periods >= begins && with.periods % 7 == 0 ? bytes.size() / 2 : bytes.size();
    now.insert(now.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(half));
    rest.assign(bytes.begin() + static_cast<std::ptrdiff_t>(half), bytes.end());
    return now;
  };
}

template <class Session>
mischief littering(Session& with) {
  return [&with, noise = 1u](byte_string bytes) mutable {
    if (with.periods < begins) return bytes;
    byte_string litter(40);
    for (std::uint8_t& byte : litter) byte = static_cast<std::uint8_t>((noise = noise * 1664525u + 1013904223u) >> 24);
    litter.push_back(0x64);  // a false start
    return joined({litter, bytes, litter});
  };
}

template <class Session>
mischief swallowing(Session& with) {
  return [&with](byte_string bytes) { return with.periods >= begins ? byte_string() : bytes; };
}

template <class Plant>
float safe_damping(unsigned brake) {
  if constexpr (Plant::axes == 1) return static_cast<float>(described_board().brake.safe_damping);
  else return static_cast<float>(described_arm_board().brakes[brake].brake.safe_damping);
}

// Of a board of two axes the last joint is the one that misbehaves, where it is one.
template <class Plant>
const std::map<std::string, misbehaviour<Plant>>& misbehaviours() {
  using session = session_of<Plant>;
  using sample_type = basic_sample_message<Plant::axes>;
  constexpr unsigned last = Plant::axes - 1;
  static const std::map<std::string, misbehaviour<Plant>> all = {
      {"none", {sampling::on_command, [](session&) {}}},
      {"duplicate", {sampling::on_command, both_ways(duplicating<session>)}},
      {"reorder", {sampling::free_running, both_ways(reordering<session>)}},
      {"replay samples", {sampling::on_command, [](session& with) { with.up = replaying(with); }}},
      {"replay commands", {sampling::on_command, [](session& with) { with.down = replaying(with); }}},
      {"split", {sampling::on_command, both_ways(splitting<session>)}},
      {"garbage", {sampling::on_command, both_ways(littering<session>)}},
      {"silence", {sampling::on_command, [](session& with) { with.up = swallowing(with); }}},
      {"deaf", {sampling::free_running, [](session& with) { with.down = swallowing(with); }}},
      {"dead", {sampling::on_command, both_ways(swallowing<session>)}},
      {"late configure",
       {sampling::on_command,
        [](session& with) {
          with.down = [&with](byte_string bytes) {
            basic_configure_message<Plant::axes> late;
            late.period = 1'000'000;
            for (unsigned i = 0; i < Plant::brakes; ++i) nth(late.safe_damping, i) = safe_damping<Plant>(i);
            late.watchdog_periods = 8;
            if (with.periods == begins) bytes = joined({bytes_of(late), bytes});
            return bytes;
          };
        }}},
      {"weak",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(
              with, [](sample_type& sample, std::uint32_t&) { nth(sample.motor_torque, last) /= 5; });
        }}},
      {"reboot",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(with, [](sample_type& sample, std::uint32_t& number) {
            sample.state = board_state::idle;
            sample.cause = stop_cause::none;
            nth(sample.motor_torque, last) = 0;
            nth(sample.brake_damping, last) = 5;
            number -= static_cast<std::uint32_t>(begins);
          });
        }}},
      {"wild number",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(with, [&with](sample_type&, std::uint32_t& number) {
            if (with.periods % 50 == 0) number += 0x2000'0000U;
          });
        }}},
      {"clock set back",
       {sampling::on_command,
        [](session& with) {
          with.up =
              with_samples<Plant>(with, [](sample_type& sample, std::uint32_t&) { sample.timestamp -= 500'000'000; });
        }}},
      {"clock at half its rate",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(with, [](sample_type& sample, std::uint32_t&) {
            sample.timestamp = 1'400'000'000 + (sample.timestamp - 1'400'000'000) / 2;
          });
        }}},
      {"clock of nonsense",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(
              with, [](sample_type& sample, std::uint32_t&) { sample.timestamp *= 0x9E37'79B9'7F4A'7C15U; });
        }}},
      {"jumping encoder",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples<Plant>(
              with, [](sample_type& sample, std::uint32_t&) { nth(sample.counts, last) += 1'000'000; });
        }}},
  };
  return all;
}

device_description patient(device_description joint) {
  joint.loop.delay_samples = 1;
  joint.encoder.max_speed = 2;
  joint.motor.saturation_allowed = 0.1;
  return joint;
}

// Model, estimators and device of the loop.
struct one_axis {
  using options = servo_options;
  static device_description described() { return patient(described_board()); }
  spring_from_start<double> model;
  any_estimator<double> estimator{{}, 0.001, test_plant::encoder_step};
};
struct two_axes {
  using options = arm_servo_options;
  static arm_description described() {
    arm_description arm = described_arm_board();
    for (device_description& joint : arm.joints) joint = patient(joint);
    return arm;
  }
  springs_of_arm<double> model;
  any_estimator<double> estimator[arm_axes] = {{{}, 0.001, test_arm::encoder_step},
                                               {{}, 0.001, test_arm::encoder_step}};
};
template <class Plant>
using loop_on = std::conditional_t<Plant::axes == 1, one_axis, two_axes>;

struct outcome {
  std::string text;  // as in the table
  servo_summary summary;
  float torque = 0;  // the largest that the board makes in the end
};

std::string ending(const servo_summary& summary, const std::string& log) {
  std::string text = name_of(summary.state);
  if (summary.state == servo_state::safe) {
    const std::size_t at = log.find(": safe: ") + 8;
    text += ": " + log.substr(at, log.find('\n', at) - at);
  }
  if (summary.safe_confirmed) return text + "; left safe";
  return text + (summary.left_safe ? "; not confirmable" : "; not confirmed");
}

template <class Plant>
outcome outcome_of(const misbehaviour<Plant>& what) {
  board_options options;
  options.sampling = what.when;
  const auto with = std::make_unique<session_of<Plant>>(loop_on<Plant>::described(), options);
  std::string error;
  EXPECT_TRUE(with->start(error)) << error;
  what.prepare(*with);
  loop_on<Plant> parts;
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const log = open_memstream(&text, &size);
  typename loop_on<Plant>::options loop;
  loop.duration = 0.001 * ends;
  loop.outputs.log = log;
  outcome result;
  result.summary = servo_loop(parts.model, *with, parts.estimator, loop, simulated_clock{}).run();
  std::fclose(log);
  result.text = ending(result.summary, {text, size});
  std::free(text);
  for (int silent = 0; silent < 20; ++silent) with->board.pass_period();  // where nothing arrives its watchdog is last
  for (unsigned j = 0; j < Plant::axes; ++j)
    result.torque = std::max(result.torque, std::abs(nth(with->board.hardware().driven().motor_torque, j)));
  return result;
}

// The rows of the table: what misbehaves, and what that ends in.
std::map<std::string, std::string> table() {
  std::ifstream page(MISBEHAVIOUR_PAGE);
  std::map<std::string, std::string> rows;
  for (std::string line; std::getline(page, line);) {
    std::istringstream cells(line);
    std::string nothing, name, what, end;
    std::getline(cells, nothing, '|'), std::getline(cells, name, '|'), std::getline(cells, what, '|'),
        std::getline(cells, end, '|');
    const auto trimmed = [](const std::string& cell) {
      const std::size_t first = cell.find_first_not_of(" `"), last = cell.find_last_not_of(" `");
      return first == std::string::npos ? std::string() : cell.substr(first, last - first + 1);
    };
    if (misbehaviours<test_plant>().count(trimmed(name)) != 0) rows[trimmed(name)] = trimmed(end);
  }
  return rows;
}

// Whatever comes over the wire, the loop goes on where that is sound, and ends in the safe command where it is not; and
// in the end no board makes torque.
TEST(Misbehaviour, EndsAsTheTableSays) {
  const std::map<std::string, std::string> promised = table();
  for (const auto& [name, what] : misbehaviours<test_plant>()) {
    const outcome found = outcome_of(what);
    const auto row = promised.find(name);
    EXPECT_EQ(row != promised.end() ? row->second : "no row", found.text) << name;
    EXPECT_EQ(found.torque, 0) << name;
    EXPECT_LE(found.summary.faults.total(), 1U) << name;
  }
}

// Two axes end as one does, whichever joint it is; only the joint is named too.
TEST(Misbehaviour, EndsAlikeWithTwoAxes) {
  for (const auto& [name, what] : misbehaviours<test_arm>()) {
    const outcome found = outcome_of(what), of_one = outcome_of(misbehaviours<test_plant>().at(name));
    EXPECT_EQ(found.summary.state, of_one.summary.state) << name << ": " << found.text;
    EXPECT_EQ(found.summary.last_fault.kind, of_one.summary.last_fault.kind) << name << ": " << found.text;
    EXPECT_EQ(found.summary.left_safe, of_one.summary.left_safe) << name;
    EXPECT_EQ(found.summary.safe_confirmed, of_one.summary.safe_confirmed) << name;
    EXPECT_EQ(found.torque, 0) << name;
    EXPECT_LE(found.summary.faults.total(), 1U) << name;
  }
}

// A board that makes less than it is asked for must show in what the run came to.
TEST(Misbehaviour, OfAWeakBoardIsCounted) {
  EXPECT_GT(outcome_of(misbehaviours<test_plant>().at("weak")).summary.motor_clipped, 50U);
  EXPECT_EQ(outcome_of(misbehaviours<test_plant>().at("none")).summary.motor_clipped, 0U);
}

}  // namespace
}  // namespace dashpot
