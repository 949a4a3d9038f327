# Writes SOURCE into HEADER as a constant (WheatstoneShaders.cmake).
cmake_path(GET SOURCE STEM name)
cmake_path(GET SOURCE FILENAME file)
file(READ ${SOURCE} text)
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [==[
#pragma once

#include "wheatstone/gpu/program.h"

namespace wheatstone {

inline constexpr GpuSource @name@_source{"@file@", R"glsl(@text@)glsl"};

}  // namespace wheatstone
]==])
