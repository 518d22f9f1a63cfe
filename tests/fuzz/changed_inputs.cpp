// Runs a fuzzer's entry point over its seeds and over seeded changes of them, in any build: the same inputs on every
// machine, without a fuzzer. An input that ends the program, or takes longer than `seconds_an_input`, is left in a
// file. In a thorough run (support/repetitions.hpp) there are ten changes for each of --changes.
//
//     NAME --left FILE [--seeds N] [--changes N] [--largest BYTES] [--words FILE] [--megabytes N] PATH…
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "support/random.hpp"
#include "support/repetitions.hpp"
#include "support/shell_command.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using dashpot::testing::Random;

constexpr unsigned seconds_an_input = 100;

// What a handler of signals may read.
const std::string* running = nullptr;
const char* left_in = nullptr;

void leave_input(int signal) {
  const int file = open(left_in, O_CREAT | O_WRONLY | O_TRUNC, 0644);
  const auto ignored = write(file, running->data(), running->size());
  const char text[] = "the input that ended this is left in ";
  const auto told = write(2, text, sizeof text - 1) + write(2, left_in, std::strlen(left_in)) + write(2, "\n", 1);
  static_cast<void>(ignored + told);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

// In the order of their names; of a folder all that is in it, and below.
std::vector<std::string> seeds_in(const fs::path& path, std::size_t largest) {
  std::vector<fs::path> files;
  if (!fs::is_directory(path)) files.push_back(path);
  else
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(dashpot::testing::text_of(file).substr(0, largest));
  return seeds;
}

// Of a dictionary of libFuzzer's: what stands between quotes, a line each, with \\, \" and \xAB.
std::vector<std::string> words_of(const std::string& file) {
  std::vector<std::string> words;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find('"'), last = line.rfind('"');
    if (line.starts_with('#') || first >= last || last == line.npos) continue;
    std::string word;
    for (std::size_t i = first + 1; i < last; ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (line[++i] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

struct Material {
  std::vector<std::vector<std::string>> folders;  // of seeds; the last one is empty, and stands for any bytes
  std::vector<std::string> words;
  std::size_t largest;
};

// From each folder as often, however many it holds.
std::string drawn_seed(const Material& material, Random& random) {
  const std::vector<std::string>& folder = material.folders[random.index(material.folders.size())];
  if (!folder.empty()) return folder[random.index(folder.size())];
  std::string bytes;
  for (std::size_t count = random.index(600); count > 0; --count) bytes += static_cast<char>(random.index(256));
  return bytes;
}

// A digit, or bytes behind the end, which leave a text what it is, half of the time.
void change(std::string& input, const Material& material, Random& random) {
  const std::size_t at = random.index(input.size() + 1);
  const std::size_t span = std::min(random.index(random.chance(0.8) ? 9 : 200), input.size() - at);
  switch (random.chance(0.5) ? random.between(6, 7) : random.index(6)) {
    case 0:
      if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << random.index(8)));
      return;
    case 1: input.insert(at, 1, static_cast<char>(random.index(256))); return;
    case 2: input.erase(at, span); return;
    case 3: input.insert(random.index(input.size() + 1), input.substr(at, span)); return;
    case 4:
      if (!material.words.empty()) input.replace(at, span, material.words[random.index(material.words.size())]);
      return;
    case 5: {  // the end of another one
      const std::string other = drawn_seed(material, random);
      input.replace(at, input.npos, other.substr(random.index(other.size() + 1)));
      return;
    }
    case 6: {
      const std::size_t digit = input.find_first_of("0123456789", at);
      if (digit != input.npos) input[digit] = static_cast<char>('0' + random.index(10));
      return;
    }
    case 7: input += static_cast<char>(random.index(256)); return;
  }
}

std::string changed_input(const Material& material, std::uint64_t number) {
  Random random(number);
  std::string input = drawn_seed(material, random);
  for (std::size_t changes = random.between(1, 6); changes > 0; --changes) change(input, material, random);
  input.resize(std::min(input.size(), material.largest));
  return input;
}

void run(const std::string& input) {
  running = &input;
  alarm(seconds_an_input);
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());  // no zero behind them
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

int run_all(const std::vector<std::string>& arguments) {
  std::map<std::string, std::string> options;
  std::vector<std::string> paths;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (!arguments[i].starts_with("--")) paths.push_back(arguments[i]);
    else if (i + 1 < arguments.size()) options[arguments[i]] = arguments[i + 1], ++i;
  }
  const auto number = [&](const char* option, std::size_t otherwise) -> std::size_t {
    return options.contains(option) ? std::stoull(options[option]) : otherwise;
  };
  static std::string left;
  left = options.at("--left");
  left_in = left.c_str();
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, leave_input);
  if (const std::size_t megabytes = number("--megabytes", 0)) {
    const rlimit most{megabytes << 20, megabytes << 20};
    setrlimit(RLIMIT_DATA, &most);
  }
  Material material{{}, {}, number("--largest", 8192)};
  std::vector<std::string> all{""};
  for (const std::string& path : paths) {
    material.folders.push_back(seeds_in(path, material.largest));
    all.insert(all.end(), material.folders.back().begin(), material.folders.back().end());
  }
  material.folders.emplace_back();
  if (options.contains("--words")) material.words = words_of(options["--words"]);
  const std::size_t seeds = std::min(all.size(), number("--seeds", all.size()));
  for (std::size_t i = 0; i < seeds; ++i) run(all[i * all.size() / seeds]);
  const std::size_t usual = number("--changes", 1000), changes = dashpot::testing::repetitions(usual, 10 * usual);
  for (std::uint64_t i = 0; i < changes; ++i) run(changed_input(material, i));
  alarm(0);
  std::printf("%zu seeds of %zu, %zu changed inputs\n", seeds, all.size(), changes);
  return 0;
}

}  // namespace

int main(int count, char** arguments) { return run_all({arguments, arguments + count}); }
