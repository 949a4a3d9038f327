#include "run.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "failure.h"
#include "interrupt.h"
#include "program.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/ranks/launch.h"

namespace wheatstone::cli {
namespace {

/// Says on one line what went wrong, as an object too where JSON is asked for, and hands the exit code on. Of ranks
/// that share the run, all end with what one of them says.
int fail(const Session& session, const Ranks::Failure& own) {
  auto [code, message] = session.ranks.fail(own);
  message = one_line(std::move(message));
  run_is_over(!session.ranks.alone());
  fmt::print(session.errors, "wheatstone: {}\n", message);
  session.errors.flush();
  if (session.json) {
    session.output << json_text({{"error", message}, {"exit_code", code}}) << '\n';
    session.output.flush();
  }
  return code;
}

/// What CLI11 found, in the words of our other messages.
std::string in_our_words(const CLI::ParseError& error) {
  std::string found = error.what();
  const std::string option = found.substr(0, found.find(": "));
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr)
    return fmt::format("--config: {}: cannot be read", found.substr(0, found.find(" was not readable")));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    if (found.find("At Most 1 ") != std::string::npos)
      return fmt::format("{}: is given {} times, expected once", option, found.substr(found.rfind(' ') + 1));
    if (found.ends_with(" missing")) return fmt::format("{}: is given without a value", option);
  }
  return found;
}

/// Number of letters that are inserted, removed or replaced to make one word of the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// The command whose name differs from a word by at most two letters and by the fewest; empty if there is none.
std::string command_like(const CLI::App& program, const std::string& word) {
  std::string alike;
  std::size_t least = 3;
  for (const CLI::App* command : program.get_subcommands({})) {
    const std::size_t distance = edit_distance(word, command->get_name());
    if (distance >= std::min(least, word.size())) continue;
    least = distance;
    alike = command->get_name();
  }
  return alike;
}

constexpr std::string_view no_subcommand = "A subcommand is required";  ///< CLI11's words

/// What is wrong where a command is missing below `above`, which is the program or a command that has kinds.
std::string missing_command(const CLI::App& program, const CLI::App& above, const std::string& hint) {
  const bool has_kinds = &above != &program;
  const std::vector<std::string> words = program.remaining(true);
  std::string expected;
  for (const CLI::App* kind : above.get_subcommands({}))
    expected += fmt::format("{}{}", expected.empty() ? "" : ", ", kind->get_name());
  if (has_kinds && (words.empty() || words.front().starts_with('-')))
    return fmt::format("{}: its kind is missing, expected {}; {}", above.get_name(), expected, hint);
  if (words.empty()) return fmt::format("no command given; {}", hint);
  const std::string no_such = has_kinds ? fmt::format("{} {}: no such kind", above.get_name(), words.front())
                                        : fmt::format("{}: no such command", words.front());
  if (const std::string alike = command_like(above, words.front()); !alike.empty())
    return fmt::format("{}; did you mean '{}'? {}", no_such, alike, hint);
  return has_kinds ? fmt::format("{}, expected {}; {}", no_such, expected, hint) : fmt::format("{}; {}", no_such, hint);
}

/// What is wrong with the line, and where to read on.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto commands = program.get_subcommands();
  const std::string hint = commands.empty() ? "see 'wheatstone --help'"
                                            : fmt::format("see 'wheatstone {} --help'", commands.front()->get_name());
  const std::string found = error.what();
  if (dynamic_cast<const CLI::ConfigError*>(&error) != nullptr) {
    return fmt::format("--config: unknown option '{}' in the file; {}", found.substr(found.rfind(' ') + 1), hint);
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && (commands.empty() || found == no_subcommand))
    return missing_command(program, commands.empty() ? program : *commands.front(), hint);
  return fmt::format("{}; {}", in_our_words(error), hint);
}

/// Says where the processor did what a graphics processor had begun.
void tell_of_gpu(const Session& session) {
  const std::string why = why_left_by_gpu();
  if (!why.empty() && !session.quiet) fmt::print(session.errors, "wheatstone: the cpu finished the work; {}\n", why);
}

/// At most so many threads for TBB and OpenCV, as long as it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : tbb_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        opencv_before_(cv::getNumThreads()) {
    cv::setNumThreads(threads);
  }
  ~ThreadLimit() { cv::setNumThreads(opencv_before_); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  tbb::global_control tbb_;
  int opencv_before_;
};

/// Where mpirun has started several processes, those of a command that can share its work.
void share_with_ranks(const CLI::App& program, Session& session) {
  const std::optional<Launch> launch = mpi_launch();
  if (!launch || launch->count == 1) return;
  const std::string command = program.get_subcommands().front()->get_name();
  if (command != "render" && command != "rotoscope")
    throw Error(ErrorKind::wrong_usage, fmt::format("mpirun started {} processes, but '{}' works in one process; only "
                                                    "'render' and 'rotoscope' share their work",
                                                    launch->count, command));
  session.ranks = start_ranks(*launch);
}

int run_program(std::span<const std::string> arguments, Session& session, ProgressDisplay::Style progress) {
  std::optional<ProgressDisplay> display;
  std::optional<ThreadLimit> thread_limit;
  const std::unique_ptr<CLI::App> program = make_program(session);
  if (arguments.empty()) {
    session.output << program->help();
    return 0;
  }
  // Runs when the whole line is understood and before the command does.
  program->parse_complete_callback([&] {
    share_with_ranks(*program, session);
    display.emplace(session.quiet ? ProgressDisplay::Style::none : progress, session.errors);
    session.progress = [&display](std::string_view step, double done) {
      throw_if_interrupted();
      display->show(step, done);
    };
    session.clear_progress = [&display] { display->clear(); };
    if (session.threads > 0) thread_limit.emplace(session.threads);
  });

  try {
    // CLI11 takes the last word first.
    program->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    tell_of_gpu(session);
    session.ranks.meet();
    // A signal that comes after the last report of progress comes too late: the results have their names.
    run_is_over();
    return 0;
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    if (asked_for_help) return program->exit(error, session.output, session.errors);
    const bool missing_file = dynamic_cast<const CLI::FileError*>(&error) != nullptr;
    throw Error(missing_file ? ErrorKind::bad_input : ErrorKind::wrong_usage, usage_message(*program, error));
  } catch (const ErrorTold& told) {
    return told.exit_code;
  }
}

/// A result must reach its reader: a full disk or a closed pipe behind the output is an error.
void check_output(const Session& session) {
  session.output.flush();
  if (!session.output) throw Error(ErrorKind::cannot_read_write, "standard output: cannot write");
}

}  // namespace

int run_command_line(std::span<const std::string> arguments, std::ostream& output, std::ostream& errors,
                     ProgressDisplay::Style progress, const std::function<void()>& begin) {
  Session session{output, errors};
  // Known before the line is understood, so that a line that is not gets its error as JSON too.
  session.json = std::ranges::find(arguments, "--json") != arguments.end();
  try {
    if (begin) begin();
    const int code = run_program(arguments, session, progress);
    check_output(session);
    return code;
  } catch (...) {
    return fail(session, failure_of(std::current_exception()));
  }
}

}  // namespace wheatstone::cli
