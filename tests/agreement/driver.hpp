// Runs emitted classes over a motion as architecture, section 4, says that `dashpot simulate` does, and writes what
// they return without rounding it. Compiled at the time of the test, with the headers that it is to run.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace agreement {

struct Row {
  double position;
  double velocity;
};

// "time,position" or "time,position,velocity"; without a velocity it is the slope since the row before, 0 in the first.
inline std::vector<Row> read_motion(const char* path, double rate) {
  std::vector<Row> rows;
  std::FILE* file = std::fopen(path, "r");
  if (file == nullptr) std::exit(1);
  double time = 0, position = 0, velocity = 0, last = 0;
  char line[256];
  const bool has_velocity =
      std::fgets(line, sizeof line, file) != nullptr && std::string(line).find("velocity") != std::string::npos;
  while (std::fgets(line, sizeof line, file) != nullptr) {
    std::sscanf(line, "%lf,%lf,%lf", &time, &position, &velocity);
    if (!has_velocity) velocity = rows.empty() ? 0 : (position - last) * rate;
    rows.push_back({position, velocity});
    last = position;
  }
  std::fclose(file);
  return rows;
}

// Writes position, velocity, force, damping and motor force of every row, as the class's scalar.
template <class Law>
void run(const std::vector<Row>& rows, const std::string& output) {
  using scalar = typename Law::scalar;
  std::FILE* file = std::fopen(output.c_str(), "wb");
  if (file == nullptr) std::exit(1);
  Law law;
  law.reset(0);
  for (const Row& row : rows) {
    const scalar position = static_cast<scalar>(row.position), velocity = static_cast<scalar>(row.velocity);
    const dashpot::command<scalar> now = law.step(position, velocity);
    const scalar columns[] = {position, velocity, now.damping * velocity + now.force, now.damping, now.force};
    std::fwrite(columns, sizeof(scalar), 5, file);
  }
  std::fclose(file);
}

}  // namespace agreement
