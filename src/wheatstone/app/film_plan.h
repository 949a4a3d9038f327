#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/app/film_presentation.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

// A painted film that is planned in one run, drawn in parts by any number of others, and joined by a last one, with the
// bytes of a film that one run makes. The plan is a folder: `plan` (FilmPlan), for each frame, from 1 on, its complete
// marks marks_000001.wst and the pictures behind its paint, left_000001.png and right_000001.png, where the style has
// them there, with masks these, mask_left_000001.png, and the same files of what lies outside,
// outside_left_000001.png; in a dissolve all that of the shot that fades out, outgoing_marks_000001.wst; and `parts/`
// with the segments that are drawn.

/// How a planned painting is shown.
struct PlannedShowing {
  std::vector<ViewPosition> views;
  Placement placement;
  std::optional<CoveredPart> covered;
  std::optional<QuiltLayout> quilt;
  std::optional<LenticularScreen> screen;
  Device device = Device::processor;
  bool deep = false;             ///< as Presentation
  std::int32_t backgrounds = 0;  ///< pictures behind the paint: none, or one a view
  bool is_masked = false;        ///< with a mask for each view
  bool paints_outside = false;   ///< of the masks
  std::int32_t outside = 0;      ///< pictures there: none, or one a view
};

/// How a planned frame is shown, and when.
struct FrameInPlan {
  PlannedShowing shot;
  std::optional<PlannedShowing> outgoing = {};  ///< in a dissolve
  float share = 1;                              ///< of the shot's picture
  std::int64_t pts = 0;                         ///< as Frame
  Rational time_base{1, 1};
  std::int64_t duration = 0;
};

struct FilmPlan {
  std::string version;                     ///< of the program: another one may draw other bytes
  std::filesystem::path film, right_film;  ///< to be made; `right_film` is empty where both eyes are in one
  FilmWriterOptions writing;
  std::string anaglyph;         ///< as RotoscopeFilmOptions
  int frames_per_segment = 48;  ///< as SegmentOptions
  std::vector<FrameInPlan> frames;
};

/// Reads the description of a plan. Throws Error{bad_input} where there is none, it is damaged, or another version of
/// the program than `version` made it.
FilmPlan read_film_plan(const std::filesystem::path& folder, std::string_view version);

/// Frames of a film, counted from 1, the last included.
struct FrameRange {
  std::int64_t first = 1, last = 1;
};

/// The frames of one of so many parts of about as many segments each; `last` before `first` where there are more parts
/// than segments.
FrameRange frames_of_part(const FilmPlan& plan, std::int64_t number, std::int64_t parts);

struct DrawnPart {
  std::int64_t frames = 0;        ///< that were drawn
  std::int64_t drawn_before = 0;  ///< frames of the range that were there
  double worst_bare_share = 0;    ///< of the pixels of an eye or a view of the frames that were drawn, 0..1
  double seconds = 0;
  double core_seconds = 0;  ///< of processors
};

/// Draws and encodes the segments that begin in a range of frames and are not there yet, so that ranges that divide the
/// film draw each frame once. Any number of processes may draw different parts at the same time. Throws
/// Error{wrong_usage} for a range that is not in the film, Error{bad_input} for damaged marks, and as `present` and
/// FilmWriter. What is interrupted leaves the segments that are whole.
DrawnPart draw_film_part(const std::filesystem::path& folder, const FilmPlan& plan, FrameRange range,
                         const Progress& progress = {});

/// Joins the segments of a plan to the film `plan.film`, with the sound, chapters and timecode of the source. The plan
/// stays. Returns what the user should know. Throws Error{bad_input} that names the first frames that are not drawn,
/// and as FilmWriter; then it leaves nothing.
std::vector<std::string> join_film_parts(const std::filesystem::path& folder, const FilmPlan& plan,
                                         const Progress& progress = {});

}  // namespace wheatstone
