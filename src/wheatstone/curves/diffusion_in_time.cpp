#include "wheatstone/curves/diffusion_in_time.h"

#include <opencv2/imgproc.hpp>

#include "wheatstone/curves/diffusion_lines_internal.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/motion/film_frame.h"

namespace wheatstone {
namespace {

/// The pixels of the reference view's edges, and those beside them.
Image<std::uint8_t> edge_mask(const std::vector<CarriedEdge>& edges, int width, int height) {
  Image<std::uint8_t> mask(width, height);
  for (const CarriedEdge& edge : edges) {
    const int x = static_cast<int>(std::floor(edge.x)), y = static_cast<int>(std::floor(edge.y));
    if (edge.view == 0 && mask.contains(x, y)) mask(x, y) = 255;
  }
  // Points are two pixels apart.
  Image<std::uint8_t> grown(width, height);
  cv::Mat to = as_mat(grown);
  cv::dilate(as_mat(mask), to, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  return grown;
}

}  // namespace

DiffusionPainting plan_diffusion(const FilmFrame& frame, const Style& style, DiffusionMemory& memory) {
  if (style.propagation == Propagation::independent) return plan_diffusion(frame.views, style);
  SceneOfEdges scene = scene_of_edges(frame.views, style);
  View& reference = scene.views[0];
  if (frame.flow != nullptr) check_fits(*frame.flow, frame.views);
  const bool begins = frame.flow == nullptr || !same_size(memory.picture.frames, reference.colour);
  const FlowPair* flow = begins ? nullptr : frame.flow;

  SteadyPicture picture = begins ? begin_steady(reference.colour) : std::move(memory.picture);
  if (!begins) steady(reference.colour, flow->backward, confirmed(flow->backward, flow->forward), picture);
  reference.colour = rounded(picture.colours);
  std::optional<CarriedEdges> before;
  if (!begins) before.emplace(memory, *flow, frame.views, reference.disparity, scene.depth_threshold_px);
  LinesAndEdges found = lines_beside_edges(scene, before ? &*before : nullptr);
  memory = {std::move(picture), copy_of(reference.disparity),
            edge_mask(found.edges, reference.colour.width(), reference.colour.height()), std::move(found.edges)};
  return std::move(found.painting);
}

}  // namespace wheatstone
