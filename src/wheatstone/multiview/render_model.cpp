#include "wheatstone/multiview/render_model.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "wheatstone/error.h"
#include "wheatstone/multiview/model_resolve_internal.h"
#include "wheatstone/multiview/model_shading_internal.h"
#include "wheatstone/multiview/triangle_band_internal.h"

namespace wheatstone {
namespace {

constexpr int rows_of_band = 16;

/// Which triangles lie in each band, in their order: those of band b from begin[b] to begin[b + 1].
struct TrianglesByBand {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> triangles;
};

struct Bands {
  int first, last;
};

Bands bands_of(const ScreenTriangle& triangle, int count) {
  const auto band = [&](float y) { return std::clamp(static_cast<int>(std::floor(y / rows_of_band)), 0, count - 1); };
  return {band(triangle.y[0]), band(triangle.y[2])};
}

TrianglesByBand triangles_by_band(const std::vector<ScreenTriangle>& triangles, int height) {
  const int bands = (height + rows_of_band - 1) / rows_of_band;
  TrianglesByBand by;
  by.begin.assign(static_cast<std::size_t>(bands) + 1, 0);
  for (const ScreenTriangle& triangle : triangles) {
    const Bands of = bands_of(triangle, bands);
    for (int b = of.first; b <= of.last; ++b) ++by.begin[static_cast<std::size_t>(b) + 1];
  }
  std::partial_sum(by.begin.begin(), by.begin.end(), by.begin.begin());
  by.triangles.resize(by.begin.back());
  std::vector<std::size_t> next(by.begin.begin(), by.begin.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Bands of = bands_of(triangles[t], bands);
    for (int b = of.first; b <= of.last; ++b)
      by.triangles[next[static_cast<std::size_t>(b)]++] = static_cast<std::uint32_t>(t);
  }
  return by;
}

/// All that is the same in the views of a rig.
struct PreparedModel {
  ScreenTriangles screen;
  TrianglesByBand by_band;
};

PreparedModel prepare(const Model& model, const ModelScene& scene, const DepthKnots& knots, const Rig& rig) {
  PreparedModel prepared{.screen = screen_triangles(model, scene, knots, rig)};
  prepared.by_band = triangles_by_band(prepared.screen.triangles, rig.height);
  return prepared;
}

class Renderer {
 public:
  Renderer(const Model& model, const ModelScene& scene, const Rig& rig, RenderedModel& result, const Progress& progress)
      : scene_(scene), rig_(rig), result_(result), progress_(progress), shading_(model, scene), bands_([&] {
          return Band{TriangleBand(rig.width, scene.look.samples), {}};
        }) {}

  /// Draws views first, … end − 1 from what is prepared for them.
  void draw(const PreparedModel& prepared, std::size_t first, std::size_t end) {
    const std::size_t bands = prepared.by_band.begin.size() - 1;
    tbb::parallel_for(std::size_t{0}, bands, [&](std::size_t number) {
      draw_band(prepared, number, first, end);
      tell(static_cast<double>(end - first) / static_cast<double>(bands * rig_.positions.size()));
    });
  }

 private:
  void draw_band(const PreparedModel& prepared, std::size_t number, std::size_t first, std::size_t end) {
    auto& [band, looks] = bands_.local();
    const int first_row = static_cast<int>(number) * rows_of_band;
    const int end_row = std::min(first_row + rows_of_band, rig_.height);
    band.begin(first_row, end_row);
    const bool is_orthographic = scene_.camera.orthographic_depth > 0;
    const TrianglesByBand& by = prepared.by_band;
    const auto triangles = std::span(by.triangles).subspan(by.begin[number], by.begin[number + 1] - by.begin[number]);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      band.add(prepared.screen.triangles[triangles[i]], static_cast<std::uint32_t>(i), is_orthographic);
    looks.begin(shading_, prepared.screen, triangles);
    const bool geometry = !result_.disparity.empty();
    for (std::size_t view = first; view < end; ++view) {
      const float position = rig_.positions[view].eye_separations();
      band.show(position);
      Resolver resolver(looks, scene_.look, position);
      const ViewPictures pictures{&result_.views[view], geometry ? &result_.disparity[view] : nullptr,
                                  geometry ? &result_.depth[view] : nullptr};
      for (int row = first_row; row < end_row; ++row) resolver.resolve_row(band, row, pictures);
    }
  }

  void tell(double more) {
    const std::lock_guard lock(telling_);
    done_ += more;
    report(progress_, "drawing", std::min(done_, 1.));
  }

  struct Band {
    TriangleBand triangles;
    TriangleLooks looks;
  };

  const ModelScene& scene_;
  const Rig& rig_;
  RenderedModel& result_;
  const Progress& progress_;
  ModelShading shading_;
  tbb::enumerable_thread_specific<Band> bands_;
  std::mutex telling_;
  double done_ = 0;
};

void check(const ModelScene& scene, const Rig& rig, const RenderModelOptions& options) {
  if (options.method == Method::layered)
    throw Error(ErrorKind::wrong_usage, "method: is layered, expected exact or incremental for a model of triangles");
  if (scene.look.samples != 4 && scene.look.samples != 8)
    throw Error(ErrorKind::wrong_usage, fmt::format("samples: is {}, expected 4 or 8", scene.look.samples));
  check_depth_mapping(scene.mapping);
  for (const DepthMapping::Point& point : scene.mapping.points)
    check_number("parallax", point.parallax_px, model_parallax_range);
  check_views_fit(rig);
}

}  // namespace

RenderedModel render_model(const Model& model, const ModelScene& scene, const Rig& rig,
                           const RenderModelOptions& options, const Progress& progress) {
  check(scene, rig, options);
  RenderedModel result;
  result.method = options.method == Method::exact ? Method::exact : Method::incremental;
  const std::size_t count = rig.positions.size();
  result.reason = options.method == Method::exact ? "exact: each view on its own"
                                                  : "incremental: triangles are moved from view to view";
  result.views.assign(count, Image<Rgb8>(rig.width, rig.height));
  if (options.geometry) {
    result.disparity.assign(count, Image<float>(rig.width, rig.height));
    result.depth = result.disparity;
  }
  if (count == 0) return result;
  const DepthKnots knots(scene.mapping, scene.camera);
  Renderer renderer(model, scene, rig, result, progress);
  if (result.method == Method::incremental) {
    const PreparedModel prepared = prepare(model, scene, knots, rig);
    result.drawn_triangles = prepared.screen.triangles.size();
    renderer.draw(prepared, 0, count);
    return result;
  }
  for (std::size_t view = 0; view < count; ++view) {
    const PreparedModel prepared = prepare(model, scene, knots, {rig.width, rig.height, {rig.positions[view]}});
    result.drawn_triangles = std::max<std::uint64_t>(result.drawn_triangles, prepared.screen.triangles.size());
    renderer.draw(prepared, view, view + 1);
  }
  return result;
}

}  // namespace wheatstone
