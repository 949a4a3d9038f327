# What find_package(Wheatstone) finds: Wheatstone::wheatstone, all rooms in one. And the program.
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY WHEATSTONE_ROOMS)
add_library(wheatstone INTERFACE)
add_library(Wheatstone::wheatstone ALIAS wheatstone)
target_link_libraries(wheatstone INTERFACE ${rooms})

# wheatstone/wheatstone.h includes all public headers.
file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR}/src CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/wheatstone/*.h)
list(FILTER headers EXCLUDE REGEX "_(internal|opencv)[.]h$")
list(SORT headers)
list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"")
list(JOIN headers "\n" includes)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/wheatstone/wheatstone.h
  CONTENT "#pragma once\n\n// All public headers in one.\n\n@includes@\n" @ONLY)
target_include_directories(wheatstone INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Wheatstone)
install(TARGETS wheatstone ${rooms} EXPORT WheatstoneTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT WheatstoneTargets NAMESPACE Wheatstone:: DESTINATION ${package_folder} COMPONENT development)
install(TARGETS wheatstone_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/wheatstone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE PATTERN "*_opencv.h" EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/generated/wheatstone/wheatstone.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wheatstone COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)

# What each module needs, as the package's configuration reads it.
set(needs "")
set(names)
foreach(target IN LISTS rooms)
  string(REPLACE "wheatstone_" "" room ${target})
  list(APPEND names ${room})
  get_property(libraries GLOBAL PROPERTY WHEATSTONE_LIBRARIES_OF_${room})
  string(APPEND needs "set(wheatstone_libraries_of_${room} ${libraries})\n")
endforeach()
string(REPLACE ";" " " needs "${needs}")
string(REPLACE ";" " " names "${names}")
file(WRITE ${PROJECT_BINARY_DIR}/WheatstoneRooms.cmake "set(wheatstone_all_rooms ${names})\n${needs}")

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/WheatstoneConfig.cmake.in
  ${PROJECT_BINARY_DIR}/WheatstoneConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/WheatstoneConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/WheatstoneConfig.cmake
  ${PROJECT_BINARY_DIR}/WheatstoneConfigVersion.cmake
  ${PROJECT_BINARY_DIR}/WheatstoneRooms.cmake
  ${PROJECT_SOURCE_DIR}/cmake/WheatstoneLibraries.cmake
  DESTINATION ${package_folder} COMPONENT development)
