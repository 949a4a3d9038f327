// A painting seen from everywhere: what is bare, whether neighbouring views differ evenly, and how consistent pairs of
// views are between and beyond the eyes, against ray-cast views of the same places.
//
//     bench_painting_views [FOLDER] [PART]...
//
// FOLDER has the photographs, ../shared/data/stereo by default. A part is a style, or "pairs"; without any, all are
// measured, which takes some minutes.

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

struct Subject {
  std::string name;
  StereoPair photographs;
  StereoGeometry geometry;
};

const char* verdict(bool holds) { return holds ? "holds" : "does not hold"; }

std::vector<ViewPosition> positions(int count, float first, float last) {
  std::vector<ViewPosition> views;
  for (int i = 0; i < count; ++i)
    views.emplace_back(first + (last - first) * static_cast<float>(i) / static_cast<float>(count - 1));
  return views;
}

double mean_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
  }
  return static_cast<double>(sum) / (3.0 * static_cast<double>(a.pixels().size()));
}

/// The painting with its middle disparity on the screen plane, as displays show it.
PreparedPainting on_screen(const Painting& painting, const Subject& subject) {
  return prepare(painting,
                 {.placement = {.zero_parallax_px = depth_ends(subject.geometry.left_disparity).middle_px()}});
}

void print_bare(const PreparedPainting& prepared, const std::vector<ViewPosition>& views, double limit) {
  double worst = 0, sum = 0;
  ViewPosition where;
  for (const ViewPosition view : views) {
    const double bare = draw(prepared, view).bare_share;
    sum += bare;
    if (bare > worst) where = view;
    worst = std::max(worst, bare);
  }
  fmt::print("  bare at {} positions from {} to {}: mean {:.3f} %, worst {:.3f} % at {:.2f}, <= {} % {}\n",
             views.size(), views.front().eye_separations(), views.back().eye_separations(),
             100 * sum / static_cast<double>(views.size()), 100 * worst, where.eye_separations(), 100 * limit,
             verdict(worst <= limit));
}

void print_jumps(const PreparedPainting& prepared) {
  const std::vector<ViewPosition> views = positions(101, -0.5f, 0.5f);
  std::vector<double> steps;
  Image<Rgb8> before = draw(prepared, views.front()).picture;
  for (std::size_t i = 1; i < views.size(); ++i) {
    Image<Rgb8> picture = draw(prepared, views[i]).picture;
    steps.push_back(mean_difference(before, picture));
    before = std::move(picture);
  }
  const double largest = *std::ranges::max_element(steps);
  std::ranges::nth_element(steps, steps.begin() + 50);
  fmt::print("  neighbours of 101 views differ by {:.3f} (median), at most {:.3f}: {:.2f} x, <= 1.5 {}\n", steps[50],
             largest, largest / steps[50], verdict(largest <= 1.5 * steps[50]));
}

void print_coverage(const Subject& subject, std::string_view style_name) {
  Style style = style_by_name(style_name);
  const Painting painting = plan_painting(subject.photographs, subject.geometry, style);
  fmt::print("\n{}, {}\n", subject.name, style_name);
  print_bare(prepare(painting), positions(101, -0.5f, 0.5f), 0.001);
  const PreparedPainting prepared = on_screen(painting, subject);
  print_bare(prepared, positions(48, -2.5f, 2.5f), 0.003);
  print_jumps(prepared);
}

void print_wrong_spots(const SyntheticStillOptions& scene, const PreparedPainting& prepared) {
  fmt::print("  wrong spots per 100 000 px against ray-cast views (share):");
  for (const float position : {-0.5f, -0.25f, 0.f, 0.25f, 0.5f}) {
    const ViewPosition view(position);
    const WrongSpots wrong =
        measure_wrong_spots(draw(prepared, view).picture, make_synthetic_view(scene, view).picture);
    fmt::print("  {:+.2f}: {:.1f} ({:.2f} %)", position, wrong.spots_per_100000_px, 100 * wrong.share);
  }
  fmt::print("\n");
}

/// The pair of views half an eye separation to either side of a place, painted and ray-cast.
void print_pairs(const SyntheticStillOptions& scene, const PreparedPainting& prepared) {
  std::optional<double> of_the_eyes;
  for (const float middle : {0.f, -0.5f, -1.f, -1.5f, -2.f, 0.5f, 1.f, 1.5f, 2.f}) {
    const ViewPosition left(middle - 0.5f), right(middle + 0.5f);
    const SyntheticView truth_left = make_synthetic_view(scene, left), truth_right = make_synthetic_view(scene, right);
    const StereoPair painted{draw(prepared, left).picture, draw(prepared, right).picture};
    const double difference = measure_left_right_difference(painted, truth_left.disparity).mean_absolute;
    if (!of_the_eyes) of_the_eyes = difference;
    const double bad = measure_depth_survival(painted, truth_left.disparity).bad_2;
    const double bad_truth =
        measure_depth_survival({truth_left.picture, truth_right.picture}, truth_left.disparity).bad_2;
    fmt::print(
        "  views {:+.1f} and {:+.1f}: left-right {:.2f}, {:.2f} x the eyes', <= 1.3 {}; bad-2 {:.3f}, ray-cast {:.3f}, "
        "<= +.03 {}\n",
        left.eye_separations(), right.eye_separations(), difference, difference / *of_the_eyes,
        verdict(difference <= 1.3 * *of_the_eyes), bad, bad_truth, verdict(bad <= bad_truth + 0.03));
  }
}

Subject still_of(const SyntheticStillOptions& options) {
  SyntheticStill still = make_synthetic_still(options);
  return {"still", std::move(still.pictures), std::move(still.geometry)};
}

std::optional<Subject> read_teddy(const std::filesystem::path& shared) {
  const std::filesystem::path folder = shared / "teddy";
  if (!std::filesystem::exists(folder)) {
    fmt::print("\nteddy: not here, left out\n");
    return {};
  }
  return Subject{"teddy",
                 {read_image(folder / "left.png"), read_image(folder / "right.png")},
                 geometry_from_left(read_disparity(folder / "disp_left.png", 4.f))};
}

void print_all(std::span<const std::string_view> given) {
  const std::filesystem::path shared = given.empty() ? "../shared/data/stereo" : given.front();
  std::vector<std::string_view> parts(given.begin() + (given.empty() ? 0 : 1), given.end());
  if (parts.empty())
    parts = {"impressionist", "expressionist", "pointillist", "posterise", "mosaic", "dual", "diffusion", "pairs"};
  const SyntheticStillOptions scene{.samples_a_side = 1};
  const Subject still = still_of(scene);
  const std::optional<Subject> teddy = read_teddy(shared);
  for (const std::string_view part : parts) {
    if (part == "pairs") continue;
    if (teddy) print_coverage(*teddy, part);
    print_coverage(still, part);
  }
  if (std::ranges::find(parts, "pairs") == parts.end()) return;
  fmt::print("\nstill, impressionist, against ray-cast views\n");
  const PreparedPainting prepared = prepare(plan_painting(still.photographs, still.geometry, {}));
  print_wrong_spots(scene, prepared);
  print_pairs(scene, prepared);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argument_count, char** arguments) {
  try {
    const std::vector<std::string_view> given(arguments + 1, arguments + argument_count);
    wheatstone::bench::print_all(given);
  } catch (const wheatstone::Error& error) {
    fmt::print(stderr, "bench_painting_views: {}\n", error.what());
    return 1;
  }
}
