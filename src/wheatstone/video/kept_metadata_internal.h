#pragma once

// What a film keeps of its source beside sound and subtitles: chapters, the timecode, and on what sphere it lies.

#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {

/// The sphere that a film's pictures lie on: "360" (equirectangular), "180" (half of it), "other" (such as a cube);
/// "flat" where it says none.
std::string projection_of(const AVStream& stream);

/// Throws Error{wrong_usage} for a projection that cannot be written.
void check_projection(std::string_view projection);

/// Says on what sphere the pictures of `stream` lie, as asked, or as `source` says; null: there is none.
void say_projection(const AVFormatContext* source, const FilmWriterOptions& options, AVStream& stream);

/// The source's chapters, of which the part of the film from `start_s` to `end_s` shows something.
void keep_chapters(const AVFormatContext& source, const FilmWriterOptions& options, AVFormatContext& output);

/// The timecode of the film's first frame, where the source has one; `notes` says so where it cannot go on with the
/// frame rate. Sets the stream's rate, by which it is counted.
void keep_timecode(const AVFormatContext& source, const FilmWriterOptions& options, AVStream& stream,
                   std::vector<std::string>& notes);

}  // namespace wheatstone
