# Compute programs are files beside the code that runs them. The build checks each with glslangValidator, and embeds it:
# add_splats.comp becomes `add_splats_source` in the header "add_splats_source.h" of the room that names it.
#
#   wheatstone_shaders(multiview add_splats.comp ...)
find_program(GLSLANG_VALIDATOR_PROGRAM glslangValidator REQUIRED)

function(wheatstone_shaders room)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  foreach(shader IN LISTS ARGN)
    cmake_path(GET shader STEM name)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    set(header ${folder}/${name}_source.h)
    add_custom_command(OUTPUT ${header}
      COMMAND ${GLSLANG_VALIDATOR_PROGRAM} --quiet ${source}
      COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DHEADER=${header} -P ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake
      DEPENDS ${source} ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake VERBATIM)
    target_sources(wheatstone_${room} PRIVATE ${header})
  endforeach()
  target_include_directories(wheatstone_${room} PRIVATE ${folder})
endfunction()
