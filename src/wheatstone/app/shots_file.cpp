#include "wheatstone/app/shots_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace wheatstone {
namespace {

/// "0:02.500", or "1:00:02.500" from an hour on, as `rotoscope --from` takes it.
std::string time_text(double seconds) {
  const auto ms = static_cast<std::int64_t>(std::llround(std::max(seconds, 0.0) * 1000));
  const std::int64_t s = ms / 1000, minutes = s / 60, hours = minutes / 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}.{:03}", hours, minutes % 60, s % 60, ms % 1000);
  return fmt::format("{}:{:02}.{:03}", minutes, s % 60, ms % 1000);
}

}  // namespace

std::string shots_file_text(std::span<const FoundShot> shots) {
  std::string text =
      "# The shots of a film, for `wheatstone rotoscope --shots`. A shot lasts until the next one begins: add a\n"
      "# [[shot]] to add a cut, and delete one to remove its cut. `begin` is the first frame, counted from 1, or a\n"
      "# time, as \"0:02.5\". What a shot does not set is as on the command line. A shot takes `style`, all "
      "parameters\n"
      "# of its style, `depth-budget`, `zero-parallax`, and `last`, its last frame, if that is to be checked.\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const FoundShot& shot = shots[i];
    text += fmt::format(
        "\n[[shot]]  # {}: from {} on, {} frame{}, {:.3f} s, {}\n"
        "begin = {}\n"
        "# style = \"oil\"\n"
        "# radii = [8, 4, 2]\n"
        "# depth-budget = \"3%\"\n"
        "# zero-parallax = 0\n",
        i + 1, time_text(shot.begin_s), shot.frames, shot.frames == 1 ? "" : "s", shot.length_s, shot.thumbnail,
        shot.begin + 1);
  }
  return text;
}

}  // namespace wheatstone
