#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "wheatstone/marks/spline.h"
#include "wheatstone/regions/outline_internal.h"

namespace wheatstone {
namespace {

/// A corner between four pixels.
struct Corner {
  int x = 0, y = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};

/// A piece of the border between two regions, from one corner where three meet to the next, or once round.
struct Arc {
  std::vector<Corner> corners;     ///< a closed one ends where it begins
  std::vector<PlanePoint> points;  ///< the corners, smoothed
  std::vector<std::size_t> kept;   ///< which of them the rings keep, in order, both ends among them
  std::int32_t left = -1, right = -1;
  bool closed() const { return corners.front() == corners.back(); }
};

constexpr std::array<Corner, 4> steps{Corner{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// Walks along the cracks between pixels of different regions.
class Tracer {
 public:
  explicit Tracer(const RegionMap& regions)
      : of_(regions.of),
        width_(of_.width()),
        height_(of_.height()),
        walked_{Image<std::uint8_t>(width_ + 1, height_ + 1), Image<std::uint8_t>(width_ + 1, height_ + 1)} {}

  std::vector<Arc> arcs() {
    std::vector<Arc> arcs;
    for (const bool from_junctions : {true, false}) {
      for (int y = 0; y <= height_; ++y) {
        for (int x = 0; x <= width_; ++x) {
          if (lies_inside({x, y}) || (from_junctions && !is_junction({x, y}))) continue;
          for (int direction = 0; direction < 4; ++direction)
            if (is_crack({x, y}, direction) && !walked({x, y}, direction)) arcs.push_back(walk({x, y}, direction));
        }
      }
    }
    return arcs;
  }

 private:
  std::int32_t region(int x, int y) const { return of_.contains(x, y) ? of_(x, y) : -1; }

  /// Most corners lie inside a region.
  bool lies_inside(Corner c) const {
    if (c.x == 0 || c.y == 0 || c.x == width_ || c.y == height_) return false;
    const std::int32_t first = of_(c.x - 1, c.y - 1);
    return of_(c.x, c.y - 1) == first && of_(c.x - 1, c.y) == first && of_(c.x, c.y) == first;
  }

  /// The regions to the left and right of a step.
  std::pair<std::int32_t, std::int32_t> sides(Corner c, int direction) const {
    const std::int32_t above_left = region(c.x - 1, c.y - 1), above_right = region(c.x, c.y - 1);
    const std::int32_t below_left = region(c.x - 1, c.y), below_right = region(c.x, c.y);
    switch (direction) {
      case 0:
        return {above_right, below_right};
      case 1:
        return {below_right, below_left};
      case 2:
        return {below_left, above_left};
      default:
        return {above_left, above_right};
    }
  }
  bool is_crack(Corner c, int direction) const {
    const auto [left, right] = sides(c, direction);
    return left != right;
  }
  bool is_junction(Corner c) const {
    const bool picture_corner = (c.x == 0 || c.x == width_) && (c.y == 0 || c.y == height_);
    int cracks = 0;
    for (int direction = 0; direction < 4; ++direction) cracks += is_crack(c, direction) ? 1 : 0;
    return cracks > 2 || (cracks == 2 && picture_corner);
  }
  std::uint8_t& walked(Corner c, int direction) {
    const Corner from = direction < 2 ? c : Corner{c.x + steps[direction].x, c.y + steps[direction].y};
    return walked_[direction % 2](from.x, from.y);
  }

  Arc walk(Corner corner, int direction) {
    Arc arc;
    std::tie(arc.left, arc.right) = sides(corner, direction);
    const Corner start = corner;
    arc.corners.push_back(corner);
    while (true) {
      walked(corner, direction) = 1;
      corner = {corner.x + steps[direction].x, corner.y + steps[direction].y};
      arc.corners.push_back(corner);
      if (corner == start || is_junction(corner)) return arc;
      const int back = (direction + 2) % 4;
      for (int next = 0; next < 4; ++next) {
        if (next == back || !is_crack(corner, next)) continue;
        direction = next;
        break;
      }
    }
  }

  ImageView<const std::int32_t> of_;
  int width_, height_;
  std::array<Image<std::uint8_t>, 2> walked_;
};

/// Averages each point with its neighbours; ends of open arcs and the picture's edge stay.
void smooth(Arc& arc, int rounds, int width, int height) {
  arc.points.clear();
  for (const Corner& c : arc.corners) arc.points.push_back({static_cast<float>(c.x), static_cast<float>(c.y)});
  const std::size_t last = arc.points.size() - 1;
  const bool closed = arc.closed() && last >= 4;
  std::vector<PlanePoint> before;
  for (int round = 0; round < rounds; ++round) {
    before = arc.points;
    for (std::size_t i = closed ? 0 : 1; i < last; ++i) {
      const Corner& c = arc.corners[i];
      if (c.x == 0 || c.y == 0 || c.x == width || c.y == height) continue;
      const PlanePoint &a = before[i == 0 ? last - 1 : i - 1], &b = before[i], &d = before[i + 1];
      arc.points[i] = {(a.x + 2 * b.x + d.x) / 4, (a.y + 2 * b.y + d.y) / 4};
    }
    if (closed) arc.points[last] = arc.points[0];
  }
}

float distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const float dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const float t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.f, 1.f) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Douglas & Peucker's choice of points.
void simplify(Arc& arc, const OutlineOptions& options) {
  const std::size_t last = arc.points.size() - 1;
  std::vector<std::uint8_t> keep(arc.points.size());
  keep[0] = keep[last] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, last}};
  if (arc.closed() && last >= 4) {  // thirds: a ring has at least three points
    keep[last / 3] = keep[2 * last / 3] = 1;
    open = {{0, last / 3}, {last / 3, 2 * last / 3}, {2 * last / 3, last}};
  }
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    if (to - from < 2) continue;
    std::size_t farthest = (from + to) / 2;
    float distance = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const float d = distance_to_segment(arc.points[i], arc.points[from], arc.points[to]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    const PlanePoint a = arc.points[from], b = arc.points[to];
    if (distance <= options.tolerance_px) {
      if (std::hypot(b.x - a.x, b.y - a.y) <= options.longest_px) continue;
      farthest = (from + to) / 2;
    }
    keep[farthest] = 1;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
  for (std::size_t i = 0; i <= last; ++i)
    if (keep[i] != 0) arc.kept.push_back(i);
}

/// The disparity of a region's surface at a corner that it touches: the mean of what lies around on that surface.
float surface_disparity(const RegionMap& regions, ImageView<const float> disparity, Corner c, std::int32_t region,
                        float threshold_px) {
  float sum = 0;
  int count = 0;
  for (int y = c.y - 1; y <= c.y; ++y) {
    for (int x = c.x - 1; x <= c.x; ++x) {
      if (!disparity.contains(x, y) || regions.of(x, y) != region) continue;
      sum += disparity(x, y);
      ++count;
    }
  }
  const float own = sum / static_cast<float>(count);
  sum = 0;
  count = 0;
  for (int y = c.y - 2; y <= c.y + 1; ++y) {
    for (int x = c.x - 2; x <= c.x + 1; ++x) {
      if (!disparity.contains(x, y) || std::abs(disparity(x, y) - own) > threshold_px) continue;
      sum += disparity(x, y);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : own;
}

/// An arc as the border of the region to its left.
struct Side {
  Corner start;
  std::size_t arc;
  bool reversed;
};

/// Puts arcs together to rings.
class RingBuilder {
 public:
  RingBuilder(const RegionMap& regions, ImageView<const float> disparity, const OutlineOptions& options,
              const std::vector<Arc>& arcs, RegionPainting& painting)
      : regions_(regions), disparity_(disparity), options_(options), arcs_(arcs), painting_(painting) {}

  void add_rings(std::int32_t region, std::vector<Side>& sides) {
    std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.start.x, s.start.y, s.arc, s.reversed); });
    std::vector<std::uint8_t> used(sides.size());
    for (std::size_t first = 0; first < sides.size(); ++first) {
      if (used[first] != 0) continue;
      const std::size_t begin = painting_.points.size();
      std::size_t side = first;
      do {
        used[side] = 1;
        side = next_side(sides, used, add_points(region, sides[side]));
      } while (side < sides.size());
      finish_ring(begin);
    }
  }

