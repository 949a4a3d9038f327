// What a painting for two eyes costs: against one eye, beside the times of Stavrakis & Gelautz (2004), table 1; and
// against OpenCV's semi-global matching of the same pictures.

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <array>
#include <cstdlib>
#include <opencv2/calib3d.hpp>

#include "stopwatch.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/process_memory.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

struct Size {
  int width, height;
  double paper_ratio;  ///< both eyes to one eye; 0: not in the paper
};

constexpr std::array<Size, 4> sizes{{{640, 480, 1.98}, {1280, 1024, 1.82}, {1600, 1200, 1.74}, {1920, 1080, 0}}};

double time_of(const SyntheticStill& still, Propagation propagation) {
  Style style;
  style.propagation = propagation;
  return median_seconds([&] { paint(still.pictures, still.geometry, style); });
}

struct OneEye {
  double total_s, planning_s, rasterising_s;
};

OneEye time_of_one_eye(const SyntheticStill& still) {
  OneEye time{};
  std::vector<PaintingTimes> parts;
  time.total_s = median_seconds(
      [&] { parts.push_back(paint_view(still.pictures.left, still.geometry.left_disparity, left_eye, {}).times); });
  const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
  std::ranges::nth_element(parts, middle, {}, &PaintingTimes::planning_s);
  time.planning_s = middle->planning_s;
  std::ranges::nth_element(parts, middle, {}, &PaintingTimes::rasterising_s);
  time.rasterising_s = middle->rasterising_s;
  return time;
}

const char* verdict(bool holds) { return holds ? "holds" : "does not hold"; }

void print_row(const Size& size) {
  const SyntheticStill still = make_synthetic_still({.width = size.width, .height = size.height, .samples_a_side = 1});
  const OneEye one = time_of_one_eye(still);
  const double strokes = time_of(still, Propagation::strokes), raster = time_of(still, Propagation::raster);
  const double independent = time_of(still, Propagation::independent);
  const double share = (one.planning_s + 2 * one.rasterising_s) / (one.planning_s + one.rasterising_s);
  fmt::print(
      "{:4}x{:<4}  {:6.1f} ms  {:5.2f}  {:5.2f}  {:5.2f}   {:>5}   {:5.2f}  strokes <= {:.2f} {}, raster <= 1.15 {}\n",
      size.width, size.height, 1000 * one.total_s, strokes / one.total_s, raster / one.total_s,
      independent / one.total_s, size.paper_ratio > 0 ? fmt::format("{:.2f}", size.paper_ratio) : "-", share,
      std::min(1.1 * share, 1.5), verdict(strokes <= std::min(1.1 * share, 1.5) * one.total_s),
      verdict(raster <= 1.15 * one.total_s));
}

/// Planning included: a painting for one view alone, against a painting for 48.
void print_many_views() {
  const SyntheticStill still = make_synthetic_still({.width = 560, .height = 420, .samples_a_side = 1});
  const Rig rig = evenly_spaced(560, 420, 48, 2);
  const auto [many_s, one_s, ratio] =
      compare_times([&] { draw(prepare(plan_painting(still.pictures, still.geometry, {})), rig.positions); },
                    [&] { paint_view(still.pictures.left, still.geometry.left_disparity, central_view, {}); });
  const PreparedPainting open = prepare(plan_painting(still.pictures, still.geometry, {}));
  const double more_s = median_seconds([&] { draw(open, ViewPosition(0.3f)); });
  fmt::print(
      "\n48 views of 560x420 over two eye separations: {:.0f} ms, one view alone {:.0f} ms: {:.1f} x, <= 6 {}; one "
      "more "
      "view of an open painting: {:.2f} x\n",
      1000 * many_s, 1000 * one_s, ratio, verdict(ratio <= 6), more_s / one_s);
}

void print_against_matching() {
  const SyntheticStill still = make_synthetic_still({.width = 1920, .height = 1080, .samples_a_side = 1});
  constexpr int block = 5, disparities = 128;
  const auto matcher = cv::StereoSGBM::create(0, disparities, block, 8 * 3 * block * block, 32 * 3 * block * block, 1,
                                              63, 10, 100, 2, cv::StereoSGBM::MODE_SGBM);
  cv::Mat disparity;
  const auto [ours_s, matching_s, ratio] =
      compare_times([&] { paint(still.pictures, still.geometry, {}); },
                    [&] { matcher->compute(as_mat(still.pictures.left), as_mat(still.pictures.right), disparity); });
  fmt::print(
      "\n1920x1080, both eyes: painting {:.0f} ms, OpenCV StereoSGBM (MODE_SGBM, 128 disparities) {:.0f} ms: "
      "{:.2f} x, <= 0.5 {}\n",
      1000 * ours_s, 1000 * matching_s, ratio, verdict(ratio <= 0.5));
}

void print_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("largest memory of this benchmark, matching included: {:.0f} MB\n",
             static_cast<double>(usage.ru_maxrss) / 1024);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argument_count, char** arguments) {
  namespace bench = wheatstone::bench;
  const int threads = argument_count > 1 ? std::atoi(arguments[1]) : tbb::info::default_concurrency();
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  cv::setNumThreads(threads);
  // As the program does.
  wheatstone::use_huge_pages();
  wheatstone::keep_freed_memory();
  fmt::print(
      "Painting the synthetic still, impressionist, disparity given, {} threads.\n"
      "Both eyes as multiples of one eye's time; P planning, R rasterising of one eye.\n\n",
      threads);
  fmt::print("size         one eye  strokes raster  each    paper   (P+2R)/(P+R)\n");
  for (const bench::Size& size : bench::sizes) bench::print_row(size);
  bench::print_against_matching();
  bench::print_many_views();
  bench::print_memory();
  return 0;
}
