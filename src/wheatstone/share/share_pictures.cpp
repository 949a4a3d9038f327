#include "wheatstone/share/share_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/pictures_on_surfaces.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/surface_parts_internal.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {

SharedPicture share_photograph(const StereoPair& photographs, const StereoGeometry& geometry, const std::string& title,
                               std::span<const View> known) {
  const PicturesOnSurfaces scene = pictures_on_surfaces(photographs, geometry, shared_views, known);
  SharedPicture shared{.width = photographs.left.width(), .height = photographs.left.height()};
  const DepthEnds ends = depth_ends(geometry.left_disparity);
  const float depth_px = std::max(ends.nearest_px - ends.farthest_px, 1e-3f),
              budget_px = comfortable_parallax_share * static_cast<float>(shared.width);
  Json facts{{"kind", "layered"},
             {"title", title},
             {"width", shared.width},
             {"height", shared.height},
             {"separation", std::min(budget_px / depth_px, 1.f)},
             {"zeroParallax", ends.nearest_px},
             {"first", shared_views.first.eye_separations()},
             {"last", shared_views.last.eye_separations()}};
  facts["surfaces"] = add_surfaces(scene.surfaces, shared.parts);
  add_pictures(scene.pictures, scene.surfaces, shared.parts);
  shared.facts = text_of(facts);
  shared.still_jpeg = still_of(photographs.left);
  return shared;
}

namespace {

/// Places for so many views, none of them empty: as square a picture as there is.
QuiltLayout layout_for(int views) {
  int columns = std::max(static_cast<int>(std::sqrt(static_cast<double>(views))), 1);
  while (views % columns != 0) --columns;
  return {views / columns, columns};
}

}  // namespace

Json facts_of_views(const std::string& title, int width, int height, const QuiltLayout& places) {
  // Two eyes look at views that are an eighth of all apart.
  constexpr int eye_share = 8;
  const int steps = std::max(places.columns * places.rows - 1, 1), apart = std::max(steps / eye_share, 1);
  return {{"kind", "views"},
          {"title", title},
          {"width", width},
          {"height", height},
          {"separation", static_cast<double>(apart) / steps},
          {"zeroParallax", 0},
          {"first", -0.5},
          {"last", 0.5},
          {"columns", places.columns},
          {"rows", places.rows}};
}

SharedPicture share_views(std::span<const Image<Rgb8>> views, const std::string& title) {
  if (views.empty()) throw Error(ErrorKind::wrong_usage, "there are 0 views, expected at least 1");
  constexpr int widest_px = 8192, quality = 92;
  const auto count = static_cast<int>(views.size());
  const QuiltLayout layout = layout_for(count);
  const int width = views.front().width(), height = views.front().height();
  const double scale = std::min({1., static_cast<double>(widest_px) / (layout.columns * width),
                                 static_cast<double>(widest_px) / (layout.rows * height)});
  const PictureSize size{static_cast<int>(width * scale), static_cast<int>(height * scale)};
  std::vector<Image<Rgb8>> smaller;
  if (scale < 1)
    for (const Image<Rgb8>& view : views) smaller.push_back(reduced(view, size));
  const std::string quilt =
      encode_jpeg(make_quilt(scale < 1 ? std::span<const Image<Rgb8>>(smaller) : views, layout), quality);

  SharedPicture shared{.width = size.width, .height = size.height};
  shared.parts.push_back({"views", {quilt.begin(), quilt.end()}});
  shared.still_jpeg = still_of(scale < 1 ? smaller[smaller.size() / 2] : views[views.size() / 2]);
  Json facts = facts_of_views(title, size.width, size.height, layout);
  facts["upwards"] = true;
  facts["type"] = "image/jpeg";
  shared.facts = text_of(facts);
  return shared;
}

}  // namespace wheatstone
