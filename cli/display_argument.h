#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "wheatstone/app/film_presentation.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::cli {

/// A display with many views as it is typed.
struct DisplayArguments {
  std::string name;                 ///< of a preset; empty: there is none
  std::optional<PictureSize> size;  ///< of a view; none: the display's own
  int views = 0;                    ///< 0: the display's own
  float span = 0;                   ///< 0: chosen from the depth
  ViewFraming framing;              ///< of a picture of another shape
};

/// What the display wants, where the user does not say otherwise. Throws Error{wrong_usage}.
DisplayViewsOptions display_views_options(const DisplayPreset& display, const DisplayArguments& arguments);

/// --size and --span, for a --display.
Rows display_view_rows(DisplayArguments& arguments, const Reasons& unless = {});

/// --framing of what is shown in a frame of another shape; `frame` says in which, as "on the display".
Row framing_row(ViewFraming& framing, std::string_view frame, Reasons unless);

/// The names of all displays, each with a space before it.
std::string display_names(bool (*is_listed)(const DisplayPreset&) = [](const DisplayPreset&) { return true; });

/// --display, --size and --span of a film.
Rows film_display_rows(DisplayArguments& arguments, const Reasons& unless_display);

/// "SHARE:MM,SHARE:MM,...".
Value depth_regions(std::vector<DepthRegion>& regions);

/// The most depth from far to near, as a share of the width; none: "full". The default is 3%.
Value depth_budget(std::optional<float>& budget);

/// "COLUMNSxROWS".
Value quilt_layout(std::optional<QuiltLayout>& layout);

/// What each frame of a film becomes; none where no display is named. Throws Error{wrong_usage} where the display takes
/// neither quilts nor lenticular pictures.
std::optional<FilmDisplay> film_display_from(const DisplayArguments& arguments);

/// The name of a display's film: as it was typed where it has an ending, and else with the convention of quilts and
/// ".mp4".
std::string name_of_display_film(const std::string& output, const DisplayArguments& arguments);

/// As above, for a quilt of this layout, or none, whose screen has this aspect.
std::string name_of_film(const std::string& output, const std::optional<QuiltLayout>& quilt, double aspect);

/// The codec that holds frames of a display's film: H.264, or HEVC for larger ones than level 5.2 of H.264 allows,
/// which is the highest that players' hardware knows.
std::string codec_for(const FilmDisplay& display);

/// How a display's film is coded, where the user does not say otherwise: by that codec, and with colours at full size
/// under lenses.
void choose_coding(const Given& given, const FilmDisplay& display, FilmWriterOptions& writing);

}  // namespace wheatstone::cli
