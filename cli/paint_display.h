#pragma once

#include <string>

#include "paint_arguments.h"
#include "photograph_run.h"
#include "wheatstone/app/display_views.h"
#include "wheatstone/depth/display_presets.h"
#include "write_views_output.h"

namespace wheatstone::cli {

/// Where the results of one photograph go, and all that is read.
ViewsOutput output_of(const PaintArguments& arguments, const std::string& name);

/// What a display wants, where the user does not say otherwise.
DisplayViewsOptions views_options(const PaintArguments& arguments, const DisplayPreset& display);

/// A report that ends with where the results are.
PhotographResult with_place(Report report, std::string written);

/// Paints a photograph for the display that is named, and writes its views.
PhotographResult paint_for_display(const PaintArguments& arguments, const PhotographJob& job,
                                   const PaintSubject& subject, const PaintPhotographOptions& painting,
                                   const Session& session);

/// Draws a painting from its file again, for two eyes or for a display, and writes the pictures.
Report draw_painting_again(const PaintArguments& arguments, const Session& session);

}  // namespace wheatstone::cli
