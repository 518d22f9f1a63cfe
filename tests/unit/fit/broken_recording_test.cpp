// Recordings that something is wrong with: each is refused or warned about, with its place where it has one, and with
// what would do.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>

#include "fit/read_recording.hpp"
#include "fit/findings.hpp"
#include "source/code_name.hpp"
#include "source/render.hpp"
#include "synthetic.hpp"

namespace dashpot::compiler::fitting {
namespace {

struct BrokenRecording {
  const char* what;
  std::string text;
  const char* code;
  std::size_t line;    // 0: without a place
  const char* remedy;  // part of a note, or of the message itself
  std::string columns = {};
  bool has_header = true;
};

const std::string head = "time [s],position [mm],force [N]\n";
const std::string start = head + "0,0,0\n1,1,1\n2,2,2\n";

std::string many_rows(int count, const std::string& separator = ",") {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("{}{}{}{}{}\n", i, separator, i % 7, separator, (i % 7) * 2.5);
  return text;
}

std::string saturated() {
  std::string text = head;
  for (int i = 0; i < 40; ++i) text += fmt::format("{},{},{}\n", i, i, std::min(i * 2, 40));
  return text;
}

std::vector<BrokenRecording> broken_recordings() {
  const char* const answer = ", write: ";
  const char* const row = "correct the row";
  return {
      {"nothing", "", "recording-empty", 0, "a table of numbers is expected"},
      {"blank lines", "\n\n\n", "recording-empty", 0, "a table of numbers is expected"},
      {"only a mark", "\xEF\xBB\xBF", "recording-empty", 0, "a table of numbers is expected"},
      {"words", "once upon a time\nthere was a spring\n", "recording-without-table", 1, "numbers look like"},
      {"a header alone", head, "recording-without-table", 1, "numbers look like"},
      {"one column", "1\n2\n3\n", "recording-without-table", 1, "numbers look like"},
      {"UTF-16", std::string("\xFF\xFEt\0,\0", 6), "recording-not-text", 0, "UTF-8"},
      {"binary",
       std::string("\x7F"
                   "ELF\0\0\0\0",
                   8),
       "recording-not-text", 0, "UTF-8"},
      {"commas twice", "0,1,1,5\n1,2,2,5\n", "recording-read-in-two-ways", 1, "save the table with ';'"},
      {"commas twice below a header", "t,f\n0,1,1,5\n1,2,2,5\n", "recording-read-in-two-ways", 2, "decimal points"},
      {"NaN", start + "3,3,nan\n4,4,4\n", "recording-not-a-number", 5, row},
      {"NaN of a spreadsheet", start + "3,3,#N/A\n4,4,4\n", "recording-not-a-number", 5, row},
      {"infinite", start + "3,3,inf\n4,4,4\n", "recording-not-a-number", 5, row},
      {"a gap", start + "3,,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"a gap in time", start + ",3,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"text in the table", start + "3,three,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"hexadecimal", start + "3,0x10,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"a unit in a cell", start + "3,3,3N\n4,4,4\n", "recording-not-a-number", 5, row},
      {"beyond a double", start + "3,3,1e999\n4,4,4\n", "recording-not-a-number", 5, row},
      {"two signs", start + "3,+-3,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"a decimal comma between points", start + "\"3,5\",3,3\n4,4,4\n", "recording-not-a-number", 5, row},
      {"a row too short", start + "3,3\n4,4,4\n", "recording-field-count", 5, row},
      {"a row too long", start + "3,3,3,3\n4,4,4\n", "recording-field-count", 5, row},
      {"cut off", start + "3,3,3\n4,4", "recording-field-count", 6, row},
      {"a second header", start + head + "3,3,3\n", "recording-not-a-number", 5, row},
      {"a remark in the table", start + "paused here\n3,3,3\n", "recording-field-count", 5, row},
      {"falling time", start + "1.5,3,3\n4,4,4\n", "recording-time-falls", 5, "make a file of its own"},
      {"time that begins again", start + "0,0,0\n1,1,1\n", "recording-time-falls", 5, "make a file of its own"},
      {"two values at a time", start + "2,2,2.5\n3,3,3\n", "recording-two-values", 5, "write times with more digits"},
      {"times without digits", head + "0,0,0\n0,1,1\n0,2,2\n1,3,3\n", "recording-two-values", 3, "more digits"},
      {"one row", head + "0,0,0\n", "recording-too-short", 2, "a ramp, a hold and a reversal"},
      {"two rows", head + "0,0,0\n1,1,1\n", "recording-too-short", 2, "a ramp, a hold and a reversal"},
      {"one row many times", head + "0,0,0\n0,0,0\n0,0,0\n0,0,0\n", "recording-too-short", 2, "a ramp, a hold"},
      {"no motion", head + "0,1,0\n1,1,1\n2,1,2\n", "recording-without-motion", 2, "--relaxation"},
      {"no force", head + "0,0,5\n1,1,5\n2,2,5\n", "recording-force-constant", 2, "names another column"},
      {"no force at all", head + "0,0,0\n1,1,0\n2,2,0\n", "recording-force-constant", 2, "names another column"},
      {"a force that pulls", head + "0,0,0\n1,1,-1\n2,2,-2\n", "recording-signs", 2,
       "this turns the sign of force: dashpot fit a.csv --columns time=time,position=position,force=-force"},
      {"a force that pulls, and columns asked for", "a,b,c-d\n0,5,0\n1,6,-1\n2,7,-2\n", "recording-signs", 2,
       "--columns time=a:s,position=b-5:mm,force=-c-d:N", "time=a:s,position=b-5:mm,force=c-d:N"},
      {"a saturated force", saturated(), "recording-saturated", 22, "greater range"},
      {"no units", "time,position,force\n0,0,0\n1,1,1\n2,2,2\n", "recording-unit-missing", 0, answer},
      {"no unit of the force", "time [s],position [mm],force\n0,0,0\n1,1,1\n2,2,2\n", "recording-unit-missing", 0,
       "force=force:N"},
      {"no header", many_rows(5), "recording-without-names", 0, "time=1:s,position=2:mm,force=3:N"},
      {"no header, semicolons", many_rows(5, ";"), "recording-without-names", 0, answer},
      {"no header, tabs", many_rows(5, "\t"), "recording-without-names", 0, answer},
      {"a name unknown", "time [s],way [mm],force [N]\n0,0,0\n1,1,1\n2,2,2\n", "recording-column-missing", 0, answer},
      {"no time", "position [mm],force [N]\n0,0\n1,1\n2,2\n", "recording-column-missing", 0,
       "it has 2 columns, and one is needed for each of time, position or strain, force or stress"},
      {"no force column", "time [s],position [mm]\n0,0\n1,1\n2,2\n", "recording-column-missing", 0, "it has 2 columns"},
      {"two forces", "time [s],position [mm],force [N],load [N]\n0,0,0,0\n1,1,1,1\n2,2,2,2\n",
       "recording-several-columns", 0, answer},
      {"two strains", "time [s],strain [-],true strain [-],stress [kPa]\n0,0,0,0\n1,1,1,1\n2,2,2,2\n",
       "recording-several-columns", 0, answer},
      {"f of no unit", "t [s],x [mm],f\n0,0,0\n1,1,1\n2,2,2\n", "recording-unit-missing", 0, "force=f:N"},
      {"a material", "time [s],strain [-],stress [kPa]\n0,0,0\n1,1,1\n2,2,2\n", "recording-without-geometry", 0,
       "--geometry column:"},
      {"a column that is not there", start, "recording-no-such-column", 0, "known here: time", "force=Load:N"},
      {"a number beyond the columns", many_rows(5), "recording-no-such-column", 0, "its columns are 1 to 3",
       "time=1:s,position=2:mm,force=9:N"},
      {"a unit of something else", start, "recording-wrong-unit", 0, "such as 'N'", "force=force:mm"},
      {"a unit unknown", start, "recording-no-such-column", 0, "known here: time", "position=position [mm]:ell"},
      {"a header of forces in seconds", "time [s],position [mm],force [s]\n0,0,0\n1,1,1\n2,2,2\n",
       "recording-wrong-unit", 0, "its columns are 'time [s]', 'position [mm]', 'force [s]'"},
      {"a motion and its speed", "time [s],x [mm],v [m/s]\n0,0,0\n1,1,1\n2,2,2\n", "recording-column-missing", 0,
       "which is time, position or strain, force or stress"},
      {"a motion without a force", "t,x_mm\n0,0\n1,1\n2,2\n", "recording-unit-missing", 0, "it has 2 columns"},
      {"a spectrum with primes", "f_Hz,G' [kPa],G'' [kPa]\n1,1,1\n2,2,1\n3,3,1\n", "recording-without-geometry", 0,
       "'G' [kPa]' is a storage of a material"},
      {"a spectrum of Young's moduli", "freq [Hz],E′ (MPa),E″ (MPa)\n1,1,1\n2,2,1\n3,3,1\n",
       "recording-without-geometry", 0, "is a storage of a material"},
      {"a spectrum without units", "freq,E',E''\n1,1,1\n2,2,1\n3,3,1\n", "recording-unit-missing", 0,
       "--columns \"frequency=freq:Hz,storage=E':Pa,loss=E'':Pa\""},
      {"a spectrum by its units", "nu [Hz],real [kPa],imag [kPa]\n1,1,1\n2,2,1\n3,3,1\n", "recording-column-missing", 0,
       "--columns frequency=nu,storage=real,loss=imag"},
      {"a relaxation by its units", "time [s],r [kPa]\n0,3\n1,2\n2,1\n", "recording-column-missing", 0, "modulus=r'"},
      {"a spectrum at zero", "omega [rad/s],storage [N/m],loss [N/m]\n0,1,1\n1,2,1\n2,3,1\n",
       "recording-not-a-frequency", 2, row},
      {"a spectrum at one frequency", "omega [rad/s],storage [N/m],loss [N/m]\n1,1,1\n1,2,1\n1,3,1\n",
       "recording-two-values", 3, "take one of the rows out"},
      {"a relaxation before its step", "time [s],modulus [N/m]\n-1,3\n0,2\n1,1\n", "recording-before-step", 2,
       "from it", "modulus=modulus"},
      {"a relaxation below zero", "time [s],modulus [N/m]\n0,-3\n1,-2\n2,-1\n", "recording-signs", 2,
       "--columns modulus=-modulus", "modulus=modulus"},
      {"a magnitude and a tangent", "frequency [Hz],G* [kPa],tan delta\n1,2,0.3\n2,3,0.3\n3,4,0.3\n",
       "recording-column-missing", 0,
       "'G* [kPa]', 'tan delta' cannot stand for them; columns of storage and loss are needed"},
      {"a magnitude and an angle", "freq [Hz],|G*| [Pa],phase angle [deg]\n1,2,9\n2,3,9\n3,4,9\n",
       "recording-column-missing", 0, "loss = |G*| sin δ"},
      {"a storage and a tangent", "omega [rad/s],G' [Pa],tan δ\n1,2,0.3\n2,3,0.3\n3,4,0.3\n",
       "recording-column-missing", 0, "loss = storage · tan δ"},
      {"a spectrum of the other sign", "omega [rad/s],G' [N/m],G'' [N/m]\n1,2,-1\n2,3,-1\n3,4,0.1\n", "recording-signs",
       2, "sign of loss: dashpot fit a.csv --columns \"omega=omega,storage=G',loss=-G''\""},
      {"metadata, and no units", "Cylinder Diameter: 50mm;\ntime,position,force\n0,0,0\n1,1,1\n2,2,2\n",
       "recording-unit-missing", 0, "Cylinder Diameter: 50mm"},
  };
}

std::optional<ReadRecording> read(const std::string& text, const std::string& columns, bool has_header,
                                  Diagnostics& diagnostics) {
  ReadChoices choices;
  choices.columns.command = "dashpot fit a.csv";
  choices.has_header = has_header;
  if (!columns.empty()) choices.columns.requests = parse_columns(columns, diagnostics).value();
  LineReader lines("a.csv", text);
  if (!lines.open(diagnostics)) return std::nullopt;
  return read_recording(lines, choices, diagnostics);
}

// Fails if a column that is called like a quantity that is not read is offered as another one; or if one that is called
// like none no longer is.
TEST(BrokenRecording, UnreadColumnsAreNotOffered) {
  const auto told = [](const std::string& header) {
    Diagnostics diagnostics;
    read(header + "\n1,2,0.3\n2,3,0.3\n3,4,0.3\n", "", true, diagnostics);
    return render_text(diagnostics);
  };
  for (const char* header : {"frequency [Hz],G* [kPa],tan delta", "freq [Hz],|G*| [Pa],phase angle [deg]",
                             "omega [rad/s],G' [Pa],tan δ", "f_Hz,η* [Pa s],δ [°]", "freq [Hz],E* [MPa],Loss Factor"})
    EXPECT_EQ(told(header).find("--columns"), std::string::npos) << told(header);
  EXPECT_NE(told("t,δ [mm],kraft").find("position=δ"), std::string::npos) << told("t,δ [mm],kraft");
  EXPECT_NE(told("nu [Hz],real [kPa],imag").find("--columns frequency=nu,storage=real,loss=imag"), std::string::npos)
      << told("nu [Hz],real [kPa],imag");
}

// Fails if something that is wrong passes, is told in other words or at another place, without what would do, or if the
// command line that would do is told more than once.
TEST(BrokenRecording, IsToldWithPlaceAndRemedy) {
  const std::vector<BrokenRecording> cases = broken_recordings();
  EXPECT_GE(cases.size(), 60u);
  for (const BrokenRecording& broken : cases) {
    SCOPED_TRACE(broken.what);
    Diagnostics diagnostics;
    read(broken.text, broken.columns, broken.has_header, diagnostics);
    const std::string told = render_text(diagnostics);
    EXPECT_NE(told.find("[" + std::string(broken.code) + "]"), std::string::npos) << told;
    EXPECT_NE(told.find(broken.remedy), std::string::npos) << told;
    EXPECT_EQ(told.find(", write: "), told.rfind(", write: ")) << told;
    const std::string place = fmt::format("a.csv:{}:", broken.line);
    EXPECT_TRUE(broken.line == 0 || told.find(place) != std::string::npos) << told;
  }
}

// Fails if a message about recordings has no case that provokes it, and nobody has read it in place. Those about the
// command line, several files and lines that stream are provoked by command_line/fit_test.py.
TEST(BrokenRecording, EveryMessageHasACase) {
  const std::set<DiagnosticCode> provoked_elsewhere = {
      DiagnosticCode::recording_line_too_long,  DiagnosticCode::columns_malformed,
      DiagnosticCode::geometry_malformed,       DiagnosticCode::recordings_differ,
      DiagnosticCode::recording_delay_too_long, DiagnosticCode::recording_twice,
      DiagnosticCode::recording_held_out_fitted};
  std::set<std::string> provoked;
  for (const BrokenRecording& broken : broken_recordings()) provoked.insert(broken.code);
  for (auto i = static_cast<std::size_t>(DiagnosticCode::recording_not_text);
       i <= static_cast<std::size_t>(DiagnosticCode::recording_saturated); ++i) {
    const auto code = static_cast<DiagnosticCode>(i);
    EXPECT_TRUE(provoked_elsewhere.count(code) > 0 || provoked.count(code_name(code)) > 0) << code_name(code);
  }
}

// Fails if a force that comes late, which a fit takes for stiffness that is not there, goes unnoticed; or is seen where
// there is none.
TEST(BrokenRecording, LateForce) {
  Recording recording;
  const auto position = [](double t) { return 1e-3 * std::sin(3 * t) + 4e-4 * std::sin(11 * t); };
  for (int i = 0; i < 600; ++i) {
    recording.time.push_back(0.01 * i);
    recording.position.push_back(position(0.01 * i));
    recording.force.push_back(100 * position(0.01 * i));
  }
  EXPECT_EQ(force_delay(recording), 0);
  for (int i = 0; i < 600; ++i) recording.force[static_cast<std::size_t>(i)] = 100 * position(0.01 * i - 0.05);
  EXPECT_NEAR(force_delay(recording), 0.05, 1e-9);
}

// Fails if what is in order is refused, or read as something else.
TEST(SoundRecording, IsReadAsItIsMeant) {
  struct Sound {
    const char* what;
    std::string text, columns = {};
    bool has_header = true;
  };
  const std::vector<Sound> cases = {
      {"plain", start},
      {"a mark, and lines of Windows", "\xEF\xBB\xBFtime [s],position [mm],force [N]\r\n0,0,0\r\n1,1,1\r\n2,2,2\r\n"},
      {"decimal commas", "time [s];position [mm];force [N]\n0,0;0,0;0,0\n1,0;1,0;1,0\n2,0;2,0;2,0\n"},
      {"tabs", "time [s]\tposition [mm]\tforce [N]\n0\t0\t0\n1\t1\t1\n2\t2\t2\n"},
      {"tabs and decimal commas", "time_s\tposition_mm\tforce_N\n0\t0\t0,0\n1\t1\t1,0\n2\t2\t2,0\n"},
      {"blanks", "time_s position_mm force_N\n0 0 0\n1   1  1\n 2 2 2\n"},
      {"suffixes", "time_s,displacement_mm,force_N\n0,0,0\n1,1,1\n2,2,2\n"},
      {"a row of units", "t,x,F\ns, mm, N\n0,0,0\n1,1,1\n2,2,2\n"},
      {"remarks", "# t,x,f\n# s,mm,N\n0,0,0\n# here\n1,1,1\n\n2,2,2\n"},
      {"quotes", "\"time [s]\",\"position [mm]\",\"force [N]\"\n\"0\",\"0\",\"0\"\n1,1,1\n2,2,2\n"},
      {"metadata",
       "Machine: INSTRON 5900;\nSpeed (mm/min): 10;\ntime (s),Compression (mm),Load (N)\n0,0,0\n1,1,1\n2,2,2\n"},
      {"equal rows twice", "time [s],position [mm],force [N]\n0,0,0\n1,1,1\n1,1,1\n2,2,2\n"},
      {"other columns", "time [s],note,position [mm],force [N]\n0,a,0,0\n1,b,1,1\n2,c,2,2\n"},
      {"metres and kilonewtons", "time [ms],position [m],force [kN]\n0,0,0\n1000,0.001,0.001\n2000,0.002,0.002\n"},
      {"numbers for names", "0,0,0\n1,1,1\n2,2,2\n", "time=1:s,position=2:mm,force=3:N", false},
      {"a sign turned and a zero moved", "a,b,c\n0,5,0\n1,6,-1\n2,7,-2\n", "time=a:s,position=b-5:mm,force=-c:N"},
      {"no end of line at the end", "time [s],position [mm],force [N]\n0,0,0\n1,1,1\n2,2,2"}};
  for (const Sound& sound : cases) {
    SCOPED_TRACE(sound.what);
    Diagnostics diagnostics;
    const auto read_back = read(sound.text, sound.columns, sound.has_header, diagnostics);
    ASSERT_TRUE(read_back) << render_text(diagnostics);
    EXPECT_EQ(read_back->recording.time, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(read_back->recording.position, (std::vector<double>{0, 0.001, 0.002}));
    EXPECT_EQ(read_back->recording.force, (std::vector<double>{0, 1, 2}));
  }
}

// Fails if a recording that comes from rest at 0 begins with a jump, or one that rests elsewhere is moved.
TEST(SoundRecording, BeginsAtRest) {
  Diagnostics diagnostics;
  const auto moving = read(head + "1,1,1\n2,2,2\n3,3,3\n4,3,2.5\n", "", true, diagnostics);
  ASSERT_TRUE(moving);
  EXPECT_TRUE(moving->has_assumed_start);
  EXPECT_EQ(moving->recording.time.front(), 0);
  EXPECT_EQ(moving->recording.assumed_rows, 1u);
  const auto resting = read(head + "0,5,0\n1,5,0\n2,6,1\n3,7,2\n", "", true, diagnostics);
  ASSERT_TRUE(resting);
  EXPECT_EQ(resting->recording.position.front(), 0);
  EXPECT_EQ(resting->recording.origin, 0.005);
  const auto late = read(head + "0,50,5\n1,60,6\n2,70,7\n3,80,8\n", "", true, diagnostics);
  ASSERT_TRUE(late);
  EXPECT_TRUE(late->begins_in_motion);
}

// Fails if the noise of a phase is taken for a wrong sign, of a solid that hardly loses anything.
TEST(SoundRecording, MayLoseNothing) {
  Diagnostics diagnostics;
  const std::string lossless = "omega [rad/s],storage [N/m],loss [N/m]\n1,2,-0.01\n2,2,0.002\n3,2,-0.02\n";
  EXPECT_TRUE(read(lossless, "", true, diagnostics)) << render_text(diagnostics);
}

// Fails if a sine that is cut out where it passes 0 is taken for a motion from rest, or a ramp from rest for a cut.
TEST(SoundRecording, TellsACutFromAStart) {
  Diagnostics diagnostics;
  const auto cut = read(head + "0,0,3\n1,4,6\n2,6,5\n3,4,1\n4,0,-3\n", "", true, diagnostics);
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->begins_in_motion);
  const auto ramp = read(head + "0,0,0.1\n1,4,3\n2,6,5\n3,4,2\n4,0,-1\n", "", true, diagnostics);
  ASSERT_TRUE(ramp);
  EXPECT_FALSE(ramp->begins_in_motion);
}

}  // namespace
}  // namespace dashpot::compiler::fitting
