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

  /// A triangle in one view, prepared for shading at any of its places.
  class Surface {
   public:
    Surface(const ModelShading& shading, const ScreenTriangles& triangles, std::uint32_t index, float view);

    struct Point {
      LinearColour colour;
      float disparity, depth;
    };
    /// Colour, disparity and depth at a place of the view, in pixels, that lies in the triangle up to rounding.
    Point at(double x, double y) const;

   private:
    friend class ModelShading;
    void set_corners(const ScreenTriangles& triangles, const ScreenTriangle& screen);
    bool is_turned(const ScreenTriangle& screen) const;

    const ModelShading* shading_;
    float view_;
    bool turned_ = false;                          ///< the model's normals point away from the camera
    std::array<double, 3> begin_, across_, down_;  ///< share of each corner at (0, 0), and its slopes
    std::array<double, 3> weight_;                 ///< 1/depth of the corners in perspective
    std::array<float, 3> disparity_, depth_;
    std::array<std::array<float, 3>, 3> normal_;
    std::array<LinearColour, 3> colour_;
    std::array<std::array<float, 2>, 3> place_;  ///< in the texture
    const ModelTexture* texture_ = nullptr;
  };

  /// How finely a triangle is lit: in each pixel; at its corners, and linear between them, where it is small and has no
  /// texture; or once where it is hardly larger than a pixel. Highlights are different in each view, and lit by pixel.
  enum class Fineness : std::uint8_t { by_pixel, by_corner, once };
  Fineness fineness(const ScreenTriangle& triangle) const;

  /// The colours in the central view at the corners of a triangle that is not lit by pixel. If it is lit once, the
  /// first of them is the colour of the whole triangle.
  std::array<LinearColour, 3> corner_colours(const ScreenTriangles& triangles, std::uint32_t index) const;

 private:
  LinearColour colour_at_once(const ScreenTriangle& screen, const Surface& surface) const;
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
