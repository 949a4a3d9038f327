// From where particles and models are looked at, and the path of a camera around them.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "command_table.h"
#include "orbit.h"
#include "particle_film.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer {
namespace {

void orbit(Viewer& viewer, const Words& words) {
  wheatstone::Framing& framing = state_of(viewer).orbit;
  framing.azimuth_deg = static_cast<float>(std::remainder(framing.azimuth_deg + number_of(words[0]), 360));
  framing.elevation_deg = static_cast<float>(std::clamp(framing.elevation_deg + number_of(words[1]), -89., 89.));
}

void look_at(Viewer& viewer, const Words& words) {
  const Orbited open = orbited_or_refuse(viewer.session().opened.content);
  std::array<float, 3> point{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = static_cast<float>(number_of(words[axis]) - open.origin[axis]);
  state_of(viewer).orbit.look_at = point;
}

void look_at_place(Viewer& viewer, const Words& words) {
  const std::optional<PlaceInView> place = place_at(frame_of(viewer).places, number_of(words[0]), number_of(words[1]));
  if (!turns_around(viewer) || !place) return;
  const std::optional<SeenPoint> seen = point_at(viewer, *place);
  if (!seen) {
    viewer.tell("there is nothing there");
    return;
  }
  state_of(viewer).orbit.look_at = seen->position;
}

void set_projection(Viewer& viewer, const Words& words) {
  constexpr std::array<std::string_view, 2> names{"perspective", "orthographic"};
  state_of(viewer).orbit.orthographic = place_among(names, words[0], "projection") == 1;
}

void load_camera(Viewer& viewer, const Words& words) {
  viewer.take_camera_path(read_camera_path(words[0]), words[0]);
  if (!viewer.session().film) return;
  viewer.seek_film(0);
  viewer.play_film();
}

void add_key(Viewer& viewer, const Words& /*words*/) {
  if (!turns_around(viewer)) return viewer.tell("no particles and no model are open", true);
  const CameraKey key = key_here(viewer.session());
  viewer.take_camera_path(with_key(viewer.session(), key));
  viewer.tell(fmt::format("keyframe at {:.3g}, {} in all; go to another time and add the next", key.at,
                          viewer.session().camera_path.keys.size()));
}

void remove_key(Viewer& viewer, const Words& /*words*/) {
  if (viewer.session().camera_path.keys.empty()) return viewer.tell("the camera path has no keyframe", true);
  viewer.take_camera_path(without_nearest_key(viewer.session()));
  viewer.tell(fmt::format("{} keyframes", viewer.session().camera_path.keys.size()));
}

void save_camera(Viewer& viewer, const Words& words) {
  Session& session = viewer.session();
  if (session.camera_path.keys.empty())
    throw Error(ErrorKind::wrong_usage, "the camera path has no keyframe; 'add-key' makes one");
  write_whole_file(words[0], camera_path_text(session.camera_path));
  session.camera_file = words[0];
  session.has_unsaved_work = false;
  viewer.tell("saved " + words[0]);
}

constexpr Command camera_table[] = {
    // name, arguments, menu, text, keys
    {"orbit", "AZIMUTH ELEVATION", "Camera", "Turn around particles or a model, in degrees", "", orbit},
    {"magnify",
     "FACTOR",
     "Camera",
     "Magnification",
     "",
     [](Viewer& v, const Words& w) { state_of(v).orbit.zoom = static_cast<float>(number_of(w[0], 0.01, 1e6)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.orbit.zoom); }, .range = {0.1, 20, 0.1}}},
    {"look-at", "X Y Z", "Camera", "Point at the centre of the view, around which it turns", "", look_at},
    {"look-at-place", "X Y", "Camera", "Look at what is at a place on the screen", "", look_at_place},
    {"projection",
     "perspective|orthographic",
     "Camera",
     "Projection",
     "",
     set_projection,
     {.now =
          [](const Viewer& v) {
            return v.session().state.orbit.orthographic ? std::string("orthographic") : std::string("perspective");
          }}},
    {"camera", "FILE", "Camera", "Open a camera path…", "", load_camera},
    {"add-key", "", "Camera", "Add a keyframe to the camera path", "K", add_key, {.begins_group = true}},
    {"remove-key", "", "Camera", "Remove the nearest keyframe", "Shift+K", remove_key},
    {"clear-camera", "", "Camera", "Remove all keyframes", "", [](Viewer& v, const Words&) { v.take_camera_path({}); }},
    {"save-camera", "FILE", "Camera", "Save the camera path…", "", save_camera},
};

}  // namespace

std::span<const Command> camera_commands() { return camera_table; }

}  // namespace wheatstone::viewer
