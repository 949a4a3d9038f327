#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// A film in which slicing planes travel through a painting (Stavrakis & Gelautz 2005, sec. 3.3).
struct SliceFilmOptions {
  Slicing slicing;                   ///< what is cut, and which side stays; its depths are those of the frame
  std::vector<SliceDepth> from, to;  ///< of the planes in the first frame and the last, as many and in the same units
  int frames = 120;
  FilmWriterOptions writing;  ///< with the frame rate
};

/// What frame 0, 1, … of the film shows.
Slicing slicing_of_frame(const SliceFilmOptions& options, int frame);

/// Writes the film, or numbered pictures ("frame_%04d.png", from 1 on). `picture` makes a frame of the sliced painting.
/// A film that is stopped leaves nothing. Returns what the user should know. Throws as planes_between, FilmWriter and
/// `picture` do, and Error{bad_input} where the painting has no layers of strokes.
std::vector<std::string> write_slice_film(const Painting& painting,
                                          const std::function<Image<Rgb8>(const Painting&)>& picture,
                                          const std::filesystem::path& output, const SliceFilmOptions& options,
                                          const Progress& progress = {});

}  // namespace wheatstone
