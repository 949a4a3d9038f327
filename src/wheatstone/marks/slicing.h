#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// A place along the line of sight: a share of the way from the nearest of a painting's strokes, 0, to the farthest, 1,
/// or a disparity in pixels of the painting.
struct SliceDepth {
  float value = 0;
  bool is_share = true;
  friend bool operator==(const SliceDepth&, const SliceDepth&) = default;
};

/// Of one plane or more: "20%", "12px", "20%,40%". Throws Error{wrong_usage}, in which the text is called `name`.
std::vector<SliceDepth> parse_slice_depths(std::string_view text, std::string_view name);
std::string slice_depths_text(std::span<const SliceDepth> depths);

/// Planes on their way from `from`, at `share` 0, to `to`, at 1. Throws Error{wrong_usage} that begins with `name`
/// where these are not as many, or one is a share and the other a disparity.
std::vector<SliceDepth> planes_between(std::span<const SliceDepth> from, std::span<const SliceDepth> to, float share,
                                       std::string_view name);

/// How far the planes are on the way from the nearest of a painting's strokes to the farthest, from 0 to 1.
std::vector<float> shares_of(std::span<const SliceDepth> depths, const Painting& painting);

/// The strokes of a sliced layer that stay.
enum class SliceKeeps { back, front };

/// What of a painting's strokes is shown: the layers up to one, and of that one the strokes on one side of a plane
/// normal to the line of sight, which reveals the coarser layers under the others (Stavrakis & Gelautz 2005, sec. 3.3).
/// Coarser layers may have planes of their own.
struct Slicing {
  int finest_layer = 1 << 20;        ///< number of the last layer that is shown, from the coarsest, 0
  std::vector<SliceDepth> depths{};  ///< of the planes, from that of the finest layer on; layers without one are whole
  SliceKeeps keeps = SliceKeeps::back;
  friend bool operator==(const Slicing&, const Slicing&) = default;
};

/// A stroke's depth is the mean disparity of its points: it stays as a whole or not at all. Nothing changes a painting
/// of other marks.
Painting sliced(Painting painting, const Slicing& slicing);

}  // namespace wheatstone
