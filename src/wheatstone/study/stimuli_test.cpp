#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "throws_error.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/study/draw_graph.h"
#include "wheatstone/study/path_graph.h"
#include "wheatstone/study/random_dots.h"
#include "wheatstone/study/simulated_display.h"

namespace wheatstone::stimuli_test {

using testing::FloatNear;

constexpr int seeds = 1000;
const StudyScreen screen;

/// Whether an eye sees two spheres' outlines overlap, by the angle between them and their apparent radii.
bool hide_each_other(const PathGraph& graph, std::size_t a, std::size_t b, const EyePlace& eye) {
  // What is far apart is not worth a closer look.
  if (std::abs(graph.nodes[a][0] - graph.nodes[b][0]) + std::abs(graph.nodes[a][1] - graph.nodes[b][1]) > 80)
    return false;
  const auto from_eye = [&](std::size_t node) {
    const PlaceMm& place = graph.nodes[node];
    return std::array<double, 3>{place[0] - eye.x_mm, place[1], place[2] + eye.distance_mm};
  };
  const auto p = from_eye(a), q = from_eye(b);
  const double length_p = std::hypot(p[0], p[1], p[2]), length_q = std::hypot(q[0], q[1], q[2]);
  const double cosine = (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) / (length_p * length_q);
  return std::acos(std::min(1.0, cosine)) <
         std::asin(graph.node_radius_mm / length_p) + std::asin(graph.node_radius_mm / length_q);
}

/// What breaks a rule of Hassaine 2010, 3.2.1, or nothing.
std::string broken_rule(const PathGraph& graph, const PathGraphOptions& options) {
  const std::size_t group = graph.nodes.size() / 3;
  if (graph.nodes.size() != static_cast<std::size_t>(options.nodes)) return "number of nodes";
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    const std::size_t plane = node / group;
    if (graph.nodes[node][2] != options.depth_mm / 2 * (static_cast<float>(plane) - 1)) return "depth planes";
  }
  std::map<int, std::set<int>> links_of_leaf;
  for (const auto& [leaf, intermediate] : graph.links) {
    if (static_cast<std::size_t>(leaf) / group == 1 || static_cast<std::size_t>(intermediate) / group != 1)
      return "groups of links";
    links_of_leaf[leaf].insert(intermediate);
  }
  if (graph.links.size() != 4 * group || links_of_leaf.size() != 2 * group) return "number of links";
  for (const auto& [leaf, intermediate] : links_of_leaf)
    if (intermediate.size() != 2) return "degree of a leaf";
  if (static_cast<std::size_t>(graph.highlighted[0]) / group != 0 ||
      static_cast<std::size_t>(graph.highlighted[1]) / group != 2)
    return "highlighted nodes";
  if (has_path_of_two(graph) != graph.connected) return "the answer";
  for (std::size_t a = 0; a < graph.nodes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (const float x_mm : {0.0f, -options.eye_separation_mm / 2, options.eye_separation_mm / 2})
        if (hide_each_other(graph, a, b, {x_mm, options.viewing_distance_mm})) return "occlusion";
  return "";
}

TEST(PathGraph, KeepsAllRulesOverThousandSeeds) {
  const PathGraphOptions options;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    ASSERT_EQ(broken_rule(make_path_graph(options, seed, seed % 2 == 0), options), "") << "seed " << seed;
}

TEST(PathGraph, RulesOnOcclusionCanBeBroken) {
  PathGraph graph = make_path_graph({}, 1, true);
  graph.nodes[31] = {graph.nodes[0][0] * 700 / 650, graph.nodes[0][1] * 700 / 650, 0};
  EXPECT_EQ(broken_rule(graph, {}), "occlusion");
}

TEST(PathGraph, DependsOnItsSeedOnly) {
  EXPECT_EQ(make_path_graph({}, 5, true), make_path_graph({}, 5, true));
  EXPECT_NE(make_path_graph({}, 5, true).nodes, make_path_graph({}, 6, true).nodes);
}

TEST(PathGraph, ComesBackFromItsFile) {
  const PathGraph graph = make_path_graph({}, 7, false);
  EXPECT_EQ(graph_from_json(graph_json(graph), "graph.json"), graph);
}

/// The text with one place of it replaced.
std::string damaged(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(PathGraph, ADamagedFileIsNamedWithWhatIsWrong) {
  const PathGraph graph = make_path_graph({}, 7, false);
  const std::string whole = graph_json(graph);
  struct Damage {
    std::string from, to, message;
  };
  const std::string nodes = "\"nodes_mm\":[", links = "\"links\":[", no_graph = "is no path graph";
  const std::string first = whole.substr(whole.find(nodes) + nodes.size(),
                                         whole.find("],", whole.find(nodes)) - whole.find(nodes) - nodes.size() + 1);
  const auto connected = [&] {
    PathGraph other = graph;
    other.links.push_back({graph.highlighted[0], 40});
    other.links.push_back({40, graph.highlighted[1]});
    return graph_json(other);
  };
  for (const Damage& damage : std::vector<Damage>{
           {"{", "", no_graph},
           {"{", "[", no_graph},
           {"}", "", no_graph},
           {"}", "}}", no_graph},
           {whole.substr(whole.size() / 2), "", no_graph},
           {whole, "", no_graph},
           {whole, "[]", no_graph},
           {whole, "null", no_graph},
           {whole, "{\"seed\": 1}", no_graph},
           {whole, "nonsense", no_graph},
           {whole, std::string(100'000, '['), no_graph},
           {"\"kind\"", "\"kin\"", no_graph},
           {"path graph", "other", "kind: expected"},
           {"path graph", "\xff", no_graph},
           {"\"seed\":7", "\"seed\":-7", "seed: expected a whole number of at least 0"},
           {"\"seed\":7", "\"seed\":7.5", "seed: expected"},
           {"\"seed\":7", "\"seed\":true", "seed: expected"},
           {"\"seed\":7", "\"seed\":1e400", no_graph},
           {R"("seed":7)", R"("seed":"7")", "seed: expected"},
           {"\"seed\":7,", "", no_graph},
           {"\"connected\":false", "\"connected\":0", "connected: expected true or false"},
           {"\"connected\":false", "\"connected\":null", "connected: expected true or false"},
           {"\"connected\":false", "\"connected\":true", "connected: expected false: no path of two links"},
           {whole, connected(), "connected: expected true: a path of two links is there"},
           {"\"highlighted\":[", "\"highlighted\":[0,", "highlighted: expected lists of 2 values"},
           {R"("highlighted":[)", R"("highlighted":[],"h":[)", "highlighted: expected lists of 2 values"},
           {R"("highlighted":[)", R"("highlighted":[3,3],"h":[)", "highlighted: expected two different nodes"},
           {R"("highlighted":[)", R"("highlighted":[3,90],"h":[)", "highlighted: expected whole numbers from 0 to 89"},
           {R"("highlighted":[)", R"("highlighted":[3,-1],"h":[)", "highlighted: expected whole numbers from 0 to 89"},
           {"\"node_radius_mm\":4.0", "\"node_radius_mm\":-4", "node_radius_mm: expected numbers from 0.01 to 1000"},
           {"\"node_radius_mm\":4.0", "\"node_radius_mm\":0", "node_radius_mm: expected"},
           {"\"node_radius_mm\":4.0", "\"node_radius_mm\":1e30", "node_radius_mm: expected"},
           {"\"node_radius_mm\":4.0", "\"node_radius_mm\":null", "node_radius_mm: expected"},
           {"\"node_radius_mm\":4.0", "\"node_radius_mm\":NaN", no_graph},
           {R"("link_radius_mm":1.0)", R"("link_radius_mm":"1")", "link_radius_mm: expected"},
           {"\"link_radius_mm\":1.0", "\"link_radius_mm\":true", "link_radius_mm: expected"},
           {first, "[1e300,0,0]", "nodes_mm: expected numbers from -10000 to 10000"},
           {first, "[1,2]", "nodes_mm: expected lists of 3 values"},
           {first, "[1,2,3,4]", "nodes_mm: expected lists of 3 values"},
           {first, "[1,2,null]", "nodes_mm: expected numbers"},
           {first, "[1,2,[3]]", "nodes_mm: expected numbers"},
           {first, "7", "nodes_mm: expected lists of 3 values"},
           {first + ",", "", "links: expected whole numbers from 0 to 88"},
           {nodes, R"("nodes_mm":[],"n":[)", "highlighted: expected whole numbers"},
           {nodes, R"("nodes_mm":{},"n":[)", "highlighted: expected whole numbers"},
           {links, links + "[1,1],", "links: expected two different nodes"},
           {links, links + "[1,90],", "links: expected whole numbers from 0 to 89"},
           {links, links + "[1,4294967296],", "links: expected whole numbers"},
           {links, links + "[1,1.5],", "links: expected whole numbers"},
           {links, links + "[1,true],", "links: expected whole numbers"},
           {links, links + "[1],", "links: expected lists of 2 values"},
           {links, R"("links":[],"l":[)", "links: expected a list whose number of entries is from 1"}}) {
    SCOPED_TRACE(damage.from.substr(0, 40) + " -> " + damage.to.substr(0, 40));
    expect_error(ErrorKind::bad_input, "graph.json: " + damage.message,
                 [&] { graph_from_json(damaged(whole, damage.from, damage.to), "graph.json"); });
  }
}

TEST(PathGraph, NodesThatCannotBeAreRefused) {
  expect_error(ErrorKind::bad_input, "nodes: is 91, expected a multiple of three",
               [] { make_path_graph({.nodes = 91}, 1, true); });
  expect_error(ErrorKind::bad_input, "do not fit",
               [] { make_path_graph({.nodes = 300, .node_radius_mm = 12}, 1, true); });
}

TEST(PathGraph, AVolumeIsFilledAtRandom) {
  const PathGraph graph = make_path_graph({.placement = GraphPlacement::volume}, 3, true);
  std::set<float> depths;
  for (const PlaceMm& place : graph.nodes) {
    depths.insert(place[2]);
    EXPECT_LE(std::abs(place[2]), 50);
  }
  EXPECT_EQ(depths.size(), graph.nodes.size());
  EXPECT_TRUE(has_path_of_two(graph));
}

TEST(SimulatedDisplay, NodesHaveTheStatedDepthOnTheScreen) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const PathGraph graph = make_path_graph({.depth_mm = seed % 2 == 0 ? 20.0f : 100.0f}, seed, true);
    const std::array<SimulatedView, 2> eyes = shown_views({}, screen, {});
    for (const PlaceMm& node : graph.nodes) {
      const float parallax = on_screen_px(screen, eyes[1].view, node)[0] - on_screen_px(screen, eyes[0].view, node)[0];
      ASSERT_THAT(parallax * screen.pixel_pitch_mm(),
                  FloatNear(screen_parallax_mm(screen.viewing(), node[2]), 0.5f * screen.pixel_pitch_mm()));
    }
  }
}

/// The middle of what is red.
std::array<double, 2> middle_of_red(const Image<Rgb8>& picture) {
  double x_sum = 0, y_sum = 0, sum = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const double red = std::max(0, picture(x, y).r - 2 * picture(x, y).g);
      x_sum += red * (x + 0.5);
      y_sum += red * (y + 0.5);
      sum += red;
    }
  return {x_sum / sum, y_sum / sum};
}

/// One red sphere.
PathGraph one_node(const PlaceMm& place) { return {.nodes = {place}, .highlighted = {0, 0}, .node_radius_mm = 6}; }

TEST(DrawnGraph, ANodeIsDrawnAtItsParallax) {
  for (const float depth : {-50.0f, -10.0f, 0.0f, 10.0f, 50.0f}) {
    const StereoPair pair = draw_for_eyes(one_node({40, -25, depth}), screen, {}, {});
    const auto left = middle_of_red(pair.left), right = middle_of_red(pair.right);
    EXPECT_NEAR((right[0] - left[0]) * screen.pixel_pitch_mm(), screen_parallax_mm(screen.viewing(), depth),
                0.5 * screen.pixel_pitch_mm())
        << depth;
    EXPECT_NEAR(left[1], right[1], 0.1) << "vertical parallax";
  }
}

/// Share of a pixel that something black covers on white.
double covered(Rgb8 colour) { return 1 - linear_from_srgb(colour.g); }

TEST(DrawnGraph, ASphereCoversAsMuchAsItsOutline) {
  const Image<Rgb8> picture =
      draw_graph(one_node({0, 0, 0}), screen, {0, 700}, {.background = {255, 255, 255}, .highlighted = {0, 0, 0}});
  double area = 0;
  for (const Rgb8 colour : picture.pixels()) area += covered(colour);
  const double radius_px = 6 / screen.pixel_pitch_mm();
  EXPECT_NEAR(area, std::numbers::pi * radius_px * radius_px, 0.01 * area);
}

TEST(DrawnGraph, TheNearerNodeHidesTheFarther) {
  PathGraph graph = one_node({0, 0, -30});
  graph.nodes.push_back({0, 0, 40});
  const Image<Rgb8> both = draw_graph(graph, screen, {0, 700});
  EXPECT_GT(both(512, 384).r, 2 * both(512, 384).g) << "the red one is in front";
  graph.nodes[0][2] = 90;
  graph.nodes[1][2] = -40;
  const Image<Rgb8> hidden = draw_graph(graph, screen, {0, 700});
  EXPECT_LT(hidden(512, 384).r, 2 * hidden(512, 384).g);
}

TEST(DrawnGraph, LinksLeaveMostOfAHighlightedNodeToBeSeen) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    PathGraph graph = make_path_graph({}, seed, seed % 2 == 0);
    for (const int node : std::array{graph.highlighted[0], graph.highlighted[1]}) {
      graph.highlighted = {node, node};
      const Image<Rgb8> picture = draw_graph(graph, screen, {0, 700});
      const auto red = std::ranges::count_if(picture.pixels(), [](Rgb8 pixel) { return pixel.r > 2 * pixel.g; });
      const double depth = graph.nodes[static_cast<std::size_t>(node)][2];
      const double radius_px = graph.node_radius_mm * 700 / (700 + depth) / screen.pixel_pitch_mm();
      // Its own two links cover some of it, too.
      EXPECT_GT(static_cast<double>(red), 0.5 * std::numbers::pi * radius_px * radius_px) << "seed " << seed;
    }
  }
}

