// Every name in the emitted class, whatever the author calls the elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "compiled.hpp"
#include "support/shrink.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

std::string lowered(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::vector<std::string> names_in(const std::string& name, const std::vector<std::string>& element_names) {
  return element_names.empty() ? std::vector<std::string>{name} : element_names;
}

// As they stand in the emitted class; states end in an underscore there.
std::vector<std::string> all_names(const UpdateLaw& law) {
  std::vector<std::string> all;
  for (const Variable& variable : law.variables)
    for (const std::string& name : names_in(variable.name, variable.element_names))
      all.push_back(name + (variable.is_kept() ? "_" : ""));
  for (const Coefficient& coefficient : law.coefficients)
    for (const std::string& name : names_in(coefficient.name, coefficient.element_names)) all.push_back(name);
  return all;
}

// What the template itself declares.
const std::set<std::string> of_the_template = {
    "scalar", "sample_period", "port_motion",   "motion",  "certified_for", "parameters", "reset", "output", "update",
    "step",   "set",           "stored_energy", "damping", "threshold",     "sampled_",   "total", "lane",   "now"};

std::string complaint_about_names(const Compilation& compilation) {
  static const std::regex identifier("[A-Za-z]([A-Za-z0-9]|_(?!_))*");
  std::set<std::string> taken = of_the_template;
  for (const std::string& name : all_names(compilation.law)) {
    if (!std::regex_match(name, identifier)) return fmt::format("'{}' is no name that C++ leaves to us", name);
    if (!taken.insert(lowered(name)).second) return fmt::format("'{}' is there twice", name);
  }
  return "";
}

std::string maxwell(const std::string& spring, const std::string& damper, int stiffness) {
  return fmt::format(R"({{ "series": [ {{ "spring": {}, "name": "{}" }}, {{ "damper": 1, "name": "{}" }} ] }})",
                     stiffness, spring, damper);
}

Compiled branches(const std::string& network_name, const std::vector<std::pair<std::string, std::string>>& names) {
  std::string text;
  int stiffness = 0;
  for (const auto& [spring, damper] : names) text += (text.empty() ? "" : ", ") + maxwell(spring, damper, ++stiffness);
  return Compiled(fmt::format(
      R"({{ "dashpot": 1, "name": "{}", "network": {{ "parallel": [ {}, {{ "damper": 3 }}, {{ "spring": 2 }} ] }} }})",
      network_name, text));
}

std::string complaint(const std::string& network_name, const std::vector<std::pair<std::string, std::string>>& names) {
  return complaint_about_names(*branches(network_name, names).operator->());
}

// Fails if an underscore at the end makes a reserved double one, or hides that two names are the same without it.
TEST(Names, UnderscoresAtTheEnd) {
  EXPECT_EQ(complaint("ends", {{"a", "b"}, {"a_", "b_"}, {"c_", "d"}, {"c", "d_"}}), "");
}

// Fails if elements named like the beginnings of the law's own names take these over.
TEST(Names, BeginningsOfTheLawsOwnNames) {
  const std::string long_tail(60, 'x');  // cuts the mode's name to "no_to_xxx…"
  for (const char* first : {"relaxed", "no", "last", "sampled", "half", "total", "sum", "loss", "threshold"}) {
    EXPECT_EQ(complaint("own", {{first, "energy"}, {first + std::string("_"), "gain"}}), "") << first;
    EXPECT_EQ(complaint("own", {{first, long_tail}}), "") << first;
  }
}

// Fails if a mode's name and a numbered one coincide.
TEST(Names, ModeAndNumberedNamesDiffer) {
  EXPECT_EQ(complaint("numbers", {{"a", "b"}, {"a_b", "x2"}, {"A_", "b_2"}, {"c", "d_2"}, {"c_d", "e2"}}), "");
}

// Fails if very long names are cut so that they coincide.
TEST(Names, VeryLongNames) {
  const std::string base(300, 'x');
  EXPECT_EQ(complaint("very_long", {{base + "1", base + "2"}, {base + "3", base + "4"}, {base + "5", base + "6"}}), "");
}

// Fails if a thousand elements with numbers for names do not have a thousand names in the code.
TEST(Names, AThousandElements) {
  std::vector<std::pair<std::string, std::string>> names;
  for (int i = 1; i <= 500; ++i) names.emplace_back("K" + std::to_string(i), "B" + std::to_string(i));
  EXPECT_EQ(complaint("thousand", names), "");
}

// Fails if the class itself can be called like one of its members: C++ takes that for a constructor.
TEST(Names, TheClassAndItsMembers) {
  for (const char* name : {"K1_B1_gain", "K1_B1_force_", "K1_B1_energy_weight", "static_stiffness", "velocity_gain",
                           "last_position_", "sampled_", "threshold", "clear", "kept_share"}) {
    try {
      branches(name, {{"K1", "B1"}});
      ADD_FAILURE() << name << " is accepted";
    } catch (const std::invalid_argument& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("[name-is-member]"), std::string::npos) << refusal.what();
    }
  }
  EXPECT_NO_THROW(branches("K1_B1", {{"K1", "B1"}}));
}

