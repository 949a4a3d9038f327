#include "painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <utility>

#include "wheatstone/app/detail_map.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/painting/follow_disparity.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/retouch_strokes.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/retouched_right.h"

namespace wheatstone::viewer {
namespace {

constexpr int coarse_px = 240;

/// Every so many-th pixel's disparity, in pixels of the smaller picture.
Image<float> reduced_disparity(ImageView<const float> disparity, PictureSize size) {
  Image<float> small(size.width, size.height);
  const float scale = static_cast<float>(size.width) / static_cast<float>(disparity.width());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      small(x, y) = scale * disparity((2 * x + 1) * disparity.width() / (2 * size.width),
                                      (2 * y + 1) * disparity.height() / (2 * size.height));
  return small;
}

/// As large as the photograph.
Painting coarse_painting(const Photograph& photograph, const Style& style, ImageView<const std::uint8_t> detail,
                         const Progress& progress) {
  const Image<Rgb8>& left = photograph.pictures.left;
  Painting painting = small_painting(photograph, style, coarse_px, detail, progress);
  const int width = width_of(painting);
  return placed(std::move(painting), {.width = left.width(),
                                      .height = left.height(),
                                      .scale = static_cast<double>(left.width()) / static_cast<double>(width)});
}

/// "2:05 left", as far as it can be told from what is done in so many seconds.
std::string time_left(double done, double seconds) {
  constexpr double enough_to_tell = 0.005;
  if (done < enough_to_tell) return {};
  const auto left_s = static_cast<int>(seconds * (1 - done) / done + 0.5);
  return fmt::format(", {}:{:02} left", left_s / 60, left_s % 60);
}

}  // namespace

Painting small_painting(const Photograph& photograph, const Style& style, int largest_px,
                        ImageView<const std::uint8_t> detail, const Progress& progress) {
  const Image<Rgb8>& left = photograph.pictures.left;
  const PictureSize size = reduced_size({left.width(), left.height()}, largest_px);
  const StereoPair pair{reduced(left, size), reduced(pictures_to_paint(photograph).right, size)};
  const StereoGeometry geometry = geometry_from_both(reduced_disparity(photograph.geometry->left_disparity, size),
                                                     reduced_disparity(photograph.geometry->right_disparity, size));
  return plan_painting(pair, geometry, style, progress, ViewRange{}, detail);
}

namespace {

/// Retouches a photograph's geometry; goes on from the touches that were done before.
void retouch_geometry(std::span<const Touch> touches, const Progress& progress, Photograph& photograph) {
  const std::size_t done = photograph.touches.size();
  const bool lasso_goes_on = touches.size() > done && is_lasso(touches[done].kind) && touches[done].goes_on;
  const bool goes_on = photograph.found && touches.size() >= done && !lasso_goes_on &&
                       std::ranges::equal(photograph.touches, touches.first(done));
  if (!photograph.found) photograph.found = photograph.geometry;
  Image<float> disparity = (goes_on ? *photograph.geometry : *photograph.found).left_disparity;
  retouch_disparity(goes_on ? touches.subspan(done) : touches, photograph.pictures.left, disparity, progress);
  photograph.geometry = geometry_from_left(std::move(disparity));
  photograph.retouched_right = retouched_right(photograph.pictures, *photograph.found, *photograph.geometry);
  photograph.touches.assign(touches.begin(), touches.end());
}

/// The photograph with what a style needs of it, retouched; the same where nothing is to be done.
std::shared_ptr<const Photograph> made_ready(const std::shared_ptr<const Photograph>& photograph, const Style& style,
                                             std::span<const Touch> touches, const Progress& progress) {
  std::vector<Touch> of_depth;
  std::ranges::copy_if(touches, std::back_inserter(of_depth),
                       [](const Touch& touch) { return retouched_by(touch.kind) == Retouched::depth; });
  const bool wants_detail = reads_detail(style) && !photograph->detail;
  if (photograph->geometry && !wants_detail && of_depth == photograph->touches) return photograph;
  auto ready = std::make_shared<Photograph>(*photograph);
  if (!ready->geometry) ready->geometry = find_geometry(ready->pictures, {}, progress).geometry;
  if (wants_detail) ready->detail = detail_of_faces(ready->pictures.left);
  if (!of_depth.empty()) {
    retouch_geometry(of_depth, progress, *ready);
  } else if (ready->found) {
    ready->geometry = std::exchange(ready->found, {});
    ready->touches.clear();
    ready->retouched_right = {};
  }
  return ready;
}

/// The detail map of a photograph, retouched; empty where the style reads none.
Image<std::uint8_t> retouched_detail(const Photograph& photograph, const Style& style, std::span<const Touch> touches) {
  if (!reads_detail(style) || !photograph.detail) return {};
  Image<std::uint8_t> detail = *photograph.detail;
  const bool is_touched =
      std::ranges::any_of(touches, [](const Touch& touch) { return touch.kind == Retouch::detail; });
  if (is_touched && detail.empty())
    detail = Image<std::uint8_t>(photograph.pictures.left.width(), photograph.pictures.left.height(), even_detail);
  retouch_detail(touches, detail);
  return detail;
}

std::vector<Touch> of_strokes(std::span<const Touch> touches) {
  std::vector<Touch> found;
  std::ranges::copy_if(touches, std::back_inserter(found),
                       [](const Touch& touch) { return retouched_by(touch.kind) == Retouched::strokes; });
  return found;
}

/// The open painting with what a hand has done since, as far as that can be shown without planning; none where it
/// cannot. `now` is the photograph as it is retouched.
std::shared_ptr<const Painting> touched_at_once(const PaintedContent& open, std::span<const Touch> touches,
                                                const Photograph& now) {
  if (!open.painting || !has_strokes_to_retouch(*open.painting) || !open.photograph->geometry) return {};
  const std::vector<Touch> before = of_strokes(open.touches), all = of_strokes(touches);
  if (all.size() < before.size() || !std::ranges::equal(before, std::span(all).first(before.size()))) return {};
  std::span<const Touch> added = std::span(all).subspan(before.size());
  const bool changes_depth = open.photograph->touches != now.touches;
  if (added.empty() && !changes_depth) return {};
  if (!added.empty() && added.front().goes_on) {
    // How bright a recoloured stroke becomes depends on all that the stroke of the hand recolours.
    if (added.front().kind == Retouch::recolour || before.empty()) return {};
    added = std::span(all).subspan(before.size() - 1);  // from where the hand was
  }
  auto painting = std::make_shared<Painting>(*open.painting);
  if (changes_depth)
    follow_disparity(open.photograph->geometry->left_disparity, now.geometry->left_disparity, *painting);
  retouch_strokes(added, *painting);
  return painting;
}

}  // namespace

void paint_in_steps(const PaintedContent& open, const Style& style, std::span<const Touch> touches, StrokeFits& fits,
                    const Progress& progress, const std::function<void(PaintedContent)>& deliver) {
  const std::shared_ptr<const Photograph> known = made_ready(open.photograph, style, touches, progress);
  if (!open.photograph->geometry) deliver({nullptr, known});
  const auto deliver_painting = [&](std::shared_ptr<const Painting> painting) {
    deliver({.painting = std::move(painting), .photograph = known, .touches = {touches.begin(), touches.end()}});
  };
  const std::shared_ptr<const Painting> touched = touched_at_once(open, touches, *known);
  if (touched) deliver_painting(touched);
  const StereoPairView pictures = pictures_to_paint(*known);
  const ImageView<const Rgb8> left = pictures.left;
  const Image<std::uint8_t> detail = retouched_detail(*known, style, touches);
  constexpr double very_large_px = 6e6;
  const bool keeps_fits = !touches.empty() && static_cast<double>(left.width()) * left.height() <= very_large_px;
  if (!keeps_fits) fits.clear();
  if (fits.empty() && !touched && std::max(left.width(), left.height()) > 2 * coarse_px) {
    Painting coarse = coarse_painting(*known, style, detail, progress);
    retouch_strokes(touches, coarse);
    deliver_painting(std::make_shared<const Painting>(std::move(coarse)));
  }
  const auto plan = [&](ViewRange views) {
    Painting painting = keeps_fits ? plan_again(pictures, *known->geometry, style, fits, progress, views, detail)
                                   : plan_painting(pictures, *known->geometry, style, progress, views, detail);
    retouch_strokes(touches, painting);
    deliver_painting(std::make_shared<const Painting>(std::move(painting)));
  };
  // What the eyes see comes first where a hand changed what cannot be shown at once.
  if (!fits.empty() && !touched) plan(ViewRange{});
  plan(widest_views);
}

std::string paint_whole_film(const WholeFilm& film, const Progress& progress) {
  check_not_an_input(film.output, std::array{film.files.film, film.files.right});
  StereoFilmReader source = open_film(film.files);
  RotoscopeFilmOptions options;
  options.frames.style = film.style;
  if (film.output.extension() != ".wst") options.frames.depth_budget = comfortable_parallax_share;
  options.made_by = fmt::format("wheatstone view from {}", layout_name(source.layout()));
  options.made_from.push_back(film.files.film);
  if (!film.files.right.empty()) options.made_from.push_back(film.files.right);
  options.writing.layout = layout_of_painted_film(source, !film.files.right.empty());
  write_as_source(film.files.film, source.facts(), options.reading, options.writing);
  options.expected_frames = expected_frames(source.facts(), options.reading);
  options.resume = unfinished_film(film.output, {}).has_value();
  const RotoscopedFilm painted = rotoscope_film(source, film.output, options, progress);
  std::string text = fmt::format("painted {} frames to {}", painted.frames, film.output.string());
  for (const std::string& note : painted.notes) text += "; " + note;
  return text;
}

FilmPainting::FilmPainting(WholeFilm film, Listener listener)
    : thread_([this, film = std::move(film), listener = std::move(listener)](const std::stop_token& stop) {
        const auto start = std::chrono::steady_clock::now();
        const Progress progress = [&](std::string_view step, double done) {
          if (stop.stop_requested()) throw Error(ErrorKind::interrupted, "stopped");
          const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
          listener.progress(fmt::format("{}{}", step, time_left(done, seconds)), done);
        };
        std::string message;
        bool is_error = true;
        try {
          message = paint_whole_film(film, progress);
          is_error = false;
        } catch (const Error& error) {
          message = error.what();
          is_error = error.kind() != ErrorKind::interrupted;
        } catch (const std::exception& error) {
          message = error.what();
        }
        has_ended_ = true;
        listener.end(std::move(message), is_error);
      }) {}

}  // namespace wheatstone::viewer
