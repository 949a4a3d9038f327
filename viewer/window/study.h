#pragma once

namespace wheatstone::viewer {

/// The part of the program that runs a subject's session. `argv` begins with the word "study". Returns the
/// exit code. Throws Error.
int run_study(int argc, char** argv);

}  // namespace wheatstone::viewer