TEST(DrawnGraph, ATubeIsThinnerFartherAway) {
  const auto width_at = [](float depth) {
    PathGraph graph{.nodes = {{-100, 0, depth}, {100, 0, depth}},
                    .links = {{0, 1}},
                    .highlighted = {0, 0},
                    .node_radius_mm = 1,
                    .link_radius_mm = 4};
    const Image<Rgb8> picture = draw_graph(
        graph, screen, {0, 700}, {.background = {255, 255, 255}, .link = {0, 0, 0}, .highlighted = {255, 255, 255}});
    double rows = 0;
    for (int y = 0; y < picture.height(); ++y) rows += covered(picture(512, y));
    return rows;
  };
  EXPECT_NEAR(width_at(0), 8 / screen.pixel_pitch_mm(), 0.3);
  EXPECT_NEAR(width_at(-300), 8 / screen.pixel_pitch_mm() * 700 / 400, 0.3);
  EXPECT_NEAR(width_at(300), 8 / screen.pixel_pitch_mm() * 700 / 1000, 0.3);
}

TEST(SimulatedDisplay, PerceivedDepthIsConstantForAnyHead) {
  const PlaceMm place{35, -20, -50};
  const SimulatedDisplay dense{.views_per_10cm = 1000};
  for (const float x : {-150.0f, -40.0f, 0.0f, 95.0f})
    for (const float distance : {500.0f, 700.0f, 900.0f}) {
      const HeadPlace head{x, distance};
      const std::array<SimulatedView, 2> shown = shown_views(dense, screen, head);
      const std::array<EyePlace, 2> eyes{EyePlace{x - 32.5f, distance}, EyePlace{x + 32.5f, distance}};
      const PlaceMm seen = perceived_place(
          screen, eyes, {on_screen_px(screen, shown[0].view, place), on_screen_px(screen, shown[1].view, place)});
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(seen[axis], place[axis], 0.2) << x << " " << distance;
    }
}

