#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// A place in front of or behind a screen, in mm from its middle: x to the right, y down, z behind the screen.
using PlaceMm = std::array<float, 3>;

/// A graph for a path-searching task: is there a path of two links between the two highlighted nodes?
struct PathGraph {
  std::uint64_t seed = 0;
  std::vector<PlaceMm> nodes;             ///< a third each: leaves in front, intermediate nodes, leaves behind
  std::vector<std::array<int, 2>> links;  ///< a leaf and an intermediate node
  std::array<int, 2> highlighted{};       ///< one leaf in front, one behind
  bool connected = false;                 ///< the answer
  float node_radius_mm = 0;
  float link_radius_mm = 0;
  friend bool operator==(const PathGraph&, const PathGraph&) = default;
};

/// Where the nodes stand.
enum class GraphPlacement {
  planes,  ///< leaves in front of and behind the screen, intermediate nodes on it (Hassaine 2010, 3.2.1)
  volume,  ///< anywhere between the two outer planes (Ware & Franck 1996)
};

struct PathGraphOptions {
  int nodes = 90;  ///< a multiple of three, at least 9
  GraphPlacement placement = GraphPlacement::planes;
  float depth_mm = 100;  ///< from the nearest plane to the farthest; half of it is in front of the screen; 0: flat
  float width_mm = 300;  ///< of the field that the nodes fill, as the central view shows it on the screen
  float height_mm = 220;
  float node_radius_mm = 4;
  float link_radius_mm = 1;
  float viewing_distance_mm = 700;
  float eye_separation_mm = 65;
};

/// Makes a graph by the rules of Hassaine 2010, 3.2.1: three groups of equal size; every leaf is linked to two
/// different intermediate nodes, which are drawn at random; the highlighted nodes are a leaf in front and one behind.
/// If `connected`, they share exactly one intermediate node, else none. On planes no node hides another, or touches it,
/// in the central view, which the thesis asks for, and in either eye's of a head in the middle. Links of other leaves
/// cover less than a third of a highlighted node in the central view. The same options and seed give the same graph.
/// Throws Error{bad_input} where the number of nodes is none of these or the nodes do not fit into the field.
PathGraph make_path_graph(const PathGraphOptions& options, std::uint64_t seed, bool connected);

/// Whether there is a path of two links between the highlighted nodes.
bool has_path_of_two(const PathGraph& graph);

/// The graph as a JSON object, and back. `name` stands for the file in messages. Throws Error{bad_input} where the
/// text is no graph, or its answer is not that of its links.
std::string graph_json(const PathGraph& graph);
PathGraph graph_from_json(std::string_view text, std::string_view name);

}  // namespace wheatstone
