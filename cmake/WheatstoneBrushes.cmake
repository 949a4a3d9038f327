# Writes the built-in brushes as C++: the pixels of binary PGM files of 256 x 64.
#
#   cmake -DFOLDER=brushes "-DNAMES=round;flat" -DTO=built_in_brushes.cpp -P WheatstoneBrushes.cmake
set(text "#include \"wheatstone/marks/built_in_brushes_internal.h\"\n\nnamespace wheatstone {\nnamespace {\n\n")
foreach(name IN LISTS NAMES)
  file(READ ${FOLDER}/${name}.pgm header LIMIT 14)
  if(NOT header STREQUAL "P5\n256 64\n255\n")
    message(FATAL_ERROR "${FOLDER}/${name}.pgm: expected a binary PGM of 256x64 pixels, made by scripts/make-brushes")
  endif()
  file(READ ${FOLDER}/${name}.pgm pixels OFFSET 14 HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," pixels "${pixels}")
  string(APPEND text "constexpr std::uint8_t ${name}_brush[256 * 64] = {${pixels}};\n")
  string(APPEND list "{\"${name}\", ${name}_brush}, ")
endforeach()
file(WRITE ${TO} "${text}
constexpr BuiltInBrush all[] = {${list}};

}  // namespace

std::span<const BuiltInBrush> built_in_brushes() { return all; }

}  // namespace wheatstone\n")
