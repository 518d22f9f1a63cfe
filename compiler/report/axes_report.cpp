#include "report/axes_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emit/template_text.hpp"
#include "law/cost.hpp"
#include "report/base64.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "report/page_parts.hpp"
#include "report/schematic.hpp"
#include "report/workspace_map.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;

constexpr int map_side = 40;  // parts of the workspace in a map of shares
constexpr int arrows_across = 13;

std::string millimetres(const Pair<double>& place) {
  return fmt::format("({}, {})", number_text(1e3 * place[0], 3), number_text(1e3 * place[1], 3));
}

std::string share_text(double share) { return number_text(std::round(share * 1e3) / 1e3 + 0.0, 3); }

std::vector<Fields> facts(const AxesCompilation& c) {
  std::vector<Fields> list = {fact("certified", c.certificate.certified ? "yes" : "no", "")};
  if (c.certificate.share) {
    list.push_back(fact("share of the brakes, mean", share_text(c.certificate.share->mean), "", "brake"));
    list.push_back(fact("and at least", share_text(c.certificate.share->worst),
                        "at " + millimetres(c.certificate.share->worst_at) + " mm", "brake"));
  }
  if (c.certificate.adds())
    list.push_back(fact("added for passivity, at the tip at most", number_text(c.certificate.added_at_tip), "N·s/m"));
  list.push_back(fact("ports", std::to_string(c.ports.size()), ""));
  return list;
}

std::vector<DrawnLine> bounds_of(const axes::Box& box) {
  const Pair<double> corners[4] = {
      {box[0].low, box[1].low}, {box[0].high, box[1].low}, {box[0].high, box[1].high}, {box[0].low, box[1].high}};
  std::vector<DrawnLine> lines;
  for (int i = 0; i < 4; ++i) lines.push_back({corners[i], corners[(i + 1) % 4], "bounds"});
  return lines;
}

std::vector<DrawnLine> links_of(const axes::Arm& arm, const Pair<double>& q) {
  using axes::operator+;
  const Pair<double> tip = axes::pose(arm, q).tip, origin{0, 0};
  switch (arm.kind) {
    case axes::Kinematics::serial:
    case axes::Kinematics::parallelogram: {
      const Pair<double> elbow = axes::link(arm.proximal, q[0]);
      return {{origin, elbow, "link"}, {elbow, tip, "link"}};
    }
    case axes::Kinematics::five_bar: {
      const Pair<double> axis[2] = {{-arm.base / 2, 0}, {arm.base / 2, 0}};
      std::vector<DrawnLine> links;
      for (std::size_t side = 0; side < 2; ++side) {
        const Pair<double> elbow = axis[side] + axes::link(arm.proximal, q[side]);
        links.push_back({axis[side], elbow, "link"});
        links.push_back({elbow, tip, "link"});
      }
      return links;
    }
    case axes::Kinematics::cartesian: break;
  }
  return {};
}

// The surfaces of contacts, where there are any.
void add_surfaces(const AxesCompilation& c, const axes::Box& box, std::vector<DrawnLine>& lines) {
  for (const Port& port : c.network.ports) {
    if (!port.network.contact) continue;
    const auto beyond = [&port](const Pair<double>& tip) {
      return axes::depth(port.map, tip).value - port.network.contact->at;
    };
    const std::vector<DrawnLine> surface = zero_lines(box, beyond, "surface");
    lines.insert(lines.end(), surface.begin(), surface.end());
  }
}

// The workspace, and around it what of the arm is seen with its tip in the middle.
WorkspaceMap map_of_arm(const AxesCompilation& c) {
  const axes::Box& workspace = c.device.workspace;
  WorkspaceMap map;
  map.shown = workspace;
  if (const auto joints = axes::joints_at(c.device.arm, axes::middle_of(workspace)))
    map.lines = links_of(c.device.arm, *joints);
  for (const DrawnLine& link : map.lines)
    for (const Pair<double>& end : {link.from, link.to})
      for (std::size_t i = 0; i < 2; ++i) {
        map.shown[i].low = std::min(map.shown[i].low, end[i]);
        map.shown[i].high = std::max(map.shown[i].high, end[i]);
      }
  const double room = 0.04 * std::max(map.shown[0].width(), map.shown[1].width());
  for (axes::Interval& one : map.shown) one = {one.low - room, one.high + room};
  return map;
}

