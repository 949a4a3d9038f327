# What Wheatstone buys instead of writing; all of it is packaged by Debian 12 (scripts/install-deps).

# As if from find_package(Wheatstone REQUIRED): a missing library ends the configuration.
set(CMAKE_FIND_PACKAGE_NAME Wheatstone)
set(Wheatstone_FIND_REQUIRED TRUE)
include(${CMAKE_CURRENT_LIST_DIR}/WheatstoneLibraries.cmake)
unset(CMAKE_FIND_PACKAGE_NAME)

# Only while building: the command line's parser and the compiler of the painting file's schema.
find_package(CLI11 REQUIRED)
find_package(FlatBuffers REQUIRED)
find_program(FLATC_PROGRAM flatc REQUIRED)
