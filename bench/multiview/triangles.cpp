// Models of triangles to many views: the incremental method against the exact one, by the size of the triangles.
//
//   bench_triangles [MOST_TRIANGLES]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "stopwatch.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/multiview/render_model.h"
#include "wheatstone/synthetic/synthetic_models.h"

using namespace wheatstone;

namespace {

constexpr int width = 640, height = 480;

ModelScene scene_around(const Model& model) {
  const ModelBounds bounds = bounds_of(model);
  const auto radius = static_cast<float>(bounds.radius());
  ModelScene scene;
  scene.origin = bounds.middle();
  scene.camera = camera_around({0, 0, 0}, radius, width, height, {.zoom = 1.3f});
  const auto& [x, y, z] = scene.camera.position;
  const float distance = std::hypot(x, y, z);
  scene.mapping = {{{distance - radius, -20}, {distance + radius, 20}}};
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t most = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  fmt::print("{}x{} pixels, 4 samples; ms of processor time a view; ratio: exact / incremental\n", width, height);
  fmt::print("{:>8} {:>10} {:>10} {:>8} {:>10} {:>12} {:>8}\n", "model", "triangles", "size px", "views", "exact ms",
             "incremental", "ratio");
  bool is_same = true;
  const auto compare = [&](const std::string& name, const Model& model) {
    const ModelScene scene = scene_around(model);
    for (const int views : {9, 45}) {
      const Rig rig = evenly_spaced(width, height, views, 4);
      RenderedModel exact, incremental;
      const int runs = model.triangles.size() > 500'000 ? 1 : 3;
      const double exact_s = bench::least_processor_seconds(
          [&] { exact = render_model(model, scene, rig, {.method = Method::exact}); }, runs);
      const double incremental_s = bench::least_processor_seconds(
          [&] { incremental = render_model(model, scene, rig, {.method = Method::incremental}); }, runs);
      is_same = is_same && exact.views == incremental.views;
      // As if they covered half of the picture, front and back.
      const double size = std::sqrt(width * height * 0.5 * 2 / static_cast<double>(model.triangles.size()));
      fmt::print("{:>8} {:>10} {:>10.1f} {:>8} {:>10.1f} {:>12.1f} {:>8.2f}\n", name, model.triangles.size(), size,
                 views, 1000 * exact_s / views, 1000 * incremental_s / views, exact_s / incremental_s);
    }
  };
  for (std::size_t triangles = 10'000; triangles <= most; triangles *= 10) {
    compare("knot", make_knot(triangles));
    compare("tree", make_tree(triangles));
    compare("city", make_city(triangles));
  }
  compare("knot", make_knot(600));
  if (!is_same) fmt::print("the methods differ\n");
  return is_same ? 0 : 1;
}
