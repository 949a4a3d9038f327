# A room is one folder of src/wheatstone, one static library and one test program.
#
#   wheatstone_room(stereo
#     SOURCES match.cpp ...          compiled into the library
#     ABOVE image depth              the rooms that it may include
#     LIBRARIES opencv_calib3d ...   bought libraries that only its .cpp files see
#     TESTS match_test.cpp ...       compiled into wheatstone_stereo_test
#     TESTS_USE synthetic ...        further rooms that only the tests use: scenes with exact truth, measures
#     TEST_LIBRARIES ...)            bought libraries that only the tests use
add_library(wheatstone_warnings INTERFACE)
# Nothing reads errno or the exceptions of floating point; without them, loops with roots and choices become vectors.
target_compile_options(wheatstone_warnings INTERFACE -fno-math-errno -fno-trapping-math)
target_compile_options(wheatstone_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # Options are structs with defaults: naming only those that differ is how they are meant to be filled.
  -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # With sanitizers, GCC cannot tell what is initialised.
  target_compile_options(wheatstone_warnings INTERFACE $<$<CONFIG:RelWithDebInfo>:-Wno-maybe-uninitialized>)
  if(CMAKE_UNITY_BUILD)
    # Wrong where several source files are compiled as one.
    target_compile_options(wheatstone_warnings INTERFACE -Wno-subobject-linkage)
  endif()
elseif(CMAKE_UNITY_BUILD)
  # For Clang a local name also hides those of the unnamed namespaces of other files.
  target_compile_options(wheatstone_warnings INTERFACE -Wno-shadow)
endif()

# Code that computes little takes much less time to compile when it is optimised little: in all of the builds that are
# named, or under sanitizers alone, where that saves a third.
set(wheatstone_rooms_around_computing app display models share study video)
function(wheatstone_optimise_little target configurations)
  target_compile_options(${target} PRIVATE $<$<CONFIG:${configurations}>:-Og>)
endfunction()
# Under sanitizers, what casts rays and spreads colours takes half of some tests: it is optimised as usual.
set(wheatstone_rooms_of_long_loops curves synthetic)

# A test program is one entry of ctest: what its tests share, such as rendered scenes, is made once. The programs that
# take longest are two entries, each of which runs every second test, and begin first, so that no processor is without
# work at the end. What takes long by nature (random runs, real photographs and films of full size) is in suites whose
# names end in "Long": `make test` leaves them out, `make test-long` runs them and nothing else.
set(wheatstone_longest_tests cli app examples matching)
set(WHEATSTONE_TESTS_LEFT_OUT "" CACHE FILEPATH "File of the tests that are not run: a pattern of GoogleTest a line")
set(wheatstone_tests_left_out "")
if(WHEATSTONE_TESTS_LEFT_OUT)
  file(STRINGS ${WHEATSTONE_TESTS_LEFT_OUT} wheatstone_tests_left_out REGEX "^[^#]")
  list(JOIN wheatstone_tests_left_out ":" wheatstone_tests_left_out)
endif()
function(wheatstone_add_gtest name target)
  set(shards 1)
  if(name IN_LIST wheatstone_longest_tests)
    set(shards 2)
  endif()
  # What tests compute, they compute in the libraries. Themselves they take nearly twice as long to compile when they are
  # optimised more.
  wheatstone_optimise_little(${target} Release,RelWithDebInfo)
  foreach(shard RANGE 1 ${shards})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${name}.${shard} COMMAND ${target})
    set_tests_properties(${name}.${shard} PROPERTIES COST ${shards} TIMEOUT 1800
      ENVIRONMENT "GTEST_FILTER=-*Long.*:${wheatstone_tests_left_out};GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index};GTEST_BRIEF=1")
  endforeach()
  add_test(NAME ${name}.long COMMAND ${target})
  set_tests_properties(${name}.long PROPERTIES
    LABELS long TIMEOUT 1800 ENVIRONMENT "GTEST_FILTER=*Long.*;GTEST_BRIEF=1")
endfunction()

# Files that are compiled once for each kind of processor stay by themselves. Every kind takes the same time to
# compile, so old ones are left out: SSSE3 without SSE4 (before 2008), and under sanitizers SSE4, too.
function(wheatstone_alone_in_unity)
  foreach(source IN LISTS ARGN)
    if(source MATCHES "_simd")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
        COMPILE_DEFINITIONS "HWY_DISABLED_TARGETS=HWY_SSSE3$<$<CONFIG:RelWithDebInfo>:|HWY_SSE4>")
    endif()
  endforeach()
endfunction()

function(wheatstone_room room)
  cmake_parse_arguments(ARG "" "" "SOURCES;ABOVE;LIBRARIES;TESTS;TESTS_USE;TEST_LIBRARIES" ${ARGN})
  set(target wheatstone_${room})
  wheatstone_alone_in_unity(${ARG_SOURCES})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(Wheatstone::${room} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${room} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:wheatstone_warnings> ${ARG_LIBRARIES})
  if(room IN_LIST wheatstone_rooms_around_computing)
    wheatstone_optimise_little(${target} RelWithDebInfo)
  elseif(room IN_LIST wheatstone_rooms_of_long_loops)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O2>)
  endif()
  foreach(above IN LISTS ARG_ABOVE)
    target_link_libraries(${target} PUBLIC wheatstone_${above})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY WHEATSTONE_ROOMS ${target})
  # What the module needs, with all that it uses: for find_package(Wheatstone COMPONENTS ...).
  set(libraries ${ARG_LIBRARIES})
  foreach(above IN LISTS ARG_ABOVE)
    get_property(of_above GLOBAL PROPERTY WHEATSTONE_LIBRARIES_OF_${above})
    list(APPEND libraries ${of_above})
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  set_property(GLOBAL PROPERTY WHEATSTONE_LIBRARIES_OF_${room} ${libraries})

  if(WHEATSTONE_TESTS AND ARG_TESTS)
    add_executable(${target}_test ${ARG_TESTS})
    list(TRANSFORM ARG_TESTS_USE PREPEND wheatstone_)
    target_link_libraries(${target}_test PRIVATE
      ${ARG_TESTS_USE} ${target} wheatstone_shared_data wheatstone_warnings GTest::gmock GTest::gtest_main ${ARG_LIBRARIES} ${ARG_TEST_LIBRARIES})
    target_include_directories(${target}_test PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    wheatstone_add_gtest(${room} ${target}_test)
  endif()
endfunction()
