// The input is the payload: a checksum over it would keep every change of it out. It is sealed as version 2, which does
// not deflate it; what it may hold is the same.

#include <flatbuffers/flatbuffers.h>
#include <zlib.h>

#include "one_file.h"
#include "painting_generated.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/painting_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using wheatstone::Painting;
  namespace file = wheatstone::file;
  flatbuffers::FlatBufferBuilder builder;
  const auto payload = builder.CreateVector(data, size);
  file::FinishPaintingFileBuffer(
      builder, file::CreatePaintingFile(builder, 2, static_cast<std::uint32_t>(crc32_z(0, data, size)), payload));
  try {
    const Painting painting = wheatstone::decode_painting(
        {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()}, "input");
    // What is believed must also be drawn; size alone costs time and finds nothing.
    constexpr int small_px = 256;
    if (wheatstone::width_of(painting) <= small_px && wheatstone::height_of(painting) <= small_px)
      for (const wheatstone::ViewPosition view : {wheatstone::left_eye, wheatstone::right_eye})
        wheatstone::draw(painting, view);
  } catch (const wheatstone::Error&) {
  }
  return 0;
}
