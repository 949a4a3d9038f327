// Models of triangles to many views: the incremental method against the exact one, by the size of the triangles. What a
// further view costs is what both must do for each: find which triangle each sample shows, and make pixels of samples.
// The exact method's time by it is what no number of views exceeds.
//
//   bench_triangles [MOST_TRIANGLES]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "multiview/scene_around_model.h"
#include "stopwatch.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/multiview/render_model.h"
#include "wheatstone/synthetic/synthetic_models.h"

using namespace wheatstone;

namespace {

constexpr int width = 640, height = 480;

/// The median longer side of the triangles' boxes in the central view, in pixels.
double median_size_px(const Model& model, const ModelScene& scene) {
  const Camera& camera = scene.camera;
  std::vector<double> sizes;
  for (const auto& triangle : model.triangles) {
    std::array<double, 3> x{}, y{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> at{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from =
            model.positions[triangle[k]][axis] - scene.origin[axis] - static_cast<double>(camera.position[axis]);
        at[0] += from * static_cast<double>(camera.right[axis]);
        at[1] += from * static_cast<double>(camera.down[axis]);
        at[2] += from * static_cast<double>(camera.forward[axis]);
      }
      x[k] = static_cast<double>(camera.focal_px) * at[0] / at[2];
      y[k] = static_cast<double>(camera.focal_px) * at[1] / at[2];
    }
    const auto [left, right] = std::ranges::minmax(x);
    const auto [top, bottom] = std::ranges::minmax(y);
    sizes.push_back(std::max(right - left, bottom - top));
  }
  return bench::median(sizes);
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t most = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  fmt::print("{}x{} pixels, 4 samples; ms of processor time a view; ratio: exact / incremental\n", width, height);
  fmt::print("{:>6} {:>10} {:>15} {:>6} {:>9} {:>12} {:>6} {:>24}\n", "model", "triangles", "median side px", "views",
             "exact ms", "incremental", "ratio", "with any number of views");
  bool is_same = true;
  const auto compare = [&](const std::string& name, const Model& model) {
    const ModelScene scene = bench::scene_around(model, width, height);
    const double size = median_size_px(model, scene);
    std::array<double, 2> incremental_s{};
    constexpr std::array<int, 2> view_counts{9, 45};
    for (const std::size_t i : {0u, 1u}) {
      const int views = view_counts[i];
      const Rig rig = evenly_spaced(width, height, views, 4);
      RenderedModel exact, incremental;
      const int runs = model.triangles.size() > 500'000 ? 1 : 3;
      const double exact_s = bench::least_processor_seconds(
          [&] { exact = render_model(model, scene, rig, {.method = Method::exact}); }, runs);
      incremental_s[i] = bench::least_processor_seconds(
          [&] { incremental = render_model(model, scene, rig, {.method = Method::incremental}); }, runs);
      is_same = is_same && exact.views == incremental.views;
      fmt::print("{:>6} {:>10} {:>15.1f} {:>6} {:>9.1f} {:>12.1f} {:>6.2f}", name, model.triangles.size(), size, views,
                 1000 * exact_s / views, 1000 * incremental_s[i] / views, exact_s / incremental_s[i]);
      const double of_further_view = (incremental_s[1] - incremental_s[0]) / (view_counts[1] - view_counts[0]);
      if (i == 1) fmt::print(" {:>24.2f}", exact_s / views / of_further_view);
      fmt::print("\n");
    }
  };
  for (const std::size_t triangles : {10'000u, 100'000u, 300'000u, 1'000'000u}) {
    if (triangles > most) break;
    compare("knot", make_knot(triangles));
    compare("tree", make_tree(triangles));
    compare("city", make_city(triangles));
  }
  compare("knot", make_knot(600));
  if (!is_same) fmt::print("the methods differ\n");
  return is_same ? 0 : 1;
}
