#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/multiview/model_shading_internal.h"
#include "wheatstone/multiview/triangle_band_internal.h"

namespace wheatstone {

/// How the triangles of a band look, by their numbers there. What does not depend on the view is found for a triangle
/// when it is seen for the first time, and kept for further views.
class TriangleLooks {
 public:
  /// In the order in which it is read: what is lit once needs the first line of memory only.
  struct alignas(64) Look {
    float area, area_by_view;  ///< ScreenTriangle::area is linear in the view
    ModelShading::Fineness fineness;
    float texture_level;                  ///< where it is lit by corner and has a texture
    const ModelTexture* texture;          ///< null: none
    std::array<LinearColour, 3> colours;  ///< at the corners, or in all of it, where it is not lit by pixel
    std::array<float, 3> x, y, disparity;
    std::array<std::array<float, 2>, 3> place;  ///< of corners in the texture

    /// A view beside the central one may see a side that is not lit there.
    bool shows_other_side(float view) const { return area * (area + view * area_by_view) < 0; }
    /// Its colour at a place of a view, where it is lit by corner.
    LinearColour by_corner(float view, float at_x, float at_y) const;
  };

  /// Forgets all, and begins the band of triangles `of_band`. Borrows all.
  void begin(const ModelShading& shading, const ScreenTriangles& screen, std::span<const std::uint32_t> of_band);
  const Look& of(std::uint32_t number);
  ModelShading::Surface surface(std::uint32_t number, float view) const;  ///< of one that was looked at

 private:
  const ModelShading* shading_ = nullptr;
  const ScreenTriangles* screen_ = nullptr;
  std::span<const std::uint32_t> of_band_;
  std::vector<std::uint32_t> kept_;  ///< the place of each triangle's look, if it has one
  std::vector<Look> looks_;
  std::vector<ModelShading::Corners> corners_;
};

/// The pictures of a view.
struct ViewPictures {
  Image<Rgb8>* colour;
  Image<float>* disparity;  ///< null: not wanted
  Image<float>* depth;
};

/// Makes pixels of the samples of a band in one view.
class Resolver {
 public:
  Resolver(TriangleLooks& looks, const ModelLook& look, float view);
  void resolve_row(const TriangleBand& band, int row, const ViewPictures& pictures);

 private:
  template <std::size_t samples>
  void resolve(const TriangleBand& band, int row, const ViewPictures& pictures);
  template <std::size_t samples>
  LinearColour pixel(const std::array<std::uint32_t, samples>& shown, int x, int row, const ViewPictures& pictures);
  LinearColour colour_of(std::uint32_t triangle, float x, float y, bool is_most, std::array<int, 2> pixel,
                         const ViewPictures& pictures);
  const ModelShading::Surface& surface_of(std::uint32_t triangle);

  /// A triangle is seen again in the next pixel, and in the next row.
  struct Kept {
    std::uint32_t triangle = TriangleBand::nothing;
    std::optional<ModelShading::Surface> surface;
  };
  static constexpr std::size_t kept_surfaces = 64;

  TriangleLooks& looks_;
  float view_;
  std::span<const float> columns_;
  LinearColour background_;
  std::array<Kept, kept_surfaces> kept_;
  std::vector<float> linear_;
  std::vector<std::uint8_t> codes_;
};

}  // namespace wheatstone
