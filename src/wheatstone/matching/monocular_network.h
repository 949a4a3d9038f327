#pragma once

#include <filesystem>
#include <memory>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A monocular network that was read once, for many pictures.
class MonocularNetwork {
 public:
  /// Throws Error{bad_input} where the file is missing or no such network.
  explicit MonocularNetwork(const std::filesystem::path& model);
  MonocularNetwork(MonocularNetwork&&) noexcept;
  MonocularNetwork& operator=(MonocularNetwork&&) noexcept;
  ~MonocularNetwork();

  /// As depth_by_network.
  Image<float> depth_of(ImageView<const Rgb8> picture);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Inverse depth of one picture, up to scale and offset, larger is nearer, by a monocular network in an ONNX file that
/// follows the conventions of MiDaS and Depth Anything: it takes 1x3xHEIGHTxWIDTH, RGB, with ImageNet's mean and
/// deviation, and gives one number a pixel, 1xHEIGHTxWIDTH or 1x1xHEIGHTxWIDTH. A side that it leaves open becomes a
/// multiple of 224, which 14 and 32 divide. The result is as wide as the
/// network's answer and has the shape of the picture.
/// Throws Error{bad_input} where the file is no such network or cannot be run.
Image<float> depth_by_network(ImageView<const Rgb8> picture, const std::filesystem::path& model);

}  // namespace wheatstone
