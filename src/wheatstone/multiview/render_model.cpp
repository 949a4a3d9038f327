#include "wheatstone/multiview/render_model.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"
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
  std::vector<ModelShading::Fineness> fineness;             ///< of each triangle
  std::vector<std::array<LinearColour, 3>> corner_colours;  ///< where it is not lit by pixel
  TrianglesByBand by_band;
};

PreparedModel prepare(const Model& model, const ModelScene& scene, const DepthKnots& knots, const ModelShading& shading,
                      const Rig& rig) {
  PreparedModel prepared{.screen = screen_triangles(model, scene, knots, rig)};
  const std::vector<ScreenTriangle>& triangles = prepared.screen.triangles;
  prepared.fineness.resize(triangles.size());
  prepared.corner_colours.resize(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 1024), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      prepared.fineness[t] = shading.fineness(triangles[t]);
      if (prepared.fineness[t] != ModelShading::Fineness::by_pixel)
        prepared.corner_colours[t] = shading.corner_colours(prepared.screen, static_cast<std::uint32_t>(t));
    }
  });
  prepared.by_band = triangles_by_band(triangles, rig.height);
  return prepared;
}

/// The shares of a triangle's corners at a place of a view that lies in the triangle, up to rounding.
std::array<double, 3> shares_of_corners(const ScreenTriangle& triangle, double view, double x, double y) {
  std::array<double, 3> from_x{}, from_y{};  // from the place to each corner
  for (std::size_t k = 0; k < 3; ++k) {
    from_x[k] = static_cast<double>(triangle.x[k]) - view * static_cast<double>(triangle.disparity[k]) - x;
    from_y[k] = static_cast<double>(triangle.y[k]) - y;
  }
  std::array<double, 3> shares{};
  double sum = 0;
  const bool is_left =
      (from_x[1] - from_x[0]) * (from_y[2] - from_y[0]) < (from_x[2] - from_x[0]) * (from_y[1] - from_y[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    const double area = from_x[a] * from_y[b] - from_x[b] * from_y[a];
    shares[k] = std::max(is_left ? -area : area, 0.);
    sum += shares[k];
  }
  for (double& share : shares) share = sum > 0 ? share / sum : 1. / 3;
  return shares;
}

LinearColour between(const std::array<LinearColour, 3>& corners, const std::array<double, 3>& shares) {
  LinearColour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) colour[c] += static_cast<float>(shares[k]) * corners[k][c];
  return colour;
}

/// The pictures of a view.
struct ViewPictures {
  Image<Rgb8>* colour;
  Image<float>* disparity;  ///< null: not wanted
  Image<float>* depth;
};

/// Makes pixels of the samples of a band.
class Resolver {
 public:
  Resolver(const PreparedModel& prepared, const ModelShading& shading, const ModelLook& look, float view)
      : prepared_(prepared), shading_(shading), view_(view), columns_(sample_columns(look.samples)) {
    const std::array<float, 256>& linear = linear_codes();
    background_ = {linear[look.background.r], linear[look.background.g], linear[look.background.b]};
  }

  void resolve_row(const TriangleBand& band, int row, const ViewPictures& pictures) {
    const int width = band.width(), samples = band.samples();
    std::array<std::span<const std::uint32_t>, 8> lines;
    for (int k = 0; k < samples; ++k) lines[static_cast<std::size_t>(k)] = band.line(row, k);
    linear_.resize(3 * static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      std::array<std::uint32_t, 8> shown{};
      const auto at = static_cast<std::size_t>(x);
      shown[0] = lines[0][at];
      bool is_one = true;
      for (std::size_t k = 1; k < static_cast<std::size_t>(samples); ++k) {
        shown[k] = lines[k][at];
        is_one = is_one && shown[k] == shown[0];
      }
      const LinearColour colour =
          is_one ? colour_of(shown[0], x + 0.5, row + 0.5, true, {x, row}, pictures)
                 : pixel(std::span(shown).first(static_cast<std::size_t>(samples)), x, row, pictures);
      std::ranges::copy(colour, linear_.begin() + 3 * x);
    }
    codes_.resize(linear_.size());
    srgb_from_linear(linear_, codes_);
    const auto to = pictures.colour->row(row);
    for (std::size_t x = 0; x < to.size(); ++x) to[x] = {codes_[3 * x], codes_[3 * x + 1], codes_[3 * x + 2]};
  }

