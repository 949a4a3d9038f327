#pragma once

#include <string>

#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

/// Light as a byte: 0 is dark, and 1 to `steps` are even steps of a logarithm from `least` to `most`.
struct LightCode {
  float least = 1, most = 1;
  int steps = 255;
};

/// What page/slices.ts finds at each pixel of a slice: `light` alone, with a `share` that it is multiplied by for the
/// second number, with a `mean` likewise that may be any number, or three of `colours`.
enum class SliceChannels { light, share, mean, colours };

/// A slice in few bytes: of each of its channels the difference of each pixel from what its neighbours let expect,
/// deflated.
PagePart slice_part(std::string name, const Slice& slice, SliceChannels channels, bool has_alpha,
                    const LightCode& code);

/// The stack at half its width and height.
SliceStack halved(const SliceStack& stack);

}  // namespace wheatstone
