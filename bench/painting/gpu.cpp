// Paintings to 48 views by the graphics processor, against the processor in the same run.
//
//   bench_gpu_painting [VIEWS]     48 unless told otherwise

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "stopwatch.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

constexpr int width = 420, height = 560;

void compare(const char* style, const SyntheticStill& still, const std::vector<ViewPosition>& views) {
  const Painting painting = paint(still.pictures, still.geometry, style_by_name(style)).painting;
  const PreparedPainting by_processor = prepare(painting);
  const PreparedPainting by_graphics = prepare(painting, {}, Device::graphics);
  std::vector<DrawnView> found = draw(by_graphics, views), expected = draw(by_processor, views);
  double worst = 1000;
  for (std::size_t v = 0; v < views.size(); ++v)
    worst = std::min(worst, measure_view(found[v].picture, expected[v].picture).psnr_db);
  const double cpu = median_seconds([&] { draw(by_processor, views); }, 3);
  const double gpu = median_seconds([&] { draw(by_graphics, views); }, 3);
  const MarkCount marks = count_marks(painting);
  fmt::print(
      "  {:14} {:6} {:8}: {:7.3f} s, {:7.1f} views a second, {:5.2f} times the processor's {:.3f} s; {:.0f} dB\n",
      style, marks.count, marks.kind, gpu, static_cast<double>(views.size()) / gpu, gpu / cpu, cpu, worst);
}

void run(int view_count) {
  fmt::print("{} views of {}x{}, on {}\n", view_count, width, height, gpu_facts().name);
  const SyntheticStill still = make_synthetic_still({.width = width, .height = height, .samples_a_side = 1});
  const std::vector<ViewPosition> views = evenly_spaced(width, height, view_count).positions;
  for (const char* const style : {"oil", "impressionist", "pointillist"}) compare(style, still, views);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  try {
    wheatstone::bench::run(argc > 1 ? std::atoi(argv[1]) : 48);
  } catch (const wheatstone::Error& error) {
    fmt::print("bench_gpu_painting: {}\n", error.what());
  }
}
