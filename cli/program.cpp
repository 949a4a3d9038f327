#include "program.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::cli {
namespace {

/// A command's help, which also tells of the options that all commands share.
class CommandHelp : public CLI::Formatter {
 public:
  /// CLI11 writes behind a flag's names what its second form sets: "--no-swap{false}".
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    for (std::size_t begin = name.find('{'); begin != std::string::npos; begin = name.find('{', begin)) {
      const std::size_t end = name.find('}', begin);
      name.erase(begin, end == std::string::npos ? end : end - begin + 1);
    }
    return name;
  }

  std::string make_footer(const CLI::App* app) const override {
    if (app->get_parent() == nullptr) return CLI::Formatter::make_footer(app);
    const CLI::App* program = app;
    while (program->get_parent() != nullptr) program = program->get_parent();
    const auto shared = program->get_options([](const CLI::Option* option) {
      return option->nonpositional() && option->get_group() == "Options" && !option->check_lname("help");
    });
    return make_group("Options of every command", false, shared).substr(1) + "\n" + CLI::Formatter::make_footer(app);
  }
};

/// Gives an app and all below it our form of help. `word` is what usage calls the next word of the line.
void lay_out_help(CLI::App& app, const std::string& word) {
  const auto help = std::make_shared<CommandHelp>();
  help->label("SUBCOMMAND", word);
  app.formatter(help);
  for (CLI::App* below : app.get_subcommands({})) {
    below->group(app.get_parent() == nullptr ? "Commands" : "Kinds");
    lay_out_help(*below, "KIND");
  }
}

void add_shared_options(CLI::App& program, Session& session) {
  add_rows(program,
           {row("--json", flag(session.json), "Print the result, or the error, as one JSON object"),
            row("--threads", number(session.threads, {0, 4096}), "Number of threads; 0 uses all processors"),
            row("--seed", number(session.seed, {0, 9.2e18}), "Random seed: the same seed gives the same bytes"),
            row("-v,--verbose", flag(session.verbose), "Verbose output"),
            row("--quiet", flag(session.quiet), "Print results and errors only", {}, {}, {"--verbose"})});
  program.set_config("--config", "", "TOML file with option values; those of a command stand under [COMMAND]")
      ->type_name("FILE.toml")
      ->check([](const std::string& name) {
        std::error_code missing;
        if (std::filesystem::is_other(name, missing)) check_plain_file(name, "a TOML file", Pipes::accepted);
        return std::string();
      });
  program.allow_config_extras(CLI::config_extras_mode::error);
  program.set_version_flag("--version", "wheatstone " WHEATSTONE_VERSION);
}

}  // namespace

std::unique_ptr<CLI::App> make_program(Session& session) {
  auto program = std::make_unique<CLI::App>(
      "Stereo and multi-view painterly rendering, and particle rendering for 3D displays.", "wheatstone");
  // Taken over by every command: what all share may stand before or behind the command's name.
  program->fallthrough();
  program->require_subcommand(1);
  program->footer(
      "Run 'wheatstone COMMAND --help' for the options of a command. Exit codes: 0 done, 2 wrong usage, 3 bad input,\n"
      "4 cannot read or write, 5 interrupted.");
  add_shared_options(*program, session);

  for (const Command& command :
       {calibrate_command(), rectify_command(), match_command(), paint_command(), pack_command(), rotoscope_command(),
        render_command(), share_command(), depth_command(),
        Command{
            .name = "measure",
    .help = "Measure the consistency of a result",
    .footer = "Example:\n  wheatstone measure stereo painted/left.png painted/right.png --photographs left.png "
              "right.png",
    .kinds = {measure_film_command(), measure_painting_command(), measure_stereo_command(), measure_views_command()}},
        Command{.name = "synth",
        .help = "Make synthetic input with exact ground truth",
        .footer = "Example:\n  wheatstone synth still -o still",
        .kinds = {synth_film_command(), synth_model_command(), synth_still_command(), synth_universe_command()}},
        Command{.name = "study",
        .help = "Plan, run, simulate and analyse experiments with people",
        .footer = "Example:\n  wheatstone study stimuli --count 4 -o stimuli",
        .kinds = {study_analyse_command(), study_design_command(), study_run_command(), study_simulate_command(),
                  study_stimuli_command()}},
        view_command(), info_command()})
    add_command(*program, command, session);
  lay_out_help(*program, "COMMAND");
  return program;
}

}  // namespace wheatstone::cli
