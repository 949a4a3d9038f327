# A module is code that is loaded where a run needs it, with libraries that take long to load (files/module.h).
#
#   wheatstone_module(openimageio ROOM pictures SOURCES ... LIBRARIES ...)
#
# Programs find modules by their run path: here that of the build, after installation that of the installed programs.
# Who links the installed library gets the run path from the room.
set(WHEATSTONE_MODULE_FOLDER ${CMAKE_INSTALL_LIBDIR}/wheatstone)
set(CMAKE_BUILD_RPATH ${PROJECT_BINARY_DIR}/${WHEATSTONE_MODULE_FOLDER})
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${WHEATSTONE_MODULE_FOLDER}")

function(wheatstone_module name)
  cmake_parse_arguments(ARG "" "ROOM" "SOURCES;LIBRARIES" ${ARGN})
  set(target wheatstone_${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${WHEATSTONE_MODULE_FOLDER}
    SKIP_BUILD_RPATH TRUE INSTALL_RPATH "")
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PRIVATE wheatstone_warnings ${ARG_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY WHEATSTONE_MODULES ${target})
  install(TARGETS ${target} LIBRARY DESTINATION ${WHEATSTONE_MODULE_FOLDER} COMPONENT program)
  # What links the room finds the module beside it.
  add_dependencies(wheatstone_${ARG_ROOM} ${target})
  target_link_options(wheatstone_${ARG_ROOM} INTERFACE
    $<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${WHEATSTONE_MODULE_FOLDER}>)
  if(NOT PROJECT_IS_TOP_LEVEL)
    target_link_options(wheatstone_${ARG_ROOM} INTERFACE
      $<BUILD_INTERFACE:-Wl,-rpath,${PROJECT_BINARY_DIR}/${WHEATSTONE_MODULE_FOLDER}>)
  endif()
endfunction()
