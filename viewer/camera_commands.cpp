// The path along which a camera goes around particles.

#include <fmt/format.h>

#include "command_groups_internal.h"
#include "particle_film.h"
#include "particle_moves.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer {
namespace {

void load_camera(Viewer& viewer, const Words& words) {
  viewer.take_camera_path(read_camera_path(words[0]), words[0]);
  if (!viewer.session().film) return;
  viewer.seek_film(0);
  viewer.play_film();
}

void add_key(Viewer& viewer, const Words& /*words*/) {
  if (open_particles(viewer) == nullptr) return viewer.tell("no particles are open", true);
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
  viewer.tell("saved " + words[0]);
}

constexpr Command camera_table[] = {
    // name, arguments, menu, text, keys
    {"camera", "FILE", "Particles", "Open a camera path…", "", load_camera},
    {"add-key", "", "Particles", "Add a keyframe to the camera path", "K", add_key},
    {"remove-key", "", "Particles", "Remove the nearest keyframe", "Shift+K", remove_key},
    {"clear-camera", "", "Particles", "Remove all keyframes", "",
     [](Viewer& v, const Words&) { v.take_camera_path({}); }},
    {"save-camera", "FILE", "Particles", "Save the camera path…", "", save_camera},
};

}  // namespace

std::span<const Command> camera_commands() { return camera_table; }

}  // namespace wheatstone::viewer
