#include "wheatstone/curves/diffusion_lines_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/curves/edge_chains_internal.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/motion/steady_picture.h"

namespace wheatstone {
namespace {

/// A point of a chain, and the direction across it, from its second side to its first.
struct Station {
  PlanePoint at;
  Direction across;
};

/// Each second point of a chain.
std::vector<Station> stations_of(const std::vector<PlanePoint>& chain) {
  std::vector<Station> stations;
  const std::size_t last = chain.size() - 1;
  for (std::size_t i = 0; i <= last; i += (i + 2 > last && i < last ? last - i : 2)) {
    const PlanePoint &before = chain[i < 2 ? 0 : i - 2], &after = chain[std::min(i + 2, last)];
    const float dx = after.x - before.x, dy = after.y - before.y, length = std::hypot(dx, dy);
    if (length > 0) stations.push_back({chain[i], {-dy / length, dx / length}});
  }
  return stations;
}

/// A pixel of a picture, by column and row.
struct Pixel {
  int x = 0, y = 0;
};

/// What lies on one side of a station.
struct Side {
  SampledColour colour;
  float disparity = 0;
  bool wanted = true;
};

constexpr float line_px = 1;       // from the edge to the lines
constexpr float colour_px = 2.2f;  // colours right on the edge are mixed: they are taken a little farther out

float sign_of(int side) { return side == 0 ? 1.f : -1.f; }

PlanePoint beside(const Station& station, int side, float offset_px) {
  return {station.at.x + sign_of(side) * offset_px * station.across.x,
          station.at.y + sign_of(side) * offset_px * station.across.y};
}

class SideMaker {
 public:
  SideMaker(const SceneOfEdges& scene, std::size_t view)
      : scene_(scene),
        view_(scene.views[view]),
        index_(view),
        is_beside_eyes_(view > 0 && view_.position != left_eye && view_.position != right_eye) {}

  Side make(const Station& station, int side) const {
    const auto [x, y] = pixel(beside(station, side, colour_px));
    Side result{colour_of(station, side), view_.disparity(x, y), true};
    // Behind a nearer surface each view sees another place of the farther one.
    const bool behind =
        disparity_at(beside(station, 1 - side, colour_px)) - result.disparity > scene_.depth_threshold_px;
    const bool only_here = index_ == 0 || view_.wanted.empty() || view_.wanted(x, y) != 0;
    // Close to a corner of something near, a line beside the eyes would carry that one's colour to what is behind it.
    const bool is_covered = disparity_at(beside(station, side, line_px)) - result.disparity > scene_.depth_threshold_px;
    result.wanted = (behind || only_here) && !(is_beside_eyes_ && is_covered);
    return result;
  }

 private:
  Pixel pixel(PlanePoint p) const {
    return {std::clamp(static_cast<int>(p.x), 0, view_.colour.width() - 1),
            std::clamp(static_cast<int>(p.y), 0, view_.colour.height() - 1)};
  }

  float disparity_at(PlanePoint p) const {
    const auto [x, y] = pixel(p);
    return view_.disparity(x, y);
  }

  /// The colour a little out from the edge, but not beyond a stripe that is narrower than that: as far as it goes on
  /// to change away from that of the other side.
  SampledColour colour_of(const Station& station, int side) const {
    constexpr float first_px = 0.7f, step_px = 0.5f;
    constexpr int steps = 3;
    const auto at = [&](int of_side, float offset_px) {
      const PlanePoint p = beside(station, of_side, offset_px);
      return sample(view_.colour, p.x, p.y);
    };
    const auto light = [](const SampledColour& c) { return luma_of(c.r, c.g, c.b); };
    const float outermost = disparity_at(beside(station, side, colour_px));
    SampledColour colour = at(side, first_px);
    const bool rises = light(colour) > light(at(1 - side, first_px));
    for (int step = 1; step <= steps; ++step) {
      const float offset = first_px + static_cast<float>(step) * step_px;
      const SampledColour next = at(side, offset);
      const float change = light(next) - light(colour);
      // Beside something thin the colour would be one surface's and the disparity another's.
      const bool one_surface =
          std::abs(disparity_at(beside(station, side, offset - step_px)) - outermost) <= scene_.depth_threshold_px;
      if (one_surface && ((rises && change < -1) || (!rises && change > 1))) break;
      colour = next;
    }
    return colour;
  }

