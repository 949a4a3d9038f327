#pragma once

#include <filesystem>
#include <string>

#include "wheatstone/display/lenticular.h"

namespace wheatstone {

/// The library of Looking Glass Bridge, the driver of Looking Glass displays: of the newest one that its settings
/// (~/.lgf/Bridge/settings.json) name; without settings, a name that the system's loader looks for.
std::filesystem::path bridge_library();

/// The calibration of the first Looking Glass that is attached, as Bridge's library has it, which is loaded for that.
/// The library was seen to end the program where it finds no display: this is for a program that does nothing else.
/// Throws Error{cannot_read_write} where it is not installed, lacks a function, or knows of no display.
LenticularScreen calibration_from_bridge(const std::filesystem::path& path);

/// A calibration as read_calibration reads it.
std::string calibration_text(const LenticularScreen& screen);

}  // namespace wheatstone
