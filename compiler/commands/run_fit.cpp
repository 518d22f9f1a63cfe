#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

#include "commands/commands.hpp"
#include "commands/fit_output.hpp"
#include "emit/write_files.hpp"
#include "fit/network_text.hpp"
#include "fit/read_recording.hpp"
#include "network/name_rules.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using namespace fitting;

// What is being done, on a terminal alone: overwritten by the next, and removed at the end.
class ProgressLine {
 public:
  ~ProgressLine() { show(""); }

  void show(const std::string& what) {
    if (!is_terminal_ || (what.empty() && !is_shown_)) return;
    std::fprintf(stderr, "\r\033[K%s", what.c_str());
    std::fflush(stderr);
    is_shown_ = !what.empty();
  }

 private:
  bool is_terminal_ = ::isatty(STDERR_FILENO) == 1, is_shown_ = false;
};

// The command line; without an option and its value where those are named.
std::string command_line(const FitWords& words, const std::string& without = "") {
  std::string text = "dashpot";
  for (std::size_t i = 0; i < words.arguments.size(); ++i) {
    if (!without.empty() && words.arguments[i] == without) {
      ++i;
      continue;
    }
    if (!without.empty() && words.arguments[i].starts_with(without + "=")) continue;
    text += " " + shell_word(words.arguments[i]);
  }
  return text;
}

// A name that a network may have, of what is left of a path without its folders and its ending.
std::string name_of_file(const std::string& path) {
  std::string name;
  for (const char c : std::filesystem::path(path).stem().string()) {
    const bool is_letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_letter) name += c;
    else if (!name.empty() && name.back() != '_') name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "fitted_" + name;
  while (name.ends_with('_')) name.pop_back();
  return legal_name(name);
}

class FitCommand {
 public:
  FitCommand(const Options& options, Diagnostics& diagnostics)
      : options_(options), words_(options.fit), diagnostics_(diagnostics) {}

  ExitStatus run() {
    if (!take_words()) return ExitStatus::command_line_wrong;
    if (!read_all(words_.recordings, recordings_) || !read_all(words_.hold_out, held_out_))
      return ExitStatus::input_refused;
    if (!are_alike()) return ExitStatus::input_refused;
    if (!suits(recordings_.front().kind) || !has_deviations()) return ExitStatus::command_line_wrong;
    if (!settle_surface()) return ExitStatus::input_refused;
    settle_form();
    const std::optional<Fit> found = fit(recordings_, held_out_, choices_, diagnostics_,
                                         [this](const std::string& what) { line_.show("fitting: " + what); });
    line_.show("");
    if (!found || diagnostics_.has_errors()) return ExitStatus::input_refused;
    report_findings(*found, recordings_, diagnostics_);
    return write(*found);
  }

 private:
  static constexpr const char* needs_a_motion = "it is fitted to forces over positions";

  bool refuse(const std::string& value, const std::string& what) {
    diagnostics_.report<DiagnosticCode::fit_wrong_quantity>({}, value, what);
    return false;
  }

  bool contradicts(const char* one, const char* other, const char* why) {
    diagnostics_.report<DiagnosticCode::fit_choices_contradict>({}, one, other, why);
    return false;
  }

  bool take_words() {
    if (options_.output && words_.report && !are_apart({*options_.output, *words_.report}, diagnostics_)) return false;
    if (words_.name && !check_name({*words_.name, {}}, "network", diagnostics_)) return false;
    if (words_.relaxation && words_.creep) return contradicts("--relaxation", "--creep", "a recording is one of them");
    read_.columns.is_relaxation = words_.relaxation;
    read_.columns.is_creep = words_.creep;
    read_.columns.command = command_line(words_, "--columns");
    read_.has_header = !words_.no_header;
    if (words_.columns) {
      const auto requests = parse_columns(*words_.columns, diagnostics_);
      if (!requests) return false;
      read_.columns.requests = *requests;
    }
    if (words_.geometry && !(read_.geometry = parse_geometry(*words_.geometry, diagnostics_))) return false;
    if (words_.relaxation && !suits(RecordingKind::relaxation, "--relaxation")) return false;
    if (words_.creep && !suits(RecordingKind::creep, "--creep")) return false;
    return take_quantities() && take_sizes() && take_shape() && take_start();
  }

