#include "wheatstone/stereo/single_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/percentile.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone {
namespace {

/// Neighbours on a scan line that differ by more than this are different surfaces.
constexpr float surface_step_px = 1;

/// Width of the rim of mixed colours along an edge, in pixels.
int rim_px(int width) { return std::max(1, static_cast<int>(std::lround(static_cast<float>(width) / 400))); }

/// The right view on its way: what the warp covered, and the disparity of every pixel.
struct RightView {
  Image<Rgb8> picture;
  Image<std::uint8_t> covered;  ///< 0: nothing is known of the colour
  Image<float> disparity;
};

/// A scan line of it.
struct ScanLine {
  std::span<Rgb8> colours;
  std::span<std::uint8_t> covered;
  std::span<float> disparity;
  int width() const { return static_cast<int>(colours.size()); }
};
ScanLine scan_line(RightView& view, int y) { return {view.picture.row(y), view.covered.row(y), view.disparity.row(y)}; }

/// Uncovered pixels of a scan line, from `begin` to before `end`.
struct Gap {
  int begin, end;
  int step;  ///< 1: the farther surface lies to the right, -1: to the left
  int width() const { return end - begin; }
  int first() const { return step > 0 ? end - 1 : begin; }  ///< the gap's pixel next to the farther surface
};

/// Finds the gaps that the warp left on a line. They include the rim of mixed colours on the farther side, which
/// becomes uncovered.
std::vector<Gap> find_gaps(const ScanLine& line) {
  const int width = line.width(), rim = rim_px(width);
  std::vector<Gap> gaps;
  for (int x = 0; x < width;) {
    if (line.covered[x] != 0) {
      ++x;
      continue;
    }
    Gap gap{x, x, 1};
    while (gap.end < width && line.covered[gap.end] == 0) ++gap.end;
    const bool inner = gap.begin > 0 && gap.end < width;
    if (inner ? line.disparity[gap.end] > line.disparity[gap.begin - 1] : gap.end == width) gap.step = -1;
    const bool is_edge = inner && std::abs(line.disparity[gap.end] - line.disparity[gap.begin - 1]) > surface_step_px;
    for (int i = 0; is_edge && i < rim; ++i) {
      const int next = gap.first() + gap.step;
      if (next < 0 || next >= width || line.covered[next] == 0) break;
      line.covered[next] = 0;
      (gap.step > 0 ? gap.end : gap.begin) += gap.step;
    }
    gaps.push_back(gap);
    x = gap.end;
  }
  return gaps;
}

/// Uncovers small groups of covered pixels within uncovered parts: they are scattered off an edge, in its mixed
/// colours.
void uncover_specks(RightView& view) {
  const int side = 2 * rim_px(view.picture.width()) + 1;
  remove_occlusion_specks(view.covered, side * side);
}

/// Between two near things a scan line may not show the surface behind them, but the lines above and below do: each
/// pixel of a gap is lowered to a low percentile of the disparities of gaps near it in its column.
void lower_between_near_things(RightView& view) {
  constexpr double low = 0.3;
  const int reach = std::max(2, view.disparity.width() / 100);
  const Image<float> before = view.disparity;
  tbb::parallel_for(0, before.height(), [&](int y) {
    const int top = std::max(y - reach, 0), bottom = std::min(y + reach, before.height() - 1);
    std::vector<float> near_it;
    for (int x = 0; x < before.width(); ++x) {
      if (view.covered(x, y) != 0) continue;
      near_it.clear();
      for (int row = top; row <= bottom; ++row)
        if (view.covered(x, row) == 0) near_it.push_back(before(x, row));
      view.disparity(x, y) = std::min(before(x, y), percentile(near_it, low));
    }
  });
}

/// Whether a pixel shows its own surface alone: nothing nearer beside it, whose colours the camera mixed in.
bool is_clean(const ScanLine& line, int x) {
  const int rim = rim_px(line.width());
  for (int i = std::max(x - rim, 0); i <= std::min(x + rim, line.width() - 1); ++i)
    if (line.disparity[i] > line.disparity[x] + surface_step_px) return false;
  return line.covered[x] != 0;
}

/// The colours of the farther surface outwards from the gap, as many as the gap is wide, or as there are near it. The
/// surface may go on behind nearer things.
std::vector<Rgb8> surface_beside(const ScanLine& line, const Gap& gap) {
  constexpr float slope = 0.1f;
  const int wanted = gap.width(), nearest = gap.first() + gap.step, reach = 2 * wanted + line.width() / 40;
  std::vector<Rgb8> colours;
  float last_disparity = line.disparity[gap.first()];
  int last = gap.first();
  for (int x = nearest; x >= 0 && x < line.width() && std::abs(x - nearest) < reach; x += gap.step) {
    if (static_cast<int>(colours.size()) == wanted) break;
    const float step = std::abs(line.disparity[x] - last_disparity);
    if (step > surface_step_px + slope * static_cast<float>(std::abs(x - last)) || !is_clean(line, x)) continue;
    colours.push_back(line.colours[x]);
    last_disparity = line.disparity[x];
    last = x;
  }
  return colours;
}

/// Continues the farther surface by its mirror image where enough of it stands beside the gap.
void mirror_into_gaps(std::span<const Gap> gaps, const ScanLine& line) {
  std::vector<std::pair<Gap, std::vector<Rgb8>>> fillings;
  for (const Gap& gap : gaps)
    if (std::vector<Rgb8> surface = surface_beside(line, gap); static_cast<int>(surface.size()) == gap.width())
      fillings.emplace_back(gap, std::move(surface));
  for (const auto& [gap, surface] : fillings) {
    for (int i = 0; i < gap.width(); ++i) line.colours[gap.first() - i * gap.step] = surface[i];
    std::fill_n(line.covered.begin() + gap.begin, gap.width(), 255);
  }
}

/// A mean of the known pixels around a pixel, of the same surface if that is in sight: the nearest such pixel in each
/// of sixteen directions, weighted by the inverse square of its distance.
Rgb8 mean_around(const RightView& view, int x, int y) {
  constexpr std::array<std::pair<int, int>, 16> directions{{{2, 0},
                                                            {2, 1},
                                                            {2, 2},
                                                            {1, 2},
                                                            {0, 2},
                                                            {-1, 2},
                                                            {-2, 2},
                                                            {-2, 1},
                                                            {-2, 0},
                                                            {-2, -1},
                                                            {-2, -2},
                                                            {-1, -2},
                                                            {0, -2},
                                                            {1, -2},
                                                            {2, -2},
                                                            {2, -1}}};
  constexpr float surface_tolerance_px = 3, of_another_surface = 1e-4f;
  std::array<float, 3> sum{};
  float weights = 0;
  for (const auto& [dx, dy] : directions) {
    for (int i = 1, reach = std::max(view.picture.width(), view.picture.height()); i < reach; ++i) {
      const int at_x = x + i * dx / 2, at_y = y + i * dy / 2;
      if (!view.picture.contains(at_x, at_y)) break;
      if (view.covered(at_x, at_y) == 0) continue;
      const bool is_own = std::abs(view.disparity(at_x, at_y) - view.disparity(x, y)) <= surface_tolerance_px;
      const float squared = static_cast<float>((at_x - x) * (at_x - x) + (at_y - y) * (at_y - y));
      const float weight = (is_own ? 1 : of_another_surface) / squared;
      const Rgb8 colour = view.picture(at_x, at_y);
      sum = {sum[0] + weight * colour.r, sum[1] + weight * colour.g, sum[2] + weight * colour.b};
      weights += weight;
      break;
    }
  }
  const auto mean = [&](float total) { return static_cast<std::uint8_t>(std::lround(total / weights)); };
  return weights > 0 ? Rgb8{mean(sum[0]), mean(sum[1]), mean(sum[2])} : Rgb8{};
}

void fill_uncovered(RightView& view) {
  const int height = view.picture.height();
  uncover_specks(view);
  std::vector<std::vector<Gap>> gaps(height);
  tbb::parallel_for(0, height, [&](int y) { gaps[y] = find_gaps(scan_line(view, y)); });
  lower_between_near_things(view);
  tbb::parallel_for(0, height, [&](int y) { mirror_into_gaps(gaps[y], scan_line(view, y)); });
  Image<Rgb8> filled = view.picture;
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < filled.width(); ++x)
      if (view.covered(x, y) == 0) filled(x, y) = mean_around(view, x, y);
  });
  view.picture = std::move(filled);
}

}  // namespace

MadePair make_pair_from_single_view(Image<Rgb8> picture, Image<float> disparity) {
  check_same_size("the disparity", disparity, "the picture's", picture);
  fill_from_farther_side(disparity);
  WarpedPicture warped = warp_picture(picture, disparity, left_eye, right_eye);
  RightView view{std::move(warped.picture), std::move(warped.covered), warp_disparity(disparity, left_eye, right_eye)};
  fill_from_farther_side(view.disparity);
  fill_uncovered(view);
  MadePair made;
  made.pictures = {std::move(picture), std::move(view.picture)};
  made.geometry = geometry_from_both(std::move(disparity), std::move(view.disparity));
  return made;
}

}  // namespace wheatstone