std::string arm_figure(const AxesCompilation& c) {
  WorkspaceMap map = map_of_arm(c);
  map.title = "The arm, with its tip in the middle of the workspace";
  for (const DrawnLine& line : bounds_of(c.device.workspace)) map.lines.push_back(line);
  add_surfaces(c, c.device.workspace, map.lines);
  map.dots.push_back({axes::middle_of(c.device.workspace), ""});
  map.note = fmt::format("{}, {}. Dashed: the workspace.", escaped(c.device.name), name_of(c.device.arm.kind));
  return map_figure(map);
}

// The same without the arm, which the page's script draws where the pointer leads it.
WorkspaceMap map_to_drag_through(const AxesCompilation& c) {
  WorkspaceMap map = map_of_arm(c);
  map.title = "Drag the tool";
  map.lines = bounds_of(c.device.workspace);
  add_surfaces(c, c.device.workspace, map.lines);
  map.note = "Arrow: the force on the tip. With the map in focus the arrow keys lead the tool too.";
  return map;
}

// What all springs that do not relax oppose where the tip is held [N].
Pair<double> held_force(const AxesCompilation& c, const Pair<double>& tip) {
  Pair<double> force{0, 0};
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const auto& port = c.network.ports[i];
    const auto depth = axes::depth(port.map, tip);
    const double pushed = to_double(c.ports[i].form.linear.static_stiffness) * port.network.pushed_in(depth.value);
    for (std::size_t k = 0; k < 2; ++k) force[k] -= pushed * depth.gradient[k];
  }
  return force;
}

std::string force_figure(const AxesCompilation& c) {
  const axes::Box& box = c.device.workspace;
  WorkspaceMap map;
  map.title = "Force on a tip that is held there";
  map.shown = box;
  const double step = std::max(box[0].width(), box[1].width()) / arrows_across;
  const Pair<double> middle = axes::middle_of(box);
  double most = 0;
  const auto count = [&](std::size_t i) { return int(std::floor(box[i].width() / step / 2 - 0.25)); };
  for (int k = -count(1); k <= count(1); ++k)
    for (int i = -count(0); i <= count(0); ++i) {
      const Pair<double> at{middle[0] + step * i, middle[1] + step * k};
      const Pair<double> force = held_force(c, at);
      most = std::max(most, std::hypot(force[0], force[1]));
      map.arrows.push_back({at, force});
    }
  map.longest_arrow = 0.9 * step;
  add_surfaces(c, box, map.lines);
  const bool has_slips =
      std::any_of(c.ports.begin(), c.ports.end(), [](const Compilation& port) { return port.form.has_slips(); });
  map.note = most > 0 ? fmt::format("After everything has relaxed. The longest arrow is {} N; dots are no force.",
                                    number_text(most, 3))
                      : "No spring is left when everything has relaxed.";
  if (!map.lines.empty()) map.note += " Line: the surface of a contact.";
  if (has_slips) map.note += " What slips hold comes on top and is not drawn.";
  return map_figure(map);
}

