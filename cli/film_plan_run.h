#pragma once

#include <string>

#include "commands.h"
#include "options.h"
#include "report.h"

namespace wheatstone::cli {

/// What is done with the plan of a film.
struct PlanArguments {
  bool draw = false, join = false;
  std::string part;  ///< of --draw: "1-48" or "2/4"
};

/// Whether the film that is given is a plan.
inline bool is_of_plan(const PlanArguments& arguments) { return arguments.draw || arguments.join; }

/// `plan_row`, which makes a plan, --draw, --frame-range and --join.
Rows plan_rows(PlanArguments& arguments, const Row& plan_row);

/// The rows of the command, of which those are refused with --draw and --join that have no effect there: a plan says
/// how its film is painted.
Rows refused_on_plans(Rows rows, const PlanArguments& arguments);

/// Draws a part of a plan, or joins its parts to `output` if that is given, or else to the film that the plan names.
Report run_plan(const PlanArguments& arguments, const std::string& plan, const std::string& output, const Given& given,
                const Session& session);

}  // namespace wheatstone::cli
