#include "wheatstone/display/lettering.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"

namespace wheatstone {
namespace {

using Code = char32_t;

/// The characters of a text. Throws Error{wrong_usage} where it is not UTF-8.
std::u32string codes_of(std::string_view text) {
  if (!is_utf8(text)) throw Error(ErrorKind::wrong_usage, "the text is not UTF-8");
  std::u32string codes;
  const auto* at = reinterpret_cast<const FcChar8*>(text.data());
  for (auto left = static_cast<int>(text.size()); left > 0;) {
    FcChar32 code = 0;
    const int bytes = FcUtf8ToUcs4(at, &code, left);
    codes.push_back(code);
    at += bytes;
    left -= bytes;
  }
  return codes;
}

template <auto Free>
struct Freed {
  template <class Pointer>
  void operator()(Pointer* pointer) const {
    Free(pointer);
  }
};
using Pattern = std::unique_ptr<FcPattern, Freed<FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Freed<FcCharSetDestroy>>;
using ObjectSet = std::unique_ptr<FcObjectSet, Freed<FcObjectSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Freed<FcFontSetDestroy>>;

std::string text_of(const FcPattern* font, const char* object) {
  FcChar8* value = nullptr;
  return FcPatternGetString(font, object, 0, &value) == FcResultMatch ? reinterpret_cast<const char*>(value) : "";
}

int number_of(const FcPattern* font, const char* object) {
  int value = 0;
  return FcPatternGetInteger(font, object, 0, &value) == FcResultMatch ? value : 0;
}

/// Fonts that come first are tried first.
int place_of(const std::string& family) {
  constexpr std::array<std::string_view, 3> liked{"DejaVu Sans", "Noto Sans", "Liberation Sans"};
  return static_cast<int>(std::ranges::find(liked, family) - liked.begin());
}

/// FreeType's library and a font at a size.
class Face {
 public:
  Face(const std::filesystem::path& font, int size_px) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) fail(font);
    library_.reset(library);
    FT_Face face = nullptr;
    if (FT_New_Face(library, font.c_str(), 0, &face) != 0) fail(font);
    face_.reset(face);
    if (FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px)) != 0) fail(font);
  }

  int ascent_px() const { return static_cast<int>((face_->size->metrics.ascender + 63) >> 6); }
  int descent_px() const { return static_cast<int>((-face_->size->metrics.descender + 63) >> 6); }

  /// Calls `put` with each letter's bitmap and the place of its upper left corner, from the line's begin and its base;
  /// returns the width of the line.
  template <class Put>
  int set(const std::u32string& codes, Put put) const {
    FT_Pos pen = 0;  // in 64ths of a pixel
    FT_UInt before = 0;
    for (const Code code : codes) {
      const FT_UInt glyph = FT_Get_Char_Index(face_.get(), code);
      FT_Vector nearer{};
      if (before != 0 && FT_Get_Kerning(face_.get(), before, glyph, FT_KERNING_UNFITTED, &nearer) == 0) pen += nearer.x;
      before = glyph;
      if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_HINTING) != 0) continue;
      const FT_GlyphSlot slot = face_->glyph;
      const FT_Pos within = pen & 63;
      FT_Outline_Translate(&slot->outline, within, 0);
      const FT_Pos advance = slot->advance.x;
      if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) == 0)
        put(slot->bitmap, static_cast<int>(pen >> 6) + slot->bitmap_left, -slot->bitmap_top);
      pen += advance;
    }
    return static_cast<int>((pen + 63) >> 6);
  }
  int width_px(const std::u32string& codes) const {
    return set(codes, [](const FT_Bitmap&, int, int) {});
  }

 private:
  [[noreturn]] static void fail(const std::filesystem::path& font) {
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot read the font", font.string()));
  }
  std::unique_ptr<FT_LibraryRec_, Freed<FT_Done_FreeType>> library_;
  std::unique_ptr<FT_FaceRec_, Freed<FT_Done_Face>> face_;
};

void put_line(const Face& face, const std::u32string& codes, int left, int base, ImageView<std::uint8_t> cover) {
  face.set(codes, [&](const FT_Bitmap& letter, int x, int y) {
    for (int row = 0; row < static_cast<int>(letter.rows); ++row)
      for (int column = 0; column < static_cast<int>(letter.width); ++column) {
        const int at_x = left + x + column, at_y = base + y + row;
        if (!cover.contains(at_x, at_y)) continue;
        std::uint8_t& pixel = cover(at_x, at_y);
        pixel = std::max(pixel, letter.buffer[row * letter.pitch + column]);
      }
  });
}

}  // namespace