  const SceneOfEdges& scene_;
  const View& view_;
  std::size_t index_;
  bool is_beside_eyes_;
};

/// A chain's stations with both sides.
struct TwoSides {
  std::vector<Station> stations;
  std::vector<Side> sides[2];
};

float distance(const SampledColour& a, const SampledColour& b) { return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b); }

/// Moves what was found towards what was drawn before, the less the more they differ.
void ease_side(const SampledColour& colour_before, float disparity_before, float depth_threshold_px, Side& side) {
  constexpr float kept = 0.65f, unlike = 45;
  const float far = std::min(distance(colour_before, side.colour) / unlike, 1.f), share = kept * (1 - far * far);
  side.colour = {side.colour.r + share * (colour_before.r - side.colour.r),
                 side.colour.g + share * (colour_before.g - side.colour.g),
                 side.colour.b + share * (colour_before.b - side.colour.b)};
  const float apart = std::min(std::abs(disparity_before - side.disparity) / depth_threshold_px, 1.f);
  side.disparity += kept * (1 - apart * apart) * (disparity_before - side.disparity);
}

/// Spreads shifts along a chain, also to the stations that have none.
std::vector<float> smoothed(const std::vector<std::optional<EdgeBefore>>& before) {
  constexpr int reach = 3;
  const int count = static_cast<int>(before.size());
  std::vector<float> shifts(before.size());
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    int found = 0;
    for (int j = std::max(i - reach, 0); j <= std::min(i + reach, count - 1); ++j) {
      if (!before[static_cast<std::size_t>(j)]) continue;
      sum += before[static_cast<std::size_t>(j)]->shift_px;
      ++found;
    }
    if (found > 0) shifts[static_cast<std::size_t>(i)] = sum / static_cast<float>(found);
  }
  return shifts;
}

/// Lets a chain go on from the edges of the frame before.
void ease(const CarriedEdges& carried, std::uint32_t view, float depth_threshold_px, TwoSides& line) {
  constexpr float kept = 0.4f;
  std::vector<std::optional<EdgeBefore>> before(line.stations.size());
  for (std::size_t i = 0; i < line.stations.size(); ++i) {
    const Station& station = line.stations[i];
    const float step = line.sides[0][i].disparity - line.sides[1][i].disparity;
    const bool jumps = std::abs(step) > depth_threshold_px;
    // A jump moves with the nearer surface.
    const int nearer = step > 0 ? 0 : 1;
    const SurfacePoint carrier{beside(station, nearer, colour_px), line.sides[nearer][i].disparity, view};
    before[i] = carried.find(station.at, station.across, carrier);
    if (!before[i]) continue;
    for (const int side : {0, 1})
      if (!jumps || side == nearer)
        ease_side(before[i]->colours[side], before[i]->disparities[side], depth_threshold_px, line.sides[side][i]);
  }
  const std::vector<float> shifts = smoothed(before);
  for (std::size_t i = 0; i < line.stations.size(); ++i) {
    Station& station = line.stations[i];
    station.at.x += kept * shifts[i] * station.across.x;
    station.at.y += kept * shifts[i] * station.across.y;
  }
}

/// Adds the runs of a side that are wanted.
void add_lines(const TwoSides& line, int side, const View& view, float depth_threshold_px,
               DiffusionPainting& painting) {
  const std::vector<Side>& points = line.sides[side];
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    const auto joins = [&](std::size_t i) {
      return points[i].wanted == points[begin].wanted &&
             std::abs(points[i].disparity - points[i - 1].disparity) <= depth_threshold_px;
    };
    while (end < points.size() && joins(end)) ++end;
    if (points[begin].wanted) {
      painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()),
                                static_cast<std::uint32_t>(end - begin), view.position, all_views});
      for (std::size_t i = begin; i < end; ++i) {
        const PlanePoint at = beside(line.stations[i], side, line_px);
        painting.points.push_back(
            {{at.x + static_cast<float>(view.frame.origin_px), at.y, points[i].disparity}, rounded(points[i].colour)});
      }
    }
    begin = end;
  }
}

