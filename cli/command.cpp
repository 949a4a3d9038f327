#include "command.h"

#include <fmt/ostream.h>

#include <CLI/CLI.hpp>

namespace wheatstone::cli {
namespace {

/// The one printer of what commands tell.
void print(const Report& report, const Session& session) {
  if (report.facts.empty()) return;
  if (session.json) {
    fmt::print(session.output, "{}\n", json_text(json_of(report)));
    return;
  }
  for (const Fact& fact : report.facts)
    if (!fact.text.empty()) fmt::print(session.output, "{}\n", fact.text);
}

void run(const Command& command, const CLI::App& app, const Session& session) {
  const Given given = given_on(app, command.rows);
  if (command.given != nullptr) *command.given = given;
  refuse_without_effect(command.rows, given);
  const Report report = command.run(session);
  print(report, session);
  for (const std::string& failure : report.failures) fmt::print(session.errors, "wheatstone: {}\n", one_line(failure));
  if (report.exit_code != 0) throw ErrorTold{report.exit_code};
}

}  // namespace

void remark(const Session& session, std::string_view line) {
  if (session.quiet) return;
  session.clear_progress();
  fmt::print(session.errors, "{}\n", line);
}

void add_command(CLI::App& above, const Command& command, const Session& session) {
  CLI::App& app = *above.add_subcommand(command.name, command.help);
  app.footer(command.footer);
  add_rows(app, command.rows);
  for (const Command& kind : command.kinds) add_command(app, kind, session);
  if (!command.kinds.empty()) app.require_subcommand(1);
  if (command.run) app.callback([command, &app, &session] { run(command, app, session); });
}

}  // namespace wheatstone::cli
