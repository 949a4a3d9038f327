# The bought libraries that the rooms link, all packaged by Debian 12 (scripts/install-deps). Read by our own build and
# by the installed package.
include(CMakeFindDependencyMacro)
find_dependency(OpenCV COMPONENTS core imgproc calib3d features2d ximgproc)
find_dependency(OpenImageIO)
find_dependency(TBB)
find_dependency(fmt)
find_dependency(nlohmann_json)
find_dependency(tomlplusplus)
find_dependency(ZLIB)
find_dependency(PkgConfig)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
