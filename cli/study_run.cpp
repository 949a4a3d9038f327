#include "commands.h"
#include "interrupt.h"
#include "wheatstone/study/study_folder.h"
#include "window_program.h"

namespace wheatstone::cli {
namespace {

Report run_study_run(const StudyRunArguments& arguments, const Session& session) {
  // What is wrong with the design or the folder is said before there is a window; the window's program makes the
  // folder.
  const StudyDesign design = load_study_design(arguments.design);
  check_subject(design, arguments.subject - 1);
  check_study_folder(arguments.folder, design, false);
  check_stimuli(arguments.folder, design);
  std::vector<std::string> words = words_of(arguments.given);
  words.insert(words.begin(), "study");
  tell_what_is_kept([] { return std::string("run the session again to go on"); });
  return run_window_program(std::move(words), session);
}

}  // namespace

Command study_run_command() {
  return make_command(
      "run", "Run a subject's session in the window, on the full screen", study_run_rows, run_study_run,
      R"(Y and N answer yes and no, digits rate, space goes on, Escape breaks off. A session that was broken off goes on
where it stopped when it is run again.

Example:
  wheatstone study run path-searching-1 --subject 1 --screen-width 52cm --distance 70cm -o study)");
}

}  // namespace wheatstone::cli