TEST(SimulatedDisplay, AFixedPairRotatesFalselyWithTheHead) {
  const PlaceMm place{0, 0, -50};
  const HeadPlace head{100, 700};
  const std::array<EyePlace, 2> eyes{EyePlace{67.5f, 700}, EyePlace{132.5f, 700}};
  const auto seen = [&](const SimulatedDisplay& display) {
    const std::array<SimulatedView, 2> shown = shown_views(display, screen, head);
    return perceived_place(screen, eyes,
                           {on_screen_px(screen, shown[0].view, place), on_screen_px(screen, shown[1].view, place)});
  };
  EXPECT_NEAR(seen({.views_per_10cm = 0})[2], -50, 0.1) << "its depth stays";
  EXPECT_NEAR(seen({.views_per_10cm = 0})[0], 50 * 100 / 700.0, 0.1) << "it follows the head";
  EXPECT_NEAR(seen({.views_per_10cm = 10})[0], 0, 0.1);
}

TEST(SimulatedDisplay, TheHeadIsBroughtToTheNearestView) {
  const auto left_view = [](float density, float head_mm) {
    return shown_views({.views_per_10cm = density}, screen, {head_mm, 700})[0].view.x_mm + 32.5f;
  };
  EXPECT_FLOAT_EQ(left_view(2, 24), 0);
  EXPECT_FLOAT_EQ(left_view(2, 26), 50) << "flips to the next pair";
  EXPECT_FLOAT_EQ(left_view(4, 26), 25);
  EXPECT_FLOAT_EQ(left_view(0, 200), 0);
  const auto eyes = shown_views({.views_per_10cm = 2, .quantised = Quantised::eyes}, screen, {0, 700});
  EXPECT_FLOAT_EQ(eyes[1].view.x_mm - eyes[0].view.x_mm, 100) << "wide views change the separation";
}

