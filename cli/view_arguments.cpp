#include "view_arguments.h"

namespace wheatstone::cli {

void add_view_options(CLI::App& command, ViewArguments& arguments) {
  command.add_option(
      "FILE", arguments.files,
      "Paintings (.wst), stereo photographs, films, pictures with depth, quilts, slices (.exr), particles, or a series "
      "of snapshots ('snap_%03d.hdf5'); "
      "two pictures of one scene are its left and right view");
  command.add_option("--mode", arguments.mode, "Output mode, as --to of 'wheatstone pack'; red-cyan by default");
  command.add_option("--style", arguments.style, "Style in which photographs are painted: a preset or a style file");
  command.add_option("--display", arguments.display,
                     "Display, which sets the views of a quilt and what is comfortable");
  command.add_option("--camera", arguments.camera, "Camera path that is played, as of 'wheatstone render'");
  command.add_option(
      "--quantity", arguments.quantity,
      "Numbers that are shown of particles, as of 'wheatstone render': column-density, mean:temperature");
  auto* const focus = command.add_option("--focus", arguments.focus,
                                         "Point X,Y of particles or slices around which there is more depth: shares of "
                                         "a view's width and height");
  command.add_option("--focus-radius", arguments.focus_radius, "Radius of that area, as a share of the width")
      ->type_name("NUMBER")
      ->needs(focus);
  command.add_option("--focus-gain", arguments.focus_gain, "Factor on the depth at that point")
      ->type_name("NUMBER")
      ->needs(focus);
  command.add_option("--size", arguments.size, "Size of the window: WIDTHxHEIGHT")->capture_default_str();
  command.add_flag("--full-screen", arguments.full_screen, "Begin in full screen");
  auto* const opengl = command.add_flag(
      "--opengl", arguments.opengl, "Show pictures by OpenGL also where the processor computes it, which is slower");
  command.add_flag("--no-opengl", arguments.no_opengl, "Show pictures without OpenGL")->excludes(opengl);
  command
      .add_flag("--stereo", arguments.stereo,
                "Have the graphics card show both eyes in turn, for --mode page-flip and shutter glasses")
      ->excludes("--no-opengl");
  command.add_option("--script", arguments.script, "Do the commands in this file, one a line, and end");
  command.add_option(
      "--control", arguments.control,
      "Make a Unix socket on which other programs send commands, one a line; each is answered by a line");
  command.add_option("--bridge-calibration", arguments.bridge_calibration,
                     "Write the calibration of the Looking Glass that is attached, as Looking Glass Bridge has it, to "
                     "this .json file, and end");
  command.add_flag("--commands", arguments.commands, "List all commands with their keys, and end");
  command.footer(
      "\nClick: what lies there comes onto the screen plane. Drag: pan, or turn particles. Wheel: zoom.\n"
      "?: all keys and commands.\n\n"
      "Examples:\n"
      "  wheatstone view painting.wst\n"
      "  wheatstone view left.png right.png --style mosaic --mode left-right\n"
      "  wheatstone view film.mp4 --mode left-right\n"
      "  wheatstone view universe.hdf5 --display looking-glass-portrait\n"
      "  wheatstone view universe.hdf5 --camera path.toml --quantity column-density");
}

std::vector<std::string> view_words(const CLI::App& command) {
  std::vector<std::string> words, files;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const std::vector<std::string>& values = option->results();
    if (!option->nonpositional()) {
      files = values;
      continue;
    }
    const bool is_flag = option->get_expected_max() == 0;
    if (is_flag && !option->as<bool>()) continue;  // a file of options may say so
    words.push_back(option->get_name());
    if (!is_flag) words.insert(words.end(), values.begin(), values.end());
  }
  if (!files.empty()) words.emplace_back("--");
  words.insert(words.end(), files.begin(), files.end());
  return words;
}

}  // namespace wheatstone::cli
