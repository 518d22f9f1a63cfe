#include "exchange/prony_format.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "source/render.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

struct Read {
  Read(const std::string& text, PronyQuestion question) : file("deck", text) {
    series = read_prony(file, question, diagnostics);
  }
  std::string said() const { return render_text(diagnostics); }

  SourceFile file;
  Diagnostics diagnostics;
  std::optional<PronySeries> series;
};

std::vector<double> stiffnesses(const PronySeries& series) {
  std::vector<double> all{series.long_term_stiffness()};
  for (const PronyTerm& term : series.terms) all.push_back(series.stiffness_of(term));
  return all;
}

// What a reader returns counts in shares of the stiffness that the file is of.
PronySeries with_stiffness(PronySeries series, PronyFormat format, double at_once) {
  const double scale = format == PronyFormat::ls_dyna ? 1 : at_once;
  series.stiffness *= scale;
  if (series.of == PronyOf::absolute)
    for (PronyTerm& term : series.terms) term.weight *= scale;
  return series;
}

// If this fails, a series that is exported and imported again is another tissue.
TEST(PronyFormats, GiveBackWhatTheyWereGiven) {
  dashpot::testing::Random random(17);
  for (int round = 0; round < 50; ++round) {
    PronySeries series{PronyOf::absolute, random.log_uniform(1, 1e4), {}};
    const int terms = 1 + round % 12;
    for (int i = 0; i < terms; ++i)
      series.terms.push_back({random.log_uniform(1e-2, 1e4), random.log_uniform(1e-6, 1e6)});
    double at_once = series.stiffness;
    for (const PronyTerm& term : series.terms) at_once += term.weight;
    for (const PronyFormat format :
         {PronyFormat::abaqus, PronyFormat::ansys, PronyFormat::febio, PronyFormat::ls_dyna, PronyFormat::generic}) {
      const std::string text = write_prony(series, format, "tissue", "N/m");
      const Read read(text, {format, {}, PronyOf::instantaneous});
      ASSERT_TRUE(read.series) << name_of(format) << "\n" << text << read.said();
      const PronySeries back = with_stiffness(*read.series, format, at_once);
      ASSERT_EQ(back.terms.size(), series.terms.size()) << text;
      const std::vector<double> found = stiffnesses(back), given = stiffnesses(series);
      for (std::size_t i = 0; i < given.size(); ++i)  // the long-term stiffness is what is left of 1
        EXPECT_NEAR(found[i], given[i], 1e-14 * at_once) << name_of(format) << "\n" << text;
      for (std::size_t i = 0; i < series.terms.size(); ++i)
        EXPECT_NEAR(back.terms[i].time, series.terms[i].time, 3e-16 * series.terms[i].time) << text;
    }
  }
}

struct Deck {
  const char* what;
  PronyFormat format;
  const char* text;
  std::vector<double> stiffnesses;  // long-term, then each term
  std::vector<double> times;
};

const Deck decks[] = {
    {"Abaqus, with words as people write them",
     PronyFormat::abaqus,
     "** a remark\n*MATERIAL, NAME=liver\n*Elastic, moduli=instantaneous\n 12., 0.49\n*Viscoelastic , Time = PRONY\n"
     " 0.4, 0.,  0.1\n  2.5D-1 ,, 3.\n*Density\n 1e-9,\n",
     {0.35, 0.4, 0.25},
     {0.1, 3}},
    {"ANSYS, three constants a line, a bulk table beside",
     PronyFormat::ansys,
     "/PREP7\nTB,PRONY,2,1,2,SHEAR\nTBFIELD,TEMP,20\nTBDATA,1,0.4,0.1,0.25\nTBDATA,4,3\nTB,PRONY,2,1,1,BULK\nTBDATA,1,"
     "0.1,5\n",
     {0.35, 0.4, 0.25},
     {0.1, 3}},
    {"ANSYS, with remarks behind its values",
     PronyFormat::ansys,
     "! a remark\nTB,PRONY,2,1,2,SHEAR ! of the liver\nTBDATA,1,0.4,0.1  ! fast, slow\nTBDATA,3,0.25,3! slow\n",
     {0.35, 0.4, 0.25},
     {0.1, 3}},
    {"FEBio, with a term left out",
     PronyFormat::febio,
     "<material type=\"viscoelastic\"><g1>0.5</g1><t1>2</t1><g3>1.5</g3><t3>20</t3></material>",
     {1, 0.5, 1.5},
     {2, 20}},
    {"FEBio, long-term",
     PronyFormat::febio,
     "<?xml version=\"1.0\"?><febio_spec><Material><material id=\"1\" name=\"fat\" type=\"viscoelastic\"><g1>0.5</g1>"
     "<t1>2</t1><g2> 1.5 </g2><t2>20</t2><elastic type=\"neo-Hookean\"/></material></Material></febio_spec>",
     {1, 0.5, 1.5},
     {2, 20}},
    {"LS-DYNA, columns of ten",
     PronyFormat::ls_dyna,
     "*KEYWORD\n*MAT_GENERAL_VISCOELASTIC\n$#     mid        ro      bulk\n         7 1.000E-06      2.19\n"
     "         0\n$       gi     betai\n     120.0       0.0\n      40.0      10.0\n       8.0       0.5\n*END\n",
     {120, 40, 8},
     {0.1, 2}},
    {"LS-DYNA, the material of one term",
     PronyFormat::ls_dyna,
     "*MAT_VISCOELASTIC_TITLE\nbrain\n7, 1e-6, 2.19, 100., 30., 50.\n",
     {30, 70},
     {0.02}},
};

