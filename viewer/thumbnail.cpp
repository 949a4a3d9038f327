#include "thumbnail.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/display/quilt.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/reduced_pair.h"

namespace wheatstone::viewer {
namespace {

Image<Rgb8> picture_of(const std::filesystem::path& file) {
  if (file.extension() == ".wst") return draw(read_painting(file), left_eye).picture;
  if (const auto quilt = quilt_of_name(file.filename().string()))
    return std::move(views_of_quilt(read_image(file), quilt->layout).front());
  std::optional<ViewsFile> found = find_views(file);
  return found ? std::move(found->views.front()) : read_image(file);
}

}  // namespace

Image<Rgb8> thumbnail_of(const Item& files, PictureSize largest) {
  try {
    const Image<Rgb8> picture = picture_of(files.front());
    const double scale = std::min({static_cast<double>(largest.width) / picture.width(),
                                   static_cast<double>(largest.height) / picture.height(), 1.});
    const auto scaled = [scale](int side) { return std::max(static_cast<int>(std::lround(side * scale)), 1); };
    return reduced(picture, {scaled(picture.width()), scaled(picture.height())});
  } catch (const Error&) {
    return {};
  }
}

}  // namespace wheatstone::viewer
