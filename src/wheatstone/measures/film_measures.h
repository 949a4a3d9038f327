#pragma once

#include <optional>

#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// How much a film flickers from a frame to the next, beyond its motion (Lai et al. 2018): with the mask M of what is
/// confirmed, Σ M (warp(I₂, F) − I₁)² / Σ M. Squares are the mean over the three channels, of 0..1; the second frame
/// is taken bilinearly where the flow leads. Noise of deviation σ, new in each frame, adds 2σ² where the flow is whole
/// pixels, and down to 1.25σ² where it is halves both ways, since interpolation averages.
struct WarpError {
  double error = 0;
  double compared_share = 0;  ///< of the pixels, Σ M; 0 where nothing could be compared
};

/// `forward` is the first frame's flow, `mask` other than 0 where it counts. Throws Error{bad_input} where sizes
/// differ.
WarpError measure_warp_error(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const Flow& forward,
                             ImageView<const std::uint8_t> mask);

/// How two frames of a film belong together, found in the film that other films were made from.
struct FramePair {
  Flow forward;
  Image<std::uint8_t> mask;
  bool cut = false;  ///< then flow and mask mean nothing
};

/// From the frames themselves: whether there is a cut, and the flow with its confirmed part.
FramePair relate_frames(ImageView<const Rgb8> first, ImageView<const Rgb8> second);

/// True where no pixel's flow is known, by which a known flow tells a cut.
bool tells_cut(const FlowPair& known);

/// From a known flow.
FramePair relate_frames(FlowPair truth);

/// The temporal error E_warp of a film: the mean over its pairs of frames, cuts left out.
class TemporalError {
 public:
  /// Adds the next pair of frames. Nothing where there is a cut or nothing could be compared.
  std::optional<WarpError> add(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const FramePair& pair);

  double mean() const { return pairs_ == 0 ? 0 : sum_ / pairs_; }
  double compared_share() const { return pairs_ == 0 ? 0 : compared_ / pairs_; }
  int pairs() const { return pairs_; }  ///< that were compared

 private:
  double sum_ = 0, compared_ = 0;
  int pairs_ = 0;
};

}  // namespace wheatstone