std::filesystem::path font_for(std::string_view text) {
  const CharSet wanted(FcCharSetCreate());
  for (const Code code : codes_of(text))
    if (code > U' ') FcCharSetAddChar(wanted.get(), code);
  const Pattern pattern(FcPatternCreate());
  FcPatternAddString(pattern.get(), FC_FONTFORMAT, reinterpret_cast<const FcChar8*>("TrueType"));
  FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  FcPatternAddInteger(pattern.get(), FC_SLANT, FC_SLANT_ROMAN);
  FcPatternAddCharSet(pattern.get(), FC_CHARSET, wanted.get());
  const ObjectSet told(FcObjectSetBuild(FC_FAMILY, FC_FILE, FC_WEIGHT, FC_WIDTH, static_cast<char*>(nullptr)));
  const FontSet fonts(FcFontList(nullptr, pattern.get(), told.get()));
  using Rank = std::tuple<int, int, int, std::string>;  // the least is the best; the last is the file
  std::optional<Rank> best;
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    const FcPattern* const font = fonts->fonts[i];
    const std::string file = text_of(font, FC_FILE);
    if (!file.ends_with(".ttf")) continue;  // collections have several fonts
    Rank rank{std::abs(number_of(font, FC_WEIGHT) - FC_WEIGHT_REGULAR), place_of(text_of(font, FC_FAMILY)),
              std::abs(number_of(font, FC_WIDTH) - FC_WIDTH_NORMAL), file};
    if (!best || rank < *best) best = std::move(rank);
  }
  if (!best)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("no TrueType font is installed that has all letters of '{}', expected one, as those of "
                            "Debian's package fonts-dejavu-core",
                            text));
  return std::get<std::string>(*best);
}

std::vector<Image<std::uint8_t>> set_labels(std::span<const std::string> texts, int size_px) {
  const Face face(font_for(fmt::format("{}", fmt::join(texts, " "))), size_px);
  std::vector<Image<std::uint8_t>> labels;
  for (const std::string& text : texts) {
    const std::u32string codes = codes_of(text);
    labels.emplace_back(face.width_px(codes) + 2, face.ascent_px() + face.descent_px());  // slanted parts reach out
    put_line(face, codes, 1, face.ascent_px(), labels.back());
  }
  return labels;
}

Lettering set_text(std::string_view text, int size_px, int width_px) {
  const std::filesystem::path font = font_for(text);
  std::optional<Face> face(std::in_place, font, size_px);
  const auto width_of = [&](const std::string& line) { return face->width_px(codes_of(line)); };
  const std::vector<std::string> lines =
      broken_lines(text, [&](const std::string& line) { return width_of(line) <= width_px; });
  int widest = 1;
  for (const std::string& line : lines) widest = std::max(widest, width_of(line));
  if (widest > width_px) {
    size_px = std::max(size_px * width_px / widest, 1);
    face.emplace(font, size_px);
  }
  const int step = face->ascent_px() + face->descent_px();
  Lettering lettering{Image<std::uint8_t>(width_px, step * static_cast<int>(lines.size())),
                      static_cast<int>(lines.size())};
  int base = face->ascent_px();
  for (const std::string& line : lines) {
    const std::u32string codes = codes_of(line);
    put_line(*face, codes, (width_px - face->width_px(codes)) / 2, base, lettering.cover);
    base += step;
  }
  return lettering;
}

void lay_cover(ImageView<const std::uint8_t> cover, int left, int top, Rgb8 colour, ImageView<Rgb8> picture) {
  const auto mixed = [](std::uint8_t below, std::uint8_t over, int share) {
    return static_cast<std::uint8_t>((below * (255 - share) + over * share + 127) / 255);
  };
  for (int y = 0; y < cover.height(); ++y)
    for (int x = 0; x < cover.width(); ++x) {
      if (!picture.contains(left + x, top + y)) continue;
      Rgb8& pixel = picture(left + x, top + y);
      const int share = cover(x, y);
      pixel = {mixed(pixel.r, colour.r, share), mixed(pixel.g, colour.g, share), mixed(pixel.b, colour.b, share)};
    }
}

}  // namespace wheatstone