 private:
  /// Adds an arc's points but for its last, and returns where it ends.
  Corner add_points(std::int32_t region, const Side& side) {
    const Arc& arc = arcs_[side.arc];
    const std::size_t count = arc.kept.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const std::size_t i = arc.kept[side.reversed ? count - 1 - k : k];
      painting_.points.push_back(
          {arc.points[i].x, arc.points[i].y,
           surface_disparity(regions_, disparity_, arc.corners[i], region, options_.depth_threshold_px)});
    }
    return side.reversed ? arc.corners.front() : arc.corners.back();
  }

  static std::size_t next_side(const std::vector<Side>& sides, const std::vector<std::uint8_t>& used, Corner at) {
    auto next = static_cast<std::size_t>(
        std::ranges::lower_bound(sides, std::pair(at.x, at.y), {},
                                 [](const Side& s) { return std::pair(s.start.x, s.start.y); }) -
        sides.begin());
    for (; next < sides.size() && sides[next].start == at; ++next)
      if (used[next] == 0) return next;
    return sides.size();
  }

  void finish_ring(std::size_t begin) {
    constexpr std::size_t least_points = 3;
    const std::size_t count = painting_.points.size() - begin;
    if (count < least_points) {
      painting_.points.resize(begin);
      return;
    }
    painting_.rings.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(count)});
  }

  const RegionMap& regions_;
  ImageView<const float> disparity_;
  const OutlineOptions& options_;
  const std::vector<Arc>& arcs_;
  RegionPainting& painting_;
};

}  // namespace

void add_outlines(const RegionMap& regions, ImageView<const float> disparity, ViewPosition view,
                  const OutlineOptions& options, RegionPainting& painting) {
  std::vector<Arc> arcs = Tracer(regions).arcs();
  std::vector<std::vector<Side>> sides(static_cast<std::size_t>(regions.count));
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    Arc& arc = arcs[i];
    smooth(arc, options.smoothing, disparity.width(), disparity.height());
    simplify(arc, options);
    if (arc.left >= 0) sides[static_cast<std::size_t>(arc.left)].push_back({arc.corners.front(), i, false});
    if (arc.right >= 0) sides[static_cast<std::size_t>(arc.right)].push_back({arc.corners.back(), i, true});
  }
  RingBuilder builder(regions, disparity, options, arcs, painting);
  for (std::int32_t region = 0; region < regions.count; ++region) {
    RegionMark mark;
    mark.first_ring = static_cast<std::uint32_t>(painting.rings.size());
    builder.add_rings(region, sides[static_cast<std::size_t>(region)]);
    mark.ring_count = static_cast<std::uint32_t>(painting.rings.size()) - mark.first_ring;
    mark.reference_view = view;
    painting.marks.push_back(mark);
  }
}

}  // namespace wheatstone
