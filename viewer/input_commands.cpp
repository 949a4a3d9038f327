#include <cmath>

#include "command_groups_internal.h"
#include "depth_placing.h"
#include "gaze.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

void track_head(Viewer& viewer, const Words& words) {
  std::optional<std::uint16_t> port;
  if (words[0] != "off") {
    const double number = number_of(words[0], 0, 65535);
    if (number != std::floor(number)) throw Error(ErrorKind::wrong_usage, "expected a UDP port or off");
    port = static_cast<std::uint16_t>(number);
  }
  viewer.inputs().track_head(port, viewer.session());
}

void follow_gaze(Viewer& viewer, const Words& words) {
  if (words[0] != "pointer" && words[0] != "off")
    throw Error(ErrorKind::wrong_usage, "'" + words[0] + "' cannot be followed, expected pointer or off");
  viewer.session().gaze_follows_pointer = words[0] == "pointer";
  viewer.session().fixation.reset();
}

void deepen_gaze(Viewer& viewer, const Words& words) {
  constexpr double most = 4;
  set_gaze_gains(viewer.session(),
                 {static_cast<float>(number_of(words[0], 0, most)), static_cast<float>(number_of(words[1], 0, most))});
  if (!can_bend(viewer.session().opened.content))
    viewer.tell("only a painting of strokes or lines can have more depth where one looks");
}

constexpr double longest_smoothing_s = 2, longest_prediction_s = 0.5;

constexpr Command input_table[] = {
    // name, arguments, menu, text, keys
    {"head-tracker", "PORT|off", "Depth", "Follow the head position that OpenTrack sends to a UDP port (4242)", "",
     track_head},
    {"head-smoothing", "SECONDS", "Depth", "Smooth the tracked head position over this time", "",
     [](Viewer& v, const Words& w) { v.session().head_filter.smoothing_s = number_of(w[0], 0, longest_smoothing_s); }},
    {"head-prediction", "SECONDS", "Depth", "Predict the tracked head position this far ahead", "",
     [](Viewer& v, const Words& w) {
       v.session().head_filter.prediction_s = number_of(w[0], 0, longest_prediction_s);
     }},
    {"gaze", "X Y", "Depth", "Set the gaze point, in picture pixels", "",
     [](Viewer& v, const Words& w) {
       frame_of(v);
       look_at(v, number_of(w[0]), number_of(w[1]));
     }},
    {"gaze-follows", "pointer|off", "Depth", "Take the pointer as the gaze point; the screen plane follows it", "",
     follow_gaze},
    {"gaze-depth", "THERE ELSEWHERE", "Depth", "More depth where one looks and less elsewhere: 1.5 0.5; 1 1 for none",
     "", deepen_gaze},
};

}  // namespace

std::span<const Command> input_commands() { return input_table; }

}  // namespace wheatstone::viewer
