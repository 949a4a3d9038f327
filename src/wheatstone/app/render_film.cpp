#include "wheatstone/app/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <numeric>
#include <optional>
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

/// Whether this rank has the frames that it makes, and keeps them.
bool has_frames(const RenderFilmOptions& options) { return options.whole_frames || options.ranks.first(); }

/// Renders one frame and keeps what is to be kept of it beside its picture.
Image<Rgb8> make_frame(const FrameSource& source, int frame, const RenderFilmOptions& options, RenderedFilm& film,
                       const Progress& progress) {
  const Progress of_film = [&](std::string_view /*step*/, double done) {
    report(progress, fmt::format("frame {} of {}", frame + 1, options.frames), (frame + done) / options.frames);
  };
  report(of_film, {}, 0);
  RenderedParticles rendered = source(frame, of_film);
  if (!options.slices.empty() && has_frames(options))
    write_slices(frame_pattern(options.slices)->file(frame + 1), rendered.stack);
  Image<Rgb8> picture;
  if (has_frames(options)) picture = picture_of(std::move(rendered.rendered.views), options);
  rendered.rendered.views.clear();
  rendered.stack.slices.clear();
  film.last = std::move(rendered);
  return picture;
}

/// The numbers of the frames to be made, as the first of the ranks finds them.
std::vector<int> frames_to_make(const FramePattern& pattern, const RenderFilmOptions& options, RenderedFilm& film) {
  std::vector<int> numbers = options.only;
  if (numbers.empty()) {
    numbers.resize(static_cast<std::size_t>(options.frames));
    std::iota(numbers.begin(), numbers.end(), 1);
  }
  film.frames = static_cast<int>(numbers.size());
  if (!options.skip_existing) return numbers;
  std::erase_if(numbers, [&](int number) { return fs::exists(pattern.file(number)); });
  const Ranks::Bytes bytes = options.ranks.from_first(Ranks::bytes_of(std::span<const int>(numbers)));
  numbers.resize(bytes.size() / sizeof(int));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  film.skipped_frames = film.frames - static_cast<int>(numbers.size());
  return numbers;
}

RenderedFilm write_pictures(const FrameSource& source, const FramePattern& pattern, const RenderFilmOptions& options,
                            const Progress& progress) {
  RenderedFilm film;
  const std::vector<int> numbers = frames_to_make(pattern, options, film);
  const auto step = static_cast<std::size_t>(options.whole_frames ? options.ranks.count() : 1);
  for (auto i = static_cast<std::size_t>(options.whole_frames ? options.ranks.rank() : 0); i < numbers.size();
       i += step) {
    const Image<Rgb8> picture = make_frame(source, numbers[i] - 1, options, film, progress);
    if (has_frames(options)) write_image(pattern.file(numbers[i]), picture);
  }
  return film;
}

/// The pictures of frames from `begin` on, as many as are made at once: at the first of the ranks.
std::vector<Image<Rgb8>> make_frames(const FrameSource& source, int begin, const RenderFilmOptions& options,
                                     RenderedFilm& film, const Progress& progress) {
  const Ranks& ranks = options.ranks;
  std::vector<Image<Rgb8>> pictures;
  if (!options.whole_frames || ranks.alone()) {
    pictures.push_back(make_frame(source, begin, options, film, progress));
    return pictures;
  }
  Image<Rgb8> mine;
  if (begin + ranks.rank() < options.frames) mine = make_frame(source, begin + ranks.rank(), options, film, progress);
  const std::array<int, 2> size{mine.width(), mine.height()};
  const std::vector<std::array<int, 2>> sizes = ranks.from_all(size);
  const std::vector<Ranks::Bytes> all = ranks.to_first(Ranks::bytes_of(std::span<const Rgb8>(mine.pixels())));
  for (std::size_t rank = 0; ranks.first() && rank < all.size() && !all[rank].empty(); ++rank) {
    Image<Rgb8>& picture = pictures.emplace_back(sizes[rank][0], sizes[rank][1]);
    std::memcpy(picture.pixels().data(), all[rank].data(), all[rank].size());
  }
  return pictures;
}

/// Keeps the finished part of a film that an error stopped, if it can be resumed, and throws the error.
[[noreturn]] void leave(const Error& error, const fs::path& output, SegmentedFilm& out) {
  const std::int64_t kept = out.frames_done();
  const bool can_go_on = error.kind() == ErrorKind::interrupted || error.kind() == ErrorKind::cannot_read_write;
  if (kept == 0 || !can_go_on) out.discard();
  if (error.kind() == ErrorKind::interrupted && kept > 0)
    throw UnfinishedFilm(error.kind(), "interrupted; " + unfinished_film(output, {}).value_or("nothing is kept"));
  throw;
}

RenderedFilm write_film(const FrameSource& source, const fs::path& output, const RenderFilmOptions& options,
                        const Progress& progress) {
  std::optional<SegmentedFilm> out;
  if (options.ranks.first())
    out.emplace(output, options.writing,
                SegmentOptions{options.frames_between_checkpoints, options.made_by, options.made_from, options.resume});
  const int done = options.ranks.from_all(out ? static_cast<int>(out->frames_done()) : 0).front();
  RenderedFilm film{.frames = options.frames, .resumed_frames = done};
  const Rational rate = options.writing.frame_rate;
  const int at_once = options.whole_frames ? options.ranks.count() : 1;
  try {
    for (int begin = done; begin < options.frames; begin += at_once) {
      int frame = begin;
      for (Image<Rgb8>& picture : make_frames(source, begin, options, film, progress))
        if (out) out->write({std::move(picture), frame++, {rate.denominator, rate.numerator}, 1});
    }
    if (out) out->finish(progress);
  } catch (const Error& error) {
    if (out) leave(error, output, *out);
    throw;
  } catch (...) {
    // Exceptions other than Error, such as a lack of memory, leave no empty folder, either.
    if (out && out->frames_done() == 0) out->discard();
    throw;
  }
  if (out) film.notes = out->notes();
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
  if (numbers.empty())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is '{}', but the film ends with frame {}", name, text, frames));
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
