#include "wheatstone/app/pack_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

/// The eyes' pictures with 16 bits a channel as the film has them; empty where there are none.
Image<Rgb16> deep_of(const StereoFrame& frame, StereoLayout layout, const PackFilmOptions& options) {
  if (frame.left_deep.empty() || frame.right_deep.empty() || options.shift_px != 0 || !options.anaglyph.empty())
    return {};
  if (options.swap) return put_together(frame.right_deep, frame.left_deep, layout);
  return put_together(frame.left_deep, frame.right_deep, layout);
}

StereoPair eyes_of(StereoFrame& frame, const PackFilmOptions& options) {
  if (frame.right.empty())
    throw Error(ErrorKind::bad_input, "the film has one eye, expected two: give its layout, or a film for each eye");
  StereoPair eyes{std::move(frame.left), std::move(frame.right)};
  if (options.swap) std::swap(eyes.left, eyes.right);
  if (options.shift_px == 0) return eyes;
  std::vector<Image<Rgb8>> views;
  views.push_back(std::move(eyes.left));
  views.push_back(std::move(eyes.right));
  views = shifted_views(std::move(views), options.shift_px);
  return {std::move(views[0]), std::move(views[1])};
}

}  // namespace

PackedFilm pack_film(StereoFilmReader& source, const std::filesystem::path& output, const PackFilmOptions& options,
                     const Progress& progress) {
  std::vector<FilmWriter> films;
  films.emplace_back(output, options.writing);
  if (!options.right_film.empty()) films.emplace_back(options.right_film, options.writing);
  const StereoLayout layout = options.right_film.empty() ? options.writing.layout : StereoLayout::left_right;
  PackedFilm packed;
  for (StereoFrame frame; source.read(frame); ++packed.frames) {
    const auto expected = static_cast<double>(std::max(options.expected_frames, packed.frames + 1));
    report(progress, "packing", options.expected_frames > 0 ? static_cast<double>(packed.frames) / expected : 0);
    Frame together{put_into_frame(eyes_of(frame, options), layout, options.anaglyph), frame.pts, frame.time_base,
                   frame.duration, deep_of(frame, layout, options)};
    const std::vector<Frame> frames = frames_of_films(std::move(together), films.size());
    for (std::size_t i = 0; i < films.size(); ++i) films[i].write(frames[i]);
    packed.width = frames.front().picture.width();
    packed.height = frames.front().picture.height();
  }
  if (packed.frames == 0) throw Error(ErrorKind::bad_input, "the film has no frame");
  // Both films get their names: no signal may end the program in between.
  const auto hold = hold_outputs();
  for (FilmWriter& film : films) film.finish();
  packed.notes = notes_on_reading(source.facts());
  for (const std::string& note : films.front().notes()) packed.notes.push_back(note);
  if (const std::optional<std::string> loss = source.loss())
    throw Error(ErrorKind::bad_input, fmt::format("{}; the {} frames that could be decoded were written to {}", *loss,
                                                  packed.frames, output.string()));
  return packed;
}

}  // namespace wheatstone
