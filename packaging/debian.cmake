# Debian packages by CPack: the command line, the window, and what programs are built with.
include(maintainer.cmake)

# Debian's policy: each package has its copyright and its changes.
configure_file(changelog.in changelog @ONLY)
add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
  COMMAND gzip --best --no-name --keep --force changelog DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/changelog VERBATIM)
add_custom_target(wheatstone_changelog ALL DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
foreach(named "wheatstone program" "wheatstone-view window" "libwheatstone-dev development"
  "python3-wheatstone python" "wheatstone-mpi mpi")
  string(REPLACE " " ";" named ${named})
  list(GET named 0 package)
  list(GET named 1 component)
  install(FILES copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME wheatstone)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stereo paintings and particles for 3D displays")
set(CPACK_PACKAGE_CONTACT ${WHEATSTONE_MAINTAINER})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
if(WHEATSTONE_VIEWER)
  list(APPEND CPACK_COMPONENTS_ALL window)
endif()
if(WHEATSTONE_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(WHEATSTONE_MPI)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# With the modules that the library loads: the other packages depend on this one.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME wheatstone)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "opencv-data, fonts-dejavu-core")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"The program wheatstone paints stereo photographs and films so that both eyes
see one painting, and renders particle data sets for stereo, lenticular and
light-field displays.")
set(CPACK_DEBIAN_WINDOW_PACKAGE_NAME wheatstone-view)
set(CPACK_DEBIAN_WINDOW_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_WINDOW_PACKAGE_DEPENDS "wheatstone (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_WINDOW_DESCRIPTION
"The window of Wheatstone shows photographs, paintings, films and particles in
any stereo layout and from any place, and paints what it shows.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-wheatstone)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "wheatstone (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${CMAKE_CURRENT_SOURCE_DIR}/python/postinst;${CMAKE_CURRENT_SOURCE_DIR}/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"The package wheatstone for Python reads, rectifies, matches and paints pairs of
pictures and films, and renders particles, from and to NumPy's arrays.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME wheatstone-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "wheatstone (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION
"With this module, processes that mpirun starts on one or on many machines
share the rendering of a particle data set.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libwheatstone-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "wheatstone (= ${PROJECT_VERSION}), libopencv-dev, liblcms2-dev, libheif-dev, \
libwebp-dev, libpng-dev, libjpeg-dev, libtiff-dev, libexif-dev, libfreetype-dev, libfontconfig-dev, libhpdf-dev, libepoxy-dev, libtbb-dev, libhwy-dev, zlib1g-dev, libisal-dev, libhdf5-dev, libcfitsio-dev, libzip-dev, libnanoflann-dev, \
libfftw3-dev, libtomlplusplus-dev, libfmt-dev, \
libboost-dev, libeigen3-dev, nlohmann-json3-dev, libflatbuffers-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"The static library of Wheatstone, its headers, and what CMake's
find_package(Wheatstone) reads.")

include(CPack)
