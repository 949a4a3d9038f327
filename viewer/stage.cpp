#include "stage.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "output_mode.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::viewer {
namespace {

/// The number of the view that a wiggle shows in a step: there and back.
int wiggle_view(int step) {
  constexpr int period = 2 * (wiggle_views - 1);
  const int at = ((step % period) + period) % period;
  return at < wiggle_views ? at : period - at;
}

std::vector<ViewPosition> wanted_positions(const OutputMode& mode, const ViewState& state) {
  const EyePositions eyes = eye_positions(state);
  if (!std::holds_alternative<Wiggle>(mode.kind)) {
    std::vector<ViewPosition> positions{eyes.left, eyes.right};
    const Leaks leaks = leaks_of(state);
    for (const std::vector<LeakingView>& of_eye : {leaks.left, leaks.right})
      for (const LeakingView& leak : of_eye) positions.push_back(leak.view);
    return positions;
  }
  std::vector<ViewPosition> positions = evenly_spaced(0, 0, wiggle_views, state.adjustment.separation).positions;
  for (ViewPosition& position : positions) position = ViewPosition(position.eye_separations() + state.head);
  return positions;
}

/// How a picture of the content's size lies in an eye's: its scale, and where its corner stands.
struct Fit {
  double scale = 1;
  double origin_x = 0, origin_y = 0;
};

Fit fit_in(const PictureSize& eye, const PictureSize& content, const Framed& framed) {
  Fit fit;
  fit.scale = framed.zoom > 0 ? framed.zoom
                              : std::min(static_cast<double>(eye.width) / content.width,
                                         static_cast<double>(eye.height) / content.height);
  fit.origin_x = std::round(eye.width / 2. - (content.width / 2. + framed.pan_x) * fit.scale);
  fit.origin_y = std::round(eye.height / 2. - (content.height / 2. + framed.pan_y) * fit.scale);
  return fit;
}

/// What is to be drawn so that an eye's picture is full wherever the content reaches, also when the eyes' pictures are
/// moved a little.
WantedPart wanted_part(const Fit& fit, const PictureSize& eye, const PictureSize& content) {
  constexpr int margin_px = 96;
  const int width = std::max(static_cast<int>(std::lround(content.width * fit.scale)), 1);
  const int height = std::max(static_cast<int>(std::lround(content.height * fit.scale)), 1);
  WantedPart part{fit.scale, 0, 0, width, height};
  if (width > eye.width + 2 * margin_px) {
    part.left = std::clamp(static_cast<int>(-fit.origin_x) - margin_px, 0, width - 1);
    part.width = std::min(eye.width + 2 * margin_px, width - part.left);
  }
  if (height > eye.height + 2 * margin_px) {
    part.top = std::clamp(static_cast<int>(-fit.origin_y) - margin_px, 0, height - 1);
    part.height = std::min(eye.height + 2 * margin_px, height - part.top);
  }
  return part;
}

/// How an eye's picture is moved against where it fits.
struct Move {
  double x = 0, y = 0, roll_deg = 0;
};

Image<Rgb8> laid_on(const PictureSize& eye, const DrawnViews& drawn, std::size_t view, const Fit& fit,
                    const Move& move) {
  const double ratio = fit.scale / drawn.scale;
  const double left = fit.origin_x + move.x + drawn.left * ratio, top = fit.origin_y + move.y + drawn.top * ratio;
  const Image<Rgb8>& picture = drawn.pictures[view];
  if (move.roll_deg == 0 && ratio == 1)
    return laid_at(static_cast<int>(std::lround(left)), static_cast<int>(std::lround(top)), picture, eye);
  cv::Mat turn = cv::getRotationMatrix2D({static_cast<float>(eye.width) / 2, static_cast<float>(eye.height) / 2},
                                         -move.roll_deg, 1);
  // A pixel's centre is half a pixel from its number: (x + ½)·ratio + left − ½, and then the turn.
  const double at_x = left + ratio / 2 - 0.5, at_y = top + ratio / 2 - 0.5;
  for (int row = 0; row < 2; ++row) {
    turn.at<double>(row, 2) += turn.at<double>(row, 0) * at_x + turn.at<double>(row, 1) * at_y;
    turn.at<double>(row, 0) *= ratio;
    turn.at<double>(row, 1) *= ratio;
  }
  Image<Rgb8> laid(eye.width, eye.height);
  cv::Mat target = as_mat(laid);
  cv::warpAffine(as_mat(picture), target, turn, target.size(), cv::INTER_LINEAR);
  return laid;
}

void put_photograph_on_the_left(const Image<Rgb8>& photograph, Image<Rgb8>& painting) {
  for (int y = 0; y < painting.height(); ++y)
    std::ranges::copy(photograph.row(y).subspan(0, photograph.width() / 2), painting.row(y).begin());
}

/// Puts a share of another picture's light in the place of its own.
void let_through(const Image<Rgb8>& other, float share, Image<Rgb8>& picture) {
  const cv::Mat own = as_mat(std::as_const(picture)).clone();
  cv::Mat mixed = as_mat(picture);
  cv::addWeighted(own, 1 - share, as_mat(other), share, 0, mixed);
}

/// Adds what crosstalk lets through. `lay` makes the picture of a view by its number; those that leak follow the eyes'.
template <class Lay>
void leak_into_eyes(const ViewState& state, Lay lay, Image<Rgb8>& left, Image<Rgb8>& right) {
  const Leaks leaks = leaks_of(state);
  std::size_t view = 2;
  // Shares are of all the light in the end.
  for (const auto& [of_eye, picture] : {std::pair{&leaks.left, &left}, std::pair{&leaks.right, &right}}) {
    float share = 1 - state.crosstalk;
    for (const LeakingView& leak : *of_eye) {
      share += leak.share;
      let_through(lay(view++), leak.share / share, *picture);
    }
  }
}

/// Blackens what only one eye shows at its sides: the picture's edge lies in the same columns for both.
void show_what_both_show(const PictureSize& content, const Fit& fit, double shift_left, double shift_right,
                         Image<Rgb8>& left, Image<Rgb8>& right) {
  const double first = fit.origin_x + std::max(shift_left, shift_right);
  const double last = fit.origin_x + std::min(shift_left, shift_right) + content.width * fit.scale;
  const int from = std::clamp(static_cast<int>(std::lround(first)), 0, left.width());
  const int to = std::clamp(static_cast<int>(std::lround(last)), from, left.width());
  for (Image<Rgb8>* eye : {&left, &right})
    for (int y = 0; y < eye->height(); ++y) {
      std::ranges::fill(eye->row(y).subspan(0, from), Rgb8());
      std::ranges::fill(eye->row(y).subspan(to), Rgb8());
    }
}

/// An anaglyph of one picture would only tint it.
const OutputMode& mode_for(const Content& content, const ViewState& state) {
  const OutputMode& mode = find_output_mode(state.mode);
  const bool tints = has_one_view(content) && std::holds_alternative<const AnaglyphKind*>(mode.kind);
  return tints ? find_output_mode("left") : mode;
}

LenticularScreen screen_of(const ViewState& state) {
  return state.screen.empty() ? lenticular_screen_of(find_display(state.display)) : find_lenticular(state.screen);
}

}  // namespace

