#include "report/symbols.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

constexpr double letter = 7.2;  // width of a letter, generously, at the size of labels [px]

// Letters as people count them: bytes that do not continue a character.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string stroke(const std::string& path, const char* kind = "part") {
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, path);
}

// Each starts at the middle of the symbol's left end and is symbol_length long.
std::string strokes(const Spring&, Place p) {
  return stroke(fmt::format("M{} {}h12l4 -9l8 18l8 -18l8 18l8 -18l8 18l4 -9H{}", p.x, p.y, p.x + symbol_length));
}

std::string strokes(const Damper&, Place p) {
  const std::string rod = fmt::format("M{} {}h34m0 -7.5v15", p.x, p.y);
  const std::string cup =
      fmt::format("M{} {}h28v23h-28M{} {}H{}", p.x + 22, p.y - 11.5, p.x + 50, p.y, p.x + symbol_length);
  return stroke(rod) + stroke(cup);
}

std::string strokes(const Slip&, Place p) {
  const std::string block = fmt::format("M{} {}h20m0 -8h26v15h-26z", p.x, p.y);
  const std::string plate = fmt::format("M{} {}h44V{}H{}", p.x + 12, p.y + 9.5, p.y, p.x + symbol_length);
  std::string hatch;
  for (double x = p.x + 18; x < p.x + 56; x += 8) hatch += fmt::format("M{} {}l-5 6", x, p.y + 9.5);
  return stroke(block) + stroke(plate) + stroke(hatch, "hatch");
}

}  // namespace

double element_length(const Element& element, motion port_motion) {
  const double words = letter * double(std::max(letters(element.name), letters(value_text(element, port_motion))));
  return std::max(symbol_length, words) + 14;
}

std::string element_symbol(const Element& element, motion port_motion, Place start, double length) {
  const double first = start.x + (length - symbol_length) / 2, middle = start.x + length / 2;
  std::string svg = wire(start, {first, start.y});
  svg += std::visit([&](const auto& law) { return strokes(law, {first, start.y}); }, element.law);
  svg += wire({first + symbol_length, start.y}, {start.x + length, start.y});
  svg += fmt::format("<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", middle, start.y - 30,
                     escaped(element.name));
  return svg + fmt::format("<text class=\"value\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", middle, start.y - 17,
                           value_text(element, port_motion));
}

std::string wire(Place from, Place to) {
  if (from.x == to.x && from.y == to.y) return "";
  return stroke(fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", from.x, from.y, to.x, to.y));
}

std::string junction(Place at) {
  return fmt::format("<circle class=\"joint\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\"/>\n", at.x, at.y);
}

std::string tool_symbol(Place at) {
  const double x = at.x - tool_length;
  std::string svg = fmt::format("<circle class=\"part\" cx=\"{}\" cy=\"{:.1f}\" r=\"8\"/>\n", x + 40, at.y) +
                    wire({x + 48, at.y}, at);
  svg += fmt::format("<text class=\"value\" x=\"{}\" y=\"{:.1f}\">tool</text>", x + 40, at.y + 26);
  svg += stroke(fmt::format("M{} {:.1f}h24m-6 -4l6 4l-6 4", x + 28, at.y - 20), "arrow");
  return svg + fmt::format("<text class=\"symbol\" x=\"{}\" y=\"{:.1f}\">u</text>\n", x + 40, at.y - 27);
}

std::string ground_symbol(double x, double top, double bottom) {
  std::string hatch;
  for (double y = top + 8; y <= bottom + 4; y += 8) hatch += fmt::format("M{:.1f} {:.1f}l8 -8", x, y);
  return stroke(fmt::format("M{:.1f} {:.1f}V{:.1f}", x, top, bottom)) + stroke(hatch, "hatch");
}

std::string contact_symbol(Place at) {
  return stroke(fmt::format("M{0:.1f} {1:.1f}h8m0 -13v26m10 -26v26m0 -13h8", at.x, at.y));
}

}  // namespace dashpot::compiler
