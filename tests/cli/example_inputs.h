#pragma once

#include <filesystem>
#include <string>

namespace wheatstone {

/// The file or folder that examples call `name` ("left.jpg", "film.mp4", "rig"), small, made when it is first asked for
/// and kept until the process ends. Empty where no example input has this name.
std::filesystem::path example_input(const std::string& name);

}  // namespace wheatstone
