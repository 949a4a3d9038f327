#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// How a film is to hold two eyes: in a layout, as an anaglyph, or as a film for each eye.
struct EyesInFilm {
  std::optional<StereoLayout> layout;  ///< of one film
  std::string anaglyph;                ///< the name of an anaglyph_kind; empty: it is none
  bool two_films = false;
};

/// By the name of a layout or of a kind of anaglyph, as find_stereo_layout and ffmpeg's stereo3d know them, "anaglyph"
/// or "two-files". Throws Error{wrong_usage} that names `option` and lists what there is.
EyesInFilm find_eyes_in_film(const std::string& option, std::string_view name);

/// The film of one eye beside another: "painted_left.mp4" for "painted.mp4", "a_left_%04d.png" for "a_%04d.png".
std::filesystem::path film_of_eye(const std::filesystem::path& film, ViewPosition eye);

/// Full chroma for an anaglyph, whose colours tell the eyes apart, and for views whose pixels alternate, where the
/// codec has it and no pixel format is chosen.
void keep_full_colour(FilmWriterOptions& writing);

/// Both eyes in a frame of a film. Throws Error{wrong_usage} where there is no such anaglyph.
Image<Rgb8> put_into_frame(const StereoPair& eyes, StereoLayout layout, std::string_view anaglyph);

/// What each of so many films gets of a frame: one the frame as it is, two an eye each of a frame that is left-right.
std::vector<Frame> frames_of_films(Frame frame, std::size_t films);

}  // namespace wheatstone
