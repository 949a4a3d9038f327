#include "wheatstone/app/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "temporary_folder.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::contact_sheet_test {

TEST(ContactSheet, ShowsEachPictureWholeInItsOrder) {
  const TemporaryFolder folder;
  std::vector<SheetEntry> entries;
  for (const int red : {10, 80, 150, 220, 250}) {
    const std::string file = folder / (std::to_string(red) + ".png");
    write_image(file, Image<Rgb8>(red > 200 ? 90 : 700, 400, {static_cast<std::uint8_t>(red), 0, 0}));
    entries.push_back({file, "a name that is much too long for a small picture, " + std::to_string(red)});
  }
  const Image<Rgb8> sheet = contact_sheet(entries);
  EXPECT_EQ(sheet.width(), 3 * 332 + 12);
  EXPECT_EQ(sheet.height(), 2 * 278 + 12);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const int x = 12 + static_cast<int>(i % 3) * 332 + 160, y = 12 + static_cast<int>(i / 3) * 278 + 200;
    EXPECT_EQ(std::to_string(sheet(x, y).r) + ".png", entries[i].picture.filename().string());
  }
  EXPECT_EQ(sheet(0, 0), (Rgb8{255, 255, 255}));
  // A caption is written under the picture.
  int dark = 0;
  for (int x = 12; x < 332; ++x)
    for (int y = 256; y < 276; ++y) dark += sheet(x, y).g < 128;
  EXPECT_GT(dark, 50);
}

TEST(ContactSheet, OfNothingIsWhite) {
  const Image<Rgb8> sheet = contact_sheet({});
  EXPECT_TRUE(std::ranges::all_of(sheet.pixels(), [](Rgb8 pixel) { return pixel == Rgb8{255, 255, 255}; }));
}

}  // namespace wheatstone::contact_sheet_test
