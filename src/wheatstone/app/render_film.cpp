#include "wheatstone/app/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

Image<Rgb8> picture_of(std::vector<Image<Rgb8>> views, const RenderFilmOptions& options) {
  if (options.quilt) return make_quilt(views, *options.quilt);
  if (options.screen) return interleave(views, *options.screen);
  if (views.size() == 1) return std::move(views.front());
  return put_together(views.front(), views.back(), options.writing.layout);
}

/// Renders one frame and keeps what is to be kept of it beside its picture.
Image<Rgb8> make_frame(const FrameSource& source, int frame, const RenderFilmOptions& options, RenderedFilm& film,
                       const Progress& progress) {
  const Progress of_film = [&](std::string_view /*step*/, double done) {
    report(progress, fmt::format("frame {} of {}", frame + 1, options.frames), (frame + done) / options.frames);
  };
  report(of_film, {}, 0);
  RenderedParticles rendered = source(frame, of_film);
  if (!options.slices.empty()) write_slices(frame_pattern(options.slices)->file(frame + 1), rendered.stack);
  Image<Rgb8> picture = picture_of(std::exchange(rendered.rendered.views, {}), options);
  rendered.stack.slices.clear();
  film.last = std::move(rendered);
  return picture;
}

RenderedFilm write_pictures(const FrameSource& source, const FramePattern& pattern, const RenderFilmOptions& options,
                            const Progress& progress) {
  std::vector<int> numbers = options.only;
  if (numbers.empty()) {
    numbers.resize(static_cast<std::size_t>(options.frames));
    std::iota(numbers.begin(), numbers.end(), 1);
  }
  RenderedFilm film{.frames = static_cast<int>(numbers.size())};
  for (const int number : numbers) {
    const fs::path file = pattern.file(number);
    if (options.skip_existing && fs::exists(file)) {
      ++film.skipped_frames;
      continue;
    }
    write_image(file, make_frame(source, number - 1, options, film, progress));
  }
  return film;
}

RenderedFilm write_film(const FrameSource& source, const fs::path& output, const RenderFilmOptions& options,
                        const Progress& progress) {
  SegmentedFilm out(output, options.writing,
                    {options.frames_between_checkpoints, options.made_by, options.made_from, options.resume});
  RenderedFilm film{.frames = options.frames, .resumed_frames = static_cast<int>(out.frames_done())};
  const Rational rate = options.writing.frame_rate;
  try {
    for (int frame = film.resumed_frames; frame < options.frames; ++frame)
      out.write({make_frame(source, frame, options, film, progress), frame, {rate.denominator, rate.numerator}, 1});
    report(progress, "joining", 0);
    out.finish(progress);
  } catch (const Error& error) {
    const std::int64_t kept = out.frames_done();
    const bool can_go_on = error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::cannot_read_write;
    if (kept == 0 || !can_go_on) out.discard();
    if (error.kind() == ErrorKind::interrupted && kept > 0)
      throw UnfinishedFilm(error.kind(), "interrupted; " + unfinished_film(output, {}).value_or("nothing is kept"));
    throw;
  }
  film.notes = out.notes();
  return film;
}

/// A whole number at the beginning of the text, which is taken off it.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 1) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

}  // namespace

std::vector<int> parse_frame_range(const std::string& text, int frames, const std::string& name) {
  const auto refuse = [&]() -> int {
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is '{}', expected frames from 1 on, as 1-240x2,300", name, text));
  };
  std::set<int> numbers;
  std::string_view rest = text;
  while (true) {
    const int first = take_number(rest).value_or(0);
    int last = first, step = 1;
    if (rest.starts_with('-')) {
      rest.remove_prefix(1);
      last = take_number(rest).value_or(0);
      if (rest.starts_with('x')) {
        rest.remove_prefix(1);
        step = take_number(rest).value_or(0);
      }
    }
    if (first < 1 || last < first || step < 1) refuse();
    for (int number = first; number <= std::min(last, frames); number += std::min(step, frames)) numbers.insert(number);
    if (rest.empty()) break;
    if (!rest.starts_with(',')) refuse();
    rest.remove_prefix(1);
  }
  return {numbers.begin(), numbers.end()};
}

RenderedFilm render_film(const FrameSource& source, const fs::path& output, const RenderFilmOptions& options,
                         const Progress& progress) {
  if (const std::optional<FramePattern> pattern = frame_pattern(output))
    return write_pictures(source, *pattern, options, progress);
  if (!options.only.empty() || options.skip_existing)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("{}: is a film, expected numbered pictures (frame_%04d.png) where only some frames are made",
                    output.string()));
  return write_film(source, output, options, progress);
}

}  // namespace wheatstone
