#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/models/model.h"

namespace wheatstone::crease_normals_test {

/// A cube of side 2 around 0, of eight vertices.
Model cube() {
  Model model;
  for (int i = 0; i < 8; ++i)
    model.positions.push_back({(i & 1) != 0 ? 1. : -1., (i & 2) != 0 ? 1. : -1., (i & 4) != 0 ? 1. : -1.});
  model.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  model.material_of.assign(12, 0);
  model.materials.resize(1);
  return model;
}

TEST(CreaseNormals, EdgesOfACubeStaySharp) {
  Model model = cube();
  make_normals(model, 40);
  EXPECT_EQ(model.positions.size(), 24u);
  EXPECT_EQ(model.normals.size(), 24u);
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle) {
      const auto& normal = model.normals[vertex];
      EXPECT_NEAR(std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]), 1, 1e-6);
      // Away from the middle.
      double outwards = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        outwards += static_cast<double>(normal[axis]) * model.positions[vertex][axis];
      EXPECT_NEAR(outwards, 1, 1e-6);
    }
  }
}

TEST(CreaseNormals, AWideCreaseAngleMakesACubeSmooth) {
  Model model = cube();
  make_normals(model, 100);
  EXPECT_EQ(model.positions.size(), 8u);
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(model.normals[v][axis], model.positions[v][axis] / std::sqrt(3.), 1e-5);
}

TEST(CreaseNormals, SmoothOverVerticesThatOnlyDifferInTheirPlaceInATexture) {
  Model model;  // a roof that is almost flat, its ridge of vertices of their own on either side
  model.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, -0.1}, {0, 0, 0}, {0, 1, 0}, {1, 0, -0.1}};
  model.texture_places = {{0, 0}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {1, 0}};
  model.triangles = {{0, 1, 2}, {3, 5, 4}};
  make_normals(model, 40);
  EXPECT_EQ(model.positions.size(), 6u);
  EXPECT_NEAR(model.normals[0][0], 0, 1e-6);
  EXPECT_EQ(model.normals[0], model.normals[3]);
}

}  // namespace wheatstone::crease_normals_test
