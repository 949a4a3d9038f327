#include "wheatstone/stereo/packed_pair.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// A part of the picture as an image of its own, stretched to `size`.
template <class Pixel>
Image<Pixel> part(ImageView<const Pixel> picture, const cv::Rect& place, const cv::Size& size) {
  const cv::Mat from = as_mat(picture)(place);
  Image<Pixel> to(size.width, size.height);
  cv::Mat target = as_mat(to);
  if (place.size() == size) {
    from.copyTo(target);
  } else {
    cv::resize(from, target, size, 0, 0, cv::INTER_LANCZOS4);
  }
  return to;
}

/// 0 where a woven picture's pixel belongs to the eye that comes first, else 1.
int eye_of_pixel(Arrangement arrangement, int x, int y) {
  if (arrangement == Arrangement::rows) return y & 1;
  return arrangement == Arrangement::columns ? x & 1 : (x ^ y) & 1;
}

/// The mean of those of the four neighbours that lie in the picture and belong to the other eye than this pixel.
template <class Pixel>
Pixel mean_of_neighbours(ImageView<const Pixel> picture, Arrangement arrangement, int x, int y) {
  constexpr int steps[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  const int own = eye_of_pixel(arrangement, x, y);
  int r = 0, g = 0, b = 0, count = 0;
  for (const auto& [dx, dy] : steps) {
    const int nx = x + dx, ny = y + dy;
    if (!picture.contains(nx, ny) || eye_of_pixel(arrangement, nx, ny) == own) continue;
    const Pixel colour = picture(nx, ny);
    r += colour.r, g += colour.g, b += colour.b;
    ++count;
  }
  if (count == 0) return picture(x, y);
  const auto mean = [count](int sum) { return static_cast<decltype(Pixel::r)>((sum + count / 2) / count); };
  return {mean(r), mean(g), mean(b)};
}

template <class Pixel>
Image<Pixel> unwoven(ImageView<const Pixel> picture, Arrangement arrangement, int eye) {
  Image<Pixel> result(picture.width(), picture.height());
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x)
      result(x, y) =
          eye_of_pixel(arrangement, x, y) == eye ? picture(x, y) : mean_of_neighbours(picture, arrangement, x, y);
  });
  return result;
}

template <class Pixel>
Image<Pixel> woven(ImageView<const Pixel> first, ImageView<const Pixel> second, Arrangement arrangement) {
  Image<Pixel> picture(first.width(), first.height());
  tbb::parallel_for(0, first.height(), [&](int y) {
    const std::array<std::span<const Pixel>, 2> eyes{first.row(y), second.row(y)};
    const std::span<Pixel> to = picture.row(y);
    // All even pixels of a row are of the same eye as the first, and all odd ones of the same as the second.
    for (const int begin : {0, 1}) {
      const std::span<const Pixel> from = eyes[static_cast<std::size_t>(eye_of_pixel(arrangement, begin, y))];
      for (auto x = static_cast<std::size_t>(begin); x < to.size(); x += 2) to[x] = from[x];
    }
  });
  return picture;
}

[[noreturn]] void refuse_unpacked(const LayoutTraits& layout) {
  throw Error(ErrorKind::wrong_usage,
              fmt::format("layout: '{}' ({}) does not hold both eyes in one picture", layout.name, layout.words));
}

template <class Pixel>
std::pair<Image<Pixel>, Image<Pixel>> cut(ImageView<const Pixel> picture, StereoLayout layout,
                                          const std::string& name) {
  const LayoutTraits& of = traits_of(layout);
  if (!is_packed(layout)) refuse_unpacked(of);
  const bool side_by_side = of.arrangement == Arrangement::side_by_side;
  std::pair<Image<Pixel>, Image<Pixel>> pair;
  if (side_by_side || of.arrangement == Arrangement::over_under) {
    const int side = side_by_side ? picture.width() : picture.height();
    if (side % 2 != 0 || side == 0)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is {}x{} pixels, expected an even {} to hold two pictures {}", name, picture.width(),
                              picture.height(), side_by_side ? "width" : "height",
                              side_by_side ? "side by side" : "one above the other"));
    cv::Size each(picture.width(), picture.height());
    (side_by_side ? each.width : each.height) = side / 2;
    const cv::Point second(side_by_side ? side / 2 : 0, side_by_side ? 0 : side / 2);
    const cv::Size full = of.half ? cv::Size(picture.width(), picture.height()) : each;
    pair = {part(picture, {{0, 0}, each}, full), part(picture, {second, each}, full)};
  } else {
    pair = {unwoven(picture, of.arrangement, 0), unwoven(picture, of.arrangement, 1)};
  }
  if (of.right_first) std::swap(pair.first, pair.second);
  return pair;
}

