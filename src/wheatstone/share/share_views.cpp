#include "wheatstone/share/share_views.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/surface_parts_internal.h"
#include "wheatstone/stereo/reduced_pair.h"

namespace wheatstone {
namespace {

/// Places for so many views, none of them empty: as square a picture as there is.
QuiltLayout layout_for(int views) {
  int columns = std::max(static_cast<int>(std::sqrt(static_cast<double>(views))), 1);
  while (views % columns != 0) --columns;
  return {views / columns, columns};
}

}  // namespace

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
  // Two eyes look at views that are an eighth of all apart.
  constexpr int eye_share = 8;
  const int steps = std::max(count - 1, 1), apart = std::max(steps / eye_share, 1);
  shared.facts = text_of({{"kind", "views"},
                          {"title", title},
                          {"width", size.width},
                          {"height", size.height},
                          {"separation", static_cast<double>(apart) / steps},
                          {"zeroParallax", 0},
                          {"first", -0.5},
                          {"last", 0.5},
                          {"columns", layout.columns},
                          {"rows", layout.rows},
                          {"upwards", true},
                          {"type", "image/jpeg"}});
  return shared;
}

}  // namespace wheatstone