std::string share_figure(const AxesCompilation& c, const std::vector<CertifiedPort>& ports, const RuleShare& by) {
  const std::vector<PlacedShare> shares = shares_over(c.network, ports, c.device, by.rule, map_side);
  WorkspaceMap map;
  map.title = fmt::format("Share of the brakes, {}{}", name_of(by.rule), by.rule == c.rule ? " (chosen)" : "");
  map.shown = c.device.workspace;
  map.cell_size = {map.shown[0].width() / map_side, map.shown[1].width() / map_side};
  bool has_marks = false;
  for (const PlacedShare& one : shares) {
    map.cells.push_back({one.tip, one.share.alike, !one.share.delay_proof});
    has_marks = has_marks || !one.share.delay_proof;
    map.full = std::max(map.full, std::ceil(10 * one.share.alike) / 10);
  }
  std::stable_sort(map.cells.begin(), map.cells.end(), [&](const ShadedCell& a, const ShadedCell& b) {
    const double apart = a.centre[1] - b.centre[1];
    return std::abs(apart) > map.cell_size[1] / 2 ? apart < 0 : a.centre[0] < b.centre[0];
  });
  map.dots.push_back({by.share.worst_at, share_text(by.share.worst)});
  map.scale = "of the ports' damping";
  map.note = "The dot: where it is least.";
  if (has_marks) map.note += " Hatched: there, velocities that are late enough make the motors' part active.";
  return map_figure(map);
}

std::string shares_html(const AxesCompilation& c, const std::vector<RuleShare>& all) {
  std::string rows;
  for (const auto& [rule, share] : all)
    rows += fmt::format(
        "<tbody{}><tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{:.0f}</td></tr></tbody>\n",
        rule == c.rule ? " class=\"chosen\"" : "", name_of(rule), share_text(share.mean), share_text(share.median),
        share_text(share.worst), millimetres(share.worst_at), share_text(share.worst_direction_median),
        share_text(share.worst_direction_worst), 100 * share.delay_proof);
  return "<div class=\"wide\"><table class=\"candidates\">\n<thead><tr><th></th><th>mean</th><th>median</th><th>least"
         "</th><th>at [mm]</th><th>median in the worst direction</th><th>least there</th><th>delay-proof [%]</th></tr>"
         "</thead>\n" +
         rows + "</table></div>\n";
}

std::string field_html(const axes::ViscousField& field) {
  if (!field.is_uniform())
    return fmt::format("viscous field over a grid of {} × {} knots", field.knots[0], field.knots[1]);
  const axes::Matrix<double>& a = field.at_knot.front();
  return fmt::format("viscous field, by rows: {}, {}; {}, {} N·s/m", number_text(a[0][0]), number_text(a[0][1]),
                     number_text(a[1][0]), number_text(a[1][1]));
}

std::string ports_html(const AxesCompilation& c) {
  std::string rows;
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const Compilation& port = c.ports[i];
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"word\">{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td class=\"word\">{}</td></tr>\n",
        escaped(c.network.ports[i].name), c.network.ports[i].map_kind, port.network.contact ? ", contact" : "",
        number_text(port.decomposition.choice().damping), number_text(to_double(port.form.linear.static_stiffness)),
        number_text(to_double(port.form.linear.feedthrough_damping)), port.form.linear.modes.size(),
        escaped(port.decomposition.choice().name));
  }
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th>port</th><th class=\"word\">map</th><th>b [N·s/m]</th><th>k₀ [N/m]"
      "</th><th>b∞ [N·s/m]</th><th>modes</th><th class=\"word\">rule</th></tr></thead>\n<tbody>\n" +
      rows + "</tbody></table></div>\n";
  if (c.network.has_field()) html += "<p>Beside them a " + field_html(c.network.field) + ".</p>\n";
  return html;
}

