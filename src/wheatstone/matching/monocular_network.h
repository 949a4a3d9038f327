#pragma once

#include <filesystem>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Inverse depth of one picture, up to scale and offset, larger is nearer, by a monocular network in an ONNX file that
/// follows the conventions of MiDaS and Depth Anything: it takes 1x3xHEIGHTxWIDTH, RGB, with ImageNet's mean and
/// deviation, and gives one number a pixel, 1xHEIGHTxWIDTH or 1x1xHEIGHTxWIDTH. A side that it leaves open becomes a
/// multiple of 224, which 14 and 32 divide. The result is as wide as the
/// network's answer and has the shape of the picture.
/// Throws Error{bad_input} where the file is no such network or cannot be run.
Image<float> depth_by_network(ImageView<const Rgb8> picture, const std::filesystem::path& model);

}  // namespace wheatstone
