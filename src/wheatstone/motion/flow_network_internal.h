#pragma once

#include "wheatstone/motion/flow.h"

namespace wheatstone {

/// As estimate_flow with FlowMethod::onnx.
FlowPair flow_by_network(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const FlowOptions& options);

}  // namespace wheatstone
