#include "wheatstone/multiview/model_shading_internal.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/multiview/sphere_light_internal.h"

namespace wheatstone {
namespace {

using Direction = std::array<float, 3>;

float scalar_product(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Direction of_length_1(const Direction& v) {
  const float length = std::sqrt(scalar_product(v, v));
  return length > 0 ? Direction{v[0] / length, v[1] / length, v[2] / length} : Direction{0, 0, 1};
}

constexpr float highlight_exponent = 32;

}  // namespace

ModelShading::ModelShading(const Model& model, const ModelScene& scene)
    : model_(model), scene_(scene), is_orthographic_(scene.camera.orthographic_depth > 0) {
  textures_.reserve(model.textures.size());
  for (const Image<Rgb8>& texture : model.textures) textures_.emplace_back(texture);
  const Direction& lamp = direction_to_lamp;
  for (std::size_t axis = 0; axis < 3; ++axis)
    lamp_[axis] =
        lamp[0] * scene.camera.right[axis] + lamp[1] * scene.camera.down[axis] + lamp[2] * scene.camera.forward[axis];
  lamp_ = of_length_1(lamp_);
}

Direction ModelShading::to_camera(double x, double y) const {
  const Camera& camera = scene_.camera;
  Direction from{0, 0, 1};
  if (!is_orthographic_) {
    from[0] = (static_cast<float>(x) - camera.centre_x_px) / camera.focal_px;
    from[1] = (static_cast<float>(y) - camera.centre_y_px) / camera.focal_px;
  }
  Direction to{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    to[axis] = -(from[0] * camera.right[axis] + from[1] * camera.down[axis] + camera.forward[axis]);
  return of_length_1(to);
}

LinearColour ModelShading::lit(const Direction& normal, const Direction& to_camera, bool turned, float view,
                               const LinearColour& colour) const {
  Direction facing = of_length_1(normal);
  if (turned)
    for (float& part : facing) part = -part;
  const float towards_lamp = scalar_product(facing, lamp_);
  const float light = light_all_around + light_of_camera * std::max(scalar_product(facing, to_camera), 0.f) +
                      light_of_lamp * std::max(towards_lamp, 0.f);
  LinearColour lit_colour{colour[0] * light, colour[1] * light, colour[2] * light};
  if (scene_.look.shine > 0 && towards_lamp > 0) {
    Direction to_eye{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      to_eye[axis] = to_camera[axis] + view * scene_.look.turn * scene_.camera.right[axis];
    Direction mirrored{};
    for (std::size_t axis = 0; axis < 3; ++axis) mirrored[axis] = 2 * towards_lamp * facing[axis] - lamp_[axis];
    const float highlight = scene_.look.shine * light_of_lamp *
                            std::pow(std::max(scalar_product(mirrored, of_length_1(to_eye)), 0.f), highlight_exponent);
    for (float& channel : lit_colour) channel += highlight;
  }
  return lit_colour;
}

ModelShading::Corners ModelShading::corners(const ScreenTriangles& triangles, std::uint32_t index) const {
  const ScreenTriangle& screen = triangles.triangles[index];
  const auto& vertices = model_.triangles[screen.triangle];
  const ModelMaterial& material = model_.materials[model_.material_of[screen.triangle]];
  // Values at the corners of a part are interpolated from those at the corners of the whole triangle.
  std::array<std::array<float, 3>, 3> share{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (screen.part < 0)
      share[k][screen.corner[k]] = 1;
    else
      share[k] = triangles.parts[static_cast<std::size_t>(screen.part)][k];
  }
  Corners corners{};
  const bool has_texture = material.texture >= 0 && !model_.texture_places.empty();
  if (has_texture) corners.texture = &textures_[static_cast<std::size_t>(material.texture)];
  const std::array<float, 256>& linear = linear_codes();
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = vertices[c];
      const float part = share[k][c];
      if (part == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) corners.normal[k][axis] += part * model_.normals[vertex][axis];
      if (has_texture)
        for (std::size_t axis = 0; axis < 2; ++axis)
          corners.place[k][axis] += part * model_.texture_places[vertex][axis];
      const Rgb8 code = model_.colours.empty() ? Rgb8{255, 255, 255} : model_.colours[vertex];
      corners.colour[k][0] += part * linear[code.r];
      corners.colour[k][1] += part * linear[code.g];
      corners.colour[k][2] += part * linear[code.b];
    }
    for (std::size_t c = 0; c < 3; ++c) corners.colour[k][c] *= material.colour[c];
    corners.weight[k] = is_orthographic_ ? 1 : 1 / static_cast<double>(screen.depth[k]);
  }
  corners.turned = is_turned(screen);
  return corners;
}

bool ModelShading::is_turned(const ScreenTriangle& screen) const {
  const auto& vertices = model_.triangles[screen.triangle];
  // The triangle itself decides, since normals between its corners turn away at outlines.
  std::array<std::array<double, 3>, 2> edge{};
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t axis = 0; axis < 3; ++axis)
      edge[e][axis] = model_.positions[vertices[e + 1]][axis] - model_.positions[vertices[0]][axis];
  std::array<double, 3> across_it{}, from_camera{};
  double along_normals = 0, along_sight = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    across_it[axis] = edge[0][i] * edge[1][j] - edge[0][j] * edge[1][i];
    from_camera[axis] = is_orthographic_ ? static_cast<double>(scene_.camera.forward[axis])
                                         : model_.positions[vertices[0]][axis] - scene_.origin[axis] -
                                               static_cast<double>(scene_.camera.position[axis]);
    for (std::size_t c = 0; c < 3; ++c)
      along_normals += across_it[axis] * static_cast<double>(model_.normals[vertices[c]][axis]);
    along_sight += across_it[axis] * from_camera[axis];
  }
  return (along_normals > 0) == (along_sight > 0);
}