  // False, with a diagnostic, where something is asked for that only a motion has. The kind is known from the command
  // line, or once the recordings are read.
  bool suits(RecordingKind kind, const char* asked = nullptr) {
    if (kind == RecordingKind::motion) return true;
    struct ForMotions {
      bool is_asked;
      const char *option, *why;
    };
    const std::string other = asked != nullptr                    ? asked
                              : kind == RecordingKind::relaxation ? "a relaxation"
                              : kind == RecordingKind::frequency  ? "a spectrum"
                                                                  : "creep";
    for (const auto& [is_asked, option, why] :
         {ForMotions{words_.shape.value_or("none") != "none", "--shape", needs_a_motion},
          {words_.elastic, "--elastic", needs_a_motion},
          {words_.slips != "none", "--slips", "slips are fitted to positions over time"},
          {words_.contact.has_value(), "--contact", "a surface is found and left by a tool that moves"},
          {words_.tare, "--tare", "the sensor's offset is found where the force changes with the position"},
          {words_.force_delay.has_value(), "--force-delay", "forces are moved in time against positions"},
          {words_.start != "auto", "--start", "it says how a motion begins"},
          {words_.springpots != "none" && kind == RecordingKind::creep, "--springpots auto",
           "springpots are fitted as stiffness"},
          {words_.control == "force" && kind != RecordingKind::creep, "--control force", "it is about a motion"}})
      if (is_asked) return contradicts(option, other.c_str(), why);
    return true;
  }

  bool has_deviations() {
    if (words_.weight != "deviation") return true;
    if (recordings_.front().kind == RecordingKind::motion && words_.control == "force")
      return contradicts("--weight deviation", "--control force", "the deviation is that of the force");
    for (const std::vector<Recording>* list : {&recordings_, &held_out_})
      for (const Recording& recording : *list)
        if (recording.deviation.empty())
          return contradicts(
              "--weight deviation", ("'" + recording.name + "'").c_str(),
              "it has no column that is clearly a deviation; --columns deviation=NAME:UNIT says which is "
              "one");
    return true;
  }

  bool take_quantities() {
    if (words_.scale) {
      const auto scale = spoken_quantity(*words_.scale);
      if (!scale || !(scale->value > 0))
        return refuse(*words_.scale, "scale; a modulus, a stiffness or a compliance is expected, as in \"1kPa\"");
      read_.columns.scale = scale->value;
      read_.columns.scale_dimension = scale->dimension;
    }
    if (words_.force_delay) {
      const auto delay = spoken_quantity(*words_.force_delay);
      if (!delay || !(delay->dimension == dimensions::time))
        return refuse(*words_.force_delay, "delay; a time is expected, as in \"20ms\"");
      read_.force_delay = delay->value;
    }
    if (words_.tolerance) {
      const auto tolerance = spoken_quantity(*words_.tolerance);
      if (!tolerance || !(tolerance->dimension == dimensions::number) || !(tolerance->value > 0))
        return refuse(*words_.tolerance, "tolerance; a share above 0 is expected, as in \"1%\"");
      choices_.reduction.tolerance = tolerance->value;
    }
    return take_contact();
  }

  bool take_contact() {
    read_.keeps_positions = words_.contact.has_value();
    if (!words_.contact || *words_.contact == "find") return true;
    const auto at = spoken_quantity(*words_.contact);
    const bool is_place = at && (at->dimension == dimensions::length || at->dimension == dimensions::angle);
    if (!is_place)
      return refuse(*words_.contact, "place of a surface; 'find' or a position is expected, as in \"0.2mm\"");
    choices_.contact = at->value;
    return true;
  }

  bool take_sizes() {
    choices_.reduction.modes = words_.modes;
    choices_.reduction.gains_are_free = words_.gain_per_file;
    choices_.reduction.springpots = words_.springpots == "auto";
    if (words_.slips == "auto") choices_.reduction.slips = SlipChoice::stops;
    else if (words_.slips == "viscous") choices_.reduction.slips = SlipChoice::viscous;
    else if (words_.slips != "none") {
      std::size_t count = 0;
      const auto [end, error] = std::from_chars(words_.slips.data(), words_.slips.data() + words_.slips.size(), count);
      if (error != std::errc() || end != words_.slips.data() + words_.slips.size())
        return refuse(words_.slips, "number of slips; 'none', 'auto', 'viscous' or a number is expected");
      choices_.reduction.stops = count;
      choices_.reduction.slips = SlipChoice::stops;
    }
    if (choices_.reduction.springpots && words_.control == "force")
      return contradicts("--springpots auto", "--control force", "springpots are fitted as stiffness");
    if (choices_.reduction.slips != SlipChoice::none && words_.control == "force")
      return contradicts("--slips", "--control force", "slips are fitted to positions over time");
    if (words_.gain_per_file && words_.recordings.size() < 2)
      return contradicts("--gain-per-file", "one recording", "its gain is in the network");
    return true;
  }

