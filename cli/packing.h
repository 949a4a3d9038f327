#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "command.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone::cli {

/// A packing as it is typed.
struct PackingArguments {
  std::string to;         ///< empty: by the output's ending
  std::string screen;     ///< of lenticular
  std::string quilt;      ///< COLUMNSxROWS
  std::string display;    ///< a preset
  int quality = 95;       ///< of JPEG, MPO, JPS
  double seconds = 0.5;   ///< of a wiggle, there and back
  float depth_scale = 1;  ///< of depth: camera separation times focal length in pixels
};

enum class PackingKind {
  anaglyph,
  layout,
  mpo,
  jps,
  views,
  wiggle,
  quilt,
  lenticular,
  exr,
  depth_beside,
  disparity,
  depth
};

struct Packing {
  PackingKind kind;
  std::string name;
  const AnaglyphKind* anaglyph = nullptr;
  StereoLayout layout = StereoLayout::left_right;
  std::optional<QuiltLayout> quilt;
  double aspect = 0;  ///< of a quilt's display; 0: a view's own
};

void add_packing_options(CLI::App& command, PackingArguments& arguments);

/// What was asked for, by name or by the output's ending. Throws Error{wrong_usage} that lists what there is.
Packing find_packing(const PackingArguments& arguments, const std::string& output);

/// How many views the packing needs; 0: any number.
int views_wanted(const Packing& packing);

/// Writes the views and returns the name of what was written. Throws Error: wrong_usage where the packing takes another
/// number of views or the output another ending, cannot_read_write.
std::string write_packed(const Packing& packing, const PackingArguments& arguments, std::span<const Image<Rgb8>> views,
                         const std::string& output, const Session& session);

}  // namespace wheatstone::cli