TEST(SimulatedDisplay, DistanceIsFollowedOnlyWhereTracked) {
  EXPECT_EQ(shown_views({.views_per_10cm = 8}, screen, {0, 600})[0].view.distance_mm, 600);
  EXPECT_EQ(shown_views({.views_per_10cm = 8, .tracks_distance = false}, screen, {0, 600})[0].view.distance_mm, 700);
}

TEST(SimulatedDisplay, MonoscopicEyesSeeTheLeftView) {
  const StudyScreen small{.width_px = 160, .height_px = 120};
  const PathGraph graph = make_path_graph({}, 1, true);
  const StereoPair pair = draw_for_eyes(graph, small, {.monoscopic = true}, {});
  EXPECT_EQ(pair.left, pair.right);
  EXPECT_EQ(pair.left, draw_for_eyes(graph, small, {}, {}).left);
  EXPECT_NE(pair.left, draw_for_eyes(graph, small, {}, {}).right);
}

TEST(SimulatedDisplay, CrosstalkMixesTheNeighboursLight) {
  const Image<Rgb8> black(2, 1, {0, 0, 0}), white(2, 1, {255, 255, 255});
  EXPECT_EQ(with_crosstalk(black, {white, black}, 0.2f)(0, 0).g, 89) << "a tenth of the light";
  EXPECT_EQ(with_crosstalk(white, {white, white}, 0.2f)(0, 0).g, 255);
  const StudyScreen small{.width_px = 160, .height_px = 120};
  const PathGraph graph = make_path_graph({}, 1, true);
  EXPECT_NE(draw_for_eyes(graph, small, {.crosstalk = 0.1f}, {}).left, draw_for_eyes(graph, small, {}, {}).left);
}