  bool take_shape() {
    const std::string shape = words_.shape.value_or("none");
    static const std::map<std::string, ShapeChoice> shapes = {{"none", ShapeChoice::none},
                                                              {"power", ShapeChoice::power},
                                                              {"exponential", ShapeChoice::exponential},
                                                              {"table", ShapeChoice::table},
                                                              {"auto", ShapeChoice::automatic}};
    choices_.reduction.shape = shapes.at(shape);
    choices_.reduction.is_elastic = words_.elastic;
    const bool controls_force = words_.control == "force";
    if (shape != "none" && controls_force) return contradicts("--shape", "--control force", needs_a_motion);
    if (!words_.elastic) return true;
    if (controls_force) return contradicts("--elastic", "--control force", needs_a_motion);
    if (words_.modes || words_.slips != "none" || words_.springpots != "none")
      return contradicts("--elastic",
                         words_.modes             ? "--modes"
                         : words_.slips != "none" ? "--slips"
                                                  : "--springpots",
                         "an elastic network is one spring");
    return true;
  }

  bool take_start() {
    if (words_.start == "rest") read_.start = Start::first_row;
    if (words_.start == "zero") read_.start = Start::zero;
    if (words_.start == "moving") read_.start = Start::moving;
    return true;
  }

  bool read_all(const std::vector<std::string>& paths, std::vector<Recording>& recordings) {
    bool is_whole = true;
    for (const std::string& path : paths) {
      LineReader lines(path, [&](std::size_t done, std::size_t of) {
        if (of > (std::size_t{4} << 20))
          line_.show(fmt::format("reading {}: {} %", path, done * 100 / std::max(done, of)));
      });
      std::optional<ReadRecording> read;
      if (lines.open(diagnostics_)) read = read_recording(lines, read_, diagnostics_);
      line_.show("");
      if (!read) {
        is_whole = false;
        continue;
      }
      note_start(*read, &recordings == &recordings_, recordings.size());
      warn_of_the_same(read->recording, &recordings == &recordings_);
      recordings.push_back(std::move(read->recording));
    }
    return is_whole;
  }

  void warn_of_the_same(const Recording& recording, bool is_fitted) {
    for (const Recording& other : recordings_) {
      if (other.digest != recording.digest) continue;
      if (is_fitted) diagnostics_.report<DiagnosticCode::recording_twice>({}, recording.name, other.name);
      else diagnostics_.report<DiagnosticCode::recording_held_out_fitted>({}, recording.name, other.name);
      return;
    }
  }

  void note_start(const ReadRecording& read, bool is_fitted, std::size_t file) {
    if (!is_fitted) return;
    if (read.has_assumed_start) choices_.assumed_starts.push_back(file);
    if (!read.begins_in_motion) return;
    if (read_.start == Start::moving) {
      choices_.reduction.in_motion.push_back(file);
      choices_.reduction.beside.push_back({TermKind::offset, 0, 0, 0, file});
    } else if (read_.start == Start::automatic) {
      diagnostics_.report<DiagnosticCode::fit_in_motion>({}, read.recording.name);
      diagnostics_.note<DiagnosticCode::fit_start_remedy>({});
    }
  }

  static const char* word_of(RecordingKind kind) {
    switch (kind) {
      case RecordingKind::motion: return "motion";
      case RecordingKind::relaxation: return "relaxation";
      case RecordingKind::creep: return "creep";
      case RecordingKind::frequency: return "spectrum";
    }
    return "";
  }

  bool are_alike() {
    const Recording& first = recordings_.front();
    for (const std::vector<Recording>* list : {&recordings_, &held_out_})
      for (const Recording& recording : *list) {
        const bool is_same_kind = recording.kind == first.kind;
        if (is_same_kind && recording.port_motion == first.port_motion) continue;
        const auto word = [&](const Recording& r) { return is_same_kind ? name_of(r.port_motion) : word_of(r.kind); };
        diagnostics_.report<DiagnosticCode::recordings_differ>({}, first.name, word(first), recording.name,
                                                               word(recording));
        return false;
      }
    return true;
  }

