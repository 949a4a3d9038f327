#pragma once

#include "wheatstone/painting/plan_for_eyes.h"
#include "wheatstone/painting/present.h"

namespace wheatstone {

/// A frame of a film as its marks show it to the film's own eyes, or to the one view there is.
struct PaintedFrame {
  Painting painting;
  Presented shown;
  StrokeCounts counts;
};

inline PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                                PaintingMemory& memory, const Progress& progress = {}) {
  PlannedFrame planned = plan_for_eyes(frame, style, options, memory, progress);
  report(progress, "drawing", 0);
  Presentation presentation;
  for (const ViewPosition eye : {left_eye, right_eye})
    for (const View& view : frame.views)
      if (view.position == eye) presentation.views.push_back(eye);
  if (presentation.views.empty()) presentation.views = {frame.views.front().position};
  if (style.background == Background::photograph)
    for (const ViewPosition eye : presentation.views)
      for (const View& view : frame.views)
        if (view.position == eye) presentation.backgrounds.emplace_back(view.colour);
  Presented shown = present(planned.painting, presentation);
  return {std::move(planned.painting), std::move(shown), planned.counts};
}

}  // namespace wheatstone
