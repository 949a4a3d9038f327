#pragma once

#include <array>
#include <functional>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/study/path_graph.h"
#include "wheatstone/study/simulated_display.h"

namespace wheatstone {

/// Colours of a drawn graph.
struct GraphLook {
  Rgb8 background{96, 100, 106};
  Rgb8 node{150, 170, 196};
  Rgb8 link{176, 176, 172};
  Rgb8 highlighted{206, 40, 34};
};

/// The graph as one eye sees it through the screen, in perspective: each pixel's line of sight is cut with the spheres
/// and tubes themselves, which cover edges by the share of the pixel. The light is diffuse and the same for all eyes.
Image<Rgb8> draw_graph(const PathGraph& graph, const StudyScreen& screen, const EyePlace& eye,
                       const GraphLook& look = {});

/// Draws what an eye at a place sees.
using DrawForEye = std::function<Image<Rgb8>(const EyePlace& eye)>;

/// What the two eyes of a head see on a simulated display, and of the graph there.
StereoPair draw_for_eyes(const DrawForEye& draw, const StudyScreen& screen, const SimulatedDisplay& display,
                         const HeadPlace& head);
StereoPair draw_for_eyes(const PathGraph& graph, const StudyScreen& screen, const SimulatedDisplay& display,
                         const HeadPlace& head, const GraphLook& look = {});

/// An eye's picture with half the share of each of two others mixed into its light.
Image<Rgb8> with_crosstalk(const Image<Rgb8>& own, const std::array<Image<Rgb8>, 2>& beside, float share);

}  // namespace wheatstone