void add_edges(const TwoSides& line, std::uint32_t view, std::vector<CarriedEdge>& edges) {
  for (std::size_t i = 0; i < line.stations.size(); ++i) {
    const Side &first = line.sides[0][i], &second = line.sides[1][i];
    if (!first.wanted && !second.wanted) continue;
    const Station& station = line.stations[i];
    edges.push_back({station.at.x,
                     station.at.y,
                     station.across.x,
                     station.across.y,
                     {first.colour, second.colour},
                     {first.disparity, second.disparity},
                     view});
  }
}

/// The pixels along a picture's border, side by side.
std::vector<std::vector<Pixel>> border_of(int width, int height) {
  std::vector<std::vector<Pixel>> sides;
  for (int y = 0; y < height; y += std::max(height - 1, 1)) {
    std::vector<Pixel>& side = sides.emplace_back();
    for (int x = 0; x < width; ++x) side.push_back({x, y});
  }
  for (int x = 0; x < width; x += std::max(width - 1, 1)) {
    std::vector<Pixel>& side = sides.emplace_back();
    for (int y = 0; y < height; ++y) side.push_back({x, y});
  }
  return sides;
}

/// The picture's border is a line, too: between it and the edges colours are interpolated, and what no edge bounds, as
/// a soft shadow in a corner, is not painted in the colour of some edge far away. It is there in every frame of a film.
void add_border(const View& view, float depth_threshold_px, DiffusionPainting& painting) {
  const auto is_wanted = [&](const Pixel& at) { return view.wanted.empty() || view.wanted(at.x, at.y) != 0; };
  for (const std::vector<Pixel>& side : border_of(view.colour.width(), view.colour.height())) {
    bool goes_on = false;
    float disparity_before = 0;
    for (const Pixel& at : side) {
      const float disparity = view.disparity(at.x, at.y);
      goes_on = goes_on && std::abs(disparity - disparity_before) <= depth_threshold_px;
      disparity_before = disparity;
      if (!is_wanted(at)) {
        goes_on = false;
        continue;
      }
      if (!goes_on)
        painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()), 0, view.position, all_views});
      goes_on = true;
      ++painting.lines.back().point_count;
      painting.points.push_back(
          {{static_cast<float>(at.x + view.frame.origin_px) + 0.5f, static_cast<float>(at.y) + 0.5f, disparity},
           view.colour(at.x, at.y)});
    }
  }
}

LinesAndEdges lines_of_view(const SceneOfEdges& scene, std::size_t index, const CarriedEdges* before) {
  const View& view = scene.views[index];
  const SideMaker maker(scene, index);
  const auto number = static_cast<std::uint32_t>(index);
  Image<std::uint8_t> known;
  if (before != nullptr && index == 0) known = before->known_edges();
  LinesAndEdges result{{view.colour.width(), view.colour.height(), {}, {}}, {}};
  const EdgeOptions options{.depth_threshold_px = scene.depth_threshold_px, .known = known};
  for (const auto& chain : find_edge_chains(view.colour, view.disparity, options)) {
    TwoSides line{stations_of(chain), {}};
    for (const Station& station : line.stations)
      for (const int side : {0, 1}) line.sides[side].push_back(maker.make(station, side));
    if (before != nullptr) ease(*before, number, scene.depth_threshold_px, line);
    for (const int side : {0, 1}) add_lines(line, side, view, scene.depth_threshold_px, result.painting);
    add_edges(line, number, result.edges);
  }
  add_border(view, scene.depth_threshold_px, result.painting);
  return result;
}

void append(const LinesAndEdges& part, LinesAndEdges& whole) {
  const auto first = static_cast<std::uint32_t>(whole.painting.points.size());
  whole.painting.points.insert(whole.painting.points.end(), part.painting.points.begin(), part.painting.points.end());
  for (ColourLine line : part.painting.lines) {
    line.first_point += first;
    whole.painting.lines.push_back(line);
  }
  whole.edges.insert(whole.edges.end(), part.edges.begin(), part.edges.end());
}

}  // namespace

LinesAndEdges lines_beside_edges(const SceneOfEdges& scene, const CarriedEdges* before) {
  std::vector<LinesAndEdges> parts(scene.views.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) { parts[i] = lines_of_view(scene, i, before); });
  LinesAndEdges whole{{parts[0].painting.width, parts[0].painting.height, {}, {}}, {}};
  for (const LinesAndEdges& part : parts) append(part, whole);
  return whole;
}

}  // namespace wheatstone
