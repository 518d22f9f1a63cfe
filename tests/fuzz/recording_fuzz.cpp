// Any text as a recording: it is refused in words, or its columns are equally long, finite, and in order.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fit/read_recording.hpp"
#include "source/render.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dashpot::compiler;
  if (size == 0) return 0;
  // The first byte chooses what the command line would.
  fitting::ReadChoices choices;
  Diagnostics diagnostics;
  choices.has_header = (data[0] & 1) == 0;
  choices.columns.is_relaxation = (data[0] & 2) != 0;
  if ((data[0] & 4) != 0) choices.geometry = fitting::parse_geometry("punch:radius=5mm", diagnostics);
  if ((data[0] & 8) != 0)
    choices.columns.requests = fitting::parse_columns("time=1:s,position=2:mm,force=3:N", diagnostics).value();
  choices.start = static_cast<fitting::Start>((data[0] >> 4) & 3);
  fitting::LineReader lines("recording.csv", std::string(data + 1, data + size));
  if (!lines.open(diagnostics)) return diagnostics.has_errors() ? 0 : (std::abort(), 0);
  const auto read = fitting::read_recording(lines, choices, diagnostics);
  render_text(diagnostics);
  if (!read && !diagnostics.has_errors()) std::abort();
  if (!read) return 0;
  const fitting::Recording& r = read->recording;
  if (r.force.size() != r.time.size() || r.time.size() < 3) std::abort();
  if (!r.position.empty() && r.position.size() != r.time.size()) std::abort();
  if (!r.loss.empty() && r.loss.size() != r.time.size()) std::abort();
  for (std::size_t i = 1; i < r.time.size(); ++i)
    if (r.time[i] < r.time[i - 1]) std::abort();
  for (const auto* column : {&r.time, &r.position, &r.force, &r.loss})
    for (double value : *column)
      if (!std::isfinite(value)) std::abort();
  return 0;
}
