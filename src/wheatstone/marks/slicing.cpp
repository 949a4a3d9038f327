#include "wheatstone/marks/slicing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

float depth_of(const Layer& layer, const Stroke& stroke) {
  double sum = 0;
  for (const ControlPoint& point : layer.points_of(stroke)) sum += point.disparity;
  return static_cast<float>(sum / std::max<std::uint32_t>(stroke.point_count, 1));
}

/// Disparities of the nearest stroke and the farthest.
struct StrokeEnds {
  float nearest_px = -std::numeric_limits<float>::infinity(), farthest_px = std::numeric_limits<float>::infinity();
};

StrokeEnds ends_of(std::span<const Layer> layers) {
  StrokeEnds ends;
  for (const Layer& layer : layers) {
    for (const Stroke& stroke : layer.strokes) {
      const float disparity = depth_of(layer, stroke);
      ends.nearest_px = std::max(ends.nearest_px, disparity);
      ends.farthest_px = std::min(ends.farthest_px, disparity);
    }
  }
  return ends;
}

/// In pixels of the painting.
float disparity_at(const SliceDepth& depth, const StrokeEnds& ends) {
  return depth.is_share ? std::lerp(ends.nearest_px, ends.farthest_px, depth.value) : depth.value;
}

std::optional<SliceDepth> parsed_depth(std::string_view text) {
  SliceDepth depth;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), depth.value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  constexpr float largest_disparity_px = 65535;
  depth.is_share = unit == "%";
  const bool fits = depth.is_share ? depth.value >= 0 && depth.value <= 100
                                   : unit == "px" && std::abs(depth.value) <= largest_disparity_px;
  if (error != std::errc() || !fits) return {};
  if (depth.is_share) depth.value /= 100;
  return depth;
}

}  // namespace

std::vector<SliceDepth> parse_slice_depths(std::string_view text, std::string_view name) {
  std::vector<SliceDepth> depths;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<SliceDepth> depth = parsed_depth(text.substr(begin, end - begin));
    if (!depth)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: is '{}', expected a share of the way from the nearest to the farthest, from 0% to "
                              "100%, or a disparity, as 12px; or several of them, as 20%,40%",
                              name, text));
    depths.push_back(*depth);
    begin = end + 1;
  }
  return depths;
}

std::string slice_depths_text(std::span<const SliceDepth> depths) {
  std::string text;
  for (const SliceDepth& depth : depths)
    text += fmt::format("{}{:g}{}", text.empty() ? "" : ",", depth.is_share ? 100 * depth.value : depth.value,
                        depth.is_share ? "%" : "px");
  return text;
}

std::vector<SliceDepth> planes_between(std::span<const SliceDepth> from, std::span<const SliceDepth> to, float share,
                                       std::string_view name) {
  const bool fits = std::ranges::equal(from, to, {}, &SliceDepth::is_share, &SliceDepth::is_share);
  if (!fits)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected as many depths as '{}', in the same units",
                                                    name, slice_depths_text(to), slice_depths_text(from)));
  std::vector<SliceDepth> planes(from.begin(), from.end());
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i].value = std::lerp(from[i].value, to[i].value, share);
  return planes;
}

std::vector<float> shares_of(std::span<const SliceDepth> depths, const Painting& painting) {
  const StrokeEnds ends = ends_of(layers_of(painting));
  std::vector<float> shares;
  for (const SliceDepth& depth : depths) {
    const float way_px = ends.farthest_px - ends.nearest_px;
    const float share = way_px < 0 ? (disparity_at(depth, ends) - ends.nearest_px) / way_px : 0;
    shares.push_back(std::clamp(depth.is_share ? depth.value : share, 0.f, 1.f));
  }
  return shares;
}

Painting sliced(Painting painting, const Slicing& slicing) {
  auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  if (strokes == nullptr || strokes->layers.empty()) return painting;
  const StrokeEnds ends = slicing.depths.empty() ? StrokeEnds() : ends_of(strokes->layers);
  std::vector<float> planes_px;
  for (const SliceDepth& depth : slicing.depths) planes_px.push_back(disparity_at(depth, ends));
  const auto last = static_cast<std::size_t>(std::max(slicing.finest_layer, 0));
  if (last + 1 < strokes->layers.size()) strokes->layers.resize(last + 1);
  for (std::size_t i = 0; i < std::min(planes_px.size(), strokes->layers.size()); ++i) {
    Layer& layer = strokes->layers[strokes->layers.size() - 1 - i];
    const auto is_cut = [&](const Stroke& stroke) {
      const float disparity = depth_of(layer, stroke);
      return slicing.keeps == SliceKeeps::back ? disparity > planes_px[i] : disparity < planes_px[i];
    };
    if (std::ranges::none_of(layer.strokes, is_cut)) continue;
    number_by_place(layer);
    std::erase_if(layer.strokes, is_cut);
  }
  return painting;
}

}  // namespace wheatstone