std::optional<PictureSize> screen_size_of(const ViewState& state) {
  if (!shows_display_views(find_output_mode(state.mode))) return {};
  try {
    const LenticularScreen screen = screen_of(state);
    return PictureSize{screen.width, screen.height};
  } catch (const Error&) {
    return {};  // a display without lenses
  }
}

namespace {

/// Whether a painting's layers are shown from a side.
bool stands_apart(const Content& content, const ViewState& state) {
  const auto* const painted = std::get_if<PaintedContent>(&content);
  return painted != nullptr && state.layers_apart_deg != 0 && painted->painting && can_stand_apart(*painted->painting);
}

}  // namespace

Frame Stage::draw(const Content& content, const ViewState& state, const Viewport& viewport, Effort effort) {
  if (std::holds_alternative<std::monostate>(content))
    return {.picture = {viewport.width, viewport.height}, .right = {}, .places = {}, .shown = {}, .placed = {}};
  const Content& placed = drawer_.placed(content, state);
  const Content& shown = drawer_.bent(placed, state);
  Frame frame;
  if (shows_display_views(find_output_mode(state.mode)))
    frame = draw_display(shown, state, viewport);
  else if (stands_apart(shown, state))
    frame = draw_apart(std::get<PaintedContent>(shown), state, viewport);
  else
    frame = draw_eyes(shown, state, viewport, effort);
  frame.shown = shown;
  frame.placed = placed;
  if (measured_ != shown) {
    measured_ = shown;
    depth_ = depth_of(shown);
  }
  frame.depth = depth_;
  return frame;
}

