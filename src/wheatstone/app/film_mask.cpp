#include "wheatstone/app/film_mask.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "wheatstone/app/film_beside_internal.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/stereo/warp.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// The film that a mask belongs to.
struct MaskedFilm {
  fs::path mask, film;
  int width = 0, height = 0;  ///< of its whole frames
  StereoLayout layout = StereoLayout::mono;
};

FrameMask mask_from(const Image<Rgb8>& picture, const MaskedFilm& of, const Image<Rgb8>& left) {
  if (same_size(picture, left)) return {mask_of_picture(picture), {}};
  const bool is_whole = picture.width() == of.width && picture.height() == of.height;
  if (of.layout == StereoLayout::mono || !is_whole)
    refuse_film_beside(of.mask, fmt::format("is {}x{} pixels, expected {}x{} as an eye of {}{}", picture.width(),
                                            picture.height(), left.width(), left.height(), of.film.string(),
                                            of.layout == StereoLayout::mono
                                                ? ""
                                                : fmt::format(", or {}x{} for both eyes as its frames have them",
                                                              of.width, of.height)));
  const StereoPair eyes = cut_apart(picture, of.layout, of.mask.string());
  return {mask_of_picture(eyes.left), mask_of_picture(eyes.right)};
}

/// Fills what nothing landed on from the neighbour on the row that lies farther.
void fill_row(std::span<const float> disparity, std::span<std::uint8_t> mask) {
  const std::size_t width = mask.size();
  for (std::size_t end = 0; end < width;) {
    const std::size_t begin = end;
    while (end < width && !std::isfinite(disparity[end])) ++end;
    if (end == begin) {
      ++end;
      continue;
    }
    const bool has_left = begin > 0, has_right = end < width;
    if (!has_left && !has_right) return;
    const bool from_left = has_left && (!has_right || disparity[begin - 1] <= disparity[end]);
    std::fill(mask.begin() + static_cast<std::ptrdiff_t>(begin), mask.begin() + static_cast<std::ptrdiff_t>(end),
              mask[from_left ? begin - 1 : end]);
  }
}

}  // namespace

FilmMask mask_of_film(const fs::path& mask, const MainFilm& main, StereoLayout layout) {
  const MaskedFilm of{mask, main.film, main.facts.width, main.facts.height, layout};
  if (!is_film(mask)) {
    const auto picture = std::make_shared<const Image<Rgb8>>(read_image(mask));
    return [picture, of](std::int64_t /*frame*/, const Image<Rgb8>& left) { return mask_from(*picture, of, left); };
  }
  const auto film = std::make_shared<FilmBeside>(mask, main);
  return [film, of](std::int64_t frame, const Image<Rgb8>& left) { return mask_from(film->at(frame), of, left); };
}

Image<std::uint8_t> mask_of_picture(const Image<Rgb8>& picture) {
  Image<std::uint8_t> mask(picture.width(), picture.height());
  std::ranges::transform(picture.pixels(), mask.pixels().begin(),
                         [](Rgb8 pixel) { return static_cast<std::uint8_t>((pixel.r + pixel.g + pixel.b + 1) / 3); });
  return mask;
}

Image<Rgb8> picture_of_mask(const Image<std::uint8_t>& mask) {
  Image<Rgb8> picture(mask.width(), mask.height());
  std::ranges::transform(mask.pixels(), picture.pixels().begin(), [](std::uint8_t level) {
    return Rgb8{level, level, level};
  });
  return picture;
}

Image<std::uint8_t> mask_in_right_eye(const Image<std::uint8_t>& left, ImageView<const float> left_disparity) {
  const WarpedColumns from = warp_columns(left_disparity, left_eye, right_eye);
  Image<std::uint8_t> right(left.width(), left.height());
  tbb::parallel_for(0, right.height(), [&](int y) {
    for (int x = 0; x < right.width(); ++x) {
      const float column = from.column(x, y);
      if (!std::isfinite(column)) continue;
      const float inside = std::clamp(column, 0.f, static_cast<float>(left.width() - 1));
      const int before = static_cast<int>(inside), after = std::min(before + 1, left.width() - 1);
      const float share = inside - static_cast<float>(before);
      right(x, y) = static_cast<std::uint8_t>(
          std::lround((1 - share) * static_cast<float>(left(before, y)) + share * static_cast<float>(left(after, y))));
    }
    fill_row(from.disparity.row(y), right.row(y));
  });
  return right;
}

void show_in_mask(const Image<std::uint8_t>& mask, const Image<Rgb8>& outside, Image<Rgb8>& picture) {
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const int inside = mask(x, y);
      const auto mixed = [inside](int to, int from) {
        return static_cast<std::uint8_t>((inside * to + (255 - inside) * from + 127) / 255);
      };
      Rgb8& pixel = picture(x, y);
      const Rgb8 other = outside(x, y);
      pixel = {mixed(pixel.r, other.r), mixed(pixel.g, other.g), mixed(pixel.b, other.b)};
    }
  });
}

}  // namespace wheatstone
