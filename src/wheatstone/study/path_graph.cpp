#include "wheatstone/study/path_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/number_range.h"
#include "wheatstone/study/draw_lots_internal.h"

namespace wheatstone {
namespace {

/// A node as the central view shows it on the screen: a disc.
struct Disc {
  float x, y, radius;
  float right_mm;  ///< so far to the right does the right eye see it on the screen, and the left eye to the left
};

/// Whether two discs come closer than the gap in the view of an eye or in the central one.
bool touch(const Disc& a, const Disc& b, float gap) {
  const float apart = b.right_mm - a.right_mm;
  for (const float eye : {-1.0f, 0.0f, 1.0f})
    if (std::hypot(b.x - a.x + eye * apart, b.y - a.y) < a.radius + b.radius + gap) return true;
  return false;
}

void check(const PathGraphOptions& options) {
  if (options.nodes < 9 || options.nodes % 3 != 0)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("nodes: is {}, expected a multiple of three, at least 9: a graph has three groups of equal size",
                    options.nodes));
  if (!(options.depth_mm >= 0 && options.depth_mm / 2 + options.node_radius_mm < options.viewing_distance_mm / 2))
    throw Error(ErrorKind::bad_input,
                fmt::format("depth: is {} mm, expected at most half of the viewing distance of {} mm", options.depth_mm,
                            options.viewing_distance_mm));
}

float depth_of(const PathGraphOptions& options, int group, Lots& lots) {
  if (options.placement == GraphPlacement::volume) return options.depth_mm * (lots.unit() - 0.5f);
  return options.depth_mm / 2 * static_cast<float>(group - 1);
}

/// A free place for a node at this depth, or none after many trials.
std::optional<Disc> free_disc(const PathGraphOptions& options, float depth_mm, const std::vector<Disc>& taken,
                              Lots& lots) {
  const float scale = options.viewing_distance_mm / (options.viewing_distance_mm + depth_mm);
  // The outline of a sphere is a little larger than its radius at its depth.
  const float radius = options.node_radius_mm * scale * 1.02f;
  const float right_mm = options.eye_separation_mm / 2 * depth_mm / (options.viewing_distance_mm + depth_mm);
  const bool may_hide = options.placement == GraphPlacement::volume;
  constexpr int most_trials = 2000;
  for (int trial = 0; trial < most_trials; ++trial) {
    const Disc disc{(lots.unit() - 0.5f) * (options.width_mm - 2 * radius),
                    (lots.unit() - 0.5f) * (options.height_mm - 2 * radius), radius, right_mm};
    const auto is_near = [&](const Disc& other) { return touch(disc, other, options.node_radius_mm / 4); };
    if (may_hide || std::ranges::none_of(taken, is_near)) return disc;
  }
  return {};
}

std::vector<PlaceMm> place_nodes(const PathGraphOptions& options, Lots& lots) {
  std::vector<PlaceMm> nodes;
  std::vector<Disc> discs;
  for (int node = 0; node < options.nodes; ++node) {
    const float depth = depth_of(options, node / (options.nodes / 3), lots);
    const std::optional<Disc> disc = free_disc(options, depth, discs, lots);
    if (!disc)
      throw Error(ErrorKind::bad_input,
                  fmt::format("nodes: {} of radius {} mm do not fit into {}x{} mm without hiding each other",
                              options.nodes, options.node_radius_mm, options.width_mm, options.height_mm));
    const float on_screen = (options.viewing_distance_mm + depth) / options.viewing_distance_mm;
    nodes.push_back({disc->x * on_screen, disc->y * on_screen, depth});
    discs.push_back(*disc);
  }
  return nodes;
}

using TwoLinks = std::array<int, 2>;

bool has(const TwoLinks& links, int node) { return links[0] == node || links[1] == node; }

/// An intermediate node that is not among those given.
int other_node(int per_group, const TwoLinks& but, Lots& lots, int also_but = -1) {
  for (;;) {
    const int node = per_group + lots.below(per_group);
    if (!has(but, node) && node != also_but) return node;
  }
}

/// The two intermediate nodes of the highlighted leaf behind, given those of the one in front.
TwoLinks links_of_second(const TwoLinks& first, int per_group, bool connected, Lots& lots) {
  if (connected) return {first[static_cast<std::size_t>(lots.below(2))], other_node(per_group, first, lots)};
  const int one = other_node(per_group, first, lots);
  return {one, other_node(per_group, first, lots, one)};
}

/// Where the central view shows a place on the screen.
std::array<float, 2> on_screen(const PlaceMm& place, float viewing_distance_mm) {
  const float scale = viewing_distance_mm / (viewing_distance_mm + place[2]);
  return {place[0] * scale, place[1] * scale};
}

/// Whether a link covers a point of the screen in the central view.
bool covers(const std::array<std::array<float, 2>, 2>& link, const std::array<float, 2>& point, float radius) {
  const float along_x = link[1][0] - link[0][0], along_y = link[1][1] - link[0][1];
  const float from_x = point[0] - link[0][0], from_y = point[1] - link[0][1];
  const float share = std::clamp(
      (from_x * along_x + from_y * along_y) / std::max(along_x * along_x + along_y * along_y, 1e-6f), 0.f, 1.f);
  return std::hypot(from_x - share * along_x, from_y - share * along_y) < radius;
}

/// How much of a leaf's disc no link of another leaf covers in the central view, 0..1. A link counts where its middle
/// is nearer than the leaf.
float seen_share(const PathGraph& graph, int leaf, float viewing_distance_mm) {
  const std::array<float, 2> middle = on_screen(graph.nodes[static_cast<std::size_t>(leaf)], viewing_distance_mm);
  const float depth_mm = graph.nodes[static_cast<std::size_t>(leaf)][2];
  constexpr int across = 7;
  int points = 0, seen = 0;
  for (int i = 0; i < across * across; ++i) {
    const int column = i % across, row = i / across;
    const float right = static_cast<float>(2 * column + 1) / across - 1;
    const float down = static_cast<float>(2 * row + 1) / across - 1;
    if (right * right + down * down > 1) continue;
    const std::array<float, 2> point{middle[0] + right * graph.node_radius_mm, middle[1] + down * graph.node_radius_mm};
    ++points;
    seen += std::ranges::none_of(graph.links, [&](const std::array<int, 2>& link) {
      const PlaceMm& one = graph.nodes[static_cast<std::size_t>(link[0])];
      const PlaceMm& other = graph.nodes[static_cast<std::size_t>(link[1])];
      const bool is_nearer = (one[2] + other[2]) / 2 < depth_mm;
      return link[0] != leaf && is_nearer &&
             covers({on_screen(one, viewing_distance_mm), on_screen(other, viewing_distance_mm)}, point,
                    graph.link_radius_mm);
    });
  }
  return static_cast<float>(seen) / static_cast<float>(points);
}

/// Highlights a leaf in front and one behind, and links the second so that the answer is right. They are drawn by lot
/// until both are seen for the most part.
void highlight(const PathGraphOptions& options, Lots& lots, PathGraph& graph) {
  constexpr float least_seen = 0.7f;
  constexpr int most_trials = 200;
  const int per_group = options.nodes / 3;
  const auto links_of = [&](int leaf) {
    // Links stand in the order of their leaves, two for each.
    return graph.links.begin() + std::ptrdiff_t{2} * (leaf < per_group ? leaf : leaf - per_group);
  };
  for (int trial = 0; trial < most_trials; ++trial) {
    const std::array<int, 2> drawn{lots.below(per_group), 2 * per_group + lots.below(per_group)};
    const TwoLinks of_first{(*links_of(drawn[0]))[1], (*(links_of(drawn[0]) + 1))[1]};
    const TwoLinks of_second = links_of_second(of_first, per_group, graph.connected, lots);
    graph.highlighted = drawn;
    for (int i = 0; i < 2; ++i) (*(links_of(drawn[1]) + i))[1] = of_second[static_cast<std::size_t>(i)];
    if (std::ranges::all_of(
            drawn, [&](int leaf) { return seen_share(graph, leaf, options.viewing_distance_mm) >= least_seen; }))
      return;
  }
}

constexpr double most_nodes = 3000, most_links = 12'000;
constexpr NumberRange places_mm{-10'000, 10'000}, radii_mm{0.01, 1000};

/// Values of a graph's file. Each is checked: the library would take true for 1, and 1.5 for 1.
class GraphFile {
 public:
  GraphFile(std::string_view name, nlohmann::json json) : name_(name), json_(std::move(json)) {
    if (at("kind") != "path graph") refuse("kind", "\"path graph\"");
  }

