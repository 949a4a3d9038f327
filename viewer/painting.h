#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "content.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/retouch.h"
#include "wheatstone/strokes/strokes_in_time.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::viewer {

/// Paints an open photograph, coarse at once and then fine: `deliver` gets the photograph with its geometry, where that
/// is not known yet, then a painting of a small copy, enlarged, then the painting as `wheatstone paint` makes it. The
/// touches are of its geometry as it was found, of its detail and of its strokes. What new ones change of the depth and
/// the strokes of a painting shows at once (follow_disparity), in the place of the coarse painting. `fits` are used and
/// kept for a photograph that is being touched, unless it is very large; once there are some, a painting for the eyes
/// comes before that for all views where nothing shows at once. Throws as paint_photograph does; what `progress` throws
/// ends it.
void paint_in_steps(const PaintedContent& open, const Style& style, std::span<const Touch> touches, StrokeFits& fits,
                    const Progress& progress, const std::function<void(PaintedContent)>& deliver);

/// A painting of a small copy of a photograph whose geometry is known, in pixels of the copy, which has at most so many
/// on its longer side. Lengths of a style count in pixels of a 640-pixel-wide picture, so that it looks as the whole.
/// `detail` is of the whole photograph; empty: it is painted evenly.
Painting small_painting(const Photograph& photograph, const Style& style, int largest_px,
                        ImageView<const std::uint8_t> detail = {}, const Progress& progress = {});

/// A film that is to be painted into a file, as `wheatstone rotoscope` does it.
struct WholeFilm {
  FilmFiles files;
  Style style;
  std::filesystem::path output;
};

/// Paints it; goes on with what an earlier run has left. Says what was done, for people. Throws as rotoscope_film.
std::string paint_whole_film(const WholeFilm& film, const Progress& progress = {});

/// Paints a film on a thread of its own. Destroyed, it stops and waits for that.
class FilmPainting {
 public:
  /// Called on that thread.
  struct Listener {
    std::function<void(std::string step, double done)> progress;  ///< the step says also how much time is left
    std::function<void(std::string message, bool is_error)> end;  ///< once
  };
  FilmPainting(WholeFilm film, Listener listener);

  void cancel() { thread_.request_stop(); }
  bool has_ended() const { return has_ended_; }

 private:
  std::atomic<bool> has_ended_ = false;
  std::jthread thread_;
};

}  // namespace wheatstone::viewer
