// What describes the program to a system: manual pages, completions, and files for the desktop.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "cli/program.h"
#include "completion.h"
#include "manual_page.h"
#include "temporary_folder.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::packaging::packaging_test {

using testing::HasSubstr;

struct Output {
  std::string text;
  int code = -1;
};

/// Runs a line of the shell; its standard error is in the text, too.
Output shell(const std::string& line) {
  Output output;
  FILE* pipe = ::popen(("{ " + line + "; } 2>&1").c_str(), "r");
  char bytes[4096];
  for (std::size_t read = 0; (read = std::fread(bytes, 1, sizeof(bytes), pipe)) > 0;) output.text.append(bytes, read);
  output.code = ::pclose(pipe);
  return output;
}

bool has_program(const std::string& name) { return shell("command -v " + name).code == 0; }

class Described : public testing::Test {
 protected:
  std::ostringstream output_, errors_;
  cli::Session session_{.output = output_, .errors = errors_};
  std::unique_ptr<CLI::App> program_ = cli::make_program(session_);
  TemporaryFolder folder_;

  void for_each_command(const std::function<void(const CLI::App&)>& visit) const {
    const std::function<void(const CLI::App&)> visit_all = [&](const CLI::App& command) {
      visit(command);
      for (const CLI::App* below : command.get_subcommands({})) visit_all(*below);
    };
    visit_all(*program_);
  }
};

TEST_F(Described, ManualPagesHaveEveryOptionAndFormatWithoutWarnings) {
  if (!has_program("groff")) GTEST_SKIP() << "groff is not installed";
  for_each_command([&](const CLI::App& command) {
    const std::string page = manual_page(command, "2026-11-22", "0.0");
    put_bytes(folder_ / "page.1", page);
    // Overstruck letters are bold on a printer.
    const Output shown = shell(fmt::format("groff -K utf8 -man -ww -Tutf8 -P-c -rLL=200n {} | sed 's/.\x08//g'",
                                           (folder_ / "page.1").string()));
    EXPECT_EQ(shown.code, 0);
    const auto has = [&](const std::string& text) { return shown.text.find(text) != std::string::npos; };
    EXPECT_FALSE(has("warning")) << words_of(command);
    EXPECT_TRUE(has(words_of(command)));
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) EXPECT_TRUE(has("--" + name)) << words_of(command) << name;
  });
}

TEST_F(Described, BashOffersCommandsOptionsAndValues) {
  put_bytes(folder_ / "completion", bash_completion(*program_));
  const auto offered = [&](const std::string& words, int count) {
    return shell(fmt::format(
                     "bash -c 'source {}; COMP_WORDS=({}); COMP_CWORD={}; _wheatstone; echo \"${{COMPREPLY[*]}}\"'",
                     (folder_ / "completion").string(), words, count))
        .text;
  };
  EXPECT_EQ(offered("wheatstone rot", 1), "rotoscope\n");
  EXPECT_EQ(offered("wheatstone synth fi", 2), "film\n");
  EXPECT_THAT(offered("wheatstone render snap.hdf5 --meth", 3), HasSubstr("--method"));
  EXPECT_EQ(offered("wheatstone render --method e", 3), "exact\n");
  EXPECT_EQ(offered("wheatstone paint --seed 3 left.png --rectify al", 6), "always\n");
}

TEST_F(Described, ZshAndFishCompletionsAreWellFormed) {
  const std::string zsh = zsh_completion(*program_), fish = fish_completion(*program_);
  EXPECT_THAT(zsh, HasSubstr("_wheatstone_synth_film()"));
  EXPECT_THAT(fish,
              HasSubstr("-n '__fish_seen_subcommand_from render' -l method -x -a 'auto exact incremental layered'"));
  put_bytes(folder_ / "_wheatstone", zsh);
  put_bytes(folder_ / "wheatstone.fish", fish);
  for (const auto& [name, check, file] :
       {std::array{"zsh", "zsh -n", "_wheatstone"}, std::array{"fish", "fish --no-execute", "wheatstone.fish"}}) {
    if (!has_program(name)) continue;
    const Output checked = shell(fmt::format("{} {}", check, (folder_ / file).string()));
    EXPECT_EQ(checked.code, 0) << checked.text;
  }
}

TEST_F(Described, ThumbnailsAreSmallPicturesOfPaintings) {
  const auto thumbnail = [&](const std::string& words) {
    return shell(fmt::format("cd {} && {} {}", (folder_ / ".").string(), WHEATSTONE_THUMBNAIL, words));
  };
  write_painting(folder_ / "p.wst", {StrokePainting{.width = 400, .height = 300}});
  EXPECT_EQ(thumbnail("p.wst p.png 128").code, 0);
  const Image<Rgb8> picture = read_image(folder_ / "p.png");
  EXPECT_EQ(picture.width(), 128);
  EXPECT_EQ(picture.height(), 96);
  put_bytes(folder_ / "bad.wst", "not a painting");
  const Output refused = thumbnail("bad.wst bad.png 128");
  EXPECT_EQ(refused.code >> 8, 3);
  EXPECT_THAT(refused.text, HasSubstr("wheatstone-thumbnail: bad.wst: "));
  EXPECT_EQ(thumbnail("p.wst p.png huge").code >> 8, 2);
}

TEST_F(Described, FilesForTheDesktopAreValid) {
  const std::string desktop = WHEATSTONE_DESKTOP;
  const auto expect_valid = [](const std::string& program, const std::string& words) {
    if (!has_program(program)) return;
    EXPECT_EQ(shell(program + " " + words).text, "");
  };
  expect_valid("desktop-file-validate", desktop + "/wheatstone.desktop");
  expect_valid("xmllint", "--noout " + desktop + "/*.xml " + desktop + "/*.svg");
  EXPECT_THAT(bytes_of(desktop + "/wheatstone.desktop"), HasSubstr("Exec=wheatstone-view %F"));
}

}  // namespace wheatstone::packaging::packaging_test
