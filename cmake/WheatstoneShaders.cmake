# Compute programs are files beside the code that runs them. The build puts in what each includes, checks it with
# glslangValidator, and embeds it: add_splats.comp becomes `add_splats_source` in the header "add_splats_source.h" of the
# room that names it.
#
#   wheatstone_shaders(multiview add_splats.comp ...)
#
# What several programs share is a file of its own, `views.glsl` say, which has no #version and is not listed here. A
# program names it by its path from src/, as C++ does: #include "wheatstone/gpu/views.glsl". It is put in once, however
# often it is named. The driver's messages count the lines of the whole, which is kept as shaders/add_splats.comp in the
# folder of the build.
#
# A program with a line "// Variant: CHANNELS=2 KERNEL=1" for each set of macros with which it is run is checked with each
# of them. The macros are defined when the program is made (kept_program in wheatstone/gpu/program.h).
find_program(GLSLANG_VALIDATOR_PROGRAM glslangValidator REQUIRED)

function(wheatstone_shaders room)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  set(embed ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake)
  foreach(shader IN LISTS ARGN)
    cmake_path(GET shader STEM name)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    set(whole ${folder}/${shader})
    set(header ${folder}/${name}_source.h)
    add_custom_command(OUTPUT ${header}
      COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DINCLUDES=${PROJECT_SOURCE_DIR}/src -DWHOLE=${whole} -DHEADER=${header}
        -DVALIDATOR=${GLSLANG_VALIDATOR_PROGRAM} -P ${embed}
      DEPENDS ${source} ${embed} DEPFILE ${header}.d VERBATIM)
    target_sources(wheatstone_${room} PRIVATE ${header})
  endforeach()
  target_include_directories(wheatstone_${room} PRIVATE ${folder})
endfunction()