ModelShading::Surface::Surface(const ModelShading& shading, const ScreenTriangle& screen, const Corners& corners,
                               float view)
    : shading_(&shading),
      screen_(&screen),
      corners_(&corners),
      view_(view),
      turned_(corners.turned != screen.shows_other_side(static_cast<double>(view))) {
  std::array<double, 3> x{}, y{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = static_cast<double>(screen.x[k]) - static_cast<double>(view) * static_cast<double>(screen.disparity[k]);
    y[k] = static_cast<double>(screen.y[k]);
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  const double per_area = area != 0 ? 1 / area : 0;
  weights_by_ = u_by_ = v_by_ = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    across_[k] = (y[a] - y[b]) * per_area;
    down_[k] = (x[b] - x[a]) * per_area;
    begin_[k] = (x[a] * y[b] - x[b] * y[a]) * per_area;
    const std::array<double, 2> slopes{across_[k] * corners.weight[k], down_[k] * corners.weight[k]};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      weights_by_[axis] += slopes[axis];
      u_by_[axis] += slopes[axis] * static_cast<double>(corners.place[k][0]);
      v_by_[axis] += slopes[axis] * static_cast<double>(corners.place[k][1]);
    }
  }
}

ModelShading::Surface::Point ModelShading::Surface::at(double x, double y) const {
  std::array<double, 3> share{};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    share[k] = std::clamp(begin_[k] + across_[k] * x + down_[k] * y, 0., 1.);
    sum += share[k];
  }
  if (sum <= 0) {
    share.fill(1);
    sum = 3;
  }
  // In perspective, what the corners have weighs by 1/depth.
  std::array<double, 3> part{};
  double weights = 0, disparity = 0, depth = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    part[k] = share[k] * corners_->weight[k];
    weights += part[k];
    disparity += share[k] * static_cast<double>(screen_->disparity[k]);
  }
  disparity /= sum;
  const double per_weight = 1 / weights;
  Direction normal{};
  LinearColour colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    part[k] *= per_weight;
    depth += part[k] * static_cast<double>(screen_->depth[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[axis] += static_cast<float>(part[k]) * corners_->normal[k][axis];
      colour[axis] += static_cast<float>(part[k]) * corners_->colour[k][axis];
    }
  }
  if (corners_->texture != nullptr) {
    double u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      u += part[k] * static_cast<double>(corners_->place[k][0]);
      v += part[k] * static_cast<double>(corners_->place[k][1]);
    }
    const LinearColour textured =
        corners_->texture->at(static_cast<float>(u), static_cast<float>(v), texture_level(u, v, sum * per_weight));
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= textured[c];
  }
  const double in_centre = x + static_cast<double>(view_) * disparity;
  return {shading_->lit(normal, shading_->to_camera(in_centre, y), turned_, view_, colour),
          static_cast<float>(disparity), static_cast<float>(depth)};
}