 private:
  LinearColour pixel(std::span<const std::uint32_t> shown, int x, int row, const ViewPictures& pictures) {
    LinearColour sum{};
    std::size_t most = 0;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      const std::uint32_t triangle = shown[k];
      if (std::ranges::find(shown.first(k), triangle) != shown.begin() + static_cast<std::ptrdiff_t>(k)) continue;
      // The middle of its samples.
      double at_x = 0, at_y = 0;
      std::size_t count = 0;
      for (std::size_t other = k; other < shown.size(); ++other) {
        if (shown[other] != triangle) continue;
        at_x += static_cast<double>(columns_[other]);
        at_y += (static_cast<double>(other) + 0.5) / static_cast<double>(shown.size());
        ++count;
      }
      const double share = 1 / static_cast<double>(count);
      const LinearColour colour =
          colour_of(triangle, x + at_x * share, row + at_y * share, count > most, {x, row}, pictures);
      most = std::max(most, count);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<float>(count) * std::min(colour[c], 1.f);
    }
    for (float& channel : sum) channel /= static_cast<float>(shown.size());
    return sum;
  }

  /// The colour of a triangle at a place of the view. `is_most`: its geometry is that of the pixel.
  LinearColour colour_of(std::uint32_t triangle, double x, double y, bool is_most, std::array<int, 2> pixel,
                         const ViewPictures& pictures) {
    const bool tells_geometry = is_most && pictures.disparity != nullptr;
    if (triangle == TriangleBand::nothing) {
      if (tells_geometry) {
        (*pictures.disparity)(pixel[0], pixel[1]) = std::numeric_limits<float>::quiet_NaN();
        (*pictures.depth)(pixel[0], pixel[1]) = std::numeric_limits<float>::quiet_NaN();
      }
      return background_;
    }
    const ModelShading::Fineness fineness = prepared_.fineness[triangle];
    // A view beside the central one may see a side that is not lit there.
    const bool is_lit = fineness != ModelShading::Fineness::by_pixel &&
                        !prepared_.screen.triangles[triangle].shows_other_side(static_cast<double>(view_));
    ModelShading::Surface::Point point{};
    if (!is_lit || tells_geometry) {
      if (!surface_ || triangle != surface_of_) surface_.emplace(shading_, prepared_.screen, triangle, view_);
      surface_of_ = triangle;
      point = surface_->at(x, y);
    }
    if (tells_geometry) {
      (*pictures.disparity)(pixel[0], pixel[1]) = point.disparity;
      (*pictures.depth)(pixel[0], pixel[1]) = point.depth;
    }
    if (!is_lit) return point.colour;
    const std::array<LinearColour, 3>& corners = prepared_.corner_colours[triangle];
    return fineness == ModelShading::Fineness::once
               ? corners[0]
               : between(corners,
                         shares_of_corners(prepared_.screen.triangles[triangle], static_cast<double>(view_), x, y));
  }

  const PreparedModel& prepared_;
  const ModelShading& shading_;
  float view_;
  std::span<const float> columns_;
  LinearColour background_;
  std::optional<ModelShading::Surface> surface_;  ///< of the triangle that was looked at last
  std::uint32_t surface_of_ = 0;
  std::vector<float> linear_;
  std::vector<std::uint8_t> codes_;
};

class Renderer {
 public:
  Renderer(const Model& model, const ModelScene& scene, const Rig& rig, RenderedModel& result, const Progress& progress)
      : scene_(scene), rig_(rig), result_(result), progress_(progress), shading_(model, scene), bands_([&] {
          return TriangleBand(rig.width, scene.look.samples);
        }) {}

  const ModelShading& shading() const { return shading_; }

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
    TriangleBand& band = bands_.local();
    const int first_row = static_cast<int>(number) * rows_of_band;
    const int end_row = std::min(first_row + rows_of_band, rig_.height);
    band.begin(first_row, end_row);
    const bool is_orthographic = scene_.camera.orthographic_depth > 0;
    const TrianglesByBand& by = prepared.by_band;
    for (std::size_t i = by.begin[number]; i < by.begin[number + 1]; ++i)
      band.add(prepared.screen.triangles[by.triangles[i]], by.triangles[i], is_orthographic);
    const bool geometry = !result_.disparity.empty();
    for (std::size_t view = first; view < end; ++view) {
      const float position = rig_.positions[view].eye_separations();
      band.show(position);
      Resolver resolver(prepared, shading_, scene_.look, position);
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

  const ModelScene& scene_;
  const Rig& rig_;
  RenderedModel& result_;
  const Progress& progress_;
  ModelShading shading_;
  tbb::enumerable_thread_specific<TriangleBand> bands_;
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
    const PreparedModel prepared = prepare(model, scene, knots, renderer.shading(), rig);
    result.drawn_triangles = prepared.screen.triangles.size();
    renderer.draw(prepared, 0, count);
    return result;
  }
  for (std::size_t view = 0; view < count; ++view) {
    const PreparedModel prepared =
        prepare(model, scene, knots, renderer.shading(), {rig.width, rig.height, {rig.positions[view]}});
    result.drawn_triangles = std::max<std::uint64_t>(result.drawn_triangles, prepared.screen.triangles.size());
    renderer.draw(prepared, view, view + 1);
  }
  return result;
}

}  // namespace wheatstone
