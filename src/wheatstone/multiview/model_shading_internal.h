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

  /// A triangle as one view has it, ready to tell what it looks like at its places.
  class Surface {
   public:
    Surface(const ModelShading& shading, const ScreenTriangles& triangles, std::uint32_t index, float view);

    struct Point {
      LinearColour colour;
      float disparity, depth;
    };
    /// At a place of the view, in pixels, that lies in the triangle but for rounding.
    Point at(double x, double y) const;

   private:
    friend class ModelShading;
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

  /// One colour for a triangle that is so small that it needs no more: at its middle, in the central view.
  LinearColour colour_of_small(const ScreenTriangles& triangles, std::uint32_t index) const;
  /// Whether it is: no view adds a highlight, and it is at most 2 pixels wide and high.
  bool is_small(const ScreenTriangle& triangle) const;

 private:
  struct Lit {
    std::array<double, 3> direction;  ///< to the camera, in the model's axes, of length 1
    float highlight;
  };
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
