// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/plan_checks.hpp>
#include <heel/planning/plan_file.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr int kMostTokens = 1000000;
/// The drawing of a net has room for hundreds of nodes on each side.
constexpr double kFurthest = 4000.0;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Reads one document; knows its file for the errors' sake.
class PnmlReader {
 public:
  explicit PnmlReader(const fs::path& file) : file_(file) {}

  PetriNet read() {
    const pugi::xml_parse_result parsed = document_.load_file(file_.c_str());
    if (parsed.status == pugi::status_file_not_found) fail("there is no such file");
    if (!parsed) fail(std::string("this is not XML (") + parsed.description() + ")");
    const pugi::xml_node root = document_.child("pnml");
    if (!root) fail("this is not PNML: it has no <pnml>");
    const pugi::xml_node net = root.child("net");
    if (!net) fail("there is no <net> in it");
    if (net.next_sibling("net")) fail("there are two nets in it; a plan is one");
    net_.id = net.attribute("id").value();
    net_.name = label(net, "name");
    forEach(net, "place", [&](const pugi::xml_node& n) { readPlace(n); });
    forEach(net, "transition", [&](const pugi::xml_node& n) { readTransition(n); });
    forEach(net, "arc", [&](const pugi::xml_node& n) { readArc(n); });
    if (net_.places.empty()) fail("the net has no places");
    if (std::none_of(net_.places.begin(), net_.places.end(),
                     [](const PetriPlace& p) { return p.tokens > 0; })) {
      fail("no place has a token in its <initialMarking>, so nothing can ever happen");
    }
    return std::move(net_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(file_.string() + ": " + reason);
  }

  [[noreturn]] void fail(const pugi::xml_node& element, const std::string& reason) const {
    fail(std::string(element.name()) + " '" + element.attribute("id").value() + "' " + reason);
  }

  /// Visits the elements of a name, in the net and in its pages.
  template <typename Visit>
  void forEach(const pugi::xml_node& parent, const char* name, Visit&& visit) const {
    for (const pugi::xml_node child : parent.children()) {
      if (std::string(child.name()) == name) visit(child);
      if (std::string(child.name()) == "page") forEach(child, name, visit);
    }
  }

  static std::string label(const pugi::xml_node& element, const char* name) {
    const pugi::xml_node of = element.child(name);
    const pugi::xml_node text = of.child("text") ? of.child("text") : of.child("value");
    return trimmed(text.child_value());
  }

  /// A whole number of at least `least`. JARP writes "Default,1" for 1.
  int count(const pugi::xml_node& element, const char* name, int fallback, int least) const {
    std::string text = label(element, name);
    if (text.empty()) return fallback;
    const std::string number = trimmed(text.substr(text.rfind(',') + 1));
    int value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || value < least ||
        value > kMostTokens) {
      fail(element, std::string("has the ") + name + " '" + text +
                        "', which is not a number from " + std::to_string(least) + " to " +
                        std::to_string(kMostTokens));
    }
    return value;
  }

  std::optional<Eigen::Vector2d> point(const pugi::xml_node& element,
                                       const pugi::xml_node& at) const {
    if (!at) return std::nullopt;
    const Eigen::Vector2d p(at.attribute("x").as_double(std::nan("")),
                            at.attribute("y").as_double(std::nan("")));
    if (!p.allFinite()) fail(element, "is drawn at a place that is no place");
    if (p.cwiseAbs().maxCoeff() > kFurthest) {
      fail(element, "is drawn further away than " + std::to_string(static_cast<int>(kFurthest)));
    }
    return p;
  }

  NetGraphics graphics(const pugi::xml_node& element) const {
    NetGraphics drawn;
    drawn.position = point(element, element.child("graphics").child("position"));
    const auto offset = point(element, element.child("name").child("graphics").child("offset"));
    if (offset) drawn.label_offset = *offset;
    return drawn;
  }

  /// The element's id, which no other has.
  std::string newId(const pugi::xml_node& element) {
    const std::string id = element.attribute("id").value();
    if (id.empty()) fail(std::string("a ") + element.name() + " has no id");
    if (!ids_.emplace(id, Node{}).second) fail(element, "has an id that is used twice");
    return id;
  }

  void readPlace(const pugi::xml_node& element) {
    PetriPlace place;
    place.id = newId(element);
    // The tools of Petri Net Plans write a blank where the user named nothing; that is a name.
    if (!element.child("name")) fail(element, "has no name");
    place.name = label(element, "name");
    place.tokens = count(element, "initialMarking", 0, 0);
    place.graphics = graphics(element);
    ids_[place.id] = {static_cast<int>(net_.places.size()), true};
    net_.places.push_back(std::move(place));
  }

  void readTransition(const pugi::xml_node& element) {
    PetriTransition transition;
    transition.id = newId(element);
    transition.name = label(element, "name");
    transition.graphics = graphics(element);
    ids_[transition.id] = {static_cast<int>(net_.transitions.size()), false};
    net_.transitions.push_back(std::move(transition));
  }

