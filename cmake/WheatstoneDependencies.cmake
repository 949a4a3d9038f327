# What Wheatstone buys instead of writing; all of it is packaged by Debian 12 (scripts/install-deps).

# As if from find_package(Wheatstone REQUIRED): a missing library ends the configuration.
set(CMAKE_FIND_PACKAGE_NAME Wheatstone)
set(Wheatstone_FIND_REQUIRED TRUE)
include(${CMAKE_CURRENT_LIST_DIR}/WheatstoneLibraries.cmake)
wheatstone_find_libraries(
  opencv_core opencv_imgproc opencv_calib3d opencv_dnn opencv_features2d opencv_objdetect opencv_video opencv_ximgproc
  OpenImageIO::OpenImageIO TBB::tbb fmt::fmt nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus
  nanoflann::nanoflann ZLIB::ZLIB PNG::PNG JPEG::JPEG TIFF::TIFF Eigen3::Eigen Boost::headers PkgConfig::HWY PkgConfig::HDF5
  PkgConfig::CFITSIO PkgConfig::ISAL PkgConfig::ZIP PkgConfig::FFTW
  PkgConfig::LIBAV PkgConfig::AVFILTER PkgConfig::LCMS PkgConfig::HEIF PkgConfig::WEBP PkgConfig::EPOXY PkgConfig::ASSIMP
  PkgConfig::EXIF PkgConfig::FREETYPE PkgConfig::FONTCONFIG)
unset(CMAKE_FIND_PACKAGE_NAME)

# Only while building: the command line's parser, the compiler of the painting file's schema, and what puts the code
# of shared pages into one file.
find_package(CLI11 REQUIRED)
find_package(FlatBuffers REQUIRED)
find_program(FLATC_PROGRAM flatc REQUIRED)
find_program(ESBUILD_PROGRAM esbuild REQUIRED)
# Optional: without it the program works in one process.
set(MPI_CXX_SKIP_MPICXX TRUE)
find_package(MPI QUIET COMPONENTS CXX)
