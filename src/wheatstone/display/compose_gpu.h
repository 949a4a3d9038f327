#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "wheatstone/display/compose.h"
#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

/// The views that a picture is composed of.
struct ViewsToCompose {
  int width = 0, height = 0;  ///< of each
  std::size_t count = 0;
};

/// Composes views in the memory of the graphics processor, some at a time, in one pass: each sub-pixel of the picture
/// is read from its view. Made and used within on_gpu().
class GpuComposer {
 public:
  /// Throws Error{wrong_usage} where the views do not fit the composition, and where the graphics processor does not
  /// compose it or has no room for the picture.
  GpuComposer(const DisplayComposition& composition, const ViewsToCompose& views, const GpuFacts& facts);
  GpuComposer(const GpuComposer&) = delete;
  GpuComposer& operator=(const GpuComposer&) = delete;
  ~GpuComposer();

  /// So many views from the memory of the processor are taken at once, at most and at least.
  std::size_t views_at_once() const;
  std::size_t least_at_once() const;

  /// The share of the views' pixels of which the picture shows anything, at most (Hassaine 2010, sec. 6.5.2).
  double shown_share() const;

  /// These pixels: a bit each, rows of whole words, view by view. Of what is under lenses.
  GpuBuffer shown(std::size_t first, std::size_t count) const;

  /// Takes views from `first` on: their pixels, packed, one view after the other.
  void take(const GpuBuffer& pixels, std::size_t first, std::size_t count);
  void take(std::span<const Image<Rgb8>> views, std::size_t first);

  /// The picture, when all views have been taken.
  Image<Rgb8> picture() const;

 private:
  struct Parts;
  void run(const GpuBuffer& pixels, std::size_t first, std::size_t count, const GpuBuffer& to, bool marks) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace wheatstone
