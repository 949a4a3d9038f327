#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "command.h"
#include "study_kinds.h"
#include "study_run_arguments.h"
#include "wheatstone/study/study_folder.h"
#include "window_program.h"

namespace wheatstone::cli {
namespace {

void run_study_run(const StudyRunArguments& arguments, const Session& session) {
  // What is wrong with the design or the folder is said before there is a window; the window's program makes the
  // folder.
  const StudyDesign design = load_study_design(arguments.design);
  check_subject(design, arguments.subject - 1);
  check_study_folder(arguments.folder, design, false);
  check_stimuli(arguments.folder, design);
  session.output.flush();
  std::vector<std::string> words = study_run_words(arguments);
  words.insert(words.begin(), "study");
  if (const int code = run_window_program(words); code != 0) throw ErrorTold{code};
}

}  // namespace

void add_study_run(CLI::App& study, const Session& session) {
  const auto arguments = std::make_shared<StudyRunArguments>();
  CLI::App& command = *study.add_subcommand("run", "Run a subject's session in the window, on the full screen");
  command.fallthrough();
  add_study_run_options(command, *arguments);
  command.callback([arguments, &session] { run_study_run(*arguments, session); });
}

}  // namespace wheatstone::cli
