// Conditions that particles are chosen by: their language, what holds where, and the formats whose quantities they
// name.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/random.h"

namespace wheatstone::condition_test {

using testing::ElementsAre;

/// Two columns of so many numbers, some of them whole so that they are equal to others, some of them none.
std::vector<QuantityColumn> two_columns(std::size_t count) {
  std::vector<QuantityColumn> columns(2);
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t hash = hash_keys({c + 1, i});
      columns[c].values.push_back(hash % 11 == 0 ? NAN : static_cast<double>(hash % 9) - 4);
    }
  return columns;
}

std::vector<std::uint8_t> naive(const std::vector<QuantityColumn>& columns,
                                const std::function<bool(double a, double b)>& holds) {
  std::vector<std::uint8_t> answers;
  for (std::size_t i = 0; i < columns[0].values.size(); ++i)
    answers.push_back(holds(columns[0].values[i], columns[1].values[i]) ? 1 : 0);
  return answers;
}

TEST(Condition, HoldsWhereAProgramWrittenByHandSaysSo) {
  const std::vector<QuantityColumn> columns = two_columns(5000);
  const auto check = [&](const std::string& text, const std::function<bool(double a, double b)>& holds) {
    const Condition condition = parse_condition(text);
    EXPECT_THAT(condition.names, ElementsAre("a", "b")) << text;
    EXPECT_EQ(where_holds(condition, columns, 5000), naive(columns, holds)) << text;
  };
  check("a < 1 and b > -2", [](double a, double b) { return a < 1 && b > -2; });
  check("a<=1 or b>=+2e0", [](double a, double b) { return a <= 1 || b >= 2; });
  check("not a == 1 and b != 0", [](double a, double b) { return !(a == 1) && b != 0; });
  check("not (a == 1 and b != 0)", [](double a, double b) { return !(a == 1 && b != 0); });
  check("a < b", [](double a, double b) { return a < b; });
  check("a == 1 or a == 2 and b < 0", [](double a, double b) { return a == 1 || (a == 2 && b < 0); });
  check("(a == 1 or a == 2) AND b < 0", [](double a, double b) { return (a == 1 || a == 2) && b < 0; });
  check("-1.5e0 < a and not not (.5 >= b)", [](double a, double b) { return -1.5 < a && .5 >= b; });
  check("((a > 0 or b > 0) and (a < 3 or b < 3)) or not (a <= b)",
        [](double a, double b) { return ((a > 0 || b > 0) && (a < 3 || b < 3)) || !(a <= b); });
}

TEST(Condition, NamesQuantitiesAsFilesDo) {
  EXPECT_THAT(parse_condition("velocity-x>1 or /gas/T[K] < 3 and \"my density\" == 2 or \"3\" < 1 and B-V > B-V").names,
              ElementsAre("velocity-x", "/gas/T[K]", "my density", "3", "B-V"));
}

TEST(Condition, ComparesFloatsWithNumbersAsTheyArePrinted) {
  const std::vector<QuantityColumn> floats{{{static_cast<double>(0.1f), static_cast<double>(0.2f)}, true}};
  EXPECT_THAT(where_holds(parse_condition("a == 0.1"), floats, 2), ElementsAre(1, 0));
  EXPECT_THAT(where_holds(parse_condition("a <= 0.1"), floats, 2), ElementsAre(1, 0));
  const std::vector<QuantityColumn> doubles{{{static_cast<double>(0.1f), 0.1}, false}};
  EXPECT_THAT(where_holds(parse_condition("a == 0.1"), doubles, 2), ElementsAre(0, 1));
  // What a float cannot hold stays what it is.
  const std::vector<QuantityColumn> zero{{{0, 1}, true}};
  EXPECT_THAT(where_holds(parse_condition("a < 1e-60"), zero, 2), ElementsAre(1, 0));
  EXPECT_THAT(where_holds(parse_condition("a < 1e300"), zero, 2), ElementsAre(1, 1));
}

TEST(Condition, SaysWhereItsTextIsWrong) {
  const auto refuses = [](const std::string& text, const std::string& words) {
    expect_error(ErrorKind::wrong_usage, "--where: " + words, [&] { parse_condition(text, "--where"); });
  };
  refuses("", "expected a number or a quantity at the end of ''");
  refuses("Density <", "expected a number or a quantity at the end of 'Density <'");
  refuses("Density = 3", "expected one of < <= > >= == != at character 9, '= 3'");
  refuses("Density", "expected one of < <= > >= == != at the end of 'Density'");
  refuses("Density > 1 && Mass < 2", "expected 'and' or 'or' at character 13, '&& Mass < 2'");
  refuses("1 < Density < 2", "expected 'and' between two comparisons at character 13, '< 2'");
  refuses("(Density < 2", "expected ')' at the end of '(Density < 2'");
  refuses("Density < 2)", "expected 'and' or 'or' at character 12, ')'");
  refuses("1 < 2", "expected a quantity on one side at character 3, '< 2'");
  refuses("Density < 1e6K", "expected a number, or a name in double quotes, at character 11, '1e6K'");
  refuses("Density < 1e999", "expected a number of magnitude 1e-307 to 1e308 at character 11, '1e999'");
  refuses("and > 1", "expected a number or a quantity at character 1, 'and > 1'");
  refuses("\"Density > 1", "expected a second double quote after that at character 1");
  refuses(std::string(101, '(') + "a<1", "expected at most 100 parentheses and 'not' within each other");
  refuses(std::string(20000, ' '), "is 20000 characters long, expected at most 10000");
  EXPECT_EQ(parse_condition(std::string(100, '(') + "a<1" + std::string(100, ')')), parse_condition("a<1"));
}

