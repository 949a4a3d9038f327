#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "wheatstone/app/render_particles.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::cli {

/// What the processes of mpirun share of a film.
enum class Distribution { particles, frames };

/// What `render` is told of a film, as it is typed.
struct RenderFilmArguments {
  int frames = 0;  ///< 0: one a snapshot
  float orbit_deg = 0;
  std::string camera;  ///< a path's file
  std::string rate = "24";
  std::string output_layout, frame_range;
  FilmWriterOptions writing;
  int checkpoint = 48;
  bool resume = false, skip_existing = false;
  Distribution distribute = Distribution::particles;
};

/// What `render` is told, as it is typed.
struct RenderArguments {
  std::string file;
  std::string output = "views";
  RenderParticlesOptions options;
  std::string size = "640x360";
  std::string splat;
  std::string display, centre, look_at, selection, depth_mapping;
  std::string focus;
  float focus_radius = 0.25f, focus_gain = 1.5f;
  std::string fit = "auto";
  bool annotate = false;
  std::string values;
  std::string cold, hot;
  std::string quilt, interleave, save_slices;
  std::string format = "png";
  double aspect = 0;  ///< of the display; 0: a view's own
  RenderFilmArguments film;
};

void add_render_options(CLI::App& command, RenderArguments& arguments);

/// Throws Error{wrong_usage} for an option that has no effect on this input, or beside the others.
void refuse_options_without_effect(const CLI::App& command, const RenderArguments& arguments, bool input_is_slices);

/// What a display by name asks for, where the user does not say otherwise. Throws Error{wrong_usage}.
RenderArguments for_display(const RenderArguments& given, const CLI::App& command);

/// Throws Error{wrong_usage}.
RenderParticlesOptions render_options_from(const RenderArguments& arguments);

/// The layout that --quilt is for so many views. Throws Error{wrong_usage}.
QuiltLayout quilt_for(const std::string& text, int views);

/// The name of a way of rendering.
std::string name_of(Method method);

}  // namespace wheatstone::cli
