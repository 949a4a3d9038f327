#include "film_argument.h"

#include <array>
#include <utility>

#include "interrupt.h"
#include "wheatstone/app/rotoscope_film.h"

namespace wheatstone::cli {

Value film_layout(std::optional<StereoLayout>& layout) {
  return parsed(layout, [](const std::string& option, const std::string& words) {
    const std::optional<StereoLayout> found = words.empty() ? std::nullopt : find_stereo_layout(words);
    if (!found && !words.empty())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: there is no layout '{}', expected one of {}", option, words, stereo_layout_names()));
    return found;
  });
}

Rows film_coding_rows(FilmWriterOptions& writing) {
  return {
      row("--codec", name(writing.codec, film_codecs()),
          "hevc-10, prores, dnxhr and av1 have 10 bits; ffv1 is lossless; prores and dnxhr go into .mov or .mkv, ffv1 "
          "into .mkv, av1 and vp9 into .webm, .mp4 or .mkv"),
      row("--crf", number(writing.crf, {0, 63}),
          "Constant rate factor of h264 and hevc, to 51, and of av1 and vp9, to 63: 0 is the best quality"),
      row("--preset", text(writing.preset), "Encoder preset of these codecs, from ultrafast to placebo"),
      row("--pixel-format", without_default(text(writing.pixel_format)),
          "yuv420p, yuv422p, yuv444p; yuv420p10le and so on with 10 bits; for ffv1 also bgr0 and, with 16 bits, "
          "gbrp16le")};
}

Row projection_row(FilmWriterOptions& writing, Reasons unless) {
  static constexpr std::array<std::string_view, 4> spheres{"source", "flat", "180", "360"};
  return row("--projection", name(writing.projection, spheres),
             "Sphere that the film says it lies on: 360 or 180 (equirectangular), or flat; that of the source by "
             "default. Pictures are not changed",
             std::move(unless));
}

Rows side_stream_rows(FilmWriterOptions& writing) {
  return {row("!--no-audio", flag(writing.copy_audio), "Do not copy the film's sound"),
          row("!--no-subtitles", flag(writing.copy_subtitles), "Do not copy the film's subtitles")};
}

Rows film_resume_rows(bool& resume, int& frames_between_checkpoints) {
  return {row("--resume", flag(resume), "Continue a run that was stopped"),
          row("--checkpoint", number(frames_between_checkpoints, {1, 100'000}),
              "Number of frames between checkpoints: a stopped run loses at most this many")};
}

void tell_what_film_keeps(const std::filesystem::path& output, const std::filesystem::path& marks) {
  tell_what_is_kept([output, marks] {
    const std::optional<std::string> kept = unfinished_film(output, marks);
    return kept ? fmt::format("{}; {}", *kept, how_to_continue_film) : std::string();
  });
}

}  // namespace wheatstone::cli
