#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

/// Receives views in the memory of the graphics processor. The sink is used only within on_gpu(), and destroyed when
/// that ends.
struct GpuViewSink {
  std::size_t at_least = 1;  ///< number of views that it must receive together
  /// Which pixels of so many views from `first` on are wanted: a bit each, rows of whole words, view by view; other
  /// pixels may then be left undrawn. Empty: all are.
  std::function<GpuBuffer(std::size_t first, std::size_t count)> wanted = {};
  /// Takes so many views from `first` on: their pixels, packed, view by view.
  std::function<void(const GpuBuffer& pixels, std::size_t first, std::size_t count)> take = {};
  std::function<void()> finish = {};  ///< called at the end
};

/// Draws views of a painting that the graphics processor keeps, and leaves them in its memory. Returns the largest
/// share of a view's wanted pixels that marks cover less than half. Returns nothing if the processor must draw instead;
/// what the sink has received is then of no use. This happens if the processor draws the painting anyway, if not enough
/// views fit at once, or if a graphics processor fails that was not asked for explicitly. Throws as `draw` does.
std::optional<double> draw_on_gpu(const PreparedPainting& painting, std::span<const ViewPosition> views,
                                  const std::function<GpuViewSink(const GpuFacts&)>& make_sink);

}  // namespace wheatstone
