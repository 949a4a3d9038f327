#include "film_argument.h"

#include "interrupt.h"
#include "typed_options.h"
#include "wheatstone/app/rotoscope_film.h"

namespace wheatstone::cli {

std::optional<StereoLayout> film_layout_option(const std::string& option, const std::string& name) {
  if (name.empty()) return {};
  const std::optional<StereoLayout> layout = find_stereo_layout(name);
  if (!layout)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: there is no layout '{}', expected one of {}", option, name, stereo_layout_names()));
  return layout;
}

void add_film_coding_options(CLI::App& command, FilmWriterOptions& writing, const std::string& group) {
  command.add_option("--codec", writing.codec, "h264, hevc, or ffv1 (lossless, .mkv)")
      ->capture_default_str()
      ->group(group);
  add_number(command, "--crf", writing.crf, {0, 51},
             "Constant rate factor of h264 and hevc: from 0, the best quality, to 51")
      ->group(group);
  command.add_option("--preset", writing.preset, "Encoder preset of h264 and hevc, from ultrafast to placebo")
      ->capture_default_str()
      ->group(group);
  command.add_option("--pixel-format", writing.pixel_format, "yuv420p, yuv422p, yuv444p; bgr0 for ffv1")->group(group);
}

void add_film_resume_options(CLI::App& command, bool& resume, int& frames_between_checkpoints,
                             const std::string& group) {
  command.add_flag("--resume", resume, "Continue a run that was stopped")->group(group);
  add_number(command, "--checkpoint", frames_between_checkpoints, {1, 100'000},
             "Number of frames between checkpoints: a stopped run loses at most this many")
      ->group(group);
}

void tell_what_film_keeps(const std::filesystem::path& output, const std::filesystem::path& marks) {
  tell_what_is_kept([output, marks] {
    const std::optional<std::string> kept = unfinished_film(output, marks);
    return kept ? fmt::format("{}; {}", *kept, how_to_continue_film) : std::string();
  });
}

}  // namespace wheatstone::cli