/// x of the particles of a file that a condition chooses.
std::vector<float> chosen_x(const std::filesystem::path& file, const std::string& where, CloudChoice choice = {}) {
  choice.where = parse_condition(where);
  Cloud cloud = read_cloud(file, choice);
  select_particles(cloud, {});
  return cloud.x;
}

TEST(Condition, ChoosesFromATable) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a.csv", "id,x,y,z,rho,Metals\n1,1,0,0,10,.02\n2,2,0,0,20,.01\n3,3,0,0,30,nan\n");
  EXPECT_THAT(chosen_x(folder / "a.csv", "metals == 0.02"), ElementsAre(1));
  EXPECT_THAT(chosen_x(folder / "a.csv", "not metals == 0.02"), ElementsAre(2, 3));
  EXPECT_THAT(chosen_x(folder / "a.csv", "density > 10 and id < 3"), ElementsAre(2));  // the cloud's own name of rho
  EXPECT_THAT(chosen_x(folder / "a.csv", "x >= 2"), ElementsAre(2, 3));
  expect_error(ErrorKind::bad_input, "a.csv: has no quantity 'Temperature', but id, x, y, z, rho, Metals, density",
               [&] { chosen_x(folder / "a.csv", "Temperature > 1"); });
}

TEST(Condition, ChoosesFromPly) {
  const TemporaryFolder folder;
  const std::string header =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar class\nproperty float q\n"
      "end_header\n";
  write_whole_file(folder / "a.ply", "ply\nformat ascii 1.0\n" + header + "1 0 0 2 .1\n2 0 0 5 .2\n3 0 0 2 .3\n");
  EXPECT_THAT(chosen_x(folder / "a.ply", "class == 2 and q > 0.1"), ElementsAre(3));
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + header;
  const auto put = [&](float number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
  for (int i = 1; i <= 3; ++i) {
    for (const float number : {static_cast<float>(i), 0.f, 0.f}) put(number);
    bytes += i == 2 ? '\5' : '\2';
    put(static_cast<float>(i) / 10);
  }
  write_whole_file(folder / "b.ply", bytes);
  EXPECT_THAT(chosen_x(folder / "b.ply", "class == 2 and q > 0.1"), ElementsAre(3));
}

TEST(Condition, ChoosesTheSameInChunksOfAnySize) {
  const TemporaryFolder folder;
  std::string text = "x y z a\n";
  for (int i = 0; i < 3000; ++i) text += fmt::format("{} 0 0 {}\n", i, i * 37 % 100);
  write_whole_file(folder / "a.txt", text);
  const std::vector<float> whole = chosen_x(folder / "a.txt", "a < 30 or x == 7");
  EXPECT_EQ(whole.size(), 901u);
  for (const std::size_t most : {1, 7, 999, 1001}) {
    const CloudSource source = open_cloud(folder / "a.txt", {.where = parse_condition("a < 30 or x == 7")});
    std::vector<float> joined;
    std::uint64_t first = 0, unchosen = 0;
    for (Cloud chunk = source.next(most); chunk.size() > 0; chunk = source.next(most)) {
      const std::size_t read = chunk.size();
      unchosen += select_particles(chunk, {}, first).unchosen;
      first += read;
      joined.insert(joined.end(), chunk.x.begin(), chunk.x.end());
    }
    EXPECT_EQ(joined, whole) << most;
    EXPECT_EQ(unchosen, 3000 - 901u) << most;
  }
}

TEST(Condition, IsCheckedBeforeWhatIsLeftOutForOtherReasons) {
  Cloud cloud;
  cloud.x = {1, NAN, 3, 4};
  cloud.y = cloud.z = {0, 0, 0, 0};
  cloud.chosen = {1, 0, 1, 0};
  const SelectionCounts counts = select_particles(cloud, {.cut = Sphere{{3, 0, 0}, 1}});
  EXPECT_EQ(counts.unchosen, 2u);
  EXPECT_EQ(counts.dropped, 0u);
  EXPECT_THAT(cloud.x, ElementsAre(3));
  EXPECT_TRUE(cloud.chosen.empty());
}

}  // namespace wheatstone::condition_test
