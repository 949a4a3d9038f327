#include "view_arguments.h"

namespace wheatstone::cli {

Rows view_rows(ViewArguments& a) {
  return {
      row("FILE", texts(a.files),
          "Paintings (.wst), stereo photographs, films, pictures with depth, quilts, slices (.exr), particles, or a "
          "series of snapshots ('snap_%03d.hdf5'), or a folder of photographs; two pictures of one scene are its left "
          "and right view"),
      row("--mode", text(a.mode), "Output mode, as --to of 'wheatstone pack'; the left eye's picture by default"),
      row("--style", text(a.style), "Style of painted photographs: a preset or a style file"),
      row("--display", text(a.display), "Display, which sets the views of a quilt and the comfortable depth"),
      row("--camera", text(a.camera), "Camera path to play, as in 'wheatstone render'"),
      row("--quantity", text(a.quantity),
          "Quantity of particles that is shown, as in 'wheatstone render': column-density, mean:temperature"),
      row("--focus", text(a.focus),
          "Point X,Y of particles or slices around which there is more depth: shares of a view's width and height"),
      row("--focus-radius", number(a.focus_radius, {-no_bound, no_bound}),
          "Radius of the area around that point, as a share of the width", {}, "--focus"),
      row("--focus-gain", number(a.focus_gain, {-no_bound, no_bound}), "Factor on the depth at that point", {},
          "--focus"),
      row("--size", text(a.size), "Size of the window: WIDTHxHEIGHT"),
      row("--full-screen", flag(a.full_screen), "Begin in full screen"),
      row("--opengl", flag(a.opengl), "Show pictures by OpenGL even if the processor emulates it, which is slower"),
      row("--no-opengl", flag(a.no_opengl), "Show pictures without OpenGL", {}, {}, {"--opengl"}),
      row("--stereo", flag(a.stereo),
          "Let the graphics card show both eyes in turn, for --mode page-flip and shutter glasses", {}, {},
          {"--no-opengl"}),
      row("--script", text(a.script), "Run the commands in this file, one per line, and exit"),
      row("--control", text(a.control),
          "Create a Unix socket on which other programs send commands, one per line; each command gets one line as "
          "answer"),
      row("--bridge-calibration", text(a.bridge_calibration),
          "Write the calibration of the attached Looking Glass, as reported by Looking Glass Bridge, to this .json "
          "file, and exit"),
      row("--commands", flag(a.commands), "List all commands with their keys, and exit")};
}

}  // namespace wheatstone::cli
