#include "wheatstone/multiview/model_resolve_internal.h"

#include <algorithm>
#include <limits>

#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

constexpr std::uint32_t not_kept = ~std::uint32_t{0};

}  // namespace

LinearColour TriangleLooks::Look::by_corner(float view, float at_x, float at_y) const {
  std::array<float, 3> from_x{}, from_y{};  // from the place to each corner
  for (std::size_t k = 0; k < 3; ++k) {
    from_x[k] = x[k] - view * disparity[k] - at_x;
    from_y[k] = y[k] - at_y;
  }
  // The place lies in the triangle up to rounding.
  const float side = area + view * area_by_view < 0 ? -1.f : 1.f;
  std::array<float, 3> share{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    share[k] = std::max(side * (from_x[a] * from_y[b] - from_x[b] * from_y[a]), 0.f);
  }
  const float sum = share[0] + share[1] + share[2];
  if (sum > 0) {
    const float per_sum = 1 / sum;
    for (float& part : share) part *= per_sum;
  } else {
    share.fill(1.f / 3);
  }
  LinearColour colour{};
  std::array<float, 2> in_texture{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) colour[c] += share[k] * colours[k][c];
    for (std::size_t axis = 0; axis < 2; ++axis) in_texture[axis] += share[k] * place[k][axis];
  }
  if (texture == nullptr) return colour;
  const LinearColour textured = texture->at(in_texture[0], in_texture[1], texture_level);
  for (std::size_t c = 0; c < 3; ++c) colour[c] *= textured[c];
  return colour;
}

void TriangleLooks::begin(const ModelShading& shading, const ScreenTriangles& screen,
                          std::span<const std::uint32_t> of_band) {
  shading_ = &shading;
  screen_ = &screen;
  of_band_ = of_band;
  kept_.assign(of_band.size(), not_kept);
  looks_.clear();
  corners_.clear();
  corners_.reserve(of_band.size());  // so that they stay where they are
}

const TriangleLooks::Look& TriangleLooks::of(std::uint32_t number) {
  std::uint32_t& kept = kept_[number];
  if (kept != not_kept) return looks_[kept];
  kept = static_cast<std::uint32_t>(looks_.size());
  const ScreenTriangle& screen = screen_->triangles[of_band_[number]];
  const ModelShading::Corners& corners = corners_.emplace_back(shading_->corners(*screen_, of_band_[number]));
  Look& look = looks_.emplace_back();
  look.area = static_cast<float>(screen.area(0));
  look.area_by_view = static_cast<float>(screen.area(1) - screen.area(0));
  look.fineness = shading_->fineness(screen);
  if (look.fineness == ModelShading::Fineness::once) {
    look.colours[0] = shading_->lit_once(screen, corners);
  } else if (look.fineness == ModelShading::Fineness::by_corner) {
    look.colours = shading_->lit_corners(screen, corners);
    look.x = screen.x;
    look.y = screen.y;
    look.disparity = screen.disparity;
    look.texture = corners.texture;
    look.place = corners.place;
    if (look.texture != nullptr) look.texture_level = surface(number, 0).middle_level();
  }
  return look;
}

ModelShading::Surface TriangleLooks::surface(std::uint32_t number, float view) const {
  return {*shading_, screen_->triangles[of_band_[number]], corners_[kept_[number]], view};
}

Resolver::Resolver(TriangleLooks& looks, const ModelLook& look, float view)
    : looks_(looks), view_(view), columns_(sample_columns(look.samples)) {
  const std::array<float, 256>& linear = linear_codes();
  background_ = {linear[look.background.r], linear[look.background.g], linear[look.background.b]};
}

void Resolver::resolve_row(const TriangleBand& band, int row, const ViewPictures& pictures) {
  linear_.resize(3 * static_cast<std::size_t>(band.width()));
  if (band.samples() == 8)
    resolve<8>(band, row, pictures);
  else
    resolve<4>(band, row, pictures);
  codes_.resize(linear_.size());
  srgb_from_linear(linear_, codes_);
  const auto to = pictures.colour->row(row);
  for (std::size_t x = 0; x < to.size(); ++x) to[x] = {codes_[3 * x], codes_[3 * x + 1], codes_[3 * x + 2]};
}

