// Tables of numbers as text, in the ways that people and programs write them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/select.h"

namespace wheatstone::text_table_test {

using testing::ElementsAre;
using testing::Pair;

void expect_three_points(const Cloud& cloud) {
  EXPECT_THAT(cloud.x, ElementsAre(1, 4, 7));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5, 8));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6, 9.5f));
}

TEST(TextTable, ReadsNamedColumnsInAnyOrder) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv",
                   "# made by hand\nid,z,y,x,rho,temp\n1,3,2,1,10,1e4\n2,6,5,4,20,2e4\n3,9.5,8,7,+30,3e4\n");
  const Cloud cloud = read_cloud(folder / "a.csv");
  expect_three_points(cloud);
  EXPECT_THAT(cloud.density, ElementsAre(10, 20, 30));
  EXPECT_THAT(cloud.temperature, ElementsAre(1e4f, 2e4f, 3e4f));
}

TEST(TextTable, WithoutNamesTakesTheFirstThreeColumns) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", "1 2 3 99\r\n4\t5\t6\t99\r\n\n7 8 9.5 99");
  expect_three_points(read_cloud(folder / "a.txt"));
}

TEST(TextTable, WithAByteOrderMarkIsRead) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "\xEF\xBB\xBFx,y,z\r\n1,2,3\r\n4,5,6\r\n7,8,9.5\r\n");
  expect_three_points(read_cloud(folder / "a.csv"));
  write_whole_file(folder / "a.csv", "\xEF\xBB\xBF\"x\";\"y\";\"z\"\n1;2;3\n4;5;6\n7;8;9.5\n");
  expect_three_points(read_cloud(folder / "a.csv"));
  write_whole_file(folder / "a.csv",
                   "\xEF\xBB\xBF"
                   "1 2 3\n4 5 6\n7 8 9.5\n");
  expect_three_points(read_cloud(folder / "a.csv"));
}

TEST(TextTable, APositionNeedsThreeColumns) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "x,y,z,mass\n1,2,3,4\n");
  for (const std::string position : {"x", "x,y", "x,,", "x,y,z,mass"})
    expect_error(ErrorKind::bad_input, "'" + position + "' is not a list of positions, expected three columns",
                 [&] { read_cloud(folder / "a.csv", {.position = position}); });
  EXPECT_THAT(read_cloud(folder / "a.csv", {.position = "mass,z,y"}).x, ElementsAre(4));
}

TEST(TextTable, NamesWhatIsWrongAndWhere) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& part, const CloudChoice& choice = {}) {
    write_whole_file(folder / "a.csv", text);
    expect_error(ErrorKind::bad_input, part, [&] { read_cloud(folder / "a.csv", choice); });
  };
  refused("x,y,z\n1,2,3\n4,five,6\n", "line 3, column 2: 'five'");
  refused("x,y,z\n1,2\n", "line 2 has 2 columns");
  refused("x,y,z\n", "no particles");
  refused("# nothing\n", "no particles");
  refused("a,b,c\n1,2,3\n", "no column 'x', but a, b, c");
  refused("x,y,z,rho\n1,2,3,4\n", "no column 'mass', but x, y, z, rho", {.density = "mass"});
}

TEST(TextTable, NamesMayHaveUnitsInBracketsAndStandInAComment) {
  const TemporaryFolder folder;
  const std::string rows = "10 1 2 3\n20 4 5 6\n30 7 8 9.5\n";
  for (const std::string heading :
       {"density [Msun/kpc^3]  x [kpc]  y[kpc] z (kpc)\n", "# density x y z\n", "#density, x, y, z\n",
        "# written by hand\n# one particle a line\n# Density [g cm^-3] X [kpc] Y [kpc] Z [kpc]\n",
        "\"density [a, b]\",\"x [kpc]\",\"y [kpc]\",\"z [kpc]\"\n"}) {
    SCOPED_TRACE(heading);
    write_whole_file(folder / "a.txt", heading + rows);
    const Cloud cloud = read_cloud(folder / "a.txt");
    expect_three_points(cloud);
    EXPECT_THAT(cloud.density, ElementsAre(10, 20, 30));
  }
  EXPECT_THAT(open_cloud(folder / "a.txt").units,
              ElementsAre(Pair("density", "a, b"), Pair("x", "kpc"), Pair("y", "kpc"), Pair("z", "kpc")));
}

TEST(TextTable, ACommentOfAnotherLengthOrOtherWordsIsProse) {
  const TemporaryFolder folder;
  for (const std::string comment : {"# x y z of all\n", "# made by me\n", "# x y\n", "# a x z\n"}) {
    write_whole_file(folder / "a.txt", comment + "1 2 3\n4 5 6\n7 8 9.5\n");
    expect_three_points(read_cloud(folder / "a.txt"));
  }
}

TEST(TextTable, ExponentsMayBeFortrans) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.txt", "1.0D0 0.2d+01 +3.0D00\n4.0D0 5.0D0 0.6D+1\n7.D0 80.0d-1 9.5D0\n");
  expect_three_points(read_cloud(folder / "a.txt"));
}

TEST(TextTable, DecimalCommasAreRefusedWithAHint) {
  const TemporaryFolder folder;
  for (const std::string text : {"1,5;2,5;3,5\n", "x;y;z\n1,5;2,5;3,5\n", "x y z\n1 2 3\n1,5 2,5 3,5\n",
                                 "1;2;3\n1;2,5;3\n", "1,5\t2,25\t-3,5e2\n"}) {
    SCOPED_TRACE(text);
    write_whole_file(folder / "a.csv", text);
    expect_error(ErrorKind::bad_input, "has decimal commas, expected decimal points (12.5, not 12,5)",
                 [&] { read_cloud(folder / "a.csv"); });
  }
  write_whole_file(folder / "a.csv", "1, 2, 3\n4 ,5, 6\n7,8,9.5\n");
  expect_three_points(read_cloud(folder / "a.csv"));
}

TEST(TextTable, NumbersBeyondDoublePrecisionAreNamed) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "1,2,3\n1e-400,2,-1e400\n");
  expect_error(ErrorKind::bad_input, "line 2, column 3: '-1e400' is too large, expected at most 1.7e308",
               [&] { read_cloud(folder / "a.csv"); });
  write_whole_file(folder / "a.csv", "1,2,3\n1e-400,2,inf\n");
  EXPECT_THAT(read_cloud(folder / "a.csv").x, ElementsAre(1, 0));
}

TEST(Text, ReadsMassesAndWhatIsToBeShown) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "x,y,z,mass,metals\n1,2,3,4,0.5\n4,5,6,nan,0.25\n7,8,9,2,nan\n");
  Cloud cloud = read_cloud(folder / "a.csv", {.quantity = "metals"});
  EXPECT_EQ(cloud.mass[0], 4);
  EXPECT_EQ(cloud.quantity[1], 0.25f);
  // What has no mass, or nothing to show, is left out and counted.
  const SelectionCounts counts = select_particles(cloud, {});
  EXPECT_EQ(counts.weightless, 2u);
  EXPECT_EQ(cloud.size(), 1u);
  expect_error(ErrorKind::bad_input, "no column 'age', but x, y, z, mass, metals",
               [&] { read_cloud(folder / "a.csv", {.quantity = "age"}); });
}

}  // namespace wheatstone::text_table_test
