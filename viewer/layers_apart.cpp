#include "layers_apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::viewer {
namespace {

constexpr double gap = 0.3;              ///< between layers, in widths of the picture
constexpr double distance = 3;           ///< of the viewer, likewise
constexpr double frame_larger = 1.04;    ///< than a layer
constexpr double degrees_of_an_eye = 2;  ///< between what two eyes at that distance see of the stack

/// One layer for each of the views. What lets a black ground and a white one through alike covers nothing.
std::vector<LayerPicture> paint_alone(const Painting& one_layer, double scale,
                                      const std::array<ViewPosition, 2>& eyes) {
  const PreparedPainting prepared = prepare(one_layer, {.placement = {.scale = scale}, .relief = false});
  const Image<Rgb8> black(prepared.width(), prepared.height());
  const Image<Rgb8> white(prepared.width(), prepared.height(), {255, 255, 255});
  const std::array<ImageView<const Rgb8>, 4> grounds{black, black, white, white};
  const std::array views{eyes[0], eyes[1], eyes[0], eyes[1]};
  std::vector<DrawnView> drawn = draw(prepared, views, grounds);
  std::vector<LayerPicture> pictures;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    LayerPicture picture{std::move(drawn[eye].picture), Image<std::uint8_t>(black.width(), black.height())};
    for (std::size_t i = 0; i < picture.cover.pixels().size(); ++i)
      picture.cover.pixels()[i] = static_cast<std::uint8_t>(
          255 - std::max(drawn[eye + 2].picture.pixels()[i].g - picture.paint.pixels()[i].g, 0));
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

/// Looks at panes from a side: each a picture's width and height, `depth` before the middle of them all.
class SideView {
 public:
  SideView(double degrees, double width, double height, double stack_depth, const PictureSize& size)
      : angle_(degrees * std::numbers::pi / 180), width_(width), height_(height), size_(size) {
    const double across = width * std::cos(angle_) + stack_depth * std::abs(std::sin(angle_));
    const double nearest = magnification(width / 2, stack_depth / 2);
    zoom_ = 0.94 * std::min(size.width / (across * nearest), size.height / (height * nearest));
  }

  /// The corners, in their order around it, of a rectangle that is so much wider and higher than a pane.
  std::array<cv::Point2f, 4> corners(double depth, double larger) const {
    const double x = larger * width_ / 2, y = larger * height_ / 2;
    return {seen(-x, -y, depth), seen(x, -y, depth), seen(x, y, depth), seen(-x, y, depth)};
  }

  cv::Point2f middle(double depth) const { return seen(0, 0, depth); }

  cv::Mat of_pane(double depth) const {
    const std::array from{cv::Point2f(0, 0), cv::Point2f(static_cast<float>(width_), 0),
                          cv::Point2f(static_cast<float>(width_), static_cast<float>(height_)),
                          cv::Point2f(0, static_cast<float>(height_))};
    const std::array<cv::Point2f, 4> to = corners(depth, 1);
    return cv::getPerspectiveTransform(from.data(), to.data());
  }

 private:
  double magnification(double x, double depth) const {
    const double towards = depth * std::cos(angle_) + std::abs(x * std::sin(angle_));
    return distance * width_ / (distance * width_ - towards);
  }
  cv::Point2f seen(double x, double y, double depth) const {
    const double towards = depth * std::cos(angle_) - x * std::sin(angle_);
    const double nearer = zoom_ * distance * width_ / (distance * width_ - towards);
    return {static_cast<float>(size_.width / 2. + nearer * (x * std::cos(angle_) + depth * std::sin(angle_))),
            static_cast<float>(size_.height / 2. + nearer * y)};
  }

  double angle_, width_, height_, zoom_ = 1;
  PictureSize size_;
};

void lay_over(const LayerPicture& pane, const cv::Mat& place, Image<Rgb8>& picture) {
  Image<Rgb8> paint(picture.width(), picture.height());
  Image<std::uint8_t> cover(picture.width(), picture.height());
  cv::Mat paint_mat = as_mat(paint), cover_mat(cover.height(), cover.width(), CV_8UC1, cover.pixels().data());
  const cv::Mat cover_from(pane.cover.height(), pane.cover.width(), CV_8UC1,
                           const_cast<std::uint8_t*>(pane.cover.pixels().data()));
  cv::warpPerspective(as_mat(pane.paint), paint_mat, place, paint_mat.size(), cv::INTER_LINEAR);
  cv::warpPerspective(cover_from, cover_mat, place, cover_mat.size(), cv::INTER_LINEAR);
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    Rgb8& below = picture.pixels()[i];
    const Rgb8 above = paint.pixels()[i];
    const int through = 255 - cover.pixels()[i];
    const auto over = [through](int top, int bottom) {
      return static_cast<std::uint8_t>(std::min(top + (bottom * through + 127) / 255, 255));
    };
    below = {over(above.r, below.r), over(above.g, below.g), over(above.b, below.b)};
  }
}

PlaneFrame plane_frame(const SideView& view, double depth, double at_nearest, double at_farthest) {
  PlaneFrame plane;
  const std::array<cv::Point2f, 4> corners = view.corners(depth, frame_larger);
  for (std::size_t i = 0; i < corners.size(); ++i) plane.corners[i] = {corners[i].x, corners[i].y};
  const cv::Point2f way = view.middle(at_farthest) - view.middle(at_nearest);
  plane.way = {way.x, way.y};
  return plane;
}

void draw_frame(const std::array<cv::Point2f, 4>& corners, Image<Rgb8>& picture) {
  constexpr int fraction_bits = 4, thickness_px = 2;
  const cv::Scalar orange(255, 160, 0);
  std::vector<cv::Point> points;
  for (const cv::Point2f& corner : corners)
    points.emplace_back(static_cast<int>(std::lround(corner.x * (1 << fraction_bits))),
                        static_cast<int>(std::lround(corner.y * (1 << fraction_bits))));
  cv::Mat target = as_mat(picture);
  cv::polylines(target, points, true, orange, thickness_px, cv::LINE_AA, fraction_bits);
}

}  // namespace

