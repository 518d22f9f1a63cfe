// A wire between host and board that loses, repeats, damages and delays whole frames, by seed, and counts what it did.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <dashpot/board/frame.hpp>
#include <dashpot/board/transport.hpp>

namespace dashpot::board {

enum class mishap : unsigned char { none, loss, repetition, damage, delay };

struct mishap_counts {
  std::uint32_t lost = 0;
  std::uint32_t repeated = 0;
  std::uint32_t damaged = 0;
  std::uint32_t delayed = 0;  // delivered right after the frame behind it

  std::uint32_t total() const { return lost + repeated + damaged + delayed; }
};

// One way. What comes in must be intact frames without garbage.
class faulty_way {
 public:
  // Only frames of this type come to harm, each with probability `rate`, every kind of mishap alike.
  faulty_way(message_type victim, unsigned seed) : victim_(victim), random_(seed) {}

  void set_rate(double rate) { rate_ = rate; }
  void cut(bool dead) { dead_ = dead; }  // loses everything while true, and counts nothing
  const mishap_counts& counts() const { return counts_; }

  void carry(transport& from, transport& to) {
    std::uint8_t bytes[4096];
    while (const std::size_t count = from.read(bytes, sizeof bytes))
      waiting_.insert(waiting_.end(), bytes, bytes + count);
    while (waiting_.size() > 4 && waiting_.size() >= size_of_first()) pass_first();
    leaving_.erase(leaving_.begin(),
                   leaving_.begin() + static_cast<std::ptrdiff_t>(to.write(leaving_.data(), leaving_.size())));
  }

  std::uint32_t frames_seen() const { return frames_seen_; }

 private:
  using frame_bytes = std::vector<std::uint8_t>;

  std::size_t size_of_first() const { return header_size + waiting_[4] + 2; }

  void pass_first() {
    ++frames_seen_;
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(size_of_first());
    const frame_bytes first(waiting_.begin(), end);
    waiting_.erase(waiting_.begin(), end);
    if (!dead_) suffer(first, choose(static_cast<message_type>(first[3])));
  }

  // A frame that overtakes a delayed one is spared, so that every count has one cause.
  mishap choose(message_type type) {
    const bool spared = type != victim_ || !delayed_.empty() || std::uniform_real_distribution<>()(random_) >= rate_;
    return spared ? mishap::none : static_cast<mishap>(std::uniform_int_distribution<int>(1, 4)(random_));
  }

  void suffer(const frame_bytes& one, mishap what) {
    switch (what) {
      case mishap::none: deliver(one); break;
      case mishap::loss: ++counts_.lost; break;
      case mishap::repetition:
        ++counts_.repeated;
        deliver(one);
        put(one);
        break;
      case mishap::damage:
        ++counts_.damaged;
        put(damaged(one));
        break;
      case mishap::delay:
        ++counts_.delayed;
        delayed_ = one;
        break;
    }
  }

  void deliver(const frame_bytes& one) {
    put(one);
    put(delayed_);
    delayed_.clear();
  }

  void put(const frame_bytes& one) { leaving_.insert(leaving_.end(), one.begin(), one.end()); }

  // One to three flipped bits behind the length: the frame is still recognised as one.
  frame_bytes damaged(frame_bytes one) {
    std::uniform_int_distribution<std::size_t> place(5 * 8, one.size() * 8 - 1);
    const std::size_t first = place(random_);
    flip(one, first);
    for (int more = std::uniform_int_distribution<int>(0, 2)(random_); more > 0; --more) {
      const std::size_t other = place(random_);
      if (other != first) flip(one, other);
    }
    return one;
  }

  static void flip(frame_bytes& one, std::size_t bit) {
    one[bit / 8] = static_cast<std::uint8_t>(one[bit / 8] ^ (1U << (bit % 8)));
  }

  message_type victim_;
  std::mt19937 random_;
  double rate_ = 0;
  bool dead_ = false;
  mishap_counts counts_;
  std::uint32_t frames_seen_ = 0;
  frame_bytes waiting_;  // has come, not yet a whole frame
  frame_bytes leaving_;  // the stream has not taken it yet
  frame_bytes delayed_;
};

class faulty_wire {
 public:
  // Commands and samples come to harm, by default those of a board of one axis.
  faulty_wire(transport to_host, transport to_board, unsigned seed, message_type command = message_type::command,
              message_type sample = message_type::sample)
      : to_host_(std::move(to_host)), to_board_(std::move(to_board)), down_(command, seed), up_(sample, seed + 1) {}

  void carry() {
    down_.carry(to_host_, to_board_);
    up_.carry(to_board_, to_host_);
  }

  void set_rate(double rate) {
    down_.set_rate(rate);
    up_.set_rate(rate);
  }

  faulty_way& down() { return down_; }  // host → board
  faulty_way& up() { return up_; }      // board → host

 private:
  transport to_host_;
  transport to_board_;
  faulty_way down_;
  faulty_way up_;
};

}  // namespace dashpot::board
