#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "output_option.h"
#include "print_facts.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/share/page.h"
#include "wheatstone/share/share_painting.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string file;
  std::string output = "page.html";
  PageWords words;
  std::string element;  ///< file for the element's code; empty: it is not wanted
};

void run(Arguments arguments, const Session& session) {
  const std::array<fs::path, 1> inputs{arguments.file};
  for (const std::string& output : {arguments.output, arguments.element}) check_not_an_input(output, inputs);
  if (arguments.words.title.empty()) arguments.words.title = fs::path(arguments.file).stem().string();
  report(session.progress, "reading", 0);
  const Painting painting = read_painting(arguments.file);
  report(session.progress, "sharing", 0);
  const std::string page = html_page(share_painting(painting, {.title = arguments.words.title}), arguments.words);
  write_whole_file(arguments.output, page);
  if (!arguments.element.empty()) write_whole_file(arguments.element, page_element_code());
  if (session.json) {
    print_facts(nlohmann::ordered_json{{"output", arguments.output}, {"bytes", page.size()}}, session);
    return;
  }
  fmt::print(session.output, "written to {} ({:.0f} kB)\n", arguments.output, static_cast<double>(page.size()) / 1000);
}

}  // namespace

void add_share_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("share", "Write a page that shows a painting with its depth in any browser");
  command->add_option("FILE", arguments->file, "Painting (.wst)")->required();
  add_output_option(*command, arguments->output, "Page: one HTML file, which needs nothing else");
  command->add_option("--title", arguments->words.title, "Title of the page; the name of the file by default");
  command->add_option("--caption", arguments->words.caption, "Text below the picture");
  command->add_option("--description", arguments->words.description,
                      "What the picture shows, for readers who cannot see it; the title by default");
  command->add_option("--element", arguments->element,
                      "Also write the code of the element <wheatstone-picture>, with which other pages embed this one, "
                      "to this .js file");
  command->footer(
      "Examples:\n"
      "  wheatstone share painting.wst -o page.html\n"
      "  wheatstone share painting.wst -o page.html --title Fruit --element wheatstone-picture.js");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace wheatstone::cli
