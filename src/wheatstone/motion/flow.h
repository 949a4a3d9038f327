#pragma once

#include <filesystem>

#include "wheatstone/image/image.h"
#include "wheatstone/matching/match.h"

namespace wheatstone {

/// Where each pixel of a frame goes, in pixels: what is at (x, y) in this frame is at (x + flow.x, y + flow.y) in the
/// other. Both images have the frame's size; NaN is unknown.
struct Flow {
  Image<float> x, y;
};

/// The flow between two frames in both directions: `forward` belongs to the first frame's pixels, `backward` to the
/// second's.
struct FlowPair {
  Flow forward, backward;
};

enum class FlowMethod {
  farneback,  ///< polynomial expansion (Farnebäck 2003): the one that the rotoscoping paper uses
  dis,        ///< dense inverse search (Kroeger et al. 2016): faster, and keeps motion edges better
  onnx        ///< the user's own network
};

struct FlowOptions {
  FlowMethod method = FlowMethod::dis;
  const FlowPair* start = nullptr;  ///< of the frames before, of the same size: where to start from; borrowed
  double size = 1;                  ///< estimated in copies of this share of the frames' width, above 0 and up to 1
  /// For onnx: takes the two frames, 1x3xHEIGHTxWIDTH each, or 1x6xHEIGHTxWIDTH together, and answers 1x2xHEIGHTxWIDTH:
  /// the flow across and down, in pixels of what went in, as exports of RAFT (Teed & Deng 2020) do. Of several answers
  /// the last counts. A side that it leaves open becomes a multiple of 32. It starts from no other flow.
  std::filesystem::path model;
  NetworkValues model_values = NetworkValues::to_255;
};

/// Estimates the flow between two frames, by OpenCV, on their luminance or with a network. Throws Error{bad_input}
/// where they, or the flow to start from, differ in size, and where the network is missing, or no such one.
FlowPair estimate_flow(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const FlowOptions& options = {});

/// True where a step forward and the step back from where it leads undo each other (Sundaram et al. 2010):
/// |f + b|² ≤ 0.01 (|f|² + |b|²) + 0.5. False for the unknown.
inline bool undo_each_other(float forward_x, float forward_y, float backward_x, float backward_y) {
  const float sum_x = forward_x + backward_x, sum_y = forward_y + backward_y;
  const float forward_square = forward_x * forward_x + forward_y * forward_y;
  const float backward_square = backward_x * backward_x + backward_y * backward_y;
  return sum_x * sum_x + sum_y * sum_y <= 0.01f * (forward_square + backward_square) + 0.5f;
}

/// 255 for the pixels whose flow the other direction confirms, 0 elsewhere (Sundaram et al. 2010; Ruder et al. 2016):
/// with own flow b at a pixel, and the other frame's flow f where b leads, a pixel is left out where
/// |f + b|² > 0.01 (|f|² + |b|²) + 0.5, which occlusion does, or |∇b|² > 0.01 |b|² + 0.002, which motion edges do; also
/// where b is unknown or leads out of the picture. For the first frame's pixels, own is the forward flow. Gradients
/// are central differences. Throws Error{bad_input} where sizes differ.
Image<std::uint8_t> confirmed(const Flow& own, const Flow& other);

/// A value between pixels, interpolated bilinearly. (x, y) is a place of the picture, pixel centres at halves; beyond
/// the outermost centres the border continues. Undefined for NaN; the picture must not be empty.
float sample(ImageView<const float> image, float x, float y);

/// The colour there, channels 0..255.
struct SampledColour {
  float r = 0, g = 0, b = 0;
};
SampledColour sample(ImageView<const Rgb8> image, float x, float y);

/// How unlike two frames are that follow each other.
struct FrameChange {
  double histogram_distance = 0;  ///< share of the pixels that would have to change colour, of 8³ colours: 0..1
  double confirmed_share = 0;     ///< of the pixels whose flow is confirmed, in small pictures
  bool cut = false;               ///< another scene begins with the second frame
  FlowPair flow;                  ///< between small copies of the frames, in pixels of these
};

/// Tells a cut from motion: at a cut the colours change at once and the flow is not confirmed. Throws Error{bad_input}
/// where the sizes differ.
FrameChange find_cut(ImageView<const Rgb8> first, ImageView<const Rgb8> second);

}  // namespace wheatstone
