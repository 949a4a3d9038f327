#pragma once

#include <functional>
#include <memory>
#include <string>

#include "content.h"
#include "jobs.h"
#include "wheatstone/image/image.h"
#include "wheatstone/marks/style.h"

namespace wheatstone::viewer {

/// A photograph painted small, as the left eye sees it. Its geometry must be known. Throws as plan_painting, and what
/// `progress` throws.
Image<Rgb8> preview_of(const Photograph& photograph, const Style& style, int largest_px, const Progress& progress = {});

/// Paints a photograph small in every preset, one after the other, on a thread of its own.
class StylePreviews {
 public:
  /// Called on that thread with each that is done.
  using Deliver = std::function<void(std::shared_ptr<const Photograph>, std::string style, Image<Rgb8>)>;
  explicit StylePreviews(Deliver deliver) : deliver_(std::move(deliver)) {}

  /// Begins, and leaves what was begun of another photograph. None, or one whose geometry is not known yet: only that.
  void show(const std::shared_ptr<const Photograph>& photograph);
  /// Whether previews of this photograph have been begun.
  bool are_of(const Photograph* photograph) const { return begun_.get() == photograph; }

 private:
  Deliver deliver_;
  std::shared_ptr<const Photograph> begun_;
  NewestJob painting_;  ///< last: it ends first
};

}  // namespace wheatstone::viewer