Frame Stage::draw_apart(const PaintedContent& content, const ViewState& state, const Viewport& viewport) {
  const OutputMode& mode = find_output_mode(state.mode);
  std::vector<Image<Rgb8>> eyes = layers_apart_.draw(content.painting, state, eye_size(mode, viewport));
  if (state.swap) std::swap(eyes[0], eyes[1]);
  const ViewPlace whole{left_eye, 0, 0, eyes[0].width(), eyes[0].height()};
  const ViewPlace place = places_in_frame(mode, whole, whole, viewport).front();
  Frame frame = compose(mode, std::move(eyes[0]), std::move(eyes[1]), viewport);
  frame.planes = layers_apart_.planes();
  for (PlaneFrame& plane : frame.planes) {
    const auto squeeze_x = static_cast<float>(place.squeeze_x), squeeze_y = static_cast<float>(place.squeeze_y);
    for (FramePoint& corner : plane.corners)
      corner = {static_cast<float>(place.left) + squeeze_x * corner.x,
                static_cast<float>(place.top) + squeeze_y * corner.y};
    plane.way = {squeeze_x * plane.way.x, squeeze_y * plane.way.y};
  }
  return frame;
}

Frame Stage::draw_display(const Content& content, const ViewState& state, const Viewport& viewport) {
  const std::vector<Image<Rgb8>>& views = drawer_.display_views(content, state);
  if (state.mode == "lenticular") {
    const LenticularScreen screen = screen_of(state);
    return {.picture = laid_at(-viewport.screen_x, -viewport.screen_y, interleave(views, screen),
                               {viewport.width, viewport.height}),
            .right = {},
            .places = {},
            .shown = {},
            .placed = {}};
  }
  const DisplayPreset& display = find_display(state.display);
  QuiltLayout layout{display.quilt_columns, display.quilt_rows};
  if (layout.columns * layout.rows != static_cast<int>(views.size()))
    layout = {static_cast<int>(std::ceil(std::sqrt(static_cast<double>(views.size())))), 1};
  while (layout.columns * layout.rows < static_cast<int>(views.size())) ++layout.rows;
  std::vector<Image<Rgb8>> filled = views;
  filled.resize(static_cast<std::size_t>(layout.columns) * layout.rows,
                Image<Rgb8>(views.front().width(), views.front().height()));
  const Image<Rgb8> quilt = make_quilt(filled, layout);
  const double scale = std::min(
      {static_cast<double>(viewport.width) / quilt.width(), static_cast<double>(viewport.height) / quilt.height(), 1.});
  const PictureSize size{std::max(static_cast<int>(quilt.width() * scale), 1),
                         std::max(static_cast<int>(quilt.height() * scale), 1)};
  return {.picture = centred(reduced(quilt, size), viewport),
          .right = {},
          .places = {},
          .scale = scale,
          .shown = {},
          .placed = {}};
}