template <class Pixel>
Image<Pixel> put(ImageView<const Pixel> left, ImageView<const Pixel> right, StereoLayout layout) {
  const LayoutTraits& of = traits_of(layout);
  if (of.arrangement == Arrangement::in_time) refuse_unpacked(of);
  if (of.arrangement == Arrangement::whole)
    return part(left, {0, 0, left.width(), left.height()}, {left.width(), left.height()});
  if (!same_size(left, right))
    throw Error(ErrorKind::wrong_usage, fmt::format("views of {}x{} and {}x{} pixels, expected one size", left.width(),
                                                    left.height(), right.width(), right.height()));
  if (of.right_first) std::swap(left, right);
  const bool side_by_side = of.arrangement == Arrangement::side_by_side;
  if (!side_by_side && of.arrangement != Arrangement::over_under) return woven(left, right, of.arrangement);

  cv::Size each(left.width(), left.height());
  if (of.half) (side_by_side ? each.width : each.height) = ((side_by_side ? each.width : each.height) + 1) / 2;
  Image<Pixel> both(side_by_side ? 2 * each.width : each.width, side_by_side ? each.height : 2 * each.height);
  const cv::Mat whole = as_mat(both);
  const cv::Point second(side_by_side ? each.width : 0, side_by_side ? 0 : each.height);
  cv::resize(as_mat(left), whole({{0, 0}, each}), each, 0, 0, cv::INTER_AREA);
  cv::resize(as_mat(right), whole({second, each}), each, 0, 0, cv::INTER_AREA);
  return both;
}

}  // namespace

StereoPair cut_apart(ImageView<const Rgb8> picture, StereoLayout layout, const std::string& name) {
  auto [left, right] = cut(picture, layout, name);
  return {std::move(left), std::move(right)};
}

std::pair<Image<Rgb16>, Image<Rgb16>> cut_apart(ImageView<const Rgb16> picture, StereoLayout layout,
                                                const std::string& name) {
  return cut(picture, layout, name);
}

std::optional<Image<Rgb8>> without_middle(ImageView<const Rgb8> picture, StereoLayout layout) {
  const Arrangement arrangement = traits_of(layout).arrangement;
  const bool side_by_side = arrangement == Arrangement::side_by_side;
  if (!side_by_side && arrangement != Arrangement::over_under) return {};
  const int width = picture.width(), height = picture.height();
  const int half = (side_by_side ? width : height) / 2;
  if (2 * half == (side_by_side ? width : height) || half == 0) return {};
  Image<Rgb8> even(side_by_side ? 2 * half : width, side_by_side ? height : 2 * half);
  const cv::Mat from = as_mat(picture), to = as_mat(even);
  const cv::Size each(side_by_side ? half : width, side_by_side ? height : half);
  const cv::Point second(side_by_side ? half : 0, side_by_side ? 0 : half),
      step(side_by_side ? 1 : 0, side_by_side ? 0 : 1);
  from({{0, 0}, each}).copyTo(to({{0, 0}, each}));
  from({second + step, each}).copyTo(to({second, each}));
  return even;
}

Image<Rgb8> put_together(ImageView<const Rgb8> left, ImageView<const Rgb8> right, StereoLayout layout) {
  return put(left, right, layout);
}

Image<Rgb16> put_together(ImageView<const Rgb16> left, ImageView<const Rgb16> right, StereoLayout layout) {
  return put(left, right, layout);
}

}  // namespace wheatstone
