#include "wheatstone/strokes/layer_order.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/random.h"

namespace wheatstone {
namespace {

/// Puts a layer's strokes where `places` name them.
template <class Ordered>
void put_in_order(const std::vector<Ordered>& places, Layer& layer) {
  std::vector<Stroke> sorted;
  sorted.reserve(places.size());
  for (const Ordered& place : places) sorted.push_back(layer.strokes[place.stroke]);
  layer.strokes = std::move(sorted);
}

void sort_numbered_far_to_near(Layer& layer, std::uint64_t seed) {
  struct Ordered {
    float depth;
    std::uint32_t stroke;
  };
  std::vector<Ordered> places(layer.strokes.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Stroke& stroke = layer.strokes[i];
    places[i] = {stroke.disparity + unit_float(hash_keys({seed, stroke.number})), i};
  }
  std::ranges::sort(places, [](const Ordered& a, const Ordered& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.stroke < b.stroke;
  });
  put_in_order(places, layer);
}

}  // namespace

void append_strokes(const Layer& part, Layer& whole) {
  const auto offset = static_cast<std::uint32_t>(whole.points.size());
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  for (Stroke stroke : part.strokes) {
    stroke.first_point += offset;
    whole.strokes.push_back(stroke);
  }
}

void sort_far_to_near(Layer& layer, std::uint64_t seed) {
  struct Ordered {
    std::int32_t depth;
    std::uint32_t stroke;
    std::uint64_t random;
  };
  std::vector<Ordered> places(layer.strokes.size());
  for (std::uint32_t i = 0; i < places.size(); ++i)
    places[i] = {static_cast<std::int32_t>(std::lround(layer.strokes[i].disparity)), i, hash_keys({seed, i})};
  std::ranges::sort(places, [](const Ordered& a, const Ordered& b) {
    if (a.depth != b.depth) return a.depth < b.depth;
    return a.random != b.random ? a.random < b.random : a.stroke < b.stroke;
  });
  put_in_order(places, layer);
}

void put_in_order(Layer& layer, const Style& style) {
  if (style.marks == Marks::fitted_strokes) {
    std::ranges::stable_sort(layer.strokes, {}, &Stroke::number);
  } else {
    sort_numbered_far_to_near(layer, style.seed);
  }
}

}  // namespace wheatstone
