// A card that is not there: the functions of Comedi's library, by its own header, with a record of every call.
#pragma once

#include <comedilib.h>

#include <optional>
#include <string>
#include <vector>

namespace dashpot::tests {

struct fake_card {
  // What the card is: subdevice 0 reads voltages, 1 writes them, 2 counts.
  bool is_there = true;
  unsigned most_counts = 0xFFFFFF;
  unsigned most_output = 0xFFFF;
  comedi_range output_range = {-10, 10, UNIT_volt};
  std::optional<unsigned> failing_subdevice;  // its instructions fail
  int failure = 0;                            // errno of that
  bool refuses_mode = false;

  // What it has come to.
  std::vector<std::string> calls;
  unsigned counts = 0;
  unsigned outputs[2] = {0, 0};

  std::vector<std::string> take_calls() {
    std::vector<std::string> taken;
    taken.swap(calls);
    return taken;
  }
};

fake_card& card();

}  // namespace dashpot::tests
