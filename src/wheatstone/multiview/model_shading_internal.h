#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheatstone/models/model.h"
#include "wheatstone/multiview/model_scene.h"
#include "wheatstone/multiview/model_texture_internal.h"
#include "wheatstone/multiview/screen_triangles_internal.h"

namespace wheatstone {

/// A colour in linear light.
using LinearColour = std::array<float, 3>;

/// The look of a model's surfaces. Borrows the model and the scene.
class ModelShading {
 public:
  ModelShading(const Model& model, const ModelScene& scene);

  /// What the surface of a triangle has at its corners, the same for all views.
  struct Corners {
    std::array<std::array<float, 3>, 3> normal;
    std::array<LinearColour, 3> colour;
    std::array<std::array<float, 2>, 3> place;  ///< in the texture
    const ModelTexture* texture;                ///< null: none
    std::array<double, 3> weight;               ///< 1/depth in perspective
    bool turned;                                ///< the model's normals point away from the central camera
  };
  Corners corners(const ScreenTriangles& triangles, std::uint32_t index) const;

  /// A triangle in one view, prepared for shading at any of its places. Borrows the triangle and its corners.
  class Surface {
   public:
    Surface(const ModelShading& shading, const ScreenTriangle& screen, const Corners& corners, float view);

    struct Point {
      LinearColour colour;
      float disparity, depth;
    };
    /// Colour, disparity and depth at a place of the view, in pixels, that lies in the triangle up to rounding.
    Point at(double x, double y) const;
    /// The level of the texture in the middle of the triangle.
    float middle_level() const;

   private:
    /// The level of the texture at a place in it. `per_weight` is 1/sum of weighted shares.
    float texture_level(double u, double v, double per_weight) const;

    const ModelShading* shading_;
    const ScreenTriangle* screen_;
    const Corners* corners_;
    float view_;
    bool turned_;
    std::array<double, 3> begin_, across_, down_;  ///< share of each corner at (0, 0), and its slopes
    /// Slopes of the sum of weights, and of places in the texture times weights.
    std::array<double, 2> weights_by_, u_by_, v_by_;
  };

  /// How finely a triangle is lit: in each pixel; at its corners, and linear between them, where it is small; or once
  /// where it is hardly larger than a pixel. Highlights are different in each view, and lit by pixel.
  enum class Fineness : std::uint8_t { by_pixel, by_corner, once };
  Fineness fineness(const ScreenTriangle& triangle) const;

  /// The colours in the central view at the corners of a triangle that is lit by corner, without its texture.
  std::array<LinearColour, 3> lit_corners(const ScreenTriangle& screen, const Corners& corners) const;
  /// The colour in the central view of a triangle that is lit once.
  LinearColour lit_once(const ScreenTriangle& screen, const Corners& corners) const;

 private:
  bool is_turned(const ScreenTriangle& screen) const;
  LinearColour lit(const std::array<float, 3>& normal, const std::array<float, 3>& to_camera, bool turned, float view,
                   const LinearColour& colour) const;
  std::array<float, 3> to_camera(double x, double y) const;

  const Model& model_;
  const ModelScene& scene_;
  std::vector<ModelTexture> textures_;
  bool is_orthographic_;
  std::array<float, 3> lamp_;  ///< direction to it, in the model's axes
};

}  // namespace wheatstone