/// How much brighter than chance the pixels of two rows of dots agree where the left ones are moved.
double agreement(const StereoPair& pair, int x0, int y0, int shift) {
  double sum = 0;
  for (int y = y0; y < y0 + 20; ++y)
    for (int x = x0; x < x0 + 20; ++x) sum += std::abs(pair.left(x + shift, y).g - pair.right(x, y).g);
  return sum;
}

TEST(RandomDots, OnlyTheRingIsRaisedAndItsGapIsNot) {
  const StudyScreen small{.width_mm = 200, .width_px = 400, .height_px = 300};
  // Six pixels of crossed parallax: 3 mm at 700 mm.
  const StereoPair pair = random_dot_stereogram({.disparity_arcsec = 884}, small, RingGap::right, 4);
  const auto raised = [&](int x, int y) { return agreement(pair, x, y, 6) < agreement(pair, x, y, 0); };
  EXPECT_TRUE(raised(110, 140)) << "the ring on the left";
  EXPECT_TRUE(raised(190, 65)) << "above";
  EXPECT_FALSE(raised(270, 140)) << "the gap on the right";
  EXPECT_FALSE(raised(190, 140)) << "the middle";
}

TEST(RandomDots, ADisparityMayBeLessThanAPixel) {
  const StereoPair flat = random_dot_stereogram({.disparity_arcsec = 0}, screen, RingGap::left, 4);
  EXPECT_EQ(flat.left, flat.right);
  const StereoPair fine = random_dot_stereogram({.disparity_arcsec = 40}, screen, RingGap::left, 4);
  EXPECT_NE(fine.left, fine.right);
}

}  // namespace wheatstone::stimuli_test
