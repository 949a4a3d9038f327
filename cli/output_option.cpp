#include "output_option.h"

namespace wheatstone::cli {

CLI::Option* add_output_option(CLI::App& command, std::string& output, const std::string& description) {
  return command.add_option("-o,--output", output, description)->check(not_empty())->capture_default_str();
}

CLI::Validator not_empty() {
  return {[](const std::string& name) { return name.empty() ? "is empty, expected a name" : std::string(); }, ""};
}

}  // namespace wheatstone::cli
