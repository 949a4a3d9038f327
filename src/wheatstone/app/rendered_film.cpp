#include "wheatstone/app/rendered_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/matching/depth_fit.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// The flow that a renderer noted; renderers write huge numbers where they know no motion.
Flow flow_of(Image<float> x, Image<float> y) {
  constexpr float most_px = 1e5f;
  for (Image<float>* of_axis : {&x, &y})
    for (float& px : of_axis->pixels())
      if (!(std::abs(px) < most_px)) px = std::numeric_limits<float>::quiet_NaN();
  return {std::move(x), std::move(y)};
}

bool tells_motion(const RenderedPasses& view) { return !view.before_x.empty() && !view.after_x.empty(); }

Flow unknown_flow(const Image<float>& like) {
  const Image<float> unknown(like.width(), like.height(), std::numeric_limits<float>::quiet_NaN());
  return {unknown, unknown};
}

/// The disparities of a view; where no depth is known at all, it is infinitely far.
Image<float> disparity_of(const Image<float>& depth, const DepthFit& fit) {
  Image<float> disparity = disparity_of_depth(depth, fit);
  if (std::ranges::none_of(disparity.pixels(), [](float px) { return std::isfinite(px); }))
    disparity = Image<float>(depth.width(), depth.height(), static_cast<float>(fit.offset_px));
  return disparity;
}

class FilmWithPasses {
 public:
  FilmWithPasses(const fs::path& path, const FilmReaderOptions& reading, bool has_motion)
      // The motion of a single frame says nothing of frames that are left out.
      : pattern_(*frame_pattern(path)), every_(reading.every), has_motion_(has_motion && every_ == 1) {
    constexpr double mercy_s = 0.0005;  // as the reader has
    first_ = numbers_without_hole(pattern_).front();
    if (reading.from_s)
      first_ += std::max<std::int64_t>(
          static_cast<std::int64_t>(std::ceil((*reading.from_s - mercy_s) * reading.sequence_rate.value())), 0);
  }

  KnownFrame known(std::int64_t frame, const StereoPair& eyes) {
    const fs::path file = file_of(frame);
    std::vector<RenderedPasses> passes = passes_of(file);
    if (passes.size() != 2 || !same_size(passes.front().depth, eyes.left))
      refuse(file, fmt::format("has {} views of {}x{} pixels, expected the two eyes of the film", passes.size(),
                               passes.front().depth.width(), passes.front().depth.height()));
    const DepthFit fit = fit_of(frame, eyes, passes.front().depth);
    KnownFrame known;
    known.geometry =
        geometry_from_both(disparity_of(passes.front().depth, fit), disparity_of(passes.back().depth, fit));
    check(file, fit, known.geometry);
    if (!has_motion_ || !tells_motion(passes.front())) return known;
    if (frame > 0) known.flow = flow_to(frame, eyes.left, passes.front());
    before_ = {frame, eyes.left, std::move(passes.front())};
    return known;
  }

 private:
  [[noreturn]] static void refuse(const fs::path& file, const std::string& why) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", file.string(), why));
  }

  static std::vector<RenderedPasses> passes_of(const fs::path& file) {
    if (!has_rendered_passes(file))
      refuse(file, "has no depth, expected it as in the first frame; --passes none ignores it");
    return read_rendered_passes(file);
  }

  /// What is remembered of the left view of a frame.
  struct LeftView {
    std::int64_t frame = -1;
    Image<Rgb8> picture;
    RenderedPasses passes;
  };

  /// The flow from the frame before; none where that tells no motion, and unknown where a scene begins.
  std::optional<FlowPair> flow_to(std::int64_t frame, const Image<Rgb8>& left, const RenderedPasses& now) {
    if (before_.frame != frame - 1)
      before_ = {frame - 1, std::move(read_multiview_exr(file_of(frame - 1)).front()),
                 std::move(read_rendered_passes(file_of(frame - 1)).front())};
    if (!tells_motion(before_.passes)) return {};
    // A renderer that is asked for one scene after the other tells the motion within each.
    if (find_cut(before_.picture, left).cut) return FlowPair{unknown_flow(now.depth), unknown_flow(now.depth)};
    return FlowPair{flow_of(before_.passes.after_x, before_.passes.after_y), flow_of(now.before_x, now.before_y)};
  }

  fs::path file_of(std::int64_t frame) const { return pattern_.file(first_ + every_ * frame); }

  /// Everything is at infinity where no frame up to this one tells the cameras.
  DepthFit fit_of(std::int64_t frame, const StereoPair& eyes, const Image<float>& left_depth) {
    std::optional<DepthFit> fit = fit_depth(eyes, left_depth);
    for (std::int64_t earlier = frame - 1; earlier >= 0 && !fit; --earlier) {
      if (earlier == fitted_frame_) {
        fit = fit_there_;
        break;
      }
      std::vector<Image<Rgb8>> views = read_multiview_exr(file_of(earlier));
      fit = fit_depth({std::move(views.front()), std::move(views.back())},
                      read_rendered_passes(file_of(earlier)).front().depth);
    }
    if (!fit && find_disparity_range(eyes))
      refuse(file_of(frame),
             "its depth does not tell where its eyes see things, expected parallel cameras (off-axis), "
             "and depth along their axis; --passes none ignores it");
    fitted_frame_ = frame;
    fit_there_ = fit;
    return fit.value_or(DepthFit());
  }

  /// Throws where what the left eye sees lies elsewhere for the right one.
  static void check(const fs::path& file, const DepthFit& fit, const StereoGeometry& geometry) {
    constexpr double least_agreeing_share = 0.5;
    if (fit.scale == 0) return;
    const double share = agreeing_share(geometry.left_disparity, geometry.right_disparity);
    if (share < least_agreeing_share)
      refuse(file, fmt::format("the depths of its views agree in {:.0f} % of the picture, expected parallel cameras "
                               "(off-axis), and depth along their axis; --passes none ignores them",
                               100 * share));
  }

  FramePattern pattern_;
  std::int64_t first_ = 0;  ///< number of the first frame's file
  int every_;
  bool has_motion_;
  LeftView before_;
  std::int64_t fitted_frame_ = -1;
  std::optional<DepthFit> fit_there_;  ///< none where no frame up to that one tells it
};

}  // namespace

bool is_rendered_film(const fs::path& pattern) {
  const std::optional<FramePattern> frames = frame_pattern(pattern);
  if (!frames || frames->after != ".exr") return false;
  const std::vector<std::int64_t> numbers = numbers_of(*frames);
  return !numbers.empty() && has_rendered_passes(frames->file(numbers.front()));
}

KnownFrames known_of_rendered_film(const fs::path& pattern, const FilmReaderOptions& reading, bool has_motion) {
  // A std::function can be copied.
  const auto film = std::make_shared<FilmWithPasses>(pattern, reading, has_motion);
  return [film](std::int64_t frame, const StereoPair& eyes) { return film->known(frame, eyes); };
}

}  // namespace wheatstone
