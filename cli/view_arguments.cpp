#include "view_arguments.h"

namespace wheatstone::cli {

Rows view_rows(ViewArguments& a) {
  return {
      row("FILE", texts(a.files),
          "Paintings (.wst), stereo photographs, films, pictures with depth, quilts, slices (.exr), particles, or a "
          "series of snapshots ('snap_%03d.hdf5'), or a folder of photographs; two pictures of one scene are its left "
          "and right view"),
      row("--mode", text(a.mode), "Output mode, as --to of 'wheatstone pack'; the left eye's picture by default"),
      row("--style", text(a.style), "Style in which photographs are painted: a preset or a style file"),
      row("--display", text(a.display), "Display, which sets the views of a quilt and what is comfortable"),
      row("--camera", text(a.camera), "Camera path that is played, as of 'wheatstone render'"),
      row("--quantity", text(a.quantity),
          "Numbers that are shown of particles, as of 'wheatstone render': column-density, mean:temperature"),
      row("--focus", text(a.focus),
          "Point X,Y of particles or slices around which there is more depth: shares of a view's width and height"),
      row("--focus-radius", number(a.focus_radius, {-no_bound, no_bound}),
          "Radius of that area, as a share of the width", {}, "--focus"),
      row("--focus-gain", number(a.focus_gain, {-no_bound, no_bound}), "Factor on the depth at that point", {},
          "--focus"),
      row("--size", text(a.size), "Size of the window: WIDTHxHEIGHT"),
      row("--full-screen", flag(a.full_screen), "Begin in full screen"),
      row("--opengl", flag(a.opengl), "Show pictures by OpenGL also where the processor computes it, which is slower"),
      row("--no-opengl", flag(a.no_opengl), "Show pictures without OpenGL", {}, {}, {"--opengl"}),
      row("--stereo", flag(a.stereo),
          "Have the graphics card show both eyes in turn, for --mode page-flip and shutter glasses", {}, {},
          {"--no-opengl"}),
      row("--script", text(a.script), "Do the commands in this file, one a line, and end"),
      row("--control", text(a.control),
          "Make a Unix socket on which other programs send commands, one a line; each is answered by a line"),
      row("--bridge-calibration", text(a.bridge_calibration),
          "Write the calibration of the Looking Glass that is attached, as Looking Glass Bridge has it, to this .json "
          "file, and end"),
      row("--commands", flag(a.commands), "List all commands with their keys, and end")};
}

}  // namespace wheatstone::cli