  [[noreturn]] void refuse(std::string_view key, std::string_view expected) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}: expected {}", name_, key, expected));
  }
  const nlohmann::json& at(const char* key) const { return json_.at(key); }

  std::uint64_t seed() const {
    if (!at("seed").is_number_unsigned()) refuse("seed", "a whole number of at least 0");
    return at("seed").get<std::uint64_t>();
  }
  bool truth(const char* key) const {
    if (!at(key).is_boolean()) refuse(key, "true or false");
    return at(key).get<bool>();
  }
  float length(std::string_view key, const nlohmann::json& value, NumberRange range) const {
    if (!value.is_number() || !range.has(value.get<double>())) refuse(key, "numbers" + words_of(range));
    return value.get<float>();
  }
  const nlohmann::json& list(std::string_view key, const nlohmann::json& values, NumberRange count) const {
    if (!values.is_array() || !count.has(static_cast<double>(values.size())))
      refuse(key, count.least == count.most ? fmt::format("lists of {} values", count.least)
                                            : "a list whose number of entries is" + words_of(count));
    return values;
  }
  /// Two nodes of the graph, by their places in its list.
  std::array<int, 2> node_pair(std::string_view key, const nlohmann::json& pair) const {
    list(key, pair, {2, 2});
    const NumberRange nodes{0, static_cast<double>(at("nodes_mm").size()) - 1};
    for (const nlohmann::json& node : pair)
      if (!node.is_number_integer() || !nodes.has(node.get<double>()))
        refuse(key, "whole numbers" + words_of(nodes) + ", for a node each");
    if (pair[0] == pair[1]) refuse(key, "two different nodes");
    return pair.get<std::array<int, 2>>();
  }

 private:
  std::string_view name_;
  nlohmann::json json_;
};

}  // namespace

