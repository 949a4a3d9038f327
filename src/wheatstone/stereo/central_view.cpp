#include "wheatstone/stereo/central_view.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone {
namespace {

/// Disparities of one surface differ by no more.
constexpr float same_surface_px = 1;

/// The part of the central view that one eye shows.
struct MappedEye {
  Image<Rgb8> picture;
  Image<float> disparity;  ///< NaN where the eye shows nothing
};

/// Lanczos' kernel of eight pixels, for places between two pixels.
class LanczosRow {
 public:
  LanczosRow() {
    for (int phase = 0; phase <= phases; ++phase) {
      const double t = static_cast<double>(phase) / phases;
      double sum = 0;
      std::array<double, taps> exact{};
      for (int k = 0; k < taps; ++k) {
        exact[k] = kernel(t - (k - before));
        sum += exact[k];
      }
      for (int k = 0; k < taps; ++k) weights_[phase][k] = static_cast<float>(exact[k] / sum);
    }
  }

  Rgb8 operator()(std::span<const Rgb8> row, float column) const {
    const int last = static_cast<int>(row.size()) - 1, left = std::min(static_cast<int>(column), last);
    const auto phase = static_cast<std::size_t>((column - static_cast<float>(left)) * phases + 0.5f);
    if (phase == 0) return row[left];
    const std::array<float, taps>& weights = weights_[phase];
    // Most places have all their neighbours in the row.
    if (left >= before && left - before + taps <= last + 1) {
      const Rgb8* first = &row[left - before];
      return mean(weights, [first](int k) { return first[k]; });
    }
    return mean(weights, [&](int k) { return row[std::clamp(left + k - before, 0, last)]; });
  }

 private:
  static constexpr int taps = 8, before = 3, phases = 64;

  template <class PixelAt>
  static Rgb8 mean(const std::array<float, taps>& weights, PixelAt pixel_at) {
    float red = 0, green = 0, blue = 0;
    for (int k = 0; k < taps; ++k) {
      const Rgb8 pixel = pixel_at(k);
      red += weights[k] * static_cast<float>(pixel.r);
      green += weights[k] * static_cast<float>(pixel.g);
      blue += weights[k] * static_cast<float>(pixel.b);
    }
    const auto level = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
    return {level(red), level(green), level(blue)};
  }

  static double kernel(double x) {
    constexpr double reach = 4;
    if (std::abs(x) < 1e-9) return 1;
    if (std::abs(x) >= reach) return 0;
    const double angle = std::numbers::pi * x;
    return reach * std::sin(angle) * std::sin(angle / reach) / (angle * angle);
  }

  std::array<std::array<float, taps>, phases + 1> weights_{};
};

MappedEye map_forward(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition eye) {
  static const LanczosRow lanczos;
  WarpedColumns warped = warp_columns(disparity, eye, central_view);
  MappedEye mapped{Image<Rgb8>(picture.width(), picture.height()), std::move(warped.disparity)};
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto columns = warped.column.row(y);
    const auto from = picture.row(y);
    const auto to = mapped.picture.row(y);
    for (std::size_t x = 0; x < columns.size(); ++x)
      if (!std::isnan(columns[x])) to[x] = lanczos(from, columns[x]);
  });
  return mapped;
}

/// Gives pixels to which nothing was mapped the colour and the disparity of the farther of their neighbours on the scan
/// line.
void fill_from_farther_neighbour(MappedEye& mapped) {
  tbb::parallel_for(0, mapped.picture.height(), [&](int y) {
    const auto disparity = mapped.disparity.row(y);
    const auto colours = mapped.picture.row(y);
    const std::size_t width = disparity.size();
    for (std::size_t begin = 0; begin < width; ++begin) {
      if (!std::isnan(disparity[begin])) continue;
      std::size_t end = begin;
      while (end < width && std::isnan(disparity[end])) ++end;
      if (begin == 0 && end == width) return;  // an eye that shows nothing of this row
      const bool after = begin == 0 || (end < width && disparity[end] < disparity[begin - 1]);
      const std::size_t from = after ? end : begin - 1;
      std::fill(disparity.begin() + static_cast<std::ptrdiff_t>(begin),
                disparity.begin() + static_cast<std::ptrdiff_t>(end), disparity[from]);
      std::fill(colours.begin() + static_cast<std::ptrdiff_t>(begin),
                colours.begin() + static_cast<std::ptrdiff_t>(end), colours[from]);
      begin = end;
    }
  });
}