// Fails if a law with tunables cannot be called by a common word, or by the one that its ranges are called.
TEST(Names, TheClassOfALawWithTunables) {
  const auto called = [](const char* name) {
    return Compiled(fmt::format(R"({{ "dashpot": 1, "name": "{}", "network": {{ "spring": "K" }}, "parameters": {{ )"
                                R"("K": {{ "value": 20, "tunable": true, "min": 10, "max": 30 }} }} }})",
                                name));
  };
  for (const char* name : {"springs", "nodes", "parts", "links", "tables"}) EXPECT_NO_THROW(called(name)) << name;
  EXPECT_THROW(called("tunables"), std::invalid_argument);
}

// Of a class's members; locals of two programs may be called alike.
std::string first_member_twice(const UpdateLaw& law) {
  std::set<std::string> taken = of_the_template;
  for (const Variable& variable : law.variables)
    for (const std::string& name : names_in(variable.name, variable.element_names))
      if (variable.is_kept() && !taken.insert(lowered(name + "_")).second) return name;
  for (const Coefficient& coefficient : law.coefficients)
    for (const std::string& name : names_in(coefficient.name, coefficient.element_names))
      if (!taken.insert(lowered(name)).second) return name;
  return "";
}

// Fails if a parameter can take a name that the law has for something of its own.
TEST(Names, ParametersCalledLikeAnythingInTheLaw) {
  const std::vector<std::string> beside = {"", R"("contact": { "at": 0.001 },)",
                                           R"("static": { "power": 2, "force": "1 N", "at": "5 mm" },)"};
  const std::vector<std::string> slips = {"", R"(, { "series": [ { "slip": 0.1 }, { "spring": 50 } ] })",
                                          R"(, { "series": [ { "slip": 0.1 }, { "spring": 70 },
                                               { "parallel": [ { "spring": 50 }, { "slip": 0.2 } ] } ] })"};
  const auto text = [&](const std::string& parameter, std::size_t i, std::size_t j) {
    return fmt::format(R"({{ "dashpot": 1, "name": "tuned", {1} "parameters": {{
                             "{0}": {{ "value": 300, "tunable": true, "min": 30, "max": 900 }} }},
                           "network": {{ "parallel": [ {{ "spring": "{0}" }}, {{ "series": [ {{ "spring": "{0}" }},
                             {{ "damper": 2 }} ] }}{2} ] }} }})",
                       parameter, beside[i], slips[j]);
  };
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    for (std::size_t j = 0; j < slips.size(); ++j) {
      const Compiled law(text("K", i, j));
      for (std::string name : all_names(law.law())) {
        if (name.back() == '_') name.pop_back();
        try {
          EXPECT_EQ(first_member_twice(Compiled(text(name, i, j)).law()), "") << name;
          ++accepted;
        } catch (const std::invalid_argument& refusal) {
          EXPECT_NE(std::string(refusal.what()).find("'" + name + "'"), std::string::npos) << refusal.what();
        }
      }
    }
  }
  EXPECT_GT(accepted, 100u);
}

// Fails if unnamed elements in random networks, whose modes come from many elements, collide.
TEST(Names, ModesOfManyElements) {
  NetworkRecipe recipe;
  recipe.topology = Topology::graph;
  recipe.most_nodes = 10;
  EXPECT_EQ(first_failure(1, repetitions(30, 500), recipe,
                          [](const Network& network) {
                            return complaint_about_names(*Compiled(json_text(network)).operator->());
                          }),
            "");
}

}  // namespace
