// A board, or what lies between it and the host, that misbehaves in every way that we have thought of, under the servo
// loop. README.md has the table of what each ends in, and this test holds it.
#include <algorithm>
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

#include "stepped_session.hpp"

namespace dashpot {
namespace {

using namespace board;
using session = stepped_session<no_model>;

constexpr std::uint64_t begins = 400, ends = 1'500;  // of the misbehaviour and of the run [periods]

struct misbehaviour {
  sampling when = sampling::on_command;
  std::function<void(session&)> prepare;
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
template <class Change>
mischief with_samples(session& with, Change change) {
  return [&with, change](const byte_string& bytes) {
    if (with.periods < begins) return bytes;
    std::vector<byte_string> frames = frames_of(bytes);
    for (byte_string& one : frames) {
      frame_decoder decoder;
      decoder.accept(one.data(), one.size());
      frame found;
      if (!decoder.next(found) || found.type != message_type::sample) continue;
      sample_message sample = decode<sample_message>(found);
      std::uint32_t number = found.sequence;
      change(sample, number);
      one = bytes_of(sample, number);
    }
    return joined(frames);
  };
}

// Both ways, once it begins.
template <class Mischief>
std::function<void(session&)> both_ways(Mischief mischief_of) {
  return [mischief_of](session& with) {
    with.up = mischief_of(with);
    with.down = mischief_of(with);
  };
}

mischief duplicating(session& with) {
  return [&with](byte_string bytes) {
    if (with.periods >= begins) bytes = joined({bytes, bytes});
    return bytes;
  };
}

// Every fourth frame changes places with the one behind it.
mischief reordering(session& with) {
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
mischief replaying(session& with) {
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
mischief splitting(session& with) {
  return [&with, rest = byte_string()](const byte_string& bytes) mutable {
    byte_string now = std::exchange(rest, {});
    const std::size_t half = with.periods >= begins && with.periods % 7 == 0 ? bytes.size() / 2 : bytes.size();
    now.insert(now.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(half));
    rest.assign(bytes.begin() + static_cast<std::ptrdiff_t>(half), bytes.end());
    return now;
  };
}

mischief littering(session& with) {
  return [&with, noise = 1u](byte_string bytes) mutable {
    if (with.periods < begins) return bytes;
    byte_string litter(40);
    for (std::uint8_t& byte : litter) byte = static_cast<std::uint8_t>((noise = noise * 1664525u + 1013904223u) >> 24);
    litter.push_back(0x64);  // a false start
    return joined({litter, bytes, litter});
  };
}

mischief swallowing(session& with) {
  return [&with](byte_string bytes) { return with.periods >= begins ? byte_string() : bytes; };
}

const std::map<std::string, misbehaviour>& misbehaviours() {
  static const std::map<std::string, misbehaviour> all = {
      {"none", {sampling::on_command, [](session&) {}}},
      {"duplicate", {sampling::on_command, both_ways(duplicating)}},
      {"reorder", {sampling::free_running, both_ways(reordering)}},
      {"replay samples", {sampling::on_command, [](session& with) { with.up = replaying(with); }}},
      {"replay commands", {sampling::on_command, [](session& with) { with.down = replaying(with); }}},
      {"split", {sampling::on_command, both_ways(splitting)}},
      {"garbage", {sampling::on_command, both_ways(littering)}},
      {"silence", {sampling::on_command, [](session& with) { with.up = swallowing(with); }}},
      {"deaf", {sampling::free_running, [](session& with) { with.down = swallowing(with); }}},
      {"dead", {sampling::on_command, both_ways(swallowing)}},
      {"late configure",
       {sampling::on_command,
        [](session& with) {
          with.down = [&with](byte_string bytes) {
            const configure_message late = {1'000'000, 4, 0, 8, sampling::on_command, controller::host};
            if (with.periods == begins) bytes = joined({bytes_of(late), bytes});
            return bytes;
          };
        }}},
      {"weak",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [](sample_message& sample, std::uint32_t&) { sample.motor_torque /= 5; });
        }}},
      {"reboot",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [](sample_message& sample, std::uint32_t& number) {
            sample.state = board_state::idle;
            sample.cause = stop_cause::none;
            sample.motor_torque = 0;
            sample.brake_damping = 5;
            number -= static_cast<std::uint32_t>(begins);
          });
        }}},
      {"wild number",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [&with](sample_message&, std::uint32_t& number) {
            if (with.periods % 50 == 0) number += 0x2000'0000U;
          });
        }}},
      {"clock set back",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [](sample_message& sample, std::uint32_t&) { sample.timestamp -= 500'000'000; });
        }}},
      {"clock at half its rate",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [](sample_message& sample, std::uint32_t&) {
            sample.timestamp = 1'400'000'000 + (sample.timestamp - 1'400'000'000) / 2;
          });
        }}},
      {"clock of nonsense",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(
              with, [](sample_message& sample, std::uint32_t&) { sample.timestamp *= 0x9E37'79B9'7F4A'7C15U; });
        }}},
      {"jumping encoder",
       {sampling::on_command,
        [](session& with) {
          with.up = with_samples(with, [](sample_message& sample, std::uint32_t&) { sample.counts += 1'000'000; });
        }}},
  };
  return all;
}

device_description described() {
  device_description device = described_board();
  device.loop.delay_samples = 1;
  device.encoder.max_speed = 2;
  device.motor.saturation_allowed = 0.1;
  return device;
}

struct outcome {
  std::string text;  // as in the table
  servo_summary summary;
  float torque = 0;  // that the board makes in the end
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

outcome outcome_of(const misbehaviour& what) {
  board_options options;
  options.sampling = what.when;
  const auto with = std::make_unique<session>(described(), options);
  std::string error;
  EXPECT_TRUE(with->start(error)) << error;
  what.prepare(*with);
  spring_from_start<double> model;
  any_estimator<double> estimator({}, 0.001, test_plant::encoder_step);
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const log = open_memstream(&text, &size);
  servo_options loop;
  loop.duration = 0.001 * ends;
  loop.outputs.log = log;
  outcome result;
  result.summary = servo_loop(model, *with, estimator, loop, simulated_clock{}).run();
  std::fclose(log);
  result.text = ending(result.summary, {text, size});
  std::free(text);
  for (int silent = 0; silent < 20; ++silent) with->board.pass_period();  // where nothing arrives its watchdog is last
  result.torque = with->board.hardware().driven().motor_torque;
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
    if (misbehaviours().count(trimmed(name)) != 0) rows[trimmed(name)] = trimmed(end);
  }
  return rows;
}

// Whatever comes over the wire, the loop goes on where that is sound, and ends in the safe command where it is not; and
// in the end no board makes torque.
TEST(Misbehaviour, ends_as_the_table_says) {
  const std::map<std::string, std::string> promised = table();
  for (const auto& [name, what] : misbehaviours()) {
    const outcome found = outcome_of(what);
    const auto row = promised.find(name);
    EXPECT_EQ(row != promised.end() ? row->second : "no row", found.text) << name;
    EXPECT_EQ(found.torque, 0) << name;
    EXPECT_LE(found.summary.faults.total(), 1U) << name;
  }
}

// A board that makes less than it is asked for must show in what the run came to.
TEST(Misbehaviour, of_a_weak_board_is_counted) {
  EXPECT_GT(outcome_of(misbehaviours().at("weak")).summary.motor_clipped, 50U);
  EXPECT_EQ(outcome_of(misbehaviours().at("none")).summary.motor_clipped, 0U);
}

}  // namespace
}  // namespace dashpot
