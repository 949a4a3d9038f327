#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "content.h"
#include "head_tracker.h"
#include "view_state.h"
#include "wheatstone/app/camera_path.h"

namespace wheatstone::viewer {

/// One thing that can be opened: a file, or the two eyes of a photograph.
using Item = std::vector<std::filesystem::path>;

/// What is under way, for a progress bar.
struct Activity {
  std::string step;
  double done = 0;  ///< 0..1
};

/// A head tracker that is listened to.
struct TrackedHead {
  std::uint16_t port = 0;
  bool is_silent = true;  ///< nothing has come for a second
};

/// Where a gaze rests, in pixels of the frame.
struct Fixation {
  double x = 0, y = 0;
};

/// How much depth there is where somebody looks, and how much elsewhere: 1 is as much as without a gaze.
struct GazeGains {
  float there = 1, elsewhere = 1;
  friend bool operator==(const GazeGains&, const GazeGains&) = default;
};

constexpr double click_easing_s = 0.08;  ///< after which a third of the way is left

/// What the pointer does to the maps that a photograph is painted with.
enum class RetouchTool {
  off,
  nearer,
  farther,
  smooth,
  flatten,
  fill_far,
  fill_near,
  lasso_nearer,
  lasso_farther,
  lasso_flatten,
  finer,
  coarser,
  paint,
  erase,
  recolour,
  pick
};

inline constexpr std::array<std::string_view, 16> retouch_tool_names{
    "off",           "nearer", "farther", "smooth", "flatten", "fill-far", "fill-near", "lasso-nearer", "lasso-farther",
    "lasso-flatten", "finer",  "coarser", "paint",  "erase",   "recolour", "pick"};  ///< in their order

struct RetouchBrush {
  RetouchTool tool = RetouchTool::off;
  float radius_px = 30;                   ///< in pixels of the picture
  float strength = 1;                     ///< of a touch: pixels of disparity, or 40 levels of detail
  Rgb8 colour{200, 60, 40};               ///< of strokes
  std::optional<float> begun_at_px = {};  ///< the disparity where the stroke of the hand began
};

/// What stands beside the picture.
enum class Panel { off, style, depth, particles };

inline constexpr std::array<std::string_view, 4> panel_names{"off", "style", "depth", "particles"};  ///< in their order

/// The colours of the window.
enum class Theme { desktop, light, dark };

inline constexpr std::array<std::string_view, 3> theme_names{"desktop", "light", "dark"};  ///< in their order

/// The output modes in which contents of two views or more are opened: what was last chosen for their kind. A picture
/// of one view is shown as it is.
struct UsualModes {
  std::string pictures = "left";  ///< photographs, paintings, films, views
  std::string scenes = "left";    ///< particles and slices, which have no width of their own
};

/// A film that is open.
struct FilmStatus {
  std::int64_t frame = 0;  ///< that is shown, from 0
  double seconds = 0, duration_s = 0;
  bool plays = false;
  bool paints = true;         ///< frames where it stands still
  bool is_placed = false;     ///< its depth was brought to where it is comfortable
  bool of_particles = false;  ///< no film, but a series of particles or a camera's path
  std::string moment;         ///< of those, the time or redshift
};

/// All that a viewer knows: plain data.
struct Session {
  std::vector<Item> items;
  std::size_t item = 0;        ///< that is open
  std::vector<Item> walk;      ///< what PgUp and PgDn go through: the files that were given together, or the folder's
  bool walk_is_given = false;  ///< the former
  double slideshow_s = 0;      ///< how long each of them is shown; 0: until somebody goes on
  Opened opened;
  std::optional<FilmStatus> film;
  std::optional<Activity> whole_film;  ///< a whole film is being painted
  PictureSize eye;                     ///< of the picture that each eye is shown, in screen pixels
  ViewState state;
  UsualModes usual_modes;
  std::string device = "no-glasses";             ///< what somebody looks with: a name of devices()
  bool has_unsaved_work = false;                 ///< something was set by hand that no file holds
  std::optional<float> zero_parallax_target_px;  ///< what it moves to
  double easing_s = click_easing_s;              ///< of that move
  CameraPath camera_path;                        ///< along which particles are looked at, as time goes on
  std::filesystem::path camera_file;             ///< that holds this path; empty: none does
  HeadFilterOptions head_filter;
  std::optional<TrackedHead> tracked_head;
  bool gaze_follows_pointer = false;
  std::optional<Fixation> fixation;
  GazeGains gaze_gains;
  RetouchBrush retouch;
  std::optional<DepthAround> depth_around_target;  ///< what the state's moves to
  std::optional<ScreenFocus> focus_target;         ///< what that of particles and slices moves to
  std::vector<ViewState> done, undone;             ///< states before, for undo and redo
  std::optional<Activity> opening;                 ///< reading and painting
  std::string message;                             ///< the last error or remark, one line
  bool message_is_error = false;
  bool full_screen = false, information = false, help = false;
  int screens = 1;      ///< that there are
  int screen = 0;       ///< that is filled, from 1; 0: the display's own, or the window's
  bool stereo = false;  ///< the graphics card shows a picture for each eye in turn
  Panel panel = Panel::off;
  Theme theme = Theme::desktop;
  std::filesystem::path folder;  ///< where dialogs for files begin; empty: where the program does
  bool ends = false;
  int exit_code = 0;
};

/// Which of the walk is open, as "3 of 17"; empty where there is only one.
std::string place_told(const Session& session);

/// The files of what is open; none where nothing is.
const Item* open_item(const Session& session);

/// A name for a file that a command is to save: that of what is open, with what is saved of it.
std::string proposed_name(const Session& session, std::string_view command);

/// What was opened last, the newest first: what a session has opened, and what earlier ones had. Nothing twice, and at
/// most ten. Paths are made absolute, because the next session may begin in another folder.
std::vector<Item> recent_items(std::span<const Item> opened, std::span<const Item> before);

}  // namespace wheatstone::viewer
