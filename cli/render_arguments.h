#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "camera_motion.h"
#include "options.h"
#include "wheatstone/app/annotate.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::cli {

/// What the processes of mpirun share of a film.
enum class Distribution { particles, frames };

/// What `render` is told of a film.
struct RenderFilmArguments {
  CameraMotion motion;
  Rational rate{24, 1};
  std::optional<StereoLayout> output_layout;
  std::string frame_range;
  FilmWriterOptions writing;
  int checkpoint = 48;
  bool resume = false, skip_existing = false;
  Distribution distribute = Distribution::particles;
};

/// What `render` is told.
struct RenderArguments {
  Given given;
  std::string file;
  std::string output = "views";
  RenderParticlesOptions options;
  PictureSize size{640, 360};
  std::string display;
  std::optional<std::array<double, 2>> focus;  ///< shares of a view's width and height
  float focus_radius = 0.25f, focus_gain = 1.5f;
  bool annotate = false;
  Annotation annotation;
  bool points = false;  ///< of a model, its vertices are drawn as particles
  std::string values, interleave, save_slices;
  std::optional<QuiltLayout> quilt;
  std::string format = "png";
  double aspect = 0;  ///< of the display; 0: a view's own
  RenderFilmArguments film;
};

Rows render_rows(RenderArguments& arguments);

/// Whether depth planes are read in place of particles.
bool reads_slices(const RenderArguments& arguments);

/// Whether triangles are read in place of particles.
bool reads_model(const RenderArguments& arguments);

/// The option with which particles are drawn in the thesis's look without --look; empty: none.
std::string option_of_thesis(const RenderArguments& arguments);

bool is_thesis(const RenderArguments& arguments);

/// Whether depth planes are what is made, or made as well.
bool makes_slices(const RenderArguments& arguments);

/// Whether a run makes a film: of a series, or with a camera that moves.
bool makes_film(const RenderArguments& arguments);

/// What a display by name asks for, where the user does not say otherwise. Throws Error{wrong_usage}.
RenderArguments for_display(const RenderArguments& given);

/// Throws Error{wrong_usage}.
RenderParticlesOptions render_options_from(const RenderArguments& arguments);

/// Throws Error{wrong_usage} where --quilt has not a place for each of so many views.
void check_quilt(const QuiltLayout& layout, int views);

/// The options of `render` that other programs have: those of its views; all but those of output files, films and
/// streams.
Rows call_rows(RenderArguments& arguments);

/// The arguments of a call of another program. `file` is empty where the particles come from elsewhere. Throws
/// Error{wrong_usage} as set_rows does, and for options without effect.
RenderArguments arguments_of_call(const std::string& file, std::span<const NamedWords> options);

}  // namespace wheatstone::cli