float ModelShading::Surface::texture_level(double u, double v, double per_weight) const {
  const ModelTexture& texture = *corners_->texture;
  double most = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double du = texture.width() * (u_by_[axis] - u * weights_by_[axis]);
    const double dv = texture.height() * (v_by_[axis] - v * weights_by_[axis]);
    most = std::max(most, du * du + dv * dv);
  }
  return texture.level(static_cast<float>(std::sqrt(most) * per_weight));
}

float ModelShading::Surface::middle_level() const {
  double weights = 0, u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = corners_->weight[k] / 3;
    weights += weight;
    u += weight * static_cast<double>(corners_->place[k][0]);
    v += weight * static_cast<double>(corners_->place[k][1]);
  }
  return texture_level(u / weights, v / weights, 1 / weights);
}

ModelShading::Fineness ModelShading::fineness(const ScreenTriangle& triangle) const {
  constexpr float hardly_larger_px = 2, small_px = 8;
  if (scene_.look.shine > 0) return Fineness::by_pixel;
  const auto [left, right] = std::ranges::minmax(triangle.x);
  const float size = std::max(right - left, triangle.y[2] - triangle.y[0]);
  if (size <= hardly_larger_px) return Fineness::once;
  return size <= small_px ? Fineness::by_corner : Fineness::by_pixel;
}

std::array<LinearColour, 3> ModelShading::lit_corners(const ScreenTriangle& screen, const Corners& corners) const {
  std::array<LinearColour, 3> colours{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Direction to = to_camera(static_cast<double>(screen.x[k]), static_cast<double>(screen.y[k]));
    colours[k] = lit(corners.normal[k], to, corners.turned, 0, corners.colour[k]);
  }
  return colours;
}

LinearColour ModelShading::lit_once(const ScreenTriangle& screen, const Corners& corners) const {
  Direction normal{};
  LinearColour colour{};
  std::array<float, 2> place{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[axis] += corners.normal[k][axis];
      colour[axis] += corners.colour[k][axis] / 3;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) place[axis] += corners.place[k][axis] / 3;
  }
  if (corners.texture != nullptr) {
    // As many of the texture's pixels as there are along its longest edge, by pixel of the view.
    float texels = 0, pixels = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      texels = std::max(
          texels,
          std::hypot(static_cast<float>(corners.texture->width()) * (corners.place[next][0] - corners.place[k][0]),
                     static_cast<float>(corners.texture->height()) * (corners.place[next][1] - corners.place[k][1])));
      pixels = std::max(pixels, std::hypot(screen.x[next] - screen.x[k], screen.y[next] - screen.y[k]));
    }
    const LinearColour of_texture = corners.texture->at(place[0], place[1], corners.texture->level(texels / pixels));
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= of_texture[c];
  }
  const double x = static_cast<double>(screen.x[0] + screen.x[1] + screen.x[2]) / 3;
  const double y = static_cast<double>(screen.y[0] + screen.y[1] + screen.y[2]) / 3;
  return lit(normal, to_camera(x, y), corners.turned, 0, colour);
}

}  // namespace wheatstone
