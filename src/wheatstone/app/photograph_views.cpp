#include "wheatstone/app/photograph_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {
namespace {

/// The disparity with smooth outlines, and with near things a little larger. Around their edges the camera mixed the
/// colours of two surfaces, and a map is not exact. Pixels that stay behind when a near thing is moved show as specks;
/// pixels that move with it do not.
Image<float> with_edges_near(ImageView<const float> disparity) {
  constexpr int px_a_margin = 400, widest_px = 4;
  constexpr float step_px = 2;
  const int margin = std::clamp(disparity.width() / px_a_margin, 1, widest_px);
  constexpr int smooth_px = 5;
  Image<float> even(disparity.width(), disparity.height()), near(disparity.width(), disparity.height());
  cv::medianBlur(as_mat(disparity), as_mat(even), smooth_px);
  cv::dilate(as_mat(even), as_mat(near),
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * margin + 1, 2 * margin + 1)));
  for (int y = 0; y < near.height(); ++y)
    for (int x = 0; x < near.width(); ++x)
      if (!(near(x, y) > even(x, y) + step_px)) near(x, y) = even(x, y);
  return near;
}

/// Smooths the parts that no photograph shows. They are continued row by row, each row from its own place, and the
/// median of the colours around is calmer.
void calm_unseen(ImageView<const std::uint8_t> unseen, Image<Rgb8>& picture) {
  constexpr int around_px = 5;
  cv::Mat calm, around;
  cv::medianBlur(as_mat(picture), calm, around_px);
  cv::dilate(as_mat(unseen), around, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(around_px, around_px)));
  calm.copyTo(as_mat(picture), around);
}

}  // namespace

std::vector<Image<Rgb8>> draw_photograph_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                               const DisplayViewsOptions& options, double stretch,
                                               const Progress& progress) {
  const int width = photographs.left.width(), height = photographs.left.height();
  const DisplayPlan plan = plan_display({width, height}, depth_ends(geometry.left_disparity), options);
  check_views_fit({options.width, options.height, plan.presentation.views});
  const Image<float> left = with_edges_near(geometry.left_disparity), right = with_edges_near(geometry.right_disparity);
  const std::array<View, 2> eyes{
      View{.colour = photographs.left, .disparity = left, .wanted = {}, .position = left_eye},
      View{.colour = photographs.right, .disparity = right, .wanted = {}, .position = right_eye}};
  // The part of the screen plane that both eyes show fills the frame.
  const double shared = shared_width(width, plan.zero_parallax_px);
  ShownPart part = shown_part(shared, height, options.width, options.height, options.framing, stretch);
  const CoveredPart covered = covered_part(shared, height, options.width, options.height, part);
  std::vector<Image<Rgb8>> views;
  for (const ViewPosition position : plan.presentation.views) {
    report(progress, "views", static_cast<double>(views.size()) / static_cast<double>(plan.presentation.views.size()));
    const View view = make_outer_view(eyes, position, plan.zero_parallax_px);
    // Its pictures begin at a whole pixel; the display's do not.
    const double moved = -(position - central_view) * plan.zero_parallax_px - static_cast<float>(view.frame.origin_px);
    ShownPart of_view = part;
    of_view.left = part.left + (width - shared) / 2 + moved;
    Image<Rgb8> picture = copy_of(view.colour);
    calm_unseen(view.wanted, picture);
    views.push_back(framed_view(picture, options.width, options.height, of_view));
    put_bars(covered, views.back());
  }
  return views;
}

}  // namespace wheatstone
