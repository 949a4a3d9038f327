#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/video/film_layout_internal.h"

namespace wheatstone {
namespace {

Image<Rgb8> part_of(const Image<Rgb8>& picture, int x, int y, int width, int height) {
  Image<Rgb8> part(width, height);
  for (int row = 0; row < height; ++row) {
    std::ranges::copy(picture.row(y + row).subspan(static_cast<std::size_t>(x), static_cast<std::size_t>(width)),
                      part.row(row).begin());
  }
  return part;
}

void paste(Image<Rgb8>& onto, const Image<Rgb8>& part, int x, int y) {
  for (int row = 0; row < part.height(); ++row) std::ranges::copy(part.row(row), onto.row(y + row).begin() + x);
}

Image<Rgb8> resized(const Image<Rgb8>& picture, int width, int height, int interpolation) {
  Image<Rgb8> result(width, height);
  cv::Mat target = as_mat(result);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, interpolation);
  return result;
}

/// Whether a woven picture's pixel belongs to the eye that comes first.
bool is_of_first(Arrangement arrangement, int x, int y) {
  if (arrangement == Arrangement::rows) return y % 2 == 0;
  if (arrangement == Arrangement::columns) return x % 2 == 0;
  return (x + y) % 2 == 0;
}

/// The mean of those of the four neighbours that lie in the picture and belong to the other eye than this pixel.
Rgb8 mean_of_neighbours(const Image<Rgb8>& picture, Arrangement arrangement, int x, int y) {
  constexpr int steps[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  const bool own = is_of_first(arrangement, x, y);
  int r = 0, g = 0, b = 0, count = 0;
  for (const auto& [dx, dy] : steps) {
    if (!picture.contains(x + dx, y + dy) || is_of_first(arrangement, x + dx, y + dy) == own) continue;
    const Rgb8 colour = picture(x + dx, y + dy);
    r += colour.r, g += colour.g, b += colour.b;
    ++count;
  }
  if (count == 0) return picture(x, y);
  const auto mean = [count](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {mean(r), mean(g), mean(b)};
}

Image<Rgb8> unwoven(const Image<Rgb8>& picture, Arrangement arrangement, bool first) {
  Image<Rgb8> eye(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const bool is_its = is_of_first(arrangement, x, y) == first;
      eye(x, y) = is_its ? picture(x, y) : mean_of_neighbours(picture, arrangement, x, y);
    }
  }
  return eye;
}

Image<Rgb8> woven(const Image<Rgb8>& first, const Image<Rgb8>& second, Arrangement arrangement) {
  Image<Rgb8> picture(first.width(), first.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      picture(x, y) = is_of_first(arrangement, x, y) ? first(x, y) : second(x, y);
    }
  }
  return picture;
}

bool is_even(int size) { return size % 2 == 0; }

[[noreturn]] void refuse_alternating() {
  throw Error(ErrorKind::wrong_usage, "layout alternating: its eyes lie in two frames, expected two eyes in one");
}

}  // namespace

StereoFrame split(const Image<Rgb8>& picture, FilmLayout layout) {
  const LayoutTraits& traits = traits_of(layout);
  if (traits.arrangement == Arrangement::in_time) refuse_alternating();
  if (traits.arrangement == Arrangement::whole) return {.left = picture, .right = {}};

  const int width = picture.width(), height = picture.height();
  const bool beside = traits.arrangement == Arrangement::side_by_side;
  const bool above = traits.arrangement == Arrangement::over_under;
  if ((beside && !is_even(width)) || (above && !is_even(height))) {
    throw Error(ErrorKind::bad_input, fmt::format("frame: {}x{} pixels, expected an even {} in the layout {}", width,
                                                  height, beside ? "width" : "height", traits.name));
  }

  StereoFrame eyes;
  if (beside || above) {
    const int eye_width = beside ? width / 2 : width, eye_height = above ? height / 2 : height;
    eyes.left = part_of(picture, 0, 0, eye_width, eye_height);
    eyes.right = part_of(picture, width - eye_width, height - eye_height, eye_width, eye_height);
    if (traits.half) {
      eyes.left = resized(eyes.left, width, height, cv::INTER_LINEAR);
      eyes.right = resized(eyes.right, width, height, cv::INTER_LINEAR);
    }
  } else {
    eyes.left = unwoven(picture, traits.arrangement, true);
    eyes.right = unwoven(picture, traits.arrangement, false);
  }
  if (traits.right_first) std::swap(eyes.left, eyes.right);
  return eyes;
}

Image<Rgb8> join(const Image<Rgb8>& left, const Image<Rgb8>& right, FilmLayout layout) {
  const LayoutTraits& traits = traits_of(layout);
  if (traits.arrangement == Arrangement::in_time) refuse_alternating();
  if (traits.arrangement == Arrangement::whole) return left;
  const int width = left.width(), height = left.height();
  if (!same_size(left, right)) {
    throw Error(ErrorKind::wrong_usage, fmt::format("right eye: {}x{} pixels, expected {}x{} like the left",
                                                    right.width(), right.height(), width, height));
  }
  const Image<Rgb8>& first = traits.right_first ? right : left;
  const Image<Rgb8>& second = traits.right_first ? left : right;
  const bool beside = traits.arrangement == Arrangement::side_by_side;
  if (!beside && traits.arrangement != Arrangement::over_under) return woven(first, second, traits.arrangement);

  if (traits.half && !is_even(beside ? width : height)) {
    throw Error(ErrorKind::wrong_usage, fmt::format("eyes: {}x{} pixels, expected an even {} in the layout {}", width,
                                                    height, beside ? "width" : "height", traits.name));
  }
  const int eye_width = beside && traits.half ? width / 2 : width;
  const int eye_height = !beside && traits.half ? height / 2 : height;
  Image<Rgb8> picture(beside ? 2 * eye_width : width, beside ? height : 2 * eye_height);
  const int x = beside ? eye_width : 0, y = beside ? 0 : eye_height;
  paste(picture, traits.half ? resized(first, eye_width, eye_height, cv::INTER_AREA) : first, 0, 0);
  paste(picture, traits.half ? resized(second, eye_width, eye_height, cv::INTER_AREA) : second, x, y);
  return picture;
}

}  // namespace wheatstone
