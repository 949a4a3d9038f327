#include "wheatstone/app/slice_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {

Slicing slicing_of_frame(const SliceFilmOptions& options, int frame) {
  Slicing slicing = options.slicing;
  const float share = static_cast<float>(frame) / static_cast<float>(std::max(options.frames - 1, 1));
  slicing.depths = planes_between(options.from, options.to, share, "--slice-to");
  return slicing;
}

std::vector<std::string> write_slice_film(const Painting& painting,
                                          const std::function<Image<Rgb8>(const Painting&)>& picture,
                                          const std::filesystem::path& output, const SliceFilmOptions& options,
                                          const Progress& progress) {
  if (layers_of(painting).empty())
    throw Error(ErrorKind::bad_input, "the painting has no layers of strokes, which slicing planes cut");
  const Rational rate = options.writing.frame_rate;
  FilmWriter writer(output, options.writing);
  for (int frame = 0; frame < options.frames; ++frame) {
    report(progress, fmt::format("frame {} of {}", frame + 1, options.frames),
           static_cast<double>(frame) / options.frames);
    writer.write(
        {picture(sliced(painting, slicing_of_frame(options, frame))), frame, {rate.denominator, rate.numerator}, 1});
  }
  writer.finish();
  return writer.notes();
}

}  // namespace wheatstone
