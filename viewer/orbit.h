#pragma once

#include <array>
#include <optional>

#include "compose.h"
#include "content.h"
#include "view_state.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_mapping.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone::viewer {

class Viewer;

/// What a camera turns around: particles or a model.
struct Orbited {
  std::array<double, 3> origin;  ///< of its own coordinates, to which the other places are relative
  std::array<float, 3> middle;   ///< that is looked at where a state does not say otherwise
};

/// None where something else is open.
std::optional<Orbited> orbited(const Content& content);

/// The same; throws Error{wrong_usage} where something else is open.
Orbited orbited_or_refuse(const Content& content);

/// The central camera of the views of a rig, and how deep they stand, as `wheatstone render` has them with the options
/// of the state. Of what is orbited. Throws Error{wrong_usage} where the options make no sense.
struct OrbitedScene {
  Camera camera;
  DepthMapping mapping;
};
OrbitedScene orbited_scene(const Content& content, const ViewState& state, const Rig& rig);

/// A point on the line of sight through a place of a view, so deep.
std::array<float, 3> point_at_depth(const OrbitedScene& scene, const PlaceInView& place, float depth);

/// What is seen at a place of a view.
struct SeenPoint {
  std::array<float, 3> position{};  ///< on the line of sight through the place
  float parallax_px = 0;            ///< on the screen, of a view at full eye separation
};
/// The particle, or the point of the model, that is seen at a place of what a viewer shows; none where there is none,
/// or a model is being drawn.
std::optional<SeenPoint> point_at(const Viewer& viewer, const PlaceInView& place);

/// The framing's point in the middle of the views, moved so that what the central view shows moves by so many pixels.
/// `rig` says how large the views are.
std::array<float, 3> moved_look_at(const Content& content, const ViewState& state, const Rig& rig, double x_px,
                                   double y_px);

/// The views that a viewer's two eyes are shown.
Rig eyes_of(const Viewer& viewer);

/// Whether a camera turns around what is open.
bool turns_around(const Viewer& viewer);

/// Moves what is seen of it by so many pixels of an eye's picture. Does nothing, and returns false, where a camera does
/// not turn around it.
bool pan_orbit(Viewer& viewer, double x_px, double y_px);

/// Magnifies it so many times more; what lies so far from the middle of an eye's picture stays there.
bool magnify_orbit(Viewer& viewer, double factor, double x_px = 0, double y_px = 0);

/// Shows it as when it was opened.
bool fit_orbit(Viewer& viewer);

}  // namespace wheatstone::viewer
