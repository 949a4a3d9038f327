# Puts what SOURCE includes into it, as WHOLE, and that into HEADER as a constant; HEADER.d tells what it was made of.
# VALIDATOR checks each variant (WheatstoneShaders.cmake).
cmake_minimum_required(VERSION 3.25)
cmake_path(GET SOURCE STEM name)
cmake_path(GET SOURCE FILENAME file)
file(READ ${SOURCE} text)
set(made_of ${SOURCE})
while(text MATCHES "(^|\n)(#include \"([^\"\n]+)\"[^\n]*\n)")
  set(line "${CMAKE_MATCH_2}")
  set(path ${INCLUDES}/${CMAKE_MATCH_3})
  if(NOT EXISTS ${path})
    message(FATAL_ERROR "${SOURCE}: includes ${path}, which is not there")
  endif()
  set(included "")
  if(NOT path IN_LIST made_of)
    file(READ ${path} included)
    list(APPEND made_of ${path})
  endif()
  string(FIND "${text}" "${line}" at)
  string(LENGTH "${line}" length)
  math(EXPR end "${at} + ${length}")
  string(SUBSTRING "${text}" 0 ${at} before)
  string(SUBSTRING "${text}" ${end} -1 after)
  set(text "${before}${included}${after}")
endwhile()
file(WRITE ${WHOLE} "${text}")
string(REGEX MATCHALL "\n// Variant: [^\n]*" variants "${text}")
if(NOT variants)
  set(variants "\n// Variant: ")
endif()
foreach(variant IN LISTS variants)
  string(REPLACE "\n// Variant: " "" variant "${variant}")
  string(REGEX REPLACE "([A-Z_]+=)" "-D\\1" macros "${variant}")
  separate_arguments(macros)
  execute_process(COMMAND ${VALIDATOR} --quiet -l ${macros} ${WHOLE} RESULT_VARIABLE refused)
  if(refused)
    message(FATAL_ERROR "${SOURCE}: glslangValidator refuses variant '${variant}'")
  endif()
endforeach()
list(JOIN made_of " " made_of)
file(WRITE ${HEADER}.d "${HEADER}: ${made_of}\n")
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [==[
#pragma once

#include "wheatstone/gpu/program.h"

namespace wheatstone {

inline constexpr GpuSource @name@_source{"@file@", R"glsl(@text@)glsl"};

}  // namespace wheatstone
]==])
