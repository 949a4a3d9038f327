#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {
namespace {

using Vector = std::array<float, 3>;

float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector scaled(const Vector& a, float factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector of_length_one(const Vector& a) { return scaled(a, 1 / std::max(std::sqrt(dot(a, a)), 1e-30f)); }

/// To the lamp, behind the viewer at the upper left.
Vector to_lamp(const Camera& camera) {
  return of_length_one(
      sum(scaled(camera.right, -0.5f), sum(scaled(camera.down, -0.7f), scaled(camera.forward, -0.6f))));
}

/// To the central eye.
Vector to_eye(const Camera& camera, const Vector& at) {
  if (camera.orthographic_depth > 0) return scaled(camera.forward, -1);
  return of_length_one(sum(camera.position, scaled(at, -1)));
}

/// How clearly a change of log2 density over the radius of a kernel makes a surface: noise makes none.
float clearness(const Vector& slope) {
  const float square = dot(slope, slope);
  return square / (square + 0.25f);
}

template <class Value>
void append_chosen(std::vector<Value>& to, const std::vector<Value>& from, const std::vector<std::uint32_t>& chosen) {
  if (from.empty()) return;
  to.reserve(chosen.size());
  for (const std::uint32_t i : chosen) to.push_back(from[i]);
}

}  // namespace

float ShiningParticles::Facing::at(float turn, float sharpness) const {
  const float along = cosine + turn * cosine_a_radian;
  if (along <= 0) return 0;
  return light * std::pow(along * along / (square + turn * (square_a_radian + turn)), sharpness / 2);
}

ShiningParticles::ShiningParticles(const Cloud& chunk, const Scene& scene, std::span<const ViewPosition> views)
    : shine_(scene.shine) {
  const Camera& camera = scene.camera;
  const Vector lamp = to_lamp(camera);
  constexpr std::size_t block = 16384;
  const std::size_t blocks = (chunk.size() + block - 1) / block;
  std::vector<std::vector<Facing>> facing(blocks);
  std::vector<std::vector<std::uint32_t>> chosen(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min((b + 1) * block, chunk.size()); ++i) {
      const Vector at{chunk.x[i], chunk.y[i], chunk.z[i]};
      const Vector slope = shine_.grid->slope(at[0], at[1], at[2]);
      const Vector normal = scaled(of_length_one(slope), -1);
      // Twice the direction half way between the lamp and the eye.
      const Vector half = sum(lamp, to_eye(camera, at));
      const Facing of_one{.cosine = dot(normal, half),
                          .cosine_a_radian = dot(normal, camera.right),
                          .square = dot(half, half),
                          .square_a_radian = 2 * dot(half, camera.right),
                          .light = shine_.strength * clearness(slope)};
      constexpr float least = 1.f / 256;
      if (std::ranges::none_of(views, [&](ViewPosition view) { return light_of(of_one, view) > least; })) continue;
      facing[b].push_back(of_one);
      chosen[b].push_back(static_cast<std::uint32_t>(i));
    }
  });
  std::vector<std::uint32_t> all;
  for (std::size_t b = 0; b < blocks; ++b) {
    all.insert(all.end(), chosen[b].begin(), chosen[b].end());
    facing_.insert(facing_.end(), facing[b].begin(), facing[b].end());
  }
  for_each_column(cloud_, chunk, [&](auto& to, const auto& from) { append_chosen(to, from, all); });
  cloud_.origin = chunk.origin;
  // The highlight of a fading particle fades with it.
  for (std::size_t i = 0; i < cloud_.presence.size(); ++i) facing_[i].light *= cloud_.presence[i];
  cloud_.presence.resize(cloud_.size());
}

const Cloud& ShiningParticles::seen_from(ViewPosition view) {
  tbb::parallel_for(std::size_t{0}, facing_.size(),
                    [&](std::size_t i) { cloud_.presence[i] = light_of(facing_[i], view); });
  return cloud_;
}

void for_each_chunk_and_highlights(const RenderJob& job, std::span<const ViewPosition> views,
                                   const std::function<void(const Cloud& chunk)>& common,
                                   const std::function<void(const Cloud& shining, std::size_t view)>& highlights) {
  job.chunks([&](const Cloud& chunk) {
    common(chunk);
    if (!job.scene.shine.lit()) return;
    ShiningParticles shining(chunk, job.scene, job.rig.positions);
    if (!anywhere(!shining.empty(), job.ranks)) return;
    for (std::size_t v = 0; v < views.size(); ++v) highlights(shining.seen_from(views[v]), v);
  });
}

std::vector<ViewPosition> shine_keys(const Shine& shine, std::span<const ViewPosition> views) {
  // A highlight is about 1/√sharpness wide, in radians, and moves by half of what the direction of sight turns.
  const auto [first, last] = std::ranges::minmax(views);
  const float widths = (last - first) * shine.turn / 2 * std::sqrt(shine.sharpness);
  const int steps = widths > 0 ? static_cast<int>(std::ceil(2 * widths)) : 0;
  std::vector<ViewPosition> keys{first};
  for (int i = 1; i <= steps; ++i)
    keys.emplace_back(first.eye_separations() + (last - first) * static_cast<float>(i) / static_cast<float>(steps));
  return keys;
}

std::vector<std::vector<float>> shares_of_keys(std::span<const ViewPosition> keys,
                                               std::span<const ViewPosition> views) {
  std::vector<std::vector<float>> shares(views.size(), std::vector<float>(keys.size(), 0.f));
  const auto steps = static_cast<float>(keys.size() - 1);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const float at =
        keys.size() > 1 ? std::clamp((views[v] - keys.front()) / (keys.back() - keys.front()) * steps, 0.f, steps) : 0;
    const auto key = std::min(static_cast<std::size_t>(at), keys.size() - 1);
    shares[v][key] = 1 - (at - static_cast<float>(key));
    if (key + 1 < keys.size()) shares[v][key + 1] = at - static_cast<float>(key);
  }
  return shares;
}

}  // namespace wheatstone