  struct Node {
    int index = -1;
    bool is_place = false;
  };

  Node end(const pugi::xml_node& arc, const char* which) const {
    const std::string id = arc.attribute(which).value();
    const auto found = ids_.find(id);
    if (found == ids_.end() || found->second.index < 0) {
      fail(arc, std::string("has the ") + which + " '" + id + "', which is nothing in this net");
    }
    return found->second;
  }

  void readArc(const pugi::xml_node& element) {
    PetriArc arc;
    arc.id = newId(element);
    const Node source = end(element, "source"), target = end(element, "target");
    if (source.is_place == target.is_place) {
      fail(element, std::string("joins two ") + (source.is_place ? "places" : "transitions"));
    }
    arc.place = source.is_place ? source.index : target.index;
    arc.weight = count(element, "inscription", 1, 1);
    for (const auto& at : element.child("graphics").children("position")) {
      arc.bends.push_back(*point(element, at));
    }
    const int owner = source.is_place ? target.index : source.index;
    PetriTransition& transition = net_.transitions[static_cast<std::size_t>(owner)];
    auto& arcs = source.is_place ? transition.takes : transition.gives;
    if (std::any_of(arcs.begin(), arcs.end(),
                    [&](const PetriArc& other) { return other.place == arc.place; })) {
      fail(element, "joins what another arc joins already; write an inscription instead");
    }
    arcs.push_back(std::move(arc));
  }

  fs::path file_;
  pugi::xml_document document_;
  PetriNet net_;
  std::map<std::string, Node> ids_;
};

void appendPoint(pugi::xml_node& parent, const char* name, const Eigen::Vector2d& point) {
  pugi::xml_node node = parent.append_child(name);
  node.append_attribute("x") = point.x();
  node.append_attribute("y") = point.y();
}

pugi::xml_node appendLabel(pugi::xml_node& element, const char* name, const std::string& text) {
  pugi::xml_node label = element.append_child(name);
  label.append_child("value").text() = text.c_str();
  return label;
}

/// Id, name and graphics of a place or transition.
pugi::xml_node appendNode(pugi::xml_node& net, const char* kind, const std::string& id,
                          const std::string& name, const NetGraphics& graphics) {
  pugi::xml_node node = net.append_child(kind);
  node.append_attribute("id") = id.c_str();
  if (graphics.position) {
    pugi::xml_node drawn = node.append_child("graphics");
    appendPoint(drawn, "position", *graphics.position);
  }
  pugi::xml_node label = appendLabel(node, "name", name);
  if (!graphics.label_offset.isZero()) {
    pugi::xml_node drawn = label.append_child("graphics");
    appendPoint(drawn, "offset", graphics.label_offset);
  }
  return node;
}

void appendArc(pugi::xml_node& net, const PetriArc& arc, const std::string& source,
               const std::string& target) {
  pugi::xml_node node = net.append_child("arc");
  node.append_attribute("id") = arc.id.c_str();
  node.append_attribute("source") = source.c_str();
  node.append_attribute("target") = target.c_str();
  if (!arc.bends.empty()) {
    pugi::xml_node drawn = node.append_child("graphics");
    for (const Eigen::Vector2d& bend : arc.bends) appendPoint(drawn, "position", bend);
  }
  appendLabel(node, "inscription", std::to_string(arc.weight));
}

}  // namespace

PetriNet readPnml(const fs::path& file) { return PnmlReader(file).read(); }

std::string toPnml(const PetriNet& net) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("pnml").append_child("net");
  root.append_attribute("id") = net.id.c_str();
  root.append_attribute("type") = "PTNet";
  appendLabel(root, "name", net.name);
  for (const PetriPlace& place : net.places) {
    pugi::xml_node node = appendNode(root, "place", place.id, place.name, place.graphics);
    appendLabel(node, "initialMarking", std::to_string(place.tokens));
  }
  for (const PetriTransition& t : net.transitions) {
    appendNode(root, "transition", t.id, t.name, t.graphics);
  }
  for (const PetriTransition& t : net.transitions) {
    const auto place = [&](const PetriArc& arc) {
      return net.places[static_cast<std::size_t>(arc.place)].id;
    };
    for (const PetriArc& arc : t.takes) appendArc(root, arc, place(arc), t.id);
    for (const PetriArc& arc : t.gives) appendArc(root, arc, t.id, place(arc));
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

namespace {

PetriPlan makePlanOf(const std::filesystem::path& file, const PlanVocabulary& vocabulary) {
  PetriNet net = readPnml(file);
  try {
    return makePlan(std::move(net), vocabulary);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace

PetriPlan loadPlan(const std::filesystem::path& file, const PlanVocabulary& vocabulary) {
  PetriPlan plan = makePlanOf(file, vocabulary);
  const PlanReport report = checkPlan(plan);
  if (!report.faults.empty()) {
    throw std::runtime_error(file.string() + ": " + report.faults.front().sentence);
  }
  return plan;
}

}  // namespace heel
