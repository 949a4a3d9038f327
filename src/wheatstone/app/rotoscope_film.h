#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/film_scenes.h"
#include "wheatstone/app/film_shots.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

struct RotoscopeFilmOptions {
  RotoscopeOptions frames;
  std::vector<FilmShot> shots;  ///< as options_of_frame takes them; empty: cuts are found, and all is painted alike
  /// A new painting for every second frame only, and where a shot begins; other frames show the one before again. Needs
  /// `shots`, so that no frame is looked at in vain, and an even `frames_between_checkpoints`.
  bool on_twos = false;
  FilmReaderOptions reading;  ///< that the source was opened with: they decide which frames there are
  FilmWriterOptions writing;  ///< `layout` says how the eyes lie in a painted frame
  std::string anaglyph;       ///< an anaglyph_kind's name: two eyes in one picture for coloured glasses; empty: none
  /// The film of the right eye, where the output is that of the left eye alone; empty: both eyes are in the output.
  std::filesystem::path right_film;
  std::filesystem::path marks;  ///< "marks_%04d.wst" also keeps each frame's marks, from 1 on; empty: no
  /// A folder that gets the film's plan (film_plan.h): frames are planned and not drawn; `writing` and the output say
  /// what is to be made of them. Empty: the film is made at once.
  std::filesystem::path plan;
  std::string version;  ///< of the program, for a plan
  int frames_between_checkpoints = 48;
  bool resume = false;      ///< continue the unfinished film of an earlier run; without it, such a film is an error
  bool keep_going = false;  ///< a damaged source is a note, not an error
  std::string made_by;      ///< the program's version and whatever else decides the frames
  std::vector<std::filesystem::path> made_from;  ///< the sources' files
  std::int64_t expected_frames = 0;              ///< of all, for telling how long it takes; 0: not known
  KnownFrames known;                             ///< empty: nothing is known
  FilmMask mask;                                 ///< where frames are painted; empty: everywhere
  /// Several ranks paint the film together: each paints whole scenes, and the first writes the film, with the same
  /// bytes. In this case `scenes` are the film's (find_scenes), or begin with cuts_of its shots, and `known`
  /// gives no flow.
  Ranks ranks;
  FilmScenes scenes;
};

struct RotoscopedFilm {
  std::int64_t frames = 0;
  std::int64_t resumed_frames = 0;  ///< of these, an earlier run painted
  RotoscopeTotals totals;
  double seconds = 0;       ///< that this run took for its frames
  double core_seconds = 0;  ///< of processors
  RotoscopeTimes times;
  PaintingTimes painting_times;
  std::vector<std::string> notes;   ///< what the user should know
  std::optional<std::string> loss;  ///< damage of the source, with keep_going
};

/// Everything in the options that decides a byte of the painted frames and marks, as text. `writing` is not in it.
std::string recipe_of(const RotoscopeFilmOptions& options);

/// Says which part of a film a stopped run has kept, as "the first 8 frames are kept in a.mp4.part"; none if it has
/// kept nothing.
std::optional<std::string> unfinished_film(const std::filesystem::path& output, const std::filesystem::path& marks);

/// Paints a film (Bukenberger et al. 2015) into another, frame by frame, in memory that does not grow with its length.
/// Every `frames_between_checkpoints` frames all that the rest depends on is saved beside the output, in
/// "OUTPUT.part"; a run that is killed and resumed gives the same film. Marks get their names when the film is whole;
/// until then they lie in "MARKS.part". A run that is stopped before the first of these intervals is painted leaves
/// nothing behind; later it leaves these two folders and nothing else, and throws UnfinishedFilm{interrupted}. An
/// output of the form "marks_%04d.wst" keeps marks and no pictures, and cannot be resumed: stopped, it leaves nothing.
/// So does a plan.
/// Throws as the reader, the writer and rotoscope_frame do, Error{wrong_usage} where marks of such names exist or
/// `on_twos` lacks what it needs, and
/// Error{bad_input} after the film is written where the source is damaged, unless `keep_going`.
/// A program that must end at once leaves as little (remove_unfinished_outputs). Of several ranks, all throw the same,
/// and the result is whole at the first.
RotoscopedFilm rotoscope_film(StereoFilmReader& source, const std::filesystem::path& output,
                              const RotoscopeFilmOptions& options, const Progress& progress = {});

}  // namespace wheatstone
