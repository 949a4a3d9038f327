#pragma once

#include <optional>
#include <string>

#include "command.h"
#include "depth_argument.h"
#include "display_argument.h"
#include "film_mask_argument.h"
#include "film_plan_run.h"
#include "film_shots_run.h"
#include "match_options.h"
#include "model_argument.h"
#include "options.h"
#include "style_options.h"
#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/rotoscope_film.h"

namespace wheatstone::cli {

/// What 'rotoscope' takes.
struct RotoscopeArguments {
  Given given;
  std::string film, right;
  std::string output = "painted.mp4";
  std::optional<StereoLayout> layout;
  EyesInFilm output_layout;
  std::optional<double> from_s, to_s;
  int frame_step = 1;
  std::optional<Rational> rate;
  std::string truth;
  std::string passes = "auto";
  DisplayArguments display;
  std::string flow_values = "255";
  DepthArguments depth;
  MaskArguments mask;
  PlanArguments plan;
  ShotsArguments shots;
  ModelArguments model;
  CameraMotion motion{.frames = 96, .orbit_deg = 360};
  RotoscopeFilmOptions options;
  MatchArguments matching;
  StyleArguments style;
};

/// Whether the film is made of a model of triangles.
bool is_of_model(const RotoscopeArguments& arguments);

/// Whether the film has depth by a renderer, and that is used.
bool uses_passes(const RotoscopeArguments& arguments);

/// Whether the output is only marks.
bool writes_marks(const RotoscopeArguments& arguments);

/// All its options.
Rows rotoscope_rows(RotoscopeArguments& arguments);

}  // namespace wheatstone::cli