PathGraph make_path_graph(const PathGraphOptions& options, std::uint64_t seed, bool connected) {
  check(options);
  Lots lots({seed, 0x6772617068});
  PathGraph graph{.seed = seed,
                  .nodes = place_nodes(options, lots),
                  .connected = connected,
                  .node_radius_mm = options.node_radius_mm,
                  .link_radius_mm = options.link_radius_mm};
  const int per_group = options.nodes / 3;
  for (int leaf = 0; leaf < options.nodes; ++leaf) {
    if (leaf >= per_group && leaf < 2 * per_group) continue;
    const int first = per_group + lots.below(per_group);
    graph.links.push_back({leaf, first});
    graph.links.push_back({leaf, other_node(per_group, {first, first}, lots)});
  }
  highlight(options, lots, graph);
  return graph;
}

bool has_path_of_two(const PathGraph& graph) {
  const auto linked = [&graph](int a, int b) {
    return std::ranges::any_of(graph.links, [a, b](const auto& link) { return has(link, a) && has(link, b); });
  };
  for (int node = 0; node < std::ssize(graph.nodes); ++node)
    if (node != graph.highlighted[0] && node != graph.highlighted[1] && linked(graph.highlighted[0], node) &&
        linked(node, graph.highlighted[1]))
      return true;
  return false;
}

std::string graph_json(const PathGraph& graph) {
  const nlohmann::ordered_json json{{"kind", "path graph"},
                                    {"seed", graph.seed},
                                    {"connected", graph.connected},
                                    {"highlighted", graph.highlighted},
                                    {"node_radius_mm", graph.node_radius_mm},
                                    {"link_radius_mm", graph.link_radius_mm},
                                    {"nodes_mm", graph.nodes},
                                    {"links", graph.links}};
  return json.dump() + "\n";
}

PathGraph graph_from_json(std::string_view text, std::string_view name) {
  try {
    const GraphFile file(name, nlohmann::json::parse(text));
    PathGraph graph{.seed = file.seed(),
                    .highlighted = file.node_pair("highlighted", file.at("highlighted")),
                    .connected = file.truth("connected"),
                    .node_radius_mm = file.length("node_radius_mm", file.at("node_radius_mm"), radii_mm),
                    .link_radius_mm = file.length("link_radius_mm", file.at("link_radius_mm"), radii_mm)};
    for (const nlohmann::json& place : file.list("nodes_mm", file.at("nodes_mm"), {2, most_nodes})) {
      file.list("nodes_mm", place, {3, 3});
      graph.nodes.push_back({file.length("nodes_mm", place[0], places_mm), file.length("nodes_mm", place[1], places_mm),
                             file.length("nodes_mm", place[2], places_mm)});
    }
    for (const nlohmann::json& link : file.list("links", file.at("links"), {1, most_links}))
      graph.links.push_back(file.node_pair("links", link));
    if (has_path_of_two(graph) != graph.connected)
      file.refuse("connected",
                  graph.connected ? "false: no path of two links is there" : "true: a path of two links is there");
    return graph;
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no path graph, expected the JSON of wheatstone study stimuli", name));
  }
}

}  // namespace wheatstone