// If this fails, a format is read otherwise than its program reads it.
TEST(PronyFormats, AreReadAsTheirProgramsReadThem) {
  for (const Deck& deck : decks) {
    const Read read(deck.text, {deck.format, {}, {}});
    ASSERT_TRUE(read.series) << deck.what << "\n" << read.said();
    const std::vector<double> found = stiffnesses(*read.series);
    ASSERT_EQ(found.size(), deck.stiffnesses.size()) << deck.what;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], deck.stiffnesses[i], 1e-15 * 200) << deck.what;
    for (std::size_t i = 0; i < deck.times.size(); ++i) EXPECT_DOUBLE_EQ(read.series->terms[i].time, deck.times[i]);
  }
}

std::string file_text(const char* name) {
  std::ifstream stream(std::string(DASHPOT_SOURCE_DIR "/tests/unit/front_end/data/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// If this fails, a material that ANSYS 19.2 itself wrote is misread: its 31 terms stand in a table beside it, in more
// digits (pyvisco's verification data, National Renewable Energy Laboratory, BSD 3-Clause).
TEST(PronyFormats, ReadAMaterialThatAnsysWrote) {
  const Read ansys(file_text("ansys_master_curve.mpl"), {PronyFormat::ansys, {}, {}});
  const Read table("weight,time\n" + file_text("master_curve.csv"), {PronyFormat::generic, {}, PronyOf::instantaneous});
  ASSERT_TRUE(ansys.series) << ansys.said();
  ASSERT_TRUE(table.series) << table.said();
  ASSERT_EQ(ansys.series->terms.size(), 31u);
  ASSERT_EQ(table.series->terms.size(), 31u);
  for (std::size_t i = 0; i < 31; ++i) {  // seven digits are printed
    EXPECT_NEAR(ansys.series->terms[i].weight, table.series->terms[i].weight, 5e-7 * table.series->terms[i].weight);
    EXPECT_NEAR(ansys.series->terms[i].time, table.series->terms[i].time, 1e-12 * table.series->terms[i].time);
  }
}

// If this fails, a deck that cannot be read is imported in part, or its author is not told where it is wrong.
TEST(PronyFormats, RefuseWhatTheyCannotRead) {
  const auto refuses = [](PronyFormat format, const char* text, const char* expected) {
    const Read read(text, {format, {}, PronyOf::instantaneous});
    EXPECT_FALSE(read.series) << text;
    EXPECT_NE(read.said().find(expected), std::string::npos) << text << "\n" << read.said();
  };
  refuses(PronyFormat::abaqus, "*Elastic\n1., 0.3\n", "prony-not-found");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n0.4, 0.1\n", "prony-line-too-short");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n0.4, 0, 1, 0.2, 0, 2\n", "prony-line-too-long");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n0.4, 0, fast\n", "prony-not-a-number");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n0.4, 0, 0.\n", "not-above-zero");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n", "prony-without-terms");
  refuses(PronyFormat::abaqus, "*Viscoelastic, time=PRONY\n1,0,1\n*Viscoelastic, time=PRONY\n1,0,1\n", "prony-several");
  refuses(PronyFormat::ansys, "TB,PRONY,1,1,2\nTBDATA,1,0.4,0.1,0.2\n", "prony-constant-missing");
  refuses(PronyFormat::ansys, "TB,PRONY,1,1,2\nTBDATA,1,0.4,0.1\nTBDATA,5,0.2,3\n", "prony-constant-missing");
  refuses(PronyFormat::ansys, "TB,PRONY,1,1,2\nTBDATA,1,0.4,0.1\nTBDATA,2.5,0.2,3\n", "prony-constant-missing");
  refuses(PronyFormat::febio, "<a><b></a>", "prony-no-xml");
  refuses(PronyFormat::febio, "<material name=\"x\" type=\"viscoelastic\"><g1>0.5</g1></material>",
          "prony-time-missing");
  refuses(PronyFormat::ls_dyna, "*MAT_GENERAL_VISCOELASTIC\n1,2,3\n", "prony-cards-missing");
  refuses(PronyFormat::ls_dyna, "*MAT_VISCOELASTIC\n1,2,3\n", "prony-cards-missing");
  refuses(PronyFormat::ls_dyna, "*MAT_GENERAL_VISCOELASTIC\n1,2,3\n,\n5,-1\n", "not-above-zero");
  refuses(PronyFormat::ls_dyna, "*MAT_VISCOELASTIC\n7, 1e-6, 2.19, 100., 30., 0.\n", "prony-without-terms");
  refuses(PronyFormat::ls_dyna, "*MAT_VISCOELASTIC_THERMAL\n7, 1e-6, 2.19, 100., 30., 50.\n", "prony-not-found");
  refuses(PronyFormat::ls_dyna, "*MAT_GENERAL_VISCOELASTIC_MOISTURE\n7,1e-6,2.19\n,\n1,0.5,0.2\n120,0\n40,1\n",
          "prony-not-found");
  refuses(PronyFormat::generic, "0.4,0.1\n", "prony-columns-missing");
  refuses(PronyFormat::generic, "weight,time\n0.4\n", "prony-line-too-short");
  EXPECT_NE(Read("weight,time\n1,1\n", {PronyFormat::generic, {}, {}}).said().find("prony-convention-missing"),
            std::string::npos);
  const char* two =
      "*Material, name=a\n*Viscoelastic, time=PRONY\n1,0,1\n*Material, name=b\n*Viscoelastic, time=PRONY\n1,0,7\n";
  EXPECT_NE(Read(two, {PronyFormat::abaqus, "c", {}}).said().find("prony-material-unknown"), std::string::npos);
  EXPECT_EQ(Read(two, {PronyFormat::abaqus, "b", {}}).series.value().terms[0].time, 7);
}

// If this fails, a series of several temperatures is taken as the one of the last.
TEST(PronyFormats, AskForOneOfTheTemperaturesOfAnsys) {
  const char* two =
      "TB,PRONY,1,2,1,SHEAR\nTBTEMP,20\nTBDATA,1,0.4,0.1\nTBTEMP,60\nTBDATA,1,0.2,0.5\nTB,PRONY,2,1,1\nTBTEMP,20\n"
      "TBDATA,1,0.3,7\n";
  const Read any(two, {PronyFormat::ansys, "1", {}});
  EXPECT_FALSE(any.series);
  EXPECT_NE(any.said().find("it has '1 TBTEMP,20', '1 TBTEMP,60', '2'"), std::string::npos) << any.said();
  EXPECT_EQ(Read(two, {PronyFormat::ansys, "1 TBTEMP,60", {}}).series.value().terms[0].time, 0.5);
  EXPECT_EQ(Read(two, {PronyFormat::ansys, "2", {}}).series.value().terms[0].time, 7);
}

// If this fails, a deck of Abaqus is refused or misread for how its author broke lines or wrote capitals.
TEST(PronyFormats, ReadDecksOfAbaqusHoweverTheyAreWritten) {
  const auto time_in = [](const char* text, const char* material) {
    const Read read(text, {PronyFormat::abaqus, material, {}});
    return read.series && read.series->terms.size() == 1 ? read.series->terms[0].time : std::nan("");
  };
  EXPECT_EQ(time_in("*Material,\n** of the liver\nname=Liver\n*Viscoelastic,\n time=PRONY\n0.4,0,7,\n", "LIVER"), 7);
  EXPECT_EQ(time_in("*Material, name=liver,\n*Viscoelastic, time=PRONY\n0.4, 0, 7\n", "liver"), 7);
  const char* two =
      "*Material, name=a\n*Viscoelastic, time=PRONY\n1,0,1\n*Material, name=A\n*Viscoelastic, time=PRONY\n1,0,7\n";
  EXPECT_EQ(time_in(two, "A"), 7);
}

}  // namespace
}  // namespace dashpot::compiler