namespace {

/// Where a view of the content lies in the picture for an eye, moved by so many pixels.
ViewPlace place_of(ViewPosition view, PictureSize eye, const Fit& fit, double shift_px) {
  return {.view = view,
          .width = eye.width,
          .height = eye.height,
          .scale = fit.scale,
          .origin_x = fit.origin_x + shift_px,
          .origin_y = fit.origin_y};
}

}  // namespace

Frame Stage::draw_eyes(const Content& content, const ViewState& state, const Viewport& viewport, Effort effort) {
  const OutputMode& mode = mode_for(content, state);
  const PictureSize eye = eye_size(mode, viewport);
  PictureSize size = size_of(content);
  const bool has_no_size = size.width == 0;
  if (has_no_size) size = {eye.width, eye.height};
  const Fit fit = has_no_size ? Fit() : fit_in(eye, size, state.framed);
  const WantedPart part = wanted_part(fit, eye, size);
  const std::vector<ViewPosition> positions = wanted_positions(mode, state);
  const bool shows_depth = state.comparison == Comparison::depth;
  const bool photograph_only = state.comparison == Comparison::photograph || shows_depth;
  const DrawnViews* const photographs =
      state.comparison == Comparison::painting ? nullptr : drawer_.photographed(content, part, positions, shows_depth);
  const DrawnViews& drawn = photograph_only && photographs != nullptr
                                ? *photographs
                                : drawer_.painted(content, state, part, positions, effort);

  const bool wiggles = std::holds_alternative<Wiggle>(mode.kind);
  const std::size_t first = wiggles ? static_cast<std::size_t>(wiggle_view(state.step)) : 0;
  const std::size_t last = wiggles ? first : 1;
  const Adjustment& adjustment = state.adjustment;
  const double zero_parallax_px = adjustment.zero_parallax_px * fit.scale;
  // The eyes' distance on the screen is rounded once, so that the plane is met to half a pixel.
  const double shift_left = std::round(drawn.positions[first].eye_separations() * zero_parallax_px);
  const double shift_right =
      shift_left + std::round((drawn.positions[last] - drawn.positions[first]) * zero_parallax_px);
  const auto lay = [&](std::size_t view, double shift, double share) {
    const Move move{shift, share * adjustment.vertical_px, share * adjustment.roll_deg};
    Image<Rgb8> laid = laid_on(eye, drawn, view, fit, move);
    if (state.comparison == Comparison::split && photographs != nullptr)
      put_photograph_on_the_left(laid_on(eye, *photographs, view, fit, move), laid);
    return laid;
  };
  Image<Rgb8> left = lay(first, shift_left, -0.5), right = lay(last, shift_right, 0.5);
  if (!wiggles)
    leak_into_eyes(
        state,
        [&](std::size_t view) {
          return lay(view, shift_left + std::round((drawn.positions[view] - drawn.positions[first]) * zero_parallax_px),
                     0);
        },
        left, right);
  if (first != last) show_what_both_show(size, fit, shift_left, shift_right, left, right);
  ViewPlace left_place = place_of(drawn.positions[first], eye, fit, shift_left);
  ViewPlace right_place = place_of(drawn.positions[last], eye, fit, shift_right);
  if (state.swap) {
    std::swap(left, right);
    std::swap(left_place, right_place);
  }
  Frame frame = compose(mode, std::move(left), std::move(right), viewport);
  frame.places = places_in_frame(mode, left_place, right_place, viewport);
  frame.scale = fit.scale;
  frame.preliminary = drawn.preliminary;
  frame.brightness = drawn.brightness;
  frame.model_depth = drawn.depth;
  if (drawn.depth) frame.model_views = drawn.positions;
  return frame;
}

}  // namespace wheatstone::viewer
