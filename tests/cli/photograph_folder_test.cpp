// A folder of photographs for the commands that take one beside `paint`, and a run that is killed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"
#include "scenes/exif_data.h"
#include "scenes/test_photographs.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::photograph_folder_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A pair whose pictures differ by a few rows, a file with both views below it, a damaged file, and one view.
void write_photographs(const fs::path& folder) {
  const StereoPair still = still_for_test(192, 144);
  fs::create_directories(folder / "trip");
  write_image(folder / "a_L.png", still.left);
  Image<Rgb8> right(192, 142);
  for (int y = 0; y < 142; ++y) std::ranges::copy(still.right.row(y), right.row(y).begin());
  write_image(folder / "a_R.png", right);
  const ImageView<const Rgb8> views[] = {still.left, still.right};
  write_mpo(folder / "trip/b.mpo", views, 95, {.title = "Fruit & flowers"});
  write_image(folder / "flat.png", still.left);
  put_bytes(folder / "cut.jpg", bytes_of(folder / "trip/b.mpo").substr(0, 3000));
}

ProgramResult run_in(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.emplace_back("--quiet");
  return run_program(words, {.folder = folder / ""});
}

TEST(FolderCommands, WorkOnEachPhotographAsOnOne) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  for (const auto& [command, options, output, alone] :
       std::vector<std::tuple<std::string, std::vector<std::string>, std::string, std::string>>{
           {"match", {}, "trip/b", "one"},
           {"rectify", {}, "trip/b", "one"},
           {"pack", {"--to", "anaglyph"}, "trip/b.png", "one.png"},
           {"pack", {"--to", "jps"}, "trip/b.jps", "one.jps"},
           {"pack", {"--to", "card"}, "trip/b.pdf", "one.pdf"},
           {"pack", {"--to", "views"}, "trip/b", "one"}}) {
    SCOPED_TRACE(command + " " + output);
    std::vector<std::string> all{command, "photos", "-o", "out", "--json"},
        single{command, "photos/trip/b.mpo", "-o", alone};
    all.insert(all.end(), options.begin(), options.end());
    single.insert(single.end(), options.begin(), options.end());
    const ProgramResult result = run_in(folder, all);
    EXPECT_EQ(result.exit_code, 3) << result.errors;
    const nlohmann::json facts = nlohmann::json::parse(result.output);
    EXPECT_EQ(facts["failed"], 1);
    EXPECT_EQ(facts["left_out"].size(), 1U);
    EXPECT_EQ(facts["photographs"].size(), 3U);
    EXPECT_EQ(run_in(folder, single).exit_code, 0);
    const fs::path made = folder / "out" / output, expected = folder / alone;
    if (fs::is_directory(expected)) {
      for (const std::string& file : files_in(expected))
        EXPECT_EQ(bytes_of(made / file), bytes_of(expected / file)) << file;
      EXPECT_EQ(files_in(made), files_in(expected));
    } else {
      EXPECT_EQ(bytes_of(made), bytes_of(expected));
    }
    fs::remove_all(folder / "out");
    fs::remove_all(folder / alone);
  }
}

TEST(FolderCommands, NameTheirResults) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  run_in(folder, {"pack", "photos", "--to", "anaglyph", "--format", "jpg", "--name", "{name}-{to}", "-o", "out"});
  EXPECT_EQ(files_in(folder / "out"), (std::set<std::string>{"a-anaglyph.jpg", "b-anaglyph.jpg"}));
  const ProgramResult again = run_in(folder, {"pack", "photos", "--to", "anaglyph", "--format", "jpg", "--name",
                                              "{name}-{to}", "-o", "out", "--skip-existing"});
  EXPECT_THAT(again.output, HasSubstr("0 of 0 photographs packed, 2 packed before"));
  const auto refused = [&](const std::string& name, const std::string& part) {
    expect_refused(folder, {"match", "photos", "--name", name, "-o", "new", "--quiet"}, 2, part);
  };
  refused("{style}", "--name: has {style}, which stands for nothing, expected {stem}, {name}");
  refused("same", "the same name 'same'");
  refused("../{stem}", "expected a name within the output");
  refused("/{stem}", "expected a name within the output");
  refused("", "expected a name within the output");
  expect_refused(folder, {"match", "photos/trip/b.mpo", "--name", "{stem}", "-o", "new"}, 2, "it works on a folder");
  expect_refused(folder, {"match", "photos", "photos/a_L.png", "-o", "new"}, 3,
                 "expected no other photograph beside it");
}

