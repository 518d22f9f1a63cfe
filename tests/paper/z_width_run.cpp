#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>

#include "chosen.hpp"
#include "source/digest.hpp"
#include "z_width.hpp"

namespace dashpot::paper {
namespace {

constexpr const char* finished = "finished";

// The file begins with what its lines depend on.
std::string settings(const std::vector<MapPlace>& places) {
  std::string all = rig().digest;
  for (const Choice& choice : all_choices()) all += choice.name + choice.value;
  for (const MapPlace& place : places) all += place.key();
  return "settings," + compiler::digest_of(all);
}

struct Line {
  std::string key;
  MapPoint point;
};

std::string text_of(const Line& line) {
  return fmt::format("{},{},{},{},{},end\n", line.key, line.point.stable, line.point.certified,
                     line.point.lowest_energy, line.point.certified_runs);
}

// Empty for a line that was cut off.
std::optional<Line> line_of(const std::string& text) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t comma; (comma = text.find(',', from)) != std::string::npos; from = comma + 1)
    cells.push_back(text.substr(from, comma - from));
  if (text.substr(from) != "end" || cells.size() < 5) return std::nullopt;
  const std::size_t n = cells.size() - 4;
  Line line;
  for (std::size_t i = 0; i < n; ++i) line.key += (i ? "," : "") + cells[i];
  line.point = {std::stod(cells[n]), std::stod(cells[n + 1]), std::stod(cells[n + 2]),
                static_cast<unsigned>(std::stoul(cells[n + 3]))};
  return line;
}

std::map<std::string, MapPoint> read_points(const std::string& file, const std::string& wanted) {
  std::map<std::string, MapPoint> points;
  std::ifstream stream(file);
  std::string text;
  if (!std::getline(stream, text) || text != wanted) return {};
  while (std::getline(stream, text)) {
    if (text == finished) return {};
    if (const std::optional<Line> line = line_of(text)) points[line->key] = line->point;
  }
  return points;
}

// Begins the file anew with what is known already, so that a line that was cut off is gone.
void rewrite(const std::string& file, const std::string& heading, const std::map<std::string, MapPoint>& points) {
  const std::string next = file + ".new";
  {
    std::ofstream stream(next);
    stream << heading << "\n";
    for (const auto& [key, point] : points) stream << text_of({key, point});
  }
  std::filesystem::rename(next, file);
}

}  // namespace

ZWidth measure_z_width(const std::vector<MapPlace>& places, const std::string& file,
                       const std::function<void(std::size_t done, std::size_t all)>& progress) {
  const std::map<std::string, MapPoint> known = read_points(file, settings(places));
  rewrite(file, settings(places), known);
  std::ofstream stream(file, std::ios::app);
  ZWidth map{places, std::vector<MapPoint>(places.size())};
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < places.size();) {
      const auto found = known.find(places[i].key());
      map.points[i] = found != known.end() ? found->second : measure(places[i]);
      const std::lock_guard<std::mutex> lock(mutex);
      if (found == known.end()) stream << text_of({places[i].key(), map.points[i]}) << std::flush;
      progress(++done, places.size());
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  stream << finished << "\n";
  return map;
}

}  // namespace dashpot::paper