// What the page's script needs to lead the tool: the arm, where it is drawn, and the emitted code.
std::string drag_json(const AxesCompilation& c, const WorkspaceMap& map, const std::string& module) {
  const axes::Arm& arm = c.device.arm;
  const axes::Box& box = c.device.workspace;
  const MapFrame frame = frame_of(map);
  const PortUnits units = dotted_units(c.device.joint_motion());
  std::string brakes;
  for (const AlongBrake& brake : c.device.brakes)
    brakes +=
        fmt::format("{}[{},{}]", brakes.empty() ? "" : ",", json_literal(brake.along[0]), json_literal(brake.along[1]));
  return fmt::format(
      "{{\"name\":{},\"drag\":{{\"period\":{},\"rate\":{},\"arm\":{{\"kind\":\"{}\",\"proximal\":{},\"distal\":{},"
      "\"base\":{}}},\"workspace\":[[{},{}],[{},{}]],\"frame\":{{\"x\":{},\"y\":{},\"metre\":{}}},\"brakes\":[{}],"
      "\"torque_unit\":\"{}\",\"damping_unit\":\"{}\",\"module\":\"{}\"}}}}",
      json_literal(c.network.name), json_literal(c.law.sample_period), json_literal(c.rate), name_of(arm.kind),
      json_literal(arm.proximal), json_literal(arm.distal), json_literal(arm.base), json_literal(box[0].low),
      json_literal(box[0].high), json_literal(box[1].low), json_literal(box[1].high), json_literal(frame.x_of_origin),
      json_literal(frame.y_of_origin), json_literal(frame.metre), brakes, units.force, units.damping, base64(module));
}

void add_drag_part(const AxesCompilation& c, const std::optional<std::string>& module, CodeModel& model,
                   Diagnostics& diagnostics) {
  for (const char* list : {"live", "scripts", "still"}) model.lists[list];
  model.fields["script_rule"] = module ? "; script-src 'unsafe-inline' 'wasm-unsafe-eval'" : "";
  model.fields["page_class"] = module ? " class=\"static\"" : "";
  if (c.has_device && !module) model.lists["still"].push_back({});
  if (!module) return;
  const WorkspaceMap map = map_to_drag_through(c);
  model.lists["live"].push_back({{"figure", map_figure(map)}});
  model.lists["scripts"].push_back({});
  model.fields["data"] = drag_json(c, map, *module);
  for (const char* part : {"page.js", "drag.js", "start.js"}) model.fields["script"] += built_in(part, diagnostics);
}

}  // namespace

std::optional<std::string> report(const AxesCompilation& c, const std::optional<std::string>& module,
                                  Diagnostics& diagnostics) {
  CodeModel model;
  Fields& fields = model.fields;
  fields["title"] = escaped(c.network.title.empty() ? c.network.name : c.network.title);
  fields["name"] = escaped(c.network.name);
  fields["choices"] =
      escaped(fmt::format("two axes at {} Hz, {}, brakes {}, for {}", number_text(c.rate, 6), name_of(c.law.scalar),
                          name_of(c.rule), c.has_device ? c.device.name : "no device"));
  fields["source"] = escaped(c.network.source);
  fields["version"] = DASHPOT_VERSION;
  fields["digest"] = c.network.digest;
  fields["style"] = built_in("report.css", diagnostics);
  fields["ports"] = ports_html(c);
  for (const std::string& line : explained_lines(c.certificate, c.device)) fields["passivity"] += sentence(line);
  model.lists["facts"] = facts(c);
  for (const char* list : {"networks", "workspace", "shares", "no_device"}) model.lists[list];
  for (std::size_t i = 0; i < c.ports.size(); ++i)
    model.lists["networks"].push_back(
        {{"port", escaped(c.network.ports[i].name)}, {"drawing", schematic(c.ports[i].network)}});
  add_comments(c.network.comments, model);
  if (c.has_device) model.lists["workspace"].push_back({{"figures", arm_figure(c) + force_figure(c)}});
  else model.lists["no_device"].push_back({});
  if (c.certificate.share) {
    const std::vector<CertifiedPort> ports = certified_ports(c);
    const std::vector<RuleShare> all = shares_by_rule(c, ports);
    std::string figures;
    for (const RuleShare& by : all)
      if (by.rule != axes::BrakeRule::virtual_brake) figures += share_figure(c, ports, by);
    model.lists["shares"].push_back({{"table", shares_html(c, all)}, {"figures", figures}});
  }
  add_drag_part(c, module, model, diagnostics);
  return filled("axes_report.html.in", model, std::nullopt, diagnostics);
}

}  // namespace dashpot::compiler