TEST(FolderCommands, MakeAGalleryOfPages) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  const ProgramResult result = run_in(folder, {"share", "photos", "--title", "A day out", "-o", "gallery"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output, HasSubstr("gallery: gallery/index.html"));
  EXPECT_EQ(files_in(folder / "gallery"),
            (std::set<std::string>{"a.html", "a.jpg", "index.html", "trip", "trip/b.html", "trip/b.jpg"}));
  const std::string gallery = bytes_of(folder / "gallery/index.html");
  for (const char* part : {"<h1>A day out</h1>", "href=\"a.html\"", "href=\"trip/b.html\"", "src=\"trip/b.jpg\""})
    EXPECT_THAT(gallery, HasSubstr(part));
  EXPECT_GT(read_image(folder / "gallery/a.jpg").width(), 100);
}

TEST(FolderCommands, GoOnWhereARunWasKilled) {
  const TemporaryFolder folder;
  const StereoPair still = still_for_test(240, 180);
  fs::create_directory(folder / "photos");
  for (int i = 0; i < 6; ++i)
    write_image(folder / ("photos/p" + std::to_string(i) + "_sbs.png"), joined(still.left, still.right, true));
  const auto paint = [&](const std::string& output, const ProgramRun& run, std::vector<std::string> more) {
    std::vector<std::string> words{"paint", "photos", "-o", output, "--style", "impressionist", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words, run);
  };
  const ProgramRun here{.folder = folder / ""};
  EXPECT_EQ(paint("whole", here, {"--threads", "1"}).exit_code, 0);
  ProgramRun killed = here;
  killed.while_running = [&](int process) {
    const auto is_one_there = [&] {
      for (int i = 0; i < 6; ++i)
        if (fs::exists(folder / ("out/p" + std::to_string(i) + "_sbs/report.json"))) return true;
      return false;
    };
    for (int tries = 0; tries < 3000 && !is_one_there(); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(process, SIGKILL);
  };
  EXPECT_EQ(paint("out", killed, {}).exit_code, 128 + SIGKILL);
  const ProgramResult rest = paint("out", here, {"--skip-existing", "--json"});
  EXPECT_EQ(rest.exit_code, 0) << rest.errors;
  const nlohmann::json facts = nlohmann::json::parse(rest.output);
  EXPECT_GE(facts["skipped"], 1);
  EXPECT_EQ(facts["painted"].get<int>() + facts["skipped"].get<int>(), 6);
  for (int i = 0; i < 6; ++i)
    for (const std::string file : {"left.png", "right.png", "painting.wst", "left_disparity.pfm", "anaglyph.png"}) {
      const std::string name = "p" + std::to_string(i) + "_sbs/" + file;
      EXPECT_EQ(bytes_of(folder / "out" / name), bytes_of(folder / "whole" / name)) << name;
    }
}

TEST(PaintCommand, ItsPicturesSayWhatThePhotographSays) {
  const TemporaryFolder folder;
  const StereoPair still = still_for_test(96, 72);
  const ImageView<const Rgb8> views[] = {still.left, still.right};
  write_mpo(folder / "photo.mpo", views, 95, {.exif = exif_data("Fruit")});
  EXPECT_EQ(run_in(folder, {"paint", "photo.mpo", "--range", "0:12", "--format", "jpg", "-o", "out"}).exit_code, 0);
  for (const char* name : {"out/left.jpg", "out/anaglyph.jpg"}) {
    EXPECT_EQ(read_photograph_notes(folder / name).title, "Fruit") << name;
    EXPECT_EQ(read_photograph_notes(folder / name).taken, "2019:07:18 14:03:22") << name;
  }
  const std::string without = read_photograph_notes(folder / "out/left.jpg", true).exif;
  run_in(folder, {"paint", "photo.mpo", "--range", "0:12", "--format", "jpg", "--keep-location", "-o", "placed"});
  EXPECT_GT(read_photograph_notes(folder / "placed/left.jpg", true).exif.size(), without.size());
}

TEST(FolderCommands, FrameAPairToItsCommonRows) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  const ProgramResult result =
      run_program({"match", "photos/a_L.png", "photos/a_R.png", "-o", "out"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors,
              HasSubstr("photos/a_L.png, photos/a_R.png: 192x144 and 192x142 pixels, framed to the common 192x142"));
  EXPECT_EQ(read_image(folder / "out/disparity.png").height(), 142);
}

}  // namespace wheatstone::photograph_folder_test
