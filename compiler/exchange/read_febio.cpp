// FEBio: <material type="viscoelastic" | "uncoupled viscoelastic"> with <g0>, <g1>…, <t1>… (FEBio User Manual). The
// relaxation function is g0 + Σ g_i exp(−t/t_i) times the elastic material's stiffness.
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

#include <charconv>
#include <set>
#include <sstream>

#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

using XmlTree = boost::property_tree::ptree;

class FebioReader {
 public:
  FebioReader(const SourceFile& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void search(const XmlTree& tree) {
    for (const auto& [key, child] : tree) {
      const std::string type = folded(child.get("<xmlattr>.type", ""));
      if ((key == "material" || key == "solid") && type.find("viscoelastic") != std::string::npos) add(child);
      else if (key != "<xmlattr>") search(child);
    }
  }

  std::vector<MaterialSeries> found;

 private:
  void add(const XmlTree& material) {
    const std::string name = material.get("<xmlattr>.name", material.get("<xmlattr>.id", ""));
    const Span place{&file_, 0, 0};
    PronySeries series{PronyOf::long_term, number(material, "g0").value_or(1), {}};
    for (const int i : indices_of_weights(material)) {
      const auto weight = number(material, fmt::format("g{}", i));
      const auto time = number(material, fmt::format("t{}", i));
      if (weight && !material.get_child_optional(fmt::format("t{}", i)))
        diagnostics_.report<DiagnosticCode::prony_time_missing>(place, name, i);
      if (weight && time) series.terms.push_back({*weight, *time});
    }
    found.push_back({name, absolute(series), place});
  }

  // FEBio takes each of <g1>, <g2>, … for 0 that is left out.
  static std::set<int> indices_of_weights(const XmlTree& material) {
    std::set<int> indices;
    for (const auto& [key, child] : material) {
      int index = 0;
      const char* const end = key.data() + key.size();
      if (key.starts_with('g') && std::from_chars(key.data() + 1, end, index).ptr == end && index > 0)
        indices.insert(index);
    }
    return indices;
  }

  // Weights count for themselves: g0 scales none of them.
  static PronySeries absolute(PronySeries series) {
    series.of = PronyOf::absolute;
    return series;
  }

  std::optional<double> number(const XmlTree& material, const std::string& key) {
    const auto text = material.get_optional<std::string>(key);
    if (!text) return std::nullopt;
    const std::size_t begin = text->find_first_not_of(" \t\r\n");
    const std::size_t end = text->find_last_not_of(" \t\r\n");
    const std::string word = begin == std::string::npos ? "" : text->substr(begin, end + 1 - begin);
    return number_in({word, place_of(key)}, diagnostics_);
  }

  // The XML library keeps no places: the first element of this name.
  Span place_of(const std::string& key) const {
    const std::size_t at = file_.text().find("<" + key);
    return at == std::string::npos ? Span{} : Span{&file_, at, at + key.size() + 1};
  }

  const SourceFile& file_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<MaterialSeries> read_febio(const SourceFile& file, Diagnostics& diagnostics) {
  std::istringstream text(file.text());
  XmlTree tree;
  try {
    boost::property_tree::read_xml(text, tree, boost::property_tree::xml_parser::no_comments);
  } catch (const boost::property_tree::xml_parser_error& error) {
    const std::size_t line = std::max<std::size_t>(1, error.line());
    const std::string_view shown = file.line(line);
    const auto begin = static_cast<std::size_t>(shown.data() - file.text().data());
    diagnostics.report<DiagnosticCode::prony_no_xml>({&file, begin, begin + shown.size()}, error.message());
    return {};
  }
  FebioReader reader(file, diagnostics);
  reader.search(tree);
  return std::move(reader.found);
}

}  // namespace dashpot::compiler