template <std::size_t samples>
void Resolver::resolve(const TriangleBand& band, int row, const ViewPictures& pictures) {
  std::array<std::span<const std::uint32_t>, samples> lines;
  for (std::size_t k = 0; k < samples; ++k) lines[k] = band.line(row, static_cast<int>(k));
  for (int x = 0; x < band.width(); ++x) {
    std::array<std::uint32_t, samples> shown;
    std::uint32_t others = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      shown[k] = lines[k][static_cast<std::size_t>(x)];
      others |= shown[k] ^ shown[0];
    }
    const LinearColour colour = others == 0 ? colour_of(shown[0], static_cast<float>(x) + 0.5f,
                                                        static_cast<float>(row) + 0.5f, true, {x, row}, pictures)
                                            : pixel<samples>(shown, x, row, pictures);
    std::ranges::copy(colour, linear_.begin() + 3 * x);
  }
}

template <std::size_t samples>
LinearColour Resolver::pixel(const std::array<std::uint32_t, samples>& shown, int x, int row,
                             const ViewPictures& pictures) {
  LinearColour sum{};
  float most = 0;
  std::array<bool, samples> is_done{};
  for (std::size_t k = 0; k < samples; ++k) {
    if (is_done[k]) continue;
    // The middle of the triangle's samples.
    float at_x = 0, at_y = 0, count = 0;
    for (std::size_t other = k; other < samples; ++other) {
      const bool is_same = shown[other] == shown[k];
      is_done[other] = is_done[other] || is_same;
      const float weight = is_same ? 1 : 0;
      at_x += weight * columns_[other];
      at_y += weight * (static_cast<float>(other) + 0.5f) / samples;
      count += weight;
    }
    const LinearColour colour = colour_of(shown[k], static_cast<float>(x) + at_x / count,
                                          static_cast<float>(row) + at_y / count, count > most, {x, row}, pictures);
    most = std::max(most, count);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += count * std::min(colour[c], 1.f);
  }
  for (float& channel : sum) channel /= samples;
  return sum;
}

/// The colour of a triangle at a place of the view. `is_most`: its geometry is that of the pixel.
LinearColour Resolver::colour_of(std::uint32_t triangle, float x, float y, bool is_most, std::array<int, 2> pixel,
                                 const ViewPictures& pictures) {
  const bool tells_geometry = is_most && pictures.disparity != nullptr;
  if (triangle == TriangleBand::nothing) {
    if (tells_geometry) {
      (*pictures.disparity)(pixel[0], pixel[1]) = std::numeric_limits<float>::quiet_NaN();
      (*pictures.depth)(pixel[0], pixel[1]) = std::numeric_limits<float>::quiet_NaN();
    }
    return background_;
  }
  const TriangleLooks::Look& look = looks_.of(triangle);
  const bool is_lit = look.fineness != ModelShading::Fineness::by_pixel && !look.shows_other_side(view_);
  if (!is_lit || tells_geometry) {
    const ModelShading::Surface::Point point = surface_of(triangle).at(static_cast<double>(x), static_cast<double>(y));
    if (tells_geometry) {
      (*pictures.disparity)(pixel[0], pixel[1]) = point.disparity;
      (*pictures.depth)(pixel[0], pixel[1]) = point.depth;
    }
    if (!is_lit) return point.colour;
  }
  return look.fineness == ModelShading::Fineness::once ? look.colours[0] : look.by_corner(view_, x, y);
}

const ModelShading::Surface& Resolver::surface_of(std::uint32_t triangle) {
  Kept& kept = kept_[triangle % kept_surfaces];
  if (kept.triangle != triangle) {
    kept.surface.emplace(looks_.surface(triangle, view_));
    kept.triangle = triangle;
  }
  return *kept.surface;
}

}  // namespace wheatstone