Rgb8 mixed_colour(Rgb8 a, Rgb8 b, float share_of_b) {
  const auto channel = [share_of_b](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(static_cast<float>(from) +
                                     share_of_b * (static_cast<float>(to) - static_cast<float>(from)) + 0.5f);
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

/// How much of the right eye's colour is taken where both see a point: half where they agree, none where they do not,
/// so that highlights in one eye only, and wrongly matched points, are not doubled.
float share_of_right(Rgb8 left, Rgb8 right) {
  constexpr float agree = 24, disagree = 60;
  const int difference = std::max({std::abs(left.r - right.r), std::abs(left.g - right.g), std::abs(left.b - right.b)});
  return 0.5f * std::clamp((disagree - static_cast<float>(difference)) / (disagree - agree), 0.f, 1.f);
}

/// Merges the right eye's part into the left eye's: points that both eyes see are blended, points that one eye sees are
/// taken from it.
void merge_visible(const MappedEye& right, MappedEye& left) {
  tbb::parallel_for(0, left.picture.height(), [&](int y) {
    for (int x = 0; x < left.picture.width(); ++x) {
      float& near = left.disparity(x, y);
      const float other = right.disparity(x, y);
      if (std::isnan(other) || near > other + same_surface_px) continue;
      Rgb8& colour = left.picture(x, y);
      if (near >= other - same_surface_px) {
        colour = mixed_colour(colour, right.picture(x, y), share_of_right(colour, right.picture(x, y)));
        near = 0.5f * (near + other);
      } else {
        colour = right.picture(x, y);
        near = other;
      }
    }
  });
}

/// Eqs. 2 and 4 as they stand.
void merge_average(const MappedEye& right, MappedEye& left) {
  tbb::parallel_for(0, left.picture.height(), [&](int y) {
    for (int x = 0; x < left.picture.width(); ++x) {
      left.picture(x, y) = mixed_colour(left.picture(x, y), right.picture(x, y), 0.5f);
      left.disparity(x, y) = 0.5f * (left.disparity(x, y) + right.disparity(x, y));
    }
  });
}

/// The pixels of an eye whose points the central view hides or leaves out.
Image<std::uint8_t> hidden_from_centre(ImageView<const float> disparity, ViewPosition eye, const Image<float>& centre) {
  const float separation = central_view - eye;
  Image<std::uint8_t> hidden(disparity.width(), disparity.height());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto nearest = centre.row(y);
    for (int x = 0; x < disparity.width(); ++x) {
      const float d = disparity(x, y), place = static_cast<float>(x) + 0.5f - separation * d;
      const bool inside = place >= 0 && place < static_cast<float>(centre.width());
      hidden(x, y) = inside && nearest[static_cast<std::size_t>(place)] <= d + same_surface_px ? 0 : 255;
    }
  });
  constexpr int least_px = 12;
  remove_occlusion_specks(hidden, least_px);
  return hidden;
}

}  // namespace

CentralView make_central_view(const StereoPairView& pair, const StereoGeometryView& geometry, CentralMerge merge) {
  check_fits(pair);
  check_same_size("the left disparity", geometry.left_disparity, "the pictures'", pair.left);
  check_same_size("the right disparity", geometry.right_disparity, "the pictures'", pair.left);
  MappedEye left, right;
  tbb::parallel_invoke([&] { left = map_forward(pair.left, geometry.left_disparity, left_eye); },
                       [&] { right = map_forward(pair.right, geometry.right_disparity, right_eye); });
  if (merge == CentralMerge::visible) {
    merge_visible(right, left);
    fill_from_farther_neighbour(left);
  } else {
    fill_from_farther_neighbour(left);
    fill_from_farther_neighbour(right);
    merge_average(right, left);
  }
  CentralView centre{std::move(left.picture), std::move(left.disparity), {}, {}};
  tbb::parallel_invoke(
      [&] { centre.left_only = hidden_from_centre(geometry.left_disparity, left_eye, centre.disparity); },
      [&] { centre.right_only = hidden_from_centre(geometry.right_disparity, right_eye, centre.disparity); });
  return centre;
}

}  // namespace wheatstone
