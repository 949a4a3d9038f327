#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

/// Takes views where the graphics processor draws them. All is called within on_gpu(), and gone when that ends.
struct GpuViewSink {
  std::size_t at_least = 1;  ///< views that it must take together
  /// Which pixels of so many views from `first` on are wanted: a bit each, rows of whole words, view by view; other
  /// pixels may then be left undrawn. Empty: all are.
  std::function<GpuBuffer(std::size_t first, std::size_t count)> wanted = {};
  /// Takes so many views from `first` on: their pixels, packed, view by view.
  std::function<void(const GpuBuffer& pixels, std::size_t first, std::size_t count)> take = {};
  std::function<void()> finish = {};  ///< called at the end
};

/// Draws views of a painting that the graphics processor keeps, and leaves them in its memory. Returns the largest
/// share of a view's wanted pixels that marks cover less than half; nothing where the processor is to draw, and the
/// sink has taken nothing of use: where it draws the painting anyway, where not enough views fit at once, or where the
/// graphics processor fails that nobody asked for. Throws as `draw` does.
std::optional<double> draw_on_gpu(const PreparedPainting& painting, std::span<const ViewPosition> views,
                                  const std::function<GpuViewSink(const GpuFacts&)>& make_sink);

}  // namespace wheatstone