bool can_stand_apart(const Painting& painting) { return !layers_of(painting).empty(); }

void LayersApart::draw_layers(const std::shared_ptr<const Painting>& painting, const ViewState& state,
                              const PictureSize& size) {
  const EyePositions eyes = eye_positions(state);
  const double scale = std::min({static_cast<double>(size.width) / width_of(*painting),
                                 static_cast<double>(size.height) / height_of(*painting), 1.});
  if (painting == painting_ && state.slicing == slicing_ && scale == scale_ && eyes.left == eyes_.left &&
      eyes.right == eyes_.right)
    return;
  const Painting shown = sliced(*painting, state.slicing);
  const auto& strokes = std::get<StrokePainting>(shown.marks);
  layers_of_eyes_.assign(2, {});
  for (std::size_t layer = 0; layer < strokes.layers.size(); ++layer) {
    StrokePainting alone = strokes;
    alone.layers = {strokes.layers[layer]};
    std::vector<LayerPicture> pictures =
        paint_alone({.marks = std::move(alone), .surfaces = painting->surfaces}, scale, {eyes.left, eyes.right});
    for (std::size_t eye = 0; eye < 2; ++eye) layers_of_eyes_[eye].push_back(std::move(pictures[eye]));
  }
  for (std::vector<LayerPicture>& layers : layers_of_eyes_) {
    const LayerPicture& first = layers.front();
    const int width = first.paint.width(), height = first.paint.height();
    layers.insert(layers.begin(),
                  {Image<Rgb8>(width, height, strokes.canvas_colour), Image<std::uint8_t>(width, height, 255)});
  }
  plane_shares_ = shares_of(state.slicing.depths, *painting);
  painting_ = painting;
  slicing_ = state.slicing;
  scale_ = scale;
  eyes_ = eyes;
}

std::vector<Image<Rgb8>> LayersApart::draw(const std::shared_ptr<const Painting>& painting, const ViewState& state,
                                           const PictureSize& size) {
  draw_layers(painting, state, size);
  planes_.assign(std::min(plane_shares_.size(), layers_of_eyes_.front().size() - 1), {});
  std::vector<Image<Rgb8>> pictures;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::vector<LayerPicture>& layers = layers_of_eyes_[eye];
    const int width = layers.front().paint.width(), height = layers.front().paint.height();
    const double step = gap * width, stack = step * static_cast<double>(layers.size() - 1);
    const double side = (eye == 0 ? -0.5 : 0.5) * degrees_of_an_eye * static_cast<double>(state.adjustment.separation);
    const SideView view(state.layers_apart_deg + side, width, height, stack, size);
    Image<Rgb8> picture(size.width, size.height);
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      const double depth = step * static_cast<double>(layer) - stack / 2;
      // The canvas, which is the first, has none.
      const std::size_t plane = layer > 0 ? layers.size() - 1 - layer : plane_shares_.size();
      const bool has_plane = plane < plane_shares_.size();
      const double before = has_plane ? (0.5 - plane_shares_[plane]) * step : 0;
      const auto draw_plane = [&] { draw_frame(view.corners(depth + before, frame_larger), picture); };
      if (has_plane && eye == 0) planes_[plane] = plane_frame(view, depth + before, depth + step / 2, depth - step / 2);
      if (has_plane && before < 0) draw_plane();
      lay_over(layers[layer], view.of_pane(depth), picture);
      if (has_plane && before >= 0) draw_plane();
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace wheatstone::viewer
