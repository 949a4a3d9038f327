#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/render_particles.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// The views of frame 0, 1, … of a film.
using FrameSource = std::function<RenderedParticles(int frame, const Progress& progress)>;

struct RenderFilmOptions {
  int frames = 1;
  FilmWriterOptions writing;               ///< `layout` says how two views lie in a frame
  std::optional<QuiltLayout> quilt;        ///< a frame is a quilt
  std::optional<LenticularScreen> screen;  ///< or one picture for lenses
  std::filesystem::path slices;            ///< "slices_%04d.exr" also keeps each frame's slices, from 1 on; empty: no
  int frames_between_checkpoints = 48;
  bool resume = false;  ///< continue the unfinished film of an earlier run; without it, such a film is an error
  std::string made_by;  ///< the program's version and whatever else decides the frames
  std::vector<std::filesystem::path> made_from;  ///< the sources' files or patterns
  std::vector<int> only;                         ///< numbered pictures: these frames, from 1 on; empty: all
  bool skip_existing = false;                    ///< numbered pictures: not those whose file is there
  Ranks ranks;
  /// Each rank makes whole frames, and the source shares no work; else all make each frame, which is whole at the
  /// first.
  bool whole_frames = false;
};

struct RenderedFilm {
  int frames = 0;          ///< of the film, or that were asked for
  int resumed_frames = 0;  ///< of these, an earlier run made
  int skipped_frames = 0;  ///< of these, their pictures were there
  RenderedParticles last;  ///< what became of the last frame that was rendered, without its views and slices
  std::vector<std::string> notes;
};

/// "1-240x2,300" as 1, 3, … 239, 300: what of a film of so many frames there is; what lies beyond its end is left out.
/// Throws Error{wrong_usage}, beginning with `name`, for any other text, and where all lies beyond the end.
std::vector<int> parse_frame_range(const std::string& text, int frames, const std::string& name);

/// Writes a film (.mp4, .mov, .mkv), or numbered pictures ("frame_%04d.png", from 1 on), of which each is whole or not
/// there. A film that is stopped is kept as a painted one is (rotoscope_film.h), and gives the same bytes when it is
/// resumed. Throws as the source and the writer do, and UnfinishedFilm{interrupted}.
RenderedFilm render_film(const FrameSource& source, const std::filesystem::path& output,
                         const RenderFilmOptions& options, const Progress& progress = {});

}  // namespace wheatstone