  // Of all recordings: the least and the greatest position.
  std::pair<double, double> way() const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Recording& recording : recordings_)
      for (const double position : recording.position) low = std::min(low, position), high = std::max(high, position);
    return {low, high};
  }

  // A surface that was found, in as many digits as are told of it: at least four, and no coarser than four of the way
  // that the tool goes, however far from 0 that is.
  double in_digits(double place) const {
    const auto [low, high] = way();
    const auto decade = [](double value) { return static_cast<int>(std::floor(std::log10(value))); };
    const int more = place != 0 && high > low ? std::max(0, decade(std::abs(place)) - decade(high - low)) : 0;
    return std::strtod(fmt::format("{:.{}e}", place, 3 + more).c_str(), nullptr);
  }

  bool settle_surface() {
    if (!words_.contact) return true;
    if (!choices_.contact) {
      line_.show("fitting: looking for the surface");
      choices_.contact = in_digits(find_contact(recordings_, choices_.reduction));
      choices_.contact_is_found = true;
    }
    const auto [low, high] = way();
    if (*choices_.contact >= high) {
      const auto text = [&](double place) { return place_text(place, recordings_.front().port_motion); };
      diagnostics_.report<DiagnosticCode::fit_surface_beyond>({}, text(*choices_.contact), text(low), text(high));
      diagnostics_.note<DiagnosticCode::fit_contact_remedy>({});
      return false;
    }
    recordings_ = behind_surface(std::move(recordings_), *choices_.contact);
    held_out_ = behind_surface(std::move(held_out_), *choices_.contact);
    return true;
  }

  void settle_form() {
    const RecordingKind kind = recordings_.front().kind;
    choices_.form = kind == RecordingKind::creep || words_.control == "force" ? Form::compliance : Form::stiffness;
    choices_.weighting = words_.weight == "relative"                                   ? Weighting::relative
                         : words_.weight == "deviation"                                ? Weighting::deviation
                         : words_.weight == "auto" && kind == RecordingKind::frequency ? Weighting::relative
                                                                                       : Weighting::uniform;
    choices_.port_motion = recordings_.front().port_motion;
    choices_.name = words_.name ? *words_.name : options_.output ? name_of_file(*options_.output) : "fitted";
    choices_.command = command_line(words_);
    choices_.title = words_.title.value_or("");
    choices_.source = source();
    if (words_.tare)
      for (std::size_t file = 0; file < recordings_.size(); ++file)
        choices_.reduction.beside.push_back({TermKind::offset, 0, 0, 0, file});
  }

  std::string source() const {
    std::string text = (words_.source ? *words_.source + ". " : "") + "Fitted by dashpot fit to ";
    for (const Recording& recording : recordings_)
      text +=
          (&recording == &recordings_.front() ? "" : ", ") + std::filesystem::path(recording.name).filename().string();
    if (read_.geometry) text += "; " + read_.geometry->sentence;
    if (words_.scale) text += "; values are relative to " + *words_.scale;
    if (words_.contact) text += "; displacements of network and curve are from the surface";
    for (const Recording& recording : recordings_)
      if (recording.origin != 0) {
        text += "; displacements are from each recording's first row";
        break;
      }
    if (words_.gain_per_file) text += "; a gain for each recording was fitted, of mean 1";
    return text;
  }

  ExitStatus write(const Fit& found) {
    std::vector<OutputFile> files;
    if (options_.output) files.push_back({*options_.output, found.text});
    if (words_.report) files.push_back({*words_.report, fit_page(found, recordings_, held_out_, diagnostics_)});
    if (diagnostics_.has_errors() || !write_files("", files, diagnostics_)) return ExitStatus::input_refused;
    return write_standard_output(words_.json ? fit_json(found, recordings_) : fit_text(found, recordings_),
                                 diagnostics_);
  }

  const Options& options_;
  const FitWords& words_;
  Diagnostics& diagnostics_;
  ProgressLine line_;
  ReadChoices read_;
  FitChoices choices_;
  std::vector<Recording> recordings_, held_out_;
};

}  // namespace

ExitStatus run_fit(const Options& options, SourceFiles&, Diagnostics& diagnostics) {
  return FitCommand(options, diagnostics).run();
}

}  // namespace dashpot::compiler
